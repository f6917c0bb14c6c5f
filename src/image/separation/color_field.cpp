#include <espalier/image/separation/color_field.h>

namespace espalier {

namespace {

constexpr float kWellKnown = 1;  ///< weight of a cell that needs nothing of its neighbours

int clamped(int value, int end) { return std::clamp(value, 0, end - 1); }

}  // namespace

SmoothField::SmoothField(int width_px, int height_px, int cell_px) : cell_px_(cell_px) {
  level_.width = (width_px + cell_px - 1) / cell_px;
  level_.height = (height_px + cell_px - 1) / cell_px;
  level_.cells.resize(static_cast<std::size_t>(level_.width) * level_.height);
}

void SmoothField::add(int x, int y, const ColorValue& value, float weight) {
  auto& cell = level_.cells[static_cast<std::size_t>(y / cell_px_) * level_.width + x / cell_px_];
  for (int c = 0; c < 3; ++c) cell[c] += weight * value[c];
  cell[3] += weight;
}

SmoothField::Level SmoothField::halved(const Level& fine) {
  Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
  coarse.cells.resize(static_cast<std::size_t>(coarse.width) * coarse.height);
  for (int y = 0; y < fine.height; ++y)
    for (int x = 0; x < fine.width; ++x) {
      const auto& from = fine.cells[static_cast<std::size_t>(y) * fine.width + x];
      auto& to = coarse.cells[static_cast<std::size_t>(y / 2) * coarse.width + x / 2];
      for (int c = 0; c < 4; ++c) to[c] += from[c];
    }
  for (auto& cell : coarse.cells)
    if (cell[3] > kWellKnown) {
      const float weight = cell[3];
      for (float& value : cell) value *= kWellKnown / weight;
    }
  return coarse;
}

/// What a cell does not know, the coarser level tells, linearly between its four nearest cells.
void SmoothField::fill_from(const Level& coarse, Level& fine) {
  for (int y = 0; y < fine.height; ++y)
    for (int x = 0; x < fine.width; ++x) {
      auto& cell = fine.cells[static_cast<std::size_t>(y) * fine.width + x];
      const float missing = kWellKnown - cell[3];
      if (missing <= 0) continue;
      const int near_x = x / 2, near_y = y / 2;
      const int far_x = clamped(near_x + (x % 2 == 0 ? -1 : 1), coarse.width),
                far_y = clamped(near_y + (y % 2 == 0 ? -1 : 1), coarse.height);
      const auto at = [&](int u, int v) {
        return coarse.cells[static_cast<std::size_t>(v) * coarse.width + u];
      };
      for (int c = 0; c < 4; ++c)
        cell[c] += missing * (0.5625f * at(near_x, near_y)[c] + 0.1875f * at(far_x, near_y)[c] +
                              0.1875f * at(near_x, far_y)[c] + 0.0625f * at(far_x, far_y)[c]);
    }
}

bool SmoothField::fill() {
  for (auto& cell : level_.cells)
    if (cell[3] > kWellKnown) {
      const float weight = cell[3];
      for (float& value : cell) value *= kWellKnown / weight;
    }
  std::vector<Level> pyramid{std::move(level_)};
  while (pyramid.back().width > 1 || pyramid.back().height > 1) pyramid.push_back(halved(pyramid.back()));
  const bool is_known = pyramid.back().cells.front()[3] > 0;
  if (is_known) {
    auto& top = pyramid.back().cells.front();
    const float weight = top[3];
    for (float& value : top) value /= weight;
    for (std::size_t i = pyramid.size() - 1; i > 0; --i) fill_from(pyramid[i], pyramid[i - 1]);
  }
  level_ = std::move(pyramid.front());
  return is_known;
}

ColorValue SmoothField::at(int x, int y) const {
  const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(cell_px_) - 0.5f,
              v = (static_cast<float>(y) + 0.5f) / static_cast<float>(cell_px_) - 0.5f;
  const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
  const float right_share = u - static_cast<float>(left), bottom_share = v - static_cast<float>(top);
  ColorValue value{};
  float weight = 0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const auto& cell =
          level_.cells[static_cast<std::size_t>(clamped(top + j, level_.height)) * level_.width +
                       clamped(left + i, level_.width)];
      const float share =
          (i == 1 ? right_share : 1 - right_share) * (j == 1 ? bottom_share : 1 - bottom_share);
      for (int c = 0; c < 3; ++c) value[c] += share * cell[c];
      weight += share * cell[3];
    }
  for (float& channel : value) channel /= weight;
  return value;
}

}  // namespace espalier
