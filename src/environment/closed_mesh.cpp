// Reading closed meshes: their triangles are read, then vertices are welded by position and every
// edge is counted. Text and binary formats repeat the coordinates of shared vertices exactly, so welding
// compares bits and needs no tolerance.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <system_error>
#include <tuple>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/environment/closed_mesh.h>
#include <espalier/environment/meshes/mesh_triangles.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

struct MeshFormat {
  std::string extension;
  bool y_up;
};

/// glTF 2.0, section 3.4, fixes y up; the others have no rule and are taken as they are.
const std::array<MeshFormat, 6> kFormats{
    {{".obj", false}, {".ply", false}, {".stl", false}, {".off", false}, {".glb", true}, {".gltf", true}}};

const MeshFormat& format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const MeshFormat& format : kFormats)
    if (format.extension == extension) return format;
  throw_input_error("mesh '{}': unknown extension '{}', expected .obj, .ply, .stl, .off, .glb or .gltf",
                    path.string(), extension);
}

constexpr std::uintmax_t kMostBytes = 256u << 20;
constexpr std::size_t kMostTriangles = 20'000'000;

Vec3 z_up(Vec3 v, bool y_up) { return y_up ? Vec3{v.x, -v.z, v.y} : v; }

/// All triangles of the file, three vertices each.
std::vector<Vec3> triangle_soup(const fs::path& path) {
  const MeshFormat& format = format_of(path);
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (!fs::exists(status)) throw_input_error("mesh '{}': no such file", path.string());
  if (!fs::is_regular_file(status)) throw_input_error("mesh '{}': not a file", path.string());
  std::vector<Vec3> soup = read_mesh_triangles(read_file(path, kMostBytes), format.extension.substr(1),
                                               fmt::format("mesh '{}'", path.string()), kMostTriangles);
  for (Vec3& vertex : soup) vertex = z_up(vertex, format.y_up);
  return soup;
}

/// Gives each different position one index, in order of (x, y, z).
ClosedMesh weld(const std::vector<Vec3>& soup) {
  const auto before = [](Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  ClosedMesh mesh;
  mesh.vertices_m = soup;
  std::sort(mesh.vertices_m.begin(), mesh.vertices_m.end(), before);
  mesh.vertices_m.erase(std::unique(mesh.vertices_m.begin(), mesh.vertices_m.end()), mesh.vertices_m.end());
  const auto index = [&](Vec3 p) {
    const auto found = std::lower_bound(mesh.vertices_m.begin(), mesh.vertices_m.end(), p, before);
    return static_cast<std::uint32_t>(found - mesh.vertices_m.begin());
  };
  for (std::size_t i = 0; i + 2 < soup.size(); i += 3) {
    const std::array<std::uint32_t, 3> t{index(soup[i]), index(soup[i + 1]), index(soup[i + 2])};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
  }
  return mesh;
}

/// An edge, its lower vertex first; `forward` is 1 where the triangle runs that way, else -1.
struct EdgeUse {
  std::uint32_t low, high;
  int forward;
};

std::vector<EdgeUse> sorted_edges(const ClosedMesh& mesh) {
  std::vector<EdgeUse> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  std::sort(edges.begin(), edges.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.forward) < std::tie(b.low, b.high, b.forward);
  });
  return edges;
}

struct EdgeCounts {
  std::size_t edges = 0, open = 0, turned = 0;  ///< open: an odd number of triangles; turned: not oriented
};

EdgeCounts count_edges(const ClosedMesh& mesh) {
  const std::vector<EdgeUse> uses = sorted_edges(mesh);
  EdgeCounts counts;
  for (std::size_t i = 0; i < uses.size();) {
    int forward = 0;
    std::size_t j = i;
    for (; j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high; ++j)
      forward += uses[j].forward;
    ++counts.edges;
    counts.open += (j - i) % 2;
    counts.turned += forward != 0;
    i = j;
  }
  return counts;
}

struct Box {
  Vec3 lower, size;
  double volume() const { return double{size.x} * size.y * size.z; }
};

Box box_around(const std::vector<Vec3>& points) {
  Vec3 lower = points.front(), upper = lower;
  for (Vec3 p : points) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
  }
  return {lower, upper - lower};
}

/// a · (b × c), six times the volume of a tetrahedron at the origin.
double triple_product(Vec3 a, Vec3 b, Vec3 c) {
  return a.x * (double{b.y} * c.z - double{b.z} * c.y) + a.y * (double{b.z} * c.x - double{b.x} * c.z) +
         a.z * (double{b.x} * c.y - double{b.y} * c.x);
}

/// The volume that an oriented mesh encloses; negative where it is turned inside out.
double enclosed_volume(const ClosedMesh& mesh, Vec3 origin) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += triple_product(mesh.vertices_m[t[0]] - origin, mesh.vertices_m[t[1]] - origin,
                          mesh.vertices_m[t[2]] - origin);
  return sum / 6;
}

/// Flat meshes, and sheets whose two sides cancel. What a mesh without orientation encloses is unknown.
bool encloses_nothing(const ClosedMesh& mesh) {
  const Box box = box_around(mesh.vertices_m);
  if (box.volume() == 0) return true;
  return mesh.oriented && std::fabs(enclosed_volume(mesh, box.lower)) < 1e-6 * box.volume();
}

}  // namespace

ClosedMesh read_closed_mesh(const fs::path& path) {
  ClosedMesh mesh = weld(triangle_soup(path));
  if (mesh.triangles.empty())
    throw_input_error("mesh '{}': no triangles, expected a closed mesh", path.string());
  const EdgeCounts counts = count_edges(mesh);
  if (counts.open > 0)
    throw_input_error("mesh '{}': {} of {} edges are open, expected a closed mesh", path.string(),
                      counts.open, counts.edges);
  mesh.oriented = counts.turned == 0;
  if (encloses_nothing(mesh)) throw_input_error("mesh '{}': encloses no volume", path.string());
  return mesh;
}

}  // namespace espalier
