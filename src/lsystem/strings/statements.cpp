#include <algorithm>
#include <array>
#include <cctype>

#include <espalier/lsystem/strings/statements.h>

namespace espalier::lsystem {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Where the comment of a line starts, or the line's end.
std::size_t comment_start(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool before = i == 0 || is_blank(line[i - 1]);
    const bool after = i + 1 == line.size() || is_blank(line[i + 1]) || line[i + 1] == '#';
    if (line[i] == '#' && before && after) return i;
  }
  return line.size();
}

std::size_t indentation(std::string_view line) {
  const auto first = std::find_if_not(line.begin(), line.end(), is_blank);
  return static_cast<std::size_t>(first - line.begin());
}

/// Headings take no further lines: what follows them are statements of their own.
bool is_heading(std::string_view line) {
  const std::string_view text = line.substr(indentation(line));
  constexpr std::array kHeadings{"productions:", "interpretation:", "table "};
  return std::any_of(kHeadings.begin(), kHeadings.end(), [&](const char* h) { return text.starts_with(h); });
}

bool is_lua(std::string_view line) { return line.substr(indentation(line)).starts_with("lua:"); }

/// Whether a statement so far ends with "--> lua": what follows is the body of a production.
bool opens_lua_body(std::string_view statement) {
  const auto trim = [&] {
    while (!statement.empty() && (is_blank(statement.back()) || statement.back() == '\n'))
      statement.remove_suffix(1);
  };
  trim();
  if (!statement.ends_with("lua")) return false;
  statement.remove_suffix(3);
  trim();
  return statement.ends_with("-->");
}

/// Joins lines to statements.
class Splitter {
 public:
  explicit Splitter(FileText& file) : file_(file) {}

  void add(std::size_t begin, std::string_view raw) {
    const bool goes_on = open_ && indentation(raw) > indentation_;
    const bool is_code = goes_on ? in_lua_ : is_lua(raw);
    const std::string_view line = is_code ? raw : raw.substr(0, comment_start(raw));
    if (indentation(line) == line.size()) return;  // empty, or only a comment
    if (!goes_on) {
      file_.statements.push_back({begin + indentation(line), 0});
      open_ = !is_heading(line);
      indentation_ = indentation(line);
      in_lua_ = is_lua(line);
    }
    Statement& statement = file_.statements.back();
    statement.end = begin + line.size();
    std::copy(line.begin(), line.end(), file_.clean.begin() + static_cast<std::ptrdiff_t>(begin));
    const std::string_view clean = file_.clean;
    in_lua_ = in_lua_ || opens_lua_body(clean.substr(statement.begin, statement.end - statement.begin));
  }

 private:
  FileText& file_;
  bool open_ = false, in_lua_ = false;
  std::size_t indentation_ = 0;
};

}  // namespace

FileText split_statements(const std::shared_ptr<const Source>& source) {
  FileText file{source, std::string(source->text.size(), ' '), {}};
  const std::string_view text = source->text;
  Splitter splitter(file);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    splitter.add(begin, text.substr(begin, end - begin));
    if (end < text.size()) file.clean[end] = '\n';
    begin = end + 1;
  }
  return file;
}

void Cursor::skip_space() {
  while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '\n')) ++at_;
}

bool Cursor::take(std::string_view token) {
  skip_space();
  if (!rest().starts_with(token)) return false;
  const std::size_t end = at_ + token.size();
  if (is_word(token.back()) && end < text_.size() && is_word(text_[end])) return false;
  at_ = end;
  return true;
}

void Cursor::expect(std::string_view token) {
  if (!take(token)) fail(fmt::format("'{}'", token));
}

std::string_view Cursor::take_word() {
  skip_space();
  const std::size_t start = at_;
  while (at_ < text_.size() && is_word(text_[at_])) ++at_;
  return text_.substr(start, at_ - start);
}

std::string Cursor::expect_word(std::string_view what) {
  skip_space();
  const bool starts =
      at_ < text_.size() && is_word(text_[at_]) && !std::isdigit(static_cast<unsigned char>(text_[at_]));
  if (!starts) fail(what);
  return std::string(take_word());
}

std::size_t Cursor::find_outside(std::string_view stops) const {
  int depth = 0;
  char quote = 0;
  for (std::size_t i = at_; i < text_.size(); ++i) {
    const char c = text_[i];
    if (quote) {
      if (c == '\\') ++i;
      if (c == quote) quote = 0;
    } else if (depth == 0 && stops.find(c) != std::string_view::npos) {
      return i;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '(' || c == '{' || c == '[') {
      ++depth;
    } else if (c == ')' || c == '}' || c == ']') {
      --depth;
    }
  }
  return text_.size();
}

void Cursor::fail(std::string_view expected) const {
  throw_at(position(), "got {}, expected {}", found(), expected);
}

}  // namespace espalier::lsystem
