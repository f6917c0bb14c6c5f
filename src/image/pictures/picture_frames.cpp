#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <espalier/core/error.h>
#include <espalier/image/codecs/codecs.h>
#include <espalier/image/pictures/picture_frames.h>
#include <espalier/image/pictures/picture_size.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

constexpr int kMostBlankFrames = 100;  ///< that are looked at

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::unique_ptr<PictureInput> open_picture(const PictureFile& file, int frame) {
  std::string reason;
  auto input = picture_codecs().open(file.path.string(), file.reader, frame, reason);
  if (!input && frame > 0) {
    const int frames = picture_codecs().count_frames(file.path.string(), file.reader);
    if (frames > 0)
      throw_input_error("{}: got frame {}, expected 1{}", file.path.string(), frame + 1,
                        frames > 1 ? fmt::format(" to {}", frames) : ": it has no other");
  }
  if (!input)
    throw_input_error("{}: is no picture that can be read ({})", file.path.string(), first_line(reason));
  return input;
}

void check_layout(const PictureFile& file, const PictureLayout& layout) {
  check_picture_size(file.path, file.bytes, layout.width_px, layout.height_px, layout.layers);
  if (layout.channels < 1 || layout.channels > 64)
    throw_input_error("{}: has {} channels, expected 1 to 64", file.path.string(), layout.channels);
  const double tile_pixels =
      static_cast<double>(layout.tile_rows) * std::max(layout.tile_columns, layout.width_px);
  if (tile_pixels > static_cast<double>(kMaxSourcePixels))
    throw_input_error("{}: claims tiles of {}×{} pixels, expected at most {} in a row of them",
                      file.path.string(), layout.tile_columns, layout.tile_rows, kMaxSourcePixels);
}

/// Which channel of the file is red, green, blue and alpha (-1 where there is none).
std::array<int, 4> find_channels(const PictureLayout& layout) {
  const int alpha = layout.alpha;
  if (layout.red >= 0 && layout.green >= 0 && layout.blue >= 0)
    return {layout.red, layout.green, layout.blue, alpha};
  const int colours = layout.channels - (alpha >= 0 ? 1 : 0);
  if (colours >= 3) return {0, 1, 2, alpha};
  const int grey = alpha == 0 && layout.channels > 1 ? 1 : 0;
  return {grey, grey, grey, alpha};
}

Rgba pick_channels(const float* samples, const std::array<int, 4>& channels) {
  Rgba rgba{0, 0, 0, 1};
  for (int c = 0; c < 4; ++c)
    if (channels[c] >= 0) rgba[c] = samples[channels[c]];
  return rgba;
}

/// Brighter than any surface; sums and differences of such values stay finite.
Rgba bounded(Rgba rgba) {
  for (float& value : rgba) value = std::clamp(value, -1e6f, 1e6f);
  return rgba;
}

/// Adds rows of a picture to the blocks of block_px × block_px pixels they fall in.
class BlockAverage {
 public:
  BlockAverage(const PictureLayout& layout, int block_px) : block_px_(block_px) {
    picture_.source_width_px = layout.width_px;
    picture_.source_height_px = layout.height_px;
    picture_.width_px = layout.width_px / block_px;
    picture_.height_px = layout.height_px / block_px;
    picture_.pixels.assign(static_cast<std::size_t>(picture_.width_px) * picture_.height_px, Rgba{});
  }

  void add(int x, int y, const Rgba& rgba) {
    const int block_x = x / block_px_, block_y = y / block_px_;
    if (block_x >= picture_.width_px || block_y >= picture_.height_px) return;  // an incomplete last block
    Rgba& sum = picture_.pixels[static_cast<std::size_t>(block_y) * picture_.width_px + block_x];
    for (int c = 0; c < 4; ++c) sum[c] += rgba[c];
  }

  DecodedPicture finish() && {
    const float weight = 1.0f / static_cast<float>(block_px_ * block_px_);
    if (block_px_ > 1)
      for (Rgba& sum : picture_.pixels)
        for (float& value : sum) value *= weight;
    return std::move(picture_);
  }

