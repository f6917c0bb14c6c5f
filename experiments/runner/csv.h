// Comma-separated values with a head line (RFC 4180): what experiments leave and reports read.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace espalier {

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< as many cells as columns each
  std::string source;                          ///< names the file in messages

  bool has(const std::string& column) const;
  /// The cell's text. Throws InputError where there is no such column.
  const std::string& text(std::size_t row, const std::string& column) const;
  /// The cell as a number, NaN where it is empty. Throws InputError for other text.
  double number(std::size_t row, const std::string& column) const;
};

/// Quoted where it must be.
std::string csv_cell(const std::string& text);
std::string csv_line(const std::vector<std::string>& cells);
std::string to_csv(const CsvTable& table);

/// Throws InputError where the file cannot be read, a quote does not end, or a row has too few or too many
/// cells.
CsvTable read_csv(const std::filesystem::path& path);

}  // namespace espalier
