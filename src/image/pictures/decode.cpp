// The file is looked at before anything decodes it: that it is one of the formats that are read, how large it
// claims to be, how often it goes over its pixels. Then a child decodes it, and its answer is checked.
#include <algorithm>
#include <cmath>
#include <mutex>
#include <system_error>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/image/codecs/codecs.h>
#include <espalier/image/pictures/claimed_size.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/pictures/file_chunks.h>
#include <espalier/image/pictures/jpeg_scans.h>
#include <espalier/image/pictures/picture_format.h>
#include <espalier/image/pictures/picture_frames.h>
#include <espalier/image/pictures/picture_size.h>
#include <espalier/machine/child.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLookedAtBytes = 200 << 20;  ///< of larger files the beginning
constexpr std::size_t kMostScans = 100;            ///< of a JPEG; programs write at most about ten

void check_is_file(const fs::path& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (!fs::exists(status)) throw_input_error("{}: there is no such file", path.string());
  if (!fs::is_regular_file(status))
    throw_input_error("{}: is {}, expected a picture file", path.string(),
                      fs::is_directory(status) ? "a directory" : "not a regular file");
}

/// What can be said of a file before it is decoded.
struct LookedAt {
  PictureFile file;
  double pixels = static_cast<double>(kMaxSourcePixels);  ///< at most, as it claims
  std::vector<std::array<std::uint8_t, 3>> palette;
};

/// Each scan of a progressive JPEG goes over all its pixels.
void check_scans(const fs::path& path, std::string_view bytes, double pixels) {
  if (is_jpeg_without_end(bytes)) throw_input_error("{}: is a JPEG that was cut off", path.string());
  const std::size_t scans = count_jpeg_scans(bytes);
  if (scans > kMostScans ||
      static_cast<double>(scans) * pixels > kMaxPixelsPerByte * static_cast<double>(bytes.size()))
    throw_input_error("{}: claims {} scans of {} pixels in {} bytes, expected a picture", path.string(),
                      scans, pixels, bytes.size());
}

LookedAt look_at(const fs::path& path) {
  check_is_file(path);
  const std::string bytes = read_beginning(path, kLookedAtBytes);
  if (bytes.empty()) throw_input_error("{}: is empty, expected a picture", path.string());
  LookedAt looked{{path, picture_format(bytes, path.extension().string()), fs::file_size(path)}};
  if (looked.file.reader.empty())
    throw_input_error("{}: is no picture that can be read, expected {}", path.string(), kPictureFormats);
  if (const auto claimed = claimed_size(bytes, looked.file.reader)) {
    check_picture_size(path, looked.file.bytes, claimed->width_px, claimed->height_px);
    looked.pixels = claimed->width_px * claimed->height_px;
  }
  if (looked.file.reader == "jpeg" && looked.file.bytes <= kLookedAtBytes)
    check_scans(path, bytes, looked.pixels);
  looked.file.orientation = webp_orientation(bytes);
  looked.palette = png_palette(bytes);
  return looked;
}

/// Sound pictures take a tenth of the time. The averaged pixels, twice while they are turned, beside what
/// readers have of a picture (libjpeg's coefficients, a GIF's canvas).
ChildLimits limits_for(const LookedAt& looked, int frame) {
  constexpr double kAveraged = double{kMaxDecodedSide} * kMaxDecodedSide, kOfManyFrames = 25e6;
  const bool has_one = frame == 1 || looked.file.reader == "png" || looked.file.reader == "jpeg";
  const double pixels =
      has_one ? looked.pixels : std::max(looked.pixels, std::min(100 * looked.pixels, kOfManyFrames));
  const double megabytes = 1e-6 * static_cast<double>(looked.file.bytes);
  const double cpu_s = 0.8 + 0.4e-6 * pixels + 0.4 * megabytes;
  return {.cpu_s = cpu_s,
          .wall_s = 30 + 10 * cpu_s,
          .memory_bytes = static_cast<std::size_t>(128e6 + 32 * std::min(looked.pixels, kAveraged) +
                                                   24 * looked.pixels + 4e6 * megabytes)};
}

/// A picture without its pixels and its palette, as it is sent.
struct Sent {
  std::int32_t width_px, height_px, source_width_px, source_height_px, bits, frame, blank_frames;
  std::int32_t has_alpha, is_grey;
};

void send_picture(const DecodedPicture& picture, const SendBytes& send) {
  const Sent sent{picture.width_px,         picture.height_px, picture.source_width_px,
                  picture.source_height_px, picture.bits,      picture.frame,
                  picture.blank_frames,     picture.has_alpha, picture.is_grey};
  send(&sent, sizeof sent);
  send(picture.pixels.data(), picture.pixels.size() * sizeof(Rgba));
}

bool is_within(std::int32_t value, int low, int high) { return value >= low && value <= high; }

/// The child has read a stranger's file: what it says is checked as that is.
bool can_be(const Sent& sent) {
  return is_within(sent.width_px, 1, kMaxDecodedSide) && is_within(sent.height_px, 1, kMaxDecodedSide) &&
         sent.source_width_px >= kMinSourceSide && sent.source_height_px >= kMinSourceSide &&
         (sent.bits == 0 || sent.bits == 8 || sent.bits == 16) && sent.frame >= 1 && sent.blank_frames >= 0;
}

DecodedPicture receive_picture(Child& child, const fs::path& path) {
  Sent sent{};
  child.read(&sent, sizeof sent);
  if (!can_be(sent)) throw_input_error("{}: is no picture that can be read", path.string());
  DecodedPicture picture{.width_px = sent.width_px,
                         .height_px = sent.height_px,
                         .source_width_px = sent.source_width_px,
                         .source_height_px = sent.source_height_px,
                         .has_alpha = sent.has_alpha != 0,
                         .bits = sent.bits,
                         .is_grey = sent.is_grey != 0,
                         .frame = sent.frame,
                         .blank_frames = sent.blank_frames};
  picture.pixels.resize(static_cast<std::size_t>(sent.width_px) * static_cast<std::size_t>(sent.height_px));
  child.read(picture.pixels.data(), picture.pixels.size() * sizeof(Rgba));
  child.finish();
  return picture;
}

void check_pixels(const DecodedPicture& picture, const fs::path& path) {
  for (const Rgba& rgba : picture.pixels)
    for (const float value : rgba)
      if (!std::isfinite(value)) throw_input_error("{}: a pixel is not a finite number", path.string());
}

Child start_child(const LookedAt& looked, int frame) {
  const std::unique_lock alone(picture_codecs_in_use());
  return Child(looked.file.path.string() + ": not readable as a picture", limits_for(looked, frame),
               [&](const SendBytes& send) { send_picture(read_frame(looked.file, frame), send); });
}

DecodedPicture decoded_apart(const LookedAt& looked, int frame) {
  picture_codecs();  // loaded once, for all children; libraries that they bring start threads
  if (!forked_children_can_allocate()) return read_frame(looked.file, frame);
  Child child = start_child(looked, frame);
  return receive_picture(child, looked.file.path);
}

}  // namespace

DecodedPicture decode_picture(const fs::path& path, int frame) {
  LookedAt looked = look_at(path);
  DecodedPicture picture = decoded_apart(looked, frame);
  check_pixels(picture, path);
  picture.palette = std::move(looked.palette);
  return picture;
}

}  // namespace espalier
