// Objects of pictures are closed meshes.
#include <string_view>

#include <espalier/core/error.h>
#include <espalier/environment/closed_mesh.h>
#include <espalier/environment/scene_object.h>

namespace espalier {

namespace {

ClosedMesh read_mesh(const std::string& text, const std::string& file) {
  try {
    return read_closed_mesh(file);
  } catch (const InputError& error) {
    throw_input_error("got '{}' ({}), expected mesh:FILE, a closed mesh", text, error.what());
  }
}

}  // namespace

void add_object(const std::string& text, SceneObjects& objects) {
  constexpr std::string_view kMesh = "mesh:";
  if (!text.starts_with(kMesh)) throw_input_error("got '{}', expected mesh:FILE, a closed mesh", text);
  const ClosedMesh mesh = read_mesh(text, text.substr(kMesh.size()));
  const auto first = static_cast<std::uint32_t>(objects.vertices_m.size());
  objects.vertices_m.insert(objects.vertices_m.end(), mesh.vertices_m.begin(), mesh.vertices_m.end());
  objects.triangles.reserve(objects.triangles.size() + mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) objects.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace espalier
