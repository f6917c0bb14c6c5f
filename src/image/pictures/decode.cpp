#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <new>
#include <stdexcept>

#include <espalier/core/error.h>
#include <espalier/image/codecs/codecs.h>
#include <espalier/image/pictures/claimed_size.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/pictures/file_chunks.h>
#include <espalier/image/pictures/jpeg_end.h>
#include <espalier/image/pictures/plain_name.h>
#include <espalier/image/pictures/quiet_stderr.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

constexpr double kMaxPixelsPerByte = 10'000;
constexpr int kMostBlankFrames = 100;  ///< that are looked at

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

void check_is_file(const fs::path& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (!fs::exists(status)) throw_input_error("{}: there is no such file", path.string());
  if (!fs::is_regular_file(status))
    throw_input_error("{}: is {}, expected a picture file", path.string(),
                      fs::is_directory(status) ? "a directory" : "not a regular file");
  if (!std::ifstream(path, std::ios::binary)) throw_input_error("{}: cannot be opened", path.string());
  if (fs::file_size(path, none) == 0) throw_input_error("{}: is empty, expected a picture", path.string());
  if (is_jpeg_without_end(path)) throw_input_error("{}: is a JPEG that was cut off", path.string());
}

/// `name`: under which the library finds the path.
std::unique_ptr<PictureInput> open_picture(const fs::path& path, const fs::path& name, int frame) {
  std::string reason;
  auto input = picture_codecs().open(name.string(), frame, reason);
  if (!input && frame > 0) {
    const int frames = picture_codecs().count_frames(name.string());
    if (frames > 0)
      throw_input_error("{}: got frame {}, expected 1{}", path.string(), frame + 1,
                        frames > 1 ? fmt::format(" to {}", frames) : ": it has no other");
  }
  if (!input) throw_input_error("{}: is no picture that can be read ({})", path.string(), first_line(reason));
  return input;
}

/// Before anything is allocated for the pixels. Deflate packs at most 8 · 1032 pixels of one bit into a byte.
void check_size(const fs::path& path, int width_px, int height_px, int layers) {
  const double pixels = static_cast<double>(width_px) * height_px * std::max(1, layers);
  if (pixels > static_cast<double>(kMaxSourcePixels) || layers > 1)
    throw_input_error("{}: claims {}×{}×{} pixels, expected at most {} in one layer", path.string(), width_px,
                      height_px, layers, kMaxSourcePixels);
  if (std::min(width_px, height_px) < kMinSourceSide)
    throw_input_error("{}: has {}×{} pixels, expected at least {} on each side", path.string(), width_px,
                      height_px, kMinSourceSide);
  const auto bytes = fs::file_size(path);
  if (pixels > kMaxPixelsPerByte * static_cast<double>(bytes))
    throw_input_error("{}: claims {}×{} pixels in {} bytes: is cut off, or shows no tree", path.string(),
                      width_px, height_px, bytes);
}

void check_size(const fs::path& path, const PictureLayout& layout) {
  check_size(path, layout.width_px, layout.height_px, layout.layers);
  if (layout.channels < 1 || layout.channels > 64)
    throw_input_error("{}: has {} channels, expected 1 to 64", path.string(), layout.channels);
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

DecodedPicture read_frame(const fs::path& path, const fs::path& name, int frame) {
  const auto input = open_picture(path, name, frame);
  const PictureLayout& layout = input->layout();
  check_size(path, layout);
  const int orientation = layout.orientation == 1 ? webp_orientation(path) : layout.orientation;
  return turn_upright(read_pixels(*input, path), orientation);
}

/// All of one colour, or transparent.
bool is_blank(const DecodedPicture& picture) {
  return std::all_of(picture.pixels.begin(), picture.pixels.end(),
                     [&](const Rgba& pixel) { return pixel == picture.pixels.front(); });
}

/// The first frame that shows something; where none does, the picture stays.
void skip_blank_frames(const fs::path& path, const fs::path& name, DecodedPicture& picture) {
  const int frames = std::min(picture_codecs().count_frames(name.string()), kMostBlankFrames);
  for (int frame = 1; frame < frames; ++frame) {
    DecodedPicture next = read_frame(path, name, frame);
    if (is_blank(next)) continue;
    picture = std::move(next);
    picture.frame = frame + 1;
    picture.blank_frames = frame;
    return;
  }
}

}  // namespace

DecodedPicture decode_picture(const fs::path& path, int frame) try {
  const QuietStderr quiet;
  check_is_file(path);
  if (const auto claimed = claimed_size(path)) check_size(path, claimed->width_px, claimed->height_px, 1);
  const PlainName name(path);
  DecodedPicture picture = read_frame(path, name.path(), std::max(0, frame - 1));
  picture.frame = std::max(1, frame);
  if (frame == 0 && is_blank(picture)) skip_blank_frames(path, name.path(), picture);
  picture.palette = png_palette(path);
  return picture;
} catch (const std::bad_alloc&) {
  throw_input_error("{}: needs more memory than there is", path.string());
} catch (const std::length_error&) {  // sizes that a reader did not check
  throw_input_error("{}: is damaged: it claims impossible sizes", path.string());
}

}  // namespace espalier
