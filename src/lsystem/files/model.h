// An L-system as a model: its searched parameters and the metres of its unit are the table, its derivation
// and interpretation the function from values and seed to a plant. It can then be rendered, exported and
// fitted like the parametric model.
#pragma once
#include <memory>
#include <string>

#include <espalier/plant/model.h>

namespace espalier::lsystem {

/// The model of an L-system file, or of a bundled one ("topiary_6.lsys"); its name is the text as given.
/// Throws InputError where there is none or it is no L-system.
std::unique_ptr<Model> make_model(const std::string& name_or_path);

}  // namespace espalier::lsystem
