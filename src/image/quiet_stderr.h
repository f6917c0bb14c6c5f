// Decoders of picture files print to stderr by themselves (libpng, libjpeg), beside the error that they
// return. Errors are one line of ours, so theirs go nowhere while a picture is read.
#pragma once

namespace espalier {

/// Discards what the process writes to file descriptor 2 during its life. One at a time.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  int saved_descriptor_ = -1;
};

}  // namespace espalier
