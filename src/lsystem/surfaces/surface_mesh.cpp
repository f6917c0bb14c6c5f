#include <espalier/core/error.h>
#include <espalier/environment/meshes/mesh_triangles.h>
#include <espalier/lsystem/strings/source.h>
#include <espalier/lsystem/surfaces/surface_mesh.h>

namespace espalier::lsystem {

namespace {

constexpr std::size_t kMostTriangles = 100'000;

}  // namespace

std::vector<Triangle> read_surface_mesh(const std::string& bytes, const std::string& format,
                                        const std::string& label) try {
  const std::vector<Vec3> soup =
      read_mesh_triangles(bytes, format, fmt::format("surface \"{}\"", label), kMostTriangles);
  if (soup.empty()) throw_input_error("surface \"{}\": got no triangles, expected some", label);
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < soup.size(); i += 3) triangles.push_back({soup[i], soup[i + 1], soup[i + 2]});
  return triangles;
} catch (const InputError& error) {
  throw InputError(one_line(error.what(), kLongestMessage));
}

}  // namespace espalier::lsystem
