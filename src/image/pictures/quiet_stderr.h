// Decoders of picture files print to stderr by themselves (libpng, libjpeg), beside the error that they
// return. Errors are one line of ours, so theirs go nowhere while a picture is read.
#pragma once

namespace espalier {

/// Discards what the process writes to file descriptor 2 during its life. Lives may overlap, in any order and
/// on any thread: the first turns stderr off, the last turns it on again.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;
};

}  // namespace espalier
