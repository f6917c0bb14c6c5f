// A name under which a library finds a file that means something else by some of its characters: OpenImageIO
// reads what follows a question mark as options.
#pragma once
#include <filesystem>

namespace espalier {

/// The path itself where it is plain; else a link to it in a folder of its own, which is gone with this
/// object.
class PlainName {
 public:
  explicit PlainName(const std::filesystem::path& path);
  ~PlainName();
  PlainName(const PlainName&) = delete;
  PlainName& operator=(const PlainName&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path folder_, path_;
};

}  // namespace espalier
