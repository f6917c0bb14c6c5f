// Growth sequences as animated GIFs: pictures of one size, a palette each, repeated for ever. Frames are
// encoded as they come and kept in memory; the file is written whole or not at all.
#pragma once
#include <filesystem>
#include <memory>

#include <espalier/image/pictures/picture.h>

namespace espalier {

class Animation {
 public:
  /// `frames` pictures of this size will be added, each shown for `frame_s` seconds (0.02 or more: what
  /// viewers can do; GIF counts hundredths).
  Animation(int width_px, int height_px, int frames, double frame_s);
  ~Animation();
  Animation(const Animation&) = delete;
  Animation& operator=(const Animation&) = delete;

  void add(const Picture& picture);
  /// After the last picture. Throws InputError (one line) where the path cannot be written.
  void write(const std::filesystem::path& path);

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace espalier