 private:
  int block_px_;
  DecodedPicture picture_;
};

DecodedPicture read_pixels(PictureInput& input, const fs::path& path) {
  const PictureLayout& layout = input.layout();
  const std::array<int, 4> channels = find_channels(layout);
  const int chunk_rows = layout.tile_rows == 0 ? 64 : layout.tile_rows;
  const int larger_side = std::max(layout.width_px, layout.height_px);
  BlockAverage average(layout, (larger_side + kMaxDecodedSide - 1) / kMaxDecodedSide);
  std::vector<float> samples(static_cast<std::size_t>(chunk_rows) * layout.width_px * layout.channels);
  for (int begin = 0; begin < layout.height_px; begin += chunk_rows) {
    const int end = std::min(begin + chunk_rows, layout.height_px);
    if (!input.read_rows(begin, end, samples.data()))
      throw_input_error("{}: is damaged or cut off ({})", path.string(), first_line(input.error()));
    const float* pixel = samples.data();
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < layout.width_px; ++x, pixel += layout.channels) {
        const Rgba rgba = pick_channels(pixel, channels);
        if (!std::all_of(rgba.begin(), rgba.end(), [](float value) { return std::isfinite(value); }))
          throw_input_error("{}: pixel ({}, {}) is not a finite number", path.string(), x, y);
        average.add(x, y, bounded(rgba));
      }
  }
  DecodedPicture picture = std::move(average).finish();
  picture.has_alpha = channels[3] >= 0;
  picture.bits = layout.bits;
  picture.is_grey = channels[0] == channels[1] && channels[1] == channels[2];
  return picture;
}

/// Turns a picture upright as its EXIF orientation (1..8) says: 5..8 swap rows and columns.
DecodedPicture turn_upright(DecodedPicture picture, int orientation) {
  if (orientation < 2 || orientation > 8) return picture;
  const bool swapped = orientation >= 5;
  const bool flip_x = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool flip_y = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  DecodedPicture upright = picture;
  if (swapped) std::swap(upright.width_px, upright.height_px);
  if (swapped) std::swap(upright.source_width_px, upright.source_height_px);
  for (int y = 0; y < upright.height_px; ++y)
    for (int x = 0; x < upright.width_px; ++x) {
      const int u = swapped ? y : x, v = swapped ? x : y;
      upright.pixels[static_cast<std::size_t>(y) * upright.width_px + x] =
          picture.at(flip_x ? picture.width_px - 1 - u : u, flip_y ? picture.height_px - 1 - v : v);
    }
  return upright;
}

/// The frame that the input is at.
DecodedPicture read_current(const PictureFile& file, PictureInput& input) {
  check_layout(file, input.layout());
  const int orientation = input.layout().orientation == 1 ? file.orientation : input.layout().orientation;
  return turn_upright(read_pixels(input, file.path), orientation);
}

/// All of one colour, or transparent.
bool is_blank(const DecodedPicture& picture) {
  return std::all_of(picture.pixels.begin(), picture.pixels.end(),
                     [&](const Rgba& pixel) { return pixel == picture.pixels.front(); });
}

/// The first frame behind this one that shows something; where none does, the picture stays.
void skip_blank_frames(const PictureFile& file, PictureInput& input, DecodedPicture& picture) {
  for (int frame = 1; frame < kMostBlankFrames && input.next_frame(); ++frame) {
    DecodedPicture next = read_current(file, input);
    if (is_blank(next)) continue;
    picture = std::move(next);
    picture.frame = frame + 1;
    picture.blank_frames = frame;
    return;
  }
}

}  // namespace

DecodedPicture read_frame(const PictureFile& file, int frame) {
  const auto input = open_picture(file, std::max(0, frame - 1));
  DecodedPicture picture = read_current(file, *input);
  picture.frame = std::max(1, frame);
  if (frame == 0 && is_blank(picture)) skip_blank_frames(file, *input, picture);
  return picture;
}

}  // namespace espalier
