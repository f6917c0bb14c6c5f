#include <charconv>

#include <espalier/core/error.h>
#include <espalier/environment/meshes/ply_head.h>

namespace espalier {

namespace {

/// The count of a line "element vertex 8", or 0.
std::uintmax_t count_of(std::string_view line) {
  if (!line.starts_with("element ")) return 0;
  const std::size_t digits = line.find_last_of(' ') + 1;
  std::uintmax_t count = 0;
  const auto [end, error] = std::from_chars(line.data() + digits, line.data() + line.size(), count);
  return error == std::errc::result_out_of_range ? UINTMAX_MAX : count;
}

}  // namespace

void check_ply_head(std::string_view bytes) {
  if (!bytes.starts_with("ply")) return;
  for (std::string_view head = bytes; !head.starts_with("end_header");) {
    const std::size_t end = head.find_first_of("\r\n");
    if (end == head.npos) throw_input_error("got no line 'end_header', expected one: it was cut off");
    std::string_view line = head.substr(0, end);
    while (line.ends_with(' ')) line.remove_suffix(1);
    if (count_of(line) > bytes.size())
      throw_input_error("got '{}' in a file of {} bytes, expected as many as it holds", line.substr(0, 60),
                        bytes.size());
    head.remove_prefix(end + 1);
  }
}

}  // namespace espalier
