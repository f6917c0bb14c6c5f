#include <algorithm>
#include <array>

#include <espalier/lsystem/notation/parse_modules.h>
#include <espalier/lsystem/notation/parse_surroundings.h>

namespace espalier::lsystem {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostObjects = 1000;

void check_count(std::size_t count, const Cursor& cursor, const char* what) {
  if (count >= kMostObjects)
    throw_at(cursor.position(), "got more than {} {}, expected fewer", kMostObjects, what);
}

}  // namespace

fs::path file_beside(const std::string& name, const Source& source) {
  if (!source.may_read_files)
    throw_input_error("got file \"{}\", expected none in an L-system that is no file", name);
  if (name.empty() || name.find_first_of("/\\") != std::string::npos || name.starts_with('.'))
    throw_input_error("got file \"{}\", expected the name of a file in the folder of the L-system", name);
  return note_file(name, source);
}

void parse_volume_declaration(Cursor& cursor, const std::string& name, Grammar& grammar) {
  check_count(grammar.volumes.size(), cursor, "volumes");
  cursor.expect("=");
  cursor.skip_space();
  const Position position = cursor.position();
  const auto& names = grammar.names.volumes;
  try {
    VolumeTree tree = parse_volume_tree(
        cursor.rest(),
        [&](std::string_view word) { return std::find(names.begin(), names.end(), word) != names.end(); },
        [&](const std::string& file) { return file_beside(file, *position.source); });
    grammar.volumes.push_back({name, std::move(tree), position, grammar.constants.size()});
  } catch (const VolumeError& error) {
    throw_at({position.source, position.offset + error.offset}, "{}", error.what());
  }
  grammar.names.volumes.push_back(name);
}

void parse_field_declaration(Cursor& cursor, const std::string& name, Grammar& grammar) {
  check_count(grammar.fields.size(), cursor, "fields");
  FieldDeclaration field{name, nullptr, {}, grammar.constants.size()};
  for (const char* token : {"=", "picture", "(", "\""}) cursor.expect(token);
  const Position position = cursor.position();
  const std::size_t end = cursor.rest().find('"');
  if (end == std::string_view::npos) cursor.fail("'\"' after the file's name");
  try {
    const fs::path path = file_beside(std::string(cursor.rest().substr(0, end)), *position.source);
    field.picture = std::make_shared<PictureField>(read_picture_field(path));
  } catch (const InputError& error) {
    throw_at(position, "{}", error.what());
  }
  cursor.go_to(cursor.at() + end + 1);
  for (int i = 0; i < 3; ++i) {
    cursor.expect(",");
    field.frame.push_back(parse_expression(cursor, ",)"));
  }
  cursor.expect(")");
  if (!cursor.at_end()) cursor.fail("the end of the line");
  grammar.fields.push_back(std::move(field));
  grammar.names.fields.push_back(name);
}

void parse_sun(Cursor& cursor, Grammar& grammar) {
  const Position position = cursor.position();
  if (grammar.has_sun) throw_at(position, "got a second sun, expected one");
  const std::vector<Expression> vector = parse_expressions(cursor, "");
  if (vector.size() != 3) throw_at(position, "sun: got {} numbers, expected 3", vector.size());
  grammar.has_sun = true;
  const std::string length =
      fmt::format("sqrt(({})^2+({})^2+({})^2)", vector[0].text, vector[1].text, vector[2].text);
  constexpr std::array kNames{"sun_x", "sun_y", "sun_z"};
  for (std::size_t i = 0; i < 3; ++i) {
    grammar.constants.push_back(
        {kNames[i], {fmt::format("({})/{}", vector[i].text, length), vector[i].position}, std::nullopt});
    grammar.names.globals.push_back(kNames[i]);
  }
}

void parse_shades(Cursor& cursor, Grammar& grammar) {
  const auto& names = grammar.names.volumes;
  do {
    cursor.skip_space();
    const Position position = cursor.position();
    const std::string name = cursor.expect_word("the name of a volume");
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw_at(position, "got the unknown volume '{}', expected one declared before", name);
    grammar.shades.push_back(static_cast<std::size_t>(found - names.begin()));
  } while (cursor.take(","));
  if (!cursor.at_end()) cursor.fail("',' or the end of the line");
}

}  // namespace espalier::lsystem
