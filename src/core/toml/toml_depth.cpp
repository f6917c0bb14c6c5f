#include <string>
#include <vector>

#include <espalier/core/toml/toml_depth.h>

namespace espalier {

namespace {

/// Walks along the text by its tokens: strings and comments are stepped over, all else is looked at only for
/// what opens, closes and separates.
class DepthScanner {
 public:
  explicit DepthScanner(std::string_view text) : text_(text) {
    if (text.starts_with("\xef\xbb\xbf")) at_ = 3;  // of a byte order mark
  }

  std::optional<long> line_of_too_deep() {
    while (at_ < text_.size()) {
      step();
      if (depth() > kMaxTomlDepth) return line_;
    }
    return std::nullopt;
  }

 private:
  struct Open {
    long parts;  ///< of its key
    char bracket;
  };

  /// The tables of the header, those of the keys whose values are open, and these values.
  long depth() const { return header_parts_ + outer_ + parts_; }

  void step() {
    const char c = text_[at_];
    if (c == '"' || c == '\'') return skip_string(c);
    if (c == '#') return skip_comment();
    ++at_;
    if (c == '\n')
      end_line();
    else if (c == '=')
      is_value_ = true;
    else if (c == '.' && !is_value_)
      ++parts_;
    else if (c == '[' || c == '{')
      open(c);
    else if (c == ']' || c == '}')
      close();
    else if (c == ',' && !open_.empty())
      begin_inside(open_.back().bracket);
    is_line_new_ = is_line_new_ && (c == ' ' || c == '\t' || c == '\n' || c == '\r');
  }

  void end_line() {
    ++line_;
    if (is_header_) header_parts_ = parts_;
    if (open_.empty()) {
      is_line_new_ = true;
      is_header_ = is_value_ = false;
      parts_ = 1;
    }
  }

  /// Arrays hold values, tables keys.
  void begin_inside(char bracket) {
    is_value_ = bracket == '[';
    parts_ = 1;
  }

  /// A bracket that opens a line outside of all values is that of a table's header, "[a.b]"; in "[[a.b]]" the
  /// second makes an array.
  void open(char c) {
    if (open_.empty() && c == '[' && (is_line_new_ || is_header_)) {
      if (is_header_) ++parts_;
      is_header_ = true;
      header_parts_ = 0;
      return;
    }
    open_.push_back({parts_, c});
    outer_ += parts_;
    begin_inside(c);
  }

  void close() {
    if (open_.empty()) return;
    parts_ = open_.back().parts;
    outer_ -= parts_;
    is_value_ = true;
    open_.pop_back();
  }

  void skip_comment() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  /// Of the four kinds; one without an end is an error of syntax, which the parser tells.
  void skip_string(char quote) {
    is_line_new_ = false;
    const bool is_long = text_.substr(at_, 3) == std::string_view(quote == '"' ? "\"\"\"" : "'''");
    for (at_ += is_long ? 3 : 1; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n' && !is_long) return;
      if (c == '\n') ++line_;
      if (c == '\\' && quote == '"') {
        skip_escaped();
      } else if (c == quote && (!is_long || text_.substr(at_, 3) == std::string(3, quote))) {
        at_ += is_long ? 3 : 1;
        for (int extra = 0; is_long && extra < 2 && at_ < text_.size() && text_[at_] == quote; ++extra) ++at_;
        return;
      }
    }
  }

  /// What follows a backslash, which may be the end of a line of a long string.
  void skip_escaped() {
    if (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  long line_ = 1;
  bool is_line_new_ = true, is_header_ = false, is_value_ = false;
  long header_parts_ = 0;   ///< of the table that keys stand in
  long parts_ = 1;          ///< of the key so far, or of that whose value this is
  long outer_ = 0;          ///< sum of those of open_
  std::vector<Open> open_;  ///< arrays and tables that are not closed yet
};

}  // namespace

std::optional<long> line_of_too_deep_toml(std::string_view text) {
  return DepthScanner(text).line_of_too_deep();
}

}  // namespace espalier
