// Predefined surfaces by name, for ~("leaf", scale): the leaf and the blossom that the settings choose, the
// outlines of the parametric model by their names (plant/leaf_outlines.h), and those of files
// [Herbaceous §6, ABOP §5.1].
#pragma once
#include <string_view>

#include <espalier/lsystem/strings/source.h>
#include <espalier/lsystem/surfaces/appearance.h>
#include <espalier/plant/leaf_outlines.h>

namespace espalier::lsystem {

/// Surfaces that every file has. In a string a surface is its index here; the file's own follow.
enum Surface : int {
  kLeafSurface,
  kBlossomSurface,
  kFirstLeafOutline,  ///< leaf shape 1
  kFirstBlossomOutline = kFirstLeafOutline + static_cast<int>(kLeafShapes.size()),
  kFirstOwnSurface = kFirstBlossomOutline + static_cast<int>(kBlossomShapes.size()),
};

/// The number that stands for a surface in a string. Throws InputError for an unknown name.
int surface_by_name(std::string_view name, const Appearance& appearance);

/// The triangles of an outline, kFirstLeafOutline and up, at unit size.
std::vector<Triangle> outline_triangles(int surface);

/// The surface in `file`: bicubic patches (.patch, lsystem/surfaces/patches.h) or a mesh (.obj, .ply, .stl,
/// .off, .glb), from the folder of the text that names it, or a bundled one where that text may read no
/// files. Throws InputError at `position` where it is in another folder, too large, or no surface.
std::vector<Triangle> read_surface(const std::string& file, bool may_read_files, const Position& position);

}  // namespace espalier::lsystem
