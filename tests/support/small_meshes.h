// A cube in every format of meshes that is read, as small as it goes.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <espalier/core/text/base64.h>

namespace espalier::test {

inline constexpr std::array<std::array<int, 3>, 12> kCubeTriangles{{{0, 2, 1},
                                                                    {1, 2, 3},
                                                                    {4, 5, 6},
                                                                    {5, 7, 6},
                                                                    {0, 1, 4},
                                                                    {1, 5, 4},
                                                                    {2, 6, 3},
                                                                    {3, 6, 7},
                                                                    {0, 4, 2},
                                                                    {2, 4, 6},
                                                                    {1, 3, 5},
                                                                    {3, 7, 5}}};

/// Corner `i` of 0…7 of the cube from -1 to 1: bit 0 is x, 1 is y, 2 is z.
inline std::array<float, 3> cube_corner(int i) {
  return {i & 1 ? 1.f : -1.f, i & 2 ? 1.f : -1.f, i & 4 ? 1.f : -1.f};
}

template <typename Number>
std::string raw(Number value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

inline std::string corners_as_text(const std::string& begin) {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    text += begin;
    for (const float value : cube_corner(i)) text += value < 0 ? "-1 " : "1 ";
    text.back() = '\n';
  }
  return text;
}

inline std::string triangles_as_text(const std::string& begin, int first) {
  std::string text;
  for (const auto& triangle : kCubeTriangles) {
    text += begin;
    for (const int i : triangle) text += " " + std::to_string(i + first);
    text += '\n';
  }
  return text;
}

inline std::string obj_cube() { return corners_as_text("v ") + triangles_as_text("f", 1); }
inline std::string off_cube() { return "OFF\n8 12 0\n" + corners_as_text("") + triangles_as_text("3", 0); }

inline std::string ply_head(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ply_cube() { return ply_head("ascii") + corners_as_text("") + triangles_as_text("3", 0); }

inline std::string binary_ply_cube() {
  std::string bytes = ply_head("binary_little_endian");
  for (int i = 0; i < 8; ++i)
    for (const float value : cube_corner(i)) bytes += raw(value);
  for (const auto& triangle : kCubeTriangles) {
    bytes += '\x03';
    for (const int i : triangle) bytes += raw(i);
  }
  return bytes;
}

inline std::string stl_cube() {
  std::string bytes = std::string(80, ' ') + raw(std::uint32_t{12});
  for (const auto& triangle : kCubeTriangles) {
    bytes += std::string(12, '\0');
    for (const int i : triangle)
      for (const float value : cube_corner(i)) bytes += raw(value);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

inline std::string text_stl_cube() {
  std::string text = "solid cube\n";
  for (const auto& triangle : kCubeTriangles) {
    text += "facet normal 0 0 1\nouter loop\n";
    for (const int i : triangle) {
      text += "vertex";
      for (const float value : cube_corner(i)) text += value < 0 ? " -1" : " 1";
      text += '\n';
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid cube\n";
}

inline std::string gltf_numbers() {
  std::string bytes;
  for (int i = 0; i < 8; ++i)
    for (const float value : cube_corner(i)) bytes += raw(value);
  for (const auto& triangle : kCubeTriangles)
    for (const int i : triangle) bytes += raw(static_cast<std::uint16_t>(i));
  return bytes;  // 96 + 72
}

/// `nodes`: the JSON of the nodes, the first of which is the scene's; `uri` of the numbers, empty: in the
/// file.
inline std::string gltf(const std::string& uri, const std::string& nodes = R"({"mesh":0})") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
         R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{)" +
         (uri.empty() ? "" : R"("uri":")" + uri + R"(",)") +
         R"("byteLength":168}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":96},)"
         R"({"buffer":0,"byteOffset":96,"byteLength":72}],"accessors":[{"bufferView":0,"componentType":5126,)"
         R"("count":8,"type":"VEC3","min":[-1,-1,-1],"max":[1,1,1]},)"
         R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}]})";
}

inline std::string gltf_cube() {
  return gltf("data:application/octet-stream;base64," + base64(gltf_numbers()));
}

inline std::string glb_cube() {
  std::string json = gltf("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string numbers = gltf_numbers();
  const auto chunk = [](const std::string& bytes, const char* kind) {
    return raw(static_cast<std::uint32_t>(bytes.size())) + std::string(kind, 4) + bytes;
  };
  const std::string chunks = chunk(json, "JSON") + chunk(numbers, "BIN\0");
  return "glTF" + raw(std::uint32_t{2}) + raw(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

struct SmallMesh {
  const char* name;
  const char* format;
  std::string bytes;
};

inline const std::vector<SmallMesh>& small_meshes() {
  static const std::vector<SmallMesh> all{{"obj", "obj", obj_cube()},
                                          {"ply", "ply", ply_cube()},
                                          {"ply_binary", "ply", binary_ply_cube()},
                                          {"stl", "stl", stl_cube()},
                                          {"stl_text", "stl", text_stl_cube()},
                                          {"off", "off", off_cube()},
                                          {"gltf", "gltf", gltf_cube()},
                                          {"glb", "glb", glb_cube()}};
  return all;
}

}  // namespace espalier::test
