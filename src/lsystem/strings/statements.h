// The lines of an L-system file as statements. A statement goes on in the lines below it that are indented
// deeper than its first one; headings such as "productions:" end with their line. A comment is a # at the
// start of a line or after a space, followed by a space or the end of the line (the symbol # of a string
// has neither around it). Lua code has Lua's comments, because # is an operator there.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/lsystem/strings/source.h>

namespace espalier::lsystem {

struct Statement {
  std::size_t begin = 0, end = 0;  ///< offsets in the file
};

struct FileText {
  std::shared_ptr<const Source> source;
  std::string clean;  ///< the file's text with blanks for comments: the same offsets
  std::vector<Statement> statements;
};

FileText split_statements(const std::shared_ptr<const Source>& source);

/// Reads a stretch of a file from left to right.
class Cursor {
 public:
  Cursor(const FileText& file, std::size_t begin, std::size_t end)
      : source_(file.source), text_(std::string_view(file.clean).substr(0, end)), at_(begin) {}

  std::size_t at() const { return at_; }
  void go_to(std::size_t offset) { at_ = offset; }
  std::string_view rest() const { return text_.substr(at_); }
  std::string_view between(std::size_t begin, std::size_t end) const {
    return text_.substr(begin, end - begin);
  }
  Position position() const { return {source_, at_}; }
  Position position(std::size_t offset) const { return {source_, offset}; }
  std::string found() const { return found_at(source_->text.substr(0, text_.size()), at_); }

  /// Past blanks, tabs and line breaks.
  void skip_space();
  bool at_end() {
    skip_space();
    return at_ >= text_.size();
  }
  /// Past blanks and `token`, if that comes next.
  bool take(std::string_view token);
  void expect(std::string_view token);
  /// A name of letters, digits and underscores; empty where there is none.
  std::string_view take_word();
  std::string expect_word(std::string_view what);
  /// The offset of the first of `stops` outside brackets and quotes, or the end.
  std::size_t find_outside(std::string_view stops) const;
  [[noreturn]] void fail(std::string_view expected) const;

 private:
  std::shared_ptr<const Source> source_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace espalier::lsystem
