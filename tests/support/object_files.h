// Meshes of what stands beside plants, as OBJ files.
#pragma once
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include <espalier/core/vec3.h>

namespace espalier {

/// A closed box between two corners, in metres; without its last triangle it is open.
inline void write_box_obj(const std::filesystem::path& path, Vec3 lower, Vec3 upper, bool is_closed = true) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += fmt::format("v {} {} {}\n", i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y,
                        i & 4 ? upper.z : lower.z);
  text +=
      "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\n"
      "f 2 4 8\n";
  if (is_closed) text += "f 2 8 6\n";
  std::ofstream(path) << text;
}

}  // namespace espalier
