#include <algorithm>

#include <espalier/core/files.h>
#include <espalier/lsystem/strings/source.h>

namespace espalier::lsystem {

std::string describe(const Position& position) {
  if (!position.source) return "L-system";
  const Source& source = *position.source;
  const std::size_t offset = std::min(position.offset, source.text.size()), line = source.line_of(offset);
  return fmt::format("{}:{}:{}", source.label, line, offset - source.line_starts[line - 1] + 1);
}

std::vector<std::size_t> find_line_starts(std::string_view text) {
  std::vector<std::size_t> starts{0};
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n', end + 1))
    starts.push_back(end + 1);
  return starts;
}

std::size_t Source::line_of(std::size_t offset) const {
  const auto after = std::upper_bound(line_starts.begin(), line_starts.end(), offset);
  return static_cast<std::size_t>(after - line_starts.begin());
}

std::filesystem::path note_file(const std::string& name, const Source& source) {
  std::filesystem::path path = source.folder / name;
  std::error_code none;
  if (std::filesystem::is_other(path, none))
    throw_input_error("{}: is a pipe or a device, expected a file", path.string());
  const std::uintmax_t bytes =
      std::filesystem::is_regular_file(path, none) ? std::filesystem::file_size(path, none) : 0;
  ReadSoFar& so_far = *source.so_far;
  so_far.asset_bytes += bytes;
  if (++so_far.assets > kMostAssets || so_far.asset_bytes > kMostAssetBytes)
    throw_input_error("{}: got more than {} files or {} MB of them, expected fewer", name, kMostAssets,
                      kMostAssetBytes >> 20);
  source.files->push_back(path);
  return path;
}

std::string read_text(const std::filesystem::path& path, ReadSoFar& so_far) {
  std::string text = read_file(path, kMostTextBytes);
  so_far.text_bytes += text.size();
  if (so_far.text_bytes > kMostTextBytes)
    throw_input_error("{}: got more than {} MB, with the files before it, expected less", path.string(),
                      kMostTextBytes >> 20);
  return text;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 80;
  return text.size() <= kMost ? std::string(text) : std::string(text.substr(0, kMost)) + "…";
}

std::string found_at(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) return "the end of the file";
  const auto byte = static_cast<unsigned char>(text[offset]);
  if (byte == '\n') return "the end of the line";
  if (byte < 32 || byte > 126) return fmt::format("byte 0x{:02x}", byte);
  return fmt::format("'{}'", text[offset]);
}

}  // namespace espalier::lsystem
