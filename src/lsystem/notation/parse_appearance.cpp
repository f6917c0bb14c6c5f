#include <algorithm>

#include <espalier/lsystem/notation/parse_appearance.h>
#include <espalier/lsystem/notation/parse_parameter.h>
#include <espalier/lsystem/notation/parse_surroundings.h>
#include <espalier/lsystem/surfaces/surfaces.h>

namespace espalier::lsystem {

namespace {

constexpr std::size_t kMostPlants = 16;

std::string new_surface_name(Cursor& cursor, const Appearance& appearance) {
  cursor.skip_space();
  const Position start = cursor.position();
  std::string name = cursor.expect_word("the name of a surface");
  for (const NamedSurface& other : appearance.surfaces)
    if (other.name == name) throw_at(start, "got surface '{}' a second time, expected another name", name);
  cursor.expect("=");
  cursor.skip_space();
  return name;
}

std::vector<NamedNumber> parse_named_numbers(Cursor& cursor) {
  std::vector<NamedNumber> numbers;
  while (!cursor.at_end()) {
    NamedNumber& number = numbers.emplace_back();
    number.position = cursor.position();
    number.name = cursor.expect_word("the name of a parameter, or seed");
    cursor.expect("=");
    number.value = parse_number(cursor, "a number");
  }
  return numbers;
}

}  // namespace

std::string parse_file_name(Cursor& cursor) {
  cursor.expect("\"");
  const std::size_t end = cursor.rest().find('"');
  if (end == std::string_view::npos) cursor.fail("'\"' after the file's name");
  std::string name(cursor.rest().substr(0, end));
  for (const char byte : name)
    if (static_cast<unsigned char>(byte) < 32)
      cursor.fail("a file's name without line breaks and control characters");
  cursor.go_to(cursor.at() + end + 1);
  return name;
}

void parse_color_table(Cursor& cursor, Appearance& appearance) {
  if (!appearance.colors.empty()) throw_at(cursor.position(), "got a second table of colours, expected one");
  while (!cursor.at_end()) {
    cursor.take("#");
    const Position position = cursor.position();
    const std::string_view rest = cursor.rest();
    const std::string word(rest.substr(0, std::min(rest.find_first_of(" \t\r\n#"), rest.size())));
    if (word.size() != 6 || word.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
      throw_at(position, "got '{}', expected a colour of six hexadecimal digits", word.substr(0, 40));
    cursor.go_to(cursor.at() + word.size());
    const auto value = static_cast<unsigned>(std::stoul(word, nullptr, 16));
    const auto byte = [](unsigned bits) { return static_cast<std::uint8_t>(bits & 0xff); };
    appearance.colors.push_back({byte(value >> 16), byte(value >> 8), byte(value), true});
  }
  if (appearance.colors.empty()) cursor.fail("colours of six hexadecimal digits");
}

void parse_surface_declaration(Cursor& cursor, bool may_read_files, Appearance& appearance) {
  cursor.take("surface");
  NamedSurface surface;
  surface.name = new_surface_name(cursor, appearance);
  const Position position = cursor.position();
  const std::string file = parse_file_name(cursor);
  if (!cursor.at_end()) cursor.fail("the end of the line");
  surface.triangles = read_surface(file, may_read_files, position);
  appearance.surfaces.push_back(std::move(surface));
}

void parse_plant_declaration(Cursor& cursor, Appearance& appearance) {
  NamedSurface surface;
  surface.name = new_surface_name(cursor, appearance);
  const Position position = cursor.position();
  if (!position.source->may_have_plants)
    throw_at(position, "got a plant in an L-system that is a plant of another, expected none");
  const auto is_plant = [](const NamedSurface& other) { return other.declared.has_value(); };
  if (std::count_if(appearance.surfaces.begin(), appearance.surfaces.end(), is_plant) >=
      static_cast<std::ptrdiff_t>(kMostPlants))
    throw_at(position, "got more than {} plants, expected fewer", kMostPlants);
  const std::string file = parse_file_name(cursor);
  surface.declared = {file, parse_named_numbers(cursor), position};
  appearance.surfaces.push_back(std::move(surface));
}

}  // namespace espalier::lsystem
