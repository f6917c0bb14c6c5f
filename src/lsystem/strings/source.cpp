#include <algorithm>

#include <espalier/lsystem/strings/source.h>

namespace espalier::lsystem {

std::string describe(const Position& position) {
  if (!position.source) return "L-system";
  const std::string& text = position.source->text;
  const std::size_t offset = std::min(position.offset, text.size());
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(offset);
  const auto line = 1 + std::count(text.begin(), end, '\n');
  const std::size_t line_start = offset == 0 ? std::string::npos : text.rfind('\n', offset - 1);
  const std::size_t column = line_start == std::string::npos ? offset + 1 : offset - line_start;
  return fmt::format("{}:{}:{}", position.source->label, line, column);
}

std::filesystem::path note_file(const std::string& name, const Source& source) {
  std::filesystem::path path = source.folder / name;
  std::error_code none;
  if (std::filesystem::is_other(path, none))
    throw_input_error("{}: is no regular file, expected one", path.string());
  source.files->push_back(path);
  return path;
}

std::string found_at(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) return "the end of the file";
  const auto byte = static_cast<unsigned char>(text[offset]);
  if (byte == '\n') return "the end of the line";
  if (byte < 32 || byte > 126) return fmt::format("byte 0x{:02x}", byte);
  return fmt::format("'{}'", text[offset]);
}

}  // namespace espalier::lsystem
