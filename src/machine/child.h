// Work on files from strangers in a process of its own: libraries that read pictures and meshes crash, hang
// and take all memory where a file is damaged. The child is forked, so it needs no program of its own and
// sees what its parent has read; it has little time and memory and next to no rights
// (machine/child_rights.h), and hands back bytes through a pipe. Whatever becomes of it, its parent has one
// line to say.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <string>

namespace espalier {

struct ChildLimits {
  double cpu_s = 1;                      ///< ten times as many in builds with sanitizers
  double wall_s = 30;                    ///< a child that waits uses no processor
  std::size_t memory_bytes = 256 << 20;  ///< beside what the process has already; none with sanitizers
};

/// Always, but in builds with a sanitizer beside other threads: its allocator has locks that a child inherits
/// from threads which it has not, and waits for. Tests alone meet that.
bool forked_children_can_allocate();

/// Hands `count` bytes to the parent.
using SendBytes = std::function<void(const void* bytes, std::size_t count)>;

/// Threads may have children at a time, and programs that ignore SIGCHLD, or wait for all their children,
/// too. What is forked is this thread alone: `work` uses no lock that another thread may hold, and no OpenMP.
class Child {
 public:
  /// Starts `work`. `subject` opens the messages: "a.png: not readable as a picture". Throws InputError where
  /// no process can be started; the work is then not done at all, rather than without its limits.
  Child(std::string subject, const ChildLimits& limits, const std::function<void(const SendBytes&)>& work);
  ~Child();  ///< ends it
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits for the next bytes that the work sends. Throws InputError with what the work threw as such, or,
  /// behind the subject, with what else became of it: a crash, a limit, an end too early. They come from a
  /// reader of files from strangers: sizes among them must be checked.
  void read(void* bytes, std::size_t count);

  /// Waits for the end of the work, which has sent all; throws as above.
  void finish();

 private:
  void wait_for(int descriptor);
  std::string words();
  void check_ending(const std::string& said);
  [[noreturn]] void throw_crash();
  void await_end();
  void end();

  std::string subject_;
  ChildLimits limits_;
  double start_s_;
  pid_t process_ = -1;
  int data_ = -1, words_ = -1;  ///< ends of pipes; words: how the work ended
  int status_ = 0;              ///< as of waitpid
  bool has_status_ = false;
};

}  // namespace espalier
