// A plant of another L-system, grown once and copied wherever a string names it: hedges of a knot garden
// [Topiary §6, Fig. 12].
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <espalier/lsystem/strings/limits.h>
#include <espalier/lsystem/surfaces/appearance.h>
#include <espalier/plant/joints.h>

namespace espalier::lsystem {

/// For all plants of a file together, which are grown when it is read.
inline constexpr Limits kCopiedLimits{
    .lua_instructions = 1e8, .lua_memory_bytes = 64u << 20, .modules = 3'000'000, .work = 5e8, .steps = 1000};

/// The plant that is declared: of a file in the folder of the text that names it, after all its steps, with
/// these parameters and the default ones, and the seed among them (1 where there is none). One unit is one
/// metre. Throws InputError at its position where the file cannot be read or grown, at a number's where there
/// is no such parameter or its value is out of bounds. What it takes is taken off `left`.
std::shared_ptr<const JointedPlant> grow_copied(const PlantDeclaration& declaration, Limits& left);

}  // namespace espalier::lsystem
