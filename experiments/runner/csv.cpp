#include <algorithm>
#include <charconv>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/experiments/runner/csv.h>

namespace espalier {

namespace {

std::size_t index_of(const CsvTable& table, const std::string& column) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), column);
  if (found == table.columns.end())
    throw_input_error("{}: got no column '{}', expected it in the head", table.source, column);
  return static_cast<std::size_t>(found - table.columns.begin());
}

/// Splits text into cells and lines.
class CsvReader {
 public:
  CsvReader(const std::string& text, const std::string& source) : text_(text), source_(source) {}

  bool next_line(std::vector<std::string>& cells) {
    if (at_ >= text_.size()) return false;
    ++line_;
    cells.assign(1, "");
    for (; at_ < text_.size() && text_[at_] != '\n'; ++at_) read_character(cells);
    ++at_;
    return true;
  }
  std::size_t line() const { return line_; }

 private:
  void read_character(std::vector<std::string>& cells) {
    const char c = text_[at_];
    if (c == ',')
      cells.emplace_back();
    else if (c == '"')
      read_quoted(cells.back());
    else if (c != '\r')
      cells.back() += c;
  }
  /// From a quote to its end; two quotes in it are one.
  void read_quoted(std::string& cell) {
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] != '"') {
        cell += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        cell += text_[++at_];
      } else {
        return;
      }
    }
    throw_input_error("{}:{}: got a quote without an end, expected one", source_, line_);
  }

  const std::string& text_;
  const std::string& source_;
  std::size_t at_ = 0, line_ = 0;
};

}  // namespace

bool CsvTable::has(const std::string& column) const {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
  return rows[row][index_of(*this, column)];
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  const std::string& cell = text(row, column);
  if (cell.empty()) return NAN;
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size())
    throw_input_error("{}: column '{}', row {}: got '{}', expected a number", source, column, row + 1, cell);
  return value;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted;
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return fmt::format("\"{}\"", quoted);
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line.append(csv_cell(cell)).append(",");
  if (!line.empty()) line.pop_back();
  return line.append("\n");
}

std::string to_csv(const CsvTable& table) {
  std::string text = csv_line(table.columns);
  for (const auto& row : table.rows) text += csv_line(row);
  return text;
}

CsvTable read_csv(const std::filesystem::path& path) {
  CsvTable table;
  table.source = path.string();
  const std::string text = read_file(path);
  CsvReader reader(text, table.source);
  if (!reader.next_line(table.columns))
    throw_input_error("{}: got an empty file, expected a table", table.source);
  for (std::vector<std::string> cells; reader.next_line(cells);) {
    if (cells.size() != table.columns.size())
      throw_input_error("{}:{}: got {} cells, expected {}", table.source, reader.line(), cells.size(),
                        table.columns.size());
    table.rows.push_back(cells);
  }
  return table;
}

}  // namespace espalier
