// Predefined surfaces by name, for ~("leaf", scale): the leaf and the blossom of the parametric model
// (plant/leaf_outlines.h).
#pragma once
#include <string_view>

#include "lsystem/source.h"

namespace espalier::lsystem {

enum class Surface { leaf, blossom };

/// The number that stands for a surface in a string. Throws InputError at `position` for an unknown name.
int surface_by_name(std::string_view name, const Position& position);

}  // namespace espalier::lsystem
