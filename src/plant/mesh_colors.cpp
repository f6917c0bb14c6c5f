#include <set>

#include <espalier/plant/mesh_colors.h>

namespace espalier {

namespace {

/// Keeps the upper bits of a channel; the rest repeat them, so that 255 stays 255.
std::uint8_t rounded(std::uint8_t channel, int bits) {
  const unsigned kept = channel >> (8 - bits);
  unsigned result = 0;
  for (int filled = 0; filled < 8; filled += bits)
    result |= bits <= 8 - filled ? kept << (8 - filled - bits) : kept >> (bits - 8 + filled);
  return static_cast<std::uint8_t>(result);
}

PartColor rounded(PartColor color, int bits) {
  if (!color.is_set) return color;
  return {rounded(color.r, bits), rounded(color.g, bits), rounded(color.b, bits), true};
}

/// Few enough bits for kMostColors: 2 always are.
int bits_for(const std::vector<PartColor>& colors) {
  for (int bits = 8; bits > 2; --bits) {
    std::set<PartColor> different;
    for (const PartColor color : colors) {
      different.insert(rounded(color, bits));
      if (different.size() > kMostColors) break;
    }
    if (different.size() <= kMostColors) return bits;
  }
  return 2;
}

/// Copies vertices into a part when its triangles first need them.
struct PartBuilder {
  TriangleMesh* part = nullptr;
  std::map<std::uint32_t, std::uint32_t> copies;

  std::uint32_t copy_of(const TriangleMesh& mesh, std::uint32_t vertex) {
    const auto [found, is_new] =
        copies.try_emplace(vertex, static_cast<std::uint32_t>(part->position_m.size()));
    if (is_new) {
      part->position_m.push_back(mesh.position_m[vertex]);
      part->normal.push_back(mesh.normal[vertex]);
      part->texture.push_back(mesh.texture[vertex]);
    }
    return found->second;
  }
};

}  // namespace

std::map<PartColor, TriangleMesh> split_by_color(const TriangleMesh& mesh) {
  std::map<PartColor, TriangleMesh> parts;
  std::map<PartColor, PartBuilder> builders;
  const int bits = bits_for(mesh.color);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const PartColor color = t < mesh.color.size() ? rounded(mesh.color[t], bits) : PartColor{};
    PartBuilder& builder = builders[color];
    builder.part = &parts[color];
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = builder.copy_of(mesh, mesh.triangles[t][k]);
    builder.part->triangles.push_back(corners);
  }
  return parts;
}

}  // namespace espalier
