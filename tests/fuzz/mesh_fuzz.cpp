// libFuzzer's target for meshes from strangers: what a PLY's head claims. With ESPALIER_FUZZ_WHOLE they are
// read, too, as the format that the first byte chooses; anything but triangles or one InputError of one line
// is a find.
#include <cstdint>
#include <cstdlib>
#include <string>

#include <espalier/core/error.h>
#include <espalier/environment/meshes/mesh_triangles.h>
#include <espalier/environment/meshes/ply_head.h>

namespace {

template <typename Read>
void read_or_refuse(Read read) {
  try {
    read();
  } catch (const espalier::InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static constexpr const char* kFormats[] = {"obj", "ply", "stl", "off", "glb", "gltf"};
  static const bool is_whole = std::getenv("ESPALIER_FUZZ_WHOLE") != nullptr;
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  read_or_refuse([&] { espalier::check_ply_head(bytes); });
  read_or_refuse([&] { espalier::check_ply_head("ply\n" + std::string(bytes)); });
  if (is_whole)
    read_or_refuse(
        [&] { espalier::read_mesh_triangles(bytes, kFormats[data[0] % 6], "mesh 'a'", 1'000'000); });
  return 0;
}
