#include <algorithm>
#include <array>

#include <espalier/core/files.h>
#include <espalier/core/near_name.h>
#include <espalier/core/parameter_table.h>
#include <espalier/lsystem/surfaces/embedded_surfaces.h>
#include <espalier/lsystem/surfaces/patches.h>
#include <espalier/lsystem/surfaces/surface_mesh.h>
#include <espalier/lsystem/surfaces/surfaces.h>
#include <espalier/plant/leaf_outlines.h>

namespace espalier::lsystem {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, kFirstOwnSurface> kNames = [] {
  std::array<std::string_view, kFirstOwnSurface> names;
  names[kLeafSurface] = "leaf";
  names[kBlossomSurface] = "blossom";
  std::copy(kLeafShapes.begin(), kLeafShapes.end(), names.begin() + kFirstLeafOutline);
  std::copy(kBlossomShapes.begin(), kBlossomShapes.end(), names.begin() + kFirstBlossomOutline);
  return names;
}();
constexpr std::array<std::string_view, 5> kMeshExtensions{".obj", ".ply", ".stl", ".off", ".glb"};
constexpr std::uintmax_t kMostBytes = 16u << 20;

std::string bundled_text(const std::string& file, const Position& position) {
  for (const EmbeddedFile& surface : embedded_surfaces())
    if (file == fmt::format("{}.patch", surface.name)) return std::string(surface.text);
  throw_at(position, "got surface \"{}\", expected a bundled .patch file in an L-system that is no file",
           file);
}

std::string file_text(const std::string& file, const Position& position) {
  const fs::path path = note_file(file, *position.source);
  std::error_code none;
  const std::uintmax_t bytes = fs::file_size(path, none);
  if (!none && bytes > kMostBytes)
    throw_at(position, "surface \"{}\": got {} bytes, expected at most {}", file, bytes, kMostBytes);
  return read_file(path, kMostBytes);
}

}  // namespace

int surface_by_name(std::string_view name, const Appearance& appearance) {
  const auto built_in = std::find(kNames.begin(), kNames.end(), name);
  if (built_in != kNames.end()) return static_cast<int>(built_in - kNames.begin());
  std::vector<std::string> known(kNames.begin(), kNames.end());
  for (std::size_t i = 0; i < appearance.surfaces.size(); ++i) {
    if (appearance.surfaces[i].name == name) return kFirstOwnSurface + static_cast<int>(i);
    known.push_back(appearance.surfaces[i].name);
  }
  throw_input_error("got surface '{}', expected one of this file or a built-in one, the closest is \"{}\"",
                    one_line(name, kLongestMessage), closest_name(std::string(name), known));
}

std::vector<Triangle> outline_triangles(int surface) {
  const LeafOutline& outline = surface < kFirstBlossomOutline
                                   ? leaf_outline(surface - kFirstLeafOutline + 1)
                                   : blossom_outline(surface - kFirstBlossomOutline + 1);
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : outline.triangles)
    triangles.push_back({outline.vertices[a], outline.vertices[b], outline.vertices[c]});
  return triangles;
}

std::vector<Triangle> read_surface(const std::string& file, bool may_read_files, const Position& position) {
  const std::string extension = fs::path(file).extension().string();
  const bool is_patch = extension == ".patch";
  const bool is_mesh =
      std::find(kMeshExtensions.begin(), kMeshExtensions.end(), extension) != kMeshExtensions.end();
  // A file from a stranger must not show what else is on the disk.
  if (file.find('/') != std::string::npos || file.find('\\') != std::string::npos || !(is_patch || is_mesh))
    throw_at(
        position,
        "got surface \"{}\", expected a file in the same folder that ends with .patch, .obj, .ply, .stl, "
        ".off or .glb",
        file);
  const std::string text = may_read_files ? file_text(file, position) : bundled_text(file, position);
  return is_patch ? read_patches(text, file) : read_surface_mesh(text, extension.substr(1), file);
}

}  // namespace espalier::lsystem
