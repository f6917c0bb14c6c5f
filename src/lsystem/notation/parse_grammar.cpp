// The statements of an L-system file, one function a keyword; see docs/lsystem.md for the notation.
#include <algorithm>
#include <map>
#include <set>

#include <espalier/lsystem/expressions/lua_words.h>
#include <espalier/lsystem/notation/grammar.h>
#include <espalier/lsystem/notation/headings.h>
#include <espalier/lsystem/notation/parse_appearance.h>
#include <espalier/lsystem/notation/parse_function.h>
#include <espalier/lsystem/notation/parse_grammar.h>
#include <espalier/lsystem/notation/parse_modules.h>
#include <espalier/lsystem/notation/parse_parameter.h>
#include <espalier/lsystem/notation/parse_production.h>
#include <espalier/lsystem/notation/parse_surroundings.h>
#include <espalier/lsystem/notation/settings.h>
#include <espalier/lsystem/strings/statements.h>

namespace espalier::lsystem {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFunctions = 1000;
constexpr std::size_t kMostProductions = 20'000, kMostConstants = 20'000;
constexpr int kMostIncludes = 1000, kDeepestInclude = 64;

class Parser {
 public:
  explicit Parser(Grammar& grammar) : grammar_(grammar) { grammar.appearance = appearance_; }

  void parse(const std::shared_ptr<const Source>& source, bool may_include) {
    const FileText file = split_statements(source);
    declare_symbols(file);
    grammar_.uses_light |= file.clean.find("light(") != std::string::npos;  // skylight( too
    for (const Statement& statement : file.statements) {
      Cursor cursor(file, statement.begin, statement.end);
      parse_statement(cursor, may_include);
    }
  }

  void finish(const std::shared_ptr<const Source>& source) {
    appearance_->file = source->label;
    if (appearance_->colors.empty()) appearance_->colors = default_colors();
    if (!taken_.contains("fraction") && !grammar_.names.from_lua.contains("fraction"))
      grammar_.names.globals.push_back("fraction");
    grammar_.names.globals.push_back("step");
    if (!grammar_.axiom_position) throw_at({source, 0}, "got no axiom, expected a line 'axiom: …'");
  }

 private:
  using Handler = void (Parser::*)(Cursor&);

  /// Before all else, because they say how strings are cut into modules.
  void declare_symbols(const FileText& file) {
    for (const Statement& statement : file.statements) {
      Cursor cursor(file, statement.begin, statement.end);
      if (!cursor.take("symbols:")) continue;
      while (!cursor.at_end()) declare_symbol(cursor);
    }
  }

  void declare_symbol(Cursor& cursor) {
    cursor.skip_space();
    const Position position = cursor.position();
    try {
      grammar_.declared_symbols.add(cursor.expect_word("a name"));
    } catch (const InputError& error) {
      throw_at(position, "{}", error.what());
    }
  }

  void parse_statement(Cursor& cursor, bool may_include) {
    static const std::map<std::string, Handler, std::less<>> kHandlers{
        {"axiom:", &Parser::parse_axiom},
        {"symbols:", &Parser::skip},
        {"colors:", &Parser::parse_colors},
        {"ignore:", &Parser::parse_ignored},
        {"consider:", &Parser::parse_considered},
        {"productions:", &Parser::open_productions},
        {"interpretation:", &Parser::open_interpretation},
        {"lua:", &Parser::parse_lua},
        {"branches:", &Parser::parse_branches},
        {"segments:", &Parser::parse_segments},
        {"const ", &Parser::parse_constants},
        {"param ", &Parser::parse_parameter},
        {"let ", &Parser::parse_let},
        {"function ", &Parser::parse_function},
        {"volume ", &Parser::parse_volume},
        {"plant ", &Parser::parse_plant},
        {"field ", &Parser::parse_field},
        {"sun:", &Parser::parse_the_sun},
        {"shade:", &Parser::parse_the_shades},
        {"table ", &Parser::open_table}};
    for (const auto& [keyword, handler] : kHandlers)
      if (cursor.rest().starts_with(keyword)) {
        cursor.go_to(cursor.at() + keyword.size());
        return (this->*handler)(cursor);
      }
    if (cursor.rest().starts_with("surface "))
      return parse_surface_declaration(cursor, may_include, *appearance_);
    if (cursor.rest().starts_with("include ")) return parse_include(cursor, may_include);
    if (parse_setting(cursor)) return;
    check_heading(cursor);
    read_production(cursor);
  }

  void skip(Cursor&) {}

  void parse_axiom(Cursor& cursor) {
    if (grammar_.axiom_position) throw_at(cursor.position(), "got a second axiom, expected one");
    grammar_.axiom_position = cursor.position();
    grammar_.axiom = parse_successor(cursor, grammar_);
    if (!cursor.at_end()) cursor.fail("the end of the axiom");
  }

