// What reads and writes picture files, behind an interface: OpenImageIO (image/openimageio), which brings 250
// libraries with it. Loading them took three quarters of the time of a program that reads no picture, so they
// are a module that is loaded with the first file. Who links image/openimageio has them from the start.
#pragma once
#include <cstdint>
#include <memory>
#include <shared_mutex>
#include <string>

namespace espalier {

/// What a picture's header says. Rows count from the top of the file, before it is turned upright.
struct PictureLayout {
  int width_px = 0, height_px = 0, layers = 1, channels = 0;
  int red = -1, green = -1, blue = -1, alpha = -1;  ///< channels by name; -1: the file names none
  int orientation = 1;                              ///< EXIF's, 1 to 8
  int tile_rows = 0, tile_columns = 0;              ///< read as many rows at once; 0: any number
  int bits = 0;  ///< of a sample that is a whole number: 8 or 16; 0: it is none
};

class PictureInput {
 public:
  virtual ~PictureInput() = default;
  virtual const PictureLayout& layout() const = 0;
  /// Rows [begin, end) into (end - begin) · width_px · channels samples; integer formats span 0 to 1. False,
  /// and error() says why, where they cannot be read.
  virtual bool read_rows(int begin, int end, float* samples) = 0;
  /// Goes on to the next frame of an animation, or page; false where there is none.
  virtual bool next_frame() = 0;
  virtual std::string error() = 0;
};

/// Frames of one size, 8-bit RGB, as they come.
class AnimationOutput {
 public:
  virtual ~AnimationOutput() = default;
  virtual bool add(const std::uint8_t* rgb) = 0;
  virtual bool close() = 0;  ///< after the last frame
  virtual std::string bytes() const = 0;
  virtual std::string error() = 0;
};

struct EncodedPicture {
  std::string bytes;
  std::string error;  ///< empty: none
};

class PictureCodecs {
 public:
  virtual ~PictureCodecs() = default;
  /// A frame of an animation, or a page, counted from 0, by the reader of this name ("png", "jpeg"). Null,
  /// and `error` says why, where the file is no picture that it can read or has no such frame.
  virtual std::unique_ptr<PictureInput> open(const std::string& path, const std::string& reader, int frame,
                                             std::string& error) const = 0;
  /// Of a file that can be opened.
  virtual int count_frames(const std::string& path, const std::string& reader) const = 0;
  /// A PNG of 1, 3 or 4 channels of 8 bits (sRGB, opacity not multiplied in); `name` is for messages.
  virtual EncodedPicture encode_png(const std::string& name, int width_px, int height_px, int channels,
                                    const std::uint8_t* samples) const = 0;
  /// Null, and `error` says why, where there can be none of this size.
  virtual std::unique_ptr<AnimationOutput> encode_gif(int width_px, int height_px, int frames, double frame_s,
                                                      std::string& error) const = 0;
};

/// Those there are, loaded when first asked for; threads may ask. Throws InternalError, which says where it
/// looked, where the module is missing. From then on OpenImageIO works on the thread that asks it alone, in
/// all of the program.
const PictureCodecs& picture_codecs();

/// Held with others by who encodes, alone by who forks a process that decodes: it must not inherit a lock of
/// the library from a thread that is not there to open it.
std::shared_mutex& picture_codecs_in_use();

}  // namespace espalier