  void parse_names(Cursor& cursor, std::vector<std::string>& names) {
    while (!cursor.at_end()) {
      const std::size_t length = symbol_length(cursor.rest(), grammar_.declared_symbols);
      if (length == 0) cursor.fail("a symbol");
      names.emplace_back(cursor.rest().substr(0, length));
      cursor.go_to(cursor.at() + length);
    }
  }
  void parse_ignored(Cursor& cursor) { parse_names(cursor, grammar_.ignored); }
  void parse_considered(Cursor& cursor) {
    parse_names(cursor, grammar_.considered);
    grammar_.has_considered = true;
  }

  void parse_branches(Cursor& cursor) {
    grammar_.follow_branches = cursor.take("follow");
    if (!grammar_.follow_branches && !cursor.take("skip")) cursor.fail("'skip' or 'follow'");
    if (!cursor.at_end()) cursor.fail("the end of the line");
  }

  void parse_segments(Cursor& cursor) {
    grammar_.leafy_segments = cursor.take("leafy");
    if (!*grammar_.leafy_segments && !cursor.take("plain")) cursor.fail("'plain' or 'leafy'");
    if (!cursor.at_end()) cursor.fail("the end of the line");
  }

  void open_productions(Cursor& cursor) { open_section(cursor, &grammar_.productions); }
  void open_interpretation(Cursor& cursor) { open_section(cursor, &grammar_.interpretations); }
  void open_section(Cursor& cursor, std::vector<Production>* section) {
    if (!cursor.at_end()) cursor.fail("the end of the line");
    section_ = section;
    table_ = -1;
  }

  void open_table(Cursor& cursor) {
    ProductionTable table{cursor.expect_word("the name of a table"), {}};
    cursor.expect("when");
    table.condition = parse_expression(cursor, ":");
    cursor.expect(":");
    if (!cursor.at_end()) cursor.fail("the end of the line");
    grammar_.tables.push_back(table);
    section_ = &grammar_.productions;
    table_ = static_cast<int>(grammar_.tables.size()) - 1;
  }

  void parse_lua(Cursor& cursor) {
    collect_assigned(cursor.rest(), grammar_.names.from_lua);
    grammar_.lua.push_back({lua_code(cursor, cursor.at(), cursor.rest(), grammar_),
                            cursor.position().source->label, std::nullopt});
  }

  std::string new_name(Cursor& cursor) {
    cursor.skip_space();
    const Position position = cursor.position();
    std::string name = cursor.expect_word("a name");
    if (is_lua_word(name) || name == "step" || name == "unit")
      throw_at(position, "got '{}', expected a name that is not taken by Lua, the step or the unit", name);
    if (!taken_.insert(name).second)
      throw_at(position, "got '{}' a second time, expected another name", name);
    if (grammar_.constants.size() >= kMostConstants)
      throw_at(position, "got more than {} constants and parameters, expected fewer", kMostConstants);
    return name;
  }

  void parse_constants(Cursor& cursor) {
    do {
      const std::string name = new_name(cursor);
      cursor.expect("=");
      grammar_.constants.push_back({name, parse_expression(cursor, ","), std::nullopt});
      grammar_.names.globals.push_back(name);
    } while (cursor.take(","));
    if (!cursor.at_end()) cursor.fail("',' or the end of the line");
  }

  void parse_parameter(Cursor& cursor) {
    const std::string name = new_name(cursor);
    const Position position = cursor.position();
    ParameterInfo row = parse_parameter_row(cursor, name);
    check_role_is_free(grammar_.parameters, row, position);
    grammar_.constants.push_back({name, {"", cursor.position()}, grammar_.parameters.rows.size()});
    grammar_.names.globals.push_back(name);
    grammar_.parameters.rows.push_back(std::move(row));
  }

  /// let prune(x, y) = x^2 + y^2 > L^2
  void parse_let(Cursor& cursor) {
    LetFunction function;
    function.name = new_name(cursor);
    cursor.expect("(");
    do function.parameters.push_back(cursor.expect_word("the name of a parameter"));
    while (cursor.take(","));
    cursor.expect(")");
    cursor.expect("=");
    const Expression body = parse_expression(cursor, "");
    function.body = body.text;
    grammar_.names.functions.emplace(function.name, function);
    // Lua sees it as well, for expressions that are left to it.
    std::string parameters;
    for (const std::string& name : function.parameters) parameters += (parameters.empty() ? "" : ", ") + name;
    const std::string code =
        fmt::format("function {}({}) return {}\n end", function.name, parameters, function.body);
    grammar_.lua.push_back(
        {lua_code(cursor, body.position.offset, code, grammar_), cursor.position().source->label, body});
  }

  /// function f = [0, 0.2, 1, 1] in 0 .. 1
  void parse_function(Cursor& cursor) {
    const std::string name = new_name(cursor);
    if (grammar_.functions.size() >= kMostFunctions)
      throw_at(cursor.position(), "got more than {} functions, expected fewer", kMostFunctions);
    const Position position = cursor.position();
    std::vector<ParameterInfo> rows;
    FunctionDeclaration function = parse_function_declaration(cursor, name, rows);
    if (!rows.empty()) function.first_parameter = grammar_.parameters.rows.size();
    for (ParameterInfo& row : rows) {
      if (!taken_.insert(row.name).second)
        throw_at(position, "got '{}' a second time, as a number of '{}', expected another name", row.name,
                 name);
      grammar_.parameters.rows.push_back(std::move(row));
    }
    grammar_.functions.push_back(std::move(function));
    grammar_.names.curves.push_back(name);
  }

  void parse_volume(Cursor& cursor) { parse_volume_declaration(cursor, new_name(cursor), grammar_); }
  void parse_field(Cursor& cursor) { parse_field_declaration(cursor, new_name(cursor), grammar_); }
  void parse_the_shades(Cursor& cursor) { parse_shades(cursor, grammar_); }
  void parse_the_sun(Cursor& cursor) {
    const Position position = cursor.position();
    for (const char* name : {"sun_x", "sun_y", "sun_z"})
      if (!taken_.insert(name).second)
        throw_at(position, "got the name '{}' before, expected it for the sun", name);
    parse_sun(cursor, grammar_);
  }

  void parse_colors(Cursor& cursor) { parse_color_table(cursor, *appearance_); }
  void parse_plant(Cursor& cursor) { parse_plant_declaration(cursor, *appearance_); }

  void parse_include(Cursor& cursor, bool may_include) {
    cursor.take("include");
    cursor.skip_space();
    const Position position = cursor.position();
    const std::string name = parse_file_name(cursor);
    if (!may_include) throw_at(position, "got an include, expected none in an L-system that is no file");
    // A file from a stranger must not show what else is on the disk.
    if (name.find('/') != std::string::npos || name.find('\\') != std::string::npos ||
        !name.ends_with(".lsys"))
      throw_at(position, "got include \"{}\", expected the name of an .lsys file in the same folder", name);
    if (!included_.insert(name).second)
      throw_at(position, "got include \"{}\" a second time, expected it once", name);
    if (included_.size() > kMostIncludes || depth_ >= kDeepestInclude)
      throw_at(position, "got more than {} includes, or in more than {} files, expected fewer", kMostIncludes,
               kDeepestInclude);
    ++depth_;
    parse(included_source(name, *position.source), true);
    --depth_;
  }

  static std::shared_ptr<const Source> included_source(const std::string& name, const Source& from) {
    const fs::path path = from.folder / name;
    std::string text = read_text(path, *from.so_far);
    from.files->push_back(path);
    return std::make_shared<Source>(Source{path.string(), from.folder, std::move(text), true,
                                           from.may_have_plants, from.files, from.so_far});
  }

  bool parse_setting(Cursor& cursor) {
    const std::size_t begin = cursor.at();
    const std::string name(cursor.take_word());
    const NotationSetting* info = find_setting(name);
    if (!info || !cursor.take(":") || cursor.rest().find("-->") != std::string_view::npos) {
      cursor.go_to(begin);
      return false;
    }
    Setting setting{name, parse_expressions(cursor, "")};
    if (setting.values.size() != info->value_count)
      throw_at(cursor.position(begin), "setting '{}': got {} values, expected {}", name,
               setting.values.size(), info->value_count);
    grammar_.settings.push_back(setting);
    return true;
  }

  void read_production(Cursor& cursor) {
    if (!section_ || cursor.rest().find("-->") == std::string_view::npos)
      fail_unknown(cursor, section_ ? "a production with '-->', a setting or a keyword (see docs/lsystem.md)"
                                    : "a keyword, a setting, or 'productions:' before the first production");
    if (grammar_.productions.size() + grammar_.interpretations.size() >= kMostProductions)
      throw_at(cursor.position(), "got more than {} productions, expected fewer", kMostProductions);
    section_->push_back(parse_production(cursor, grammar_, section_->size() + 1));
    section_->back().table = table_;
  }

  Grammar& grammar_;
  std::shared_ptr<Appearance> appearance_ = std::make_shared<Appearance>();
  std::vector<Production>* section_ = nullptr;
  int table_ = -1, depth_ = 0;
  std::set<std::string> taken_, included_;
};

}  // namespace

Grammar parse_statements(const std::shared_ptr<const Source>& source, const std::string& name,
                         bool may_include) {
  Grammar grammar;
  grammar.name = grammar.parameters.model = name;
  Parser parser(grammar);
  parser.parse(source, may_include);
  parser.finish(source);
  return grammar;
}

}  // namespace espalier::lsystem
