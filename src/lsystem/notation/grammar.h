// An L-system as read from a file: alphabet, constants, productions, tables, and how its strings are drawn.
// Expressions are kept as text with their place; a Derivation compiles them. A grammar does not change once
// it is read, and many threads may derive it.
// Sources: [Topiary §2] the format of productions, [Herbaceous §4.3.3] tables.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <espalier/core/parameter_table.h>
#include <espalier/environment/picture_field.h>
#include <espalier/environment/volume_tree.h>
#include <espalier/lsystem/expressions/program.h>
#include <espalier/lsystem/strings/source.h>
#include <espalier/lsystem/strings/symbols.h>
#include <espalier/lsystem/surfaces/appearance.h>

namespace espalier::lsystem {

struct Expression {
  std::string text;
  Position position;
};

/// A module of a predecessor: its parameters are names.
struct PatternModule {
  SymbolId symbol = 0;
  std::vector<std::string> parameters;
};

/// A module of an axiom or a successor: its arguments are expressions.
struct SuccessorModule {
  SymbolId symbol = 0;
  std::vector<Expression> arguments;
};

struct Production {
  std::string name;  ///< its id, or "production N"
  Position position;
  std::vector<PatternModule> left;  ///< a path towards the root, in the order of the string
  PatternModule predecessor;
  std::vector<PatternModule> right;  ///< with brackets, in the order of the string
  std::optional<Expression> condition;
  std::vector<SuccessorModule> successor;
  std::optional<Expression> lua_body;  ///< instead of a successor
  std::optional<Expression> probability;
  int table = -1;  ///< index of its table, -1 for none

  bool is_context_sensitive() const { return !left.empty() || !right.empty(); }
};

/// A table of productions is used in the steps for which its condition holds.
struct ProductionTable {
  std::string name;
  Expression condition;
};

/// A named value of the file, computed once for a derivation, in the order of the file.
struct Constant {
  std::string name;
  Expression value;
  std::optional<std::size_t> parameter;  ///< a row of Grammar::parameters instead of an expression
};

/// A setting such as "angle: 60", by name; its values are expressions of the constants.
struct Setting {
  std::string name;
  std::vector<Expression> values;
};

/// volume clip = union(box(0,0,6, 12,12,12), …): the numbers are expressions of constants and parameters.
struct VolumeDeclaration {
  std::string name;
  VolumeTree tree;
  Position position;                 ///< where the tree's text starts
  std::size_t constants_before = 0;  ///< how many constants its numbers may use
};

/// field soil = picture("soil.png", x, y, width): its middle and its extent along x, in units.
struct FieldDeclaration {
  std::string name;
  std::shared_ptr<const PictureField> picture;
  std::vector<Expression> frame;
  std::size_t constants_before = 0;
};

/// function f = [0, 0.2, 1, 1] in 0 .. 1: of x from 0 to 1, by 1, 4, 5 or 7 numbers.
struct FunctionDeclaration {
  std::string name;
  std::vector<double> numbers;
  std::optional<std::size_t> first_parameter;  ///< the row of its first number; none: no search varies them
  std::string file;                            ///< the .func file that the numbers were fitted to, or empty
  double error = 0;                            ///< how far they are from it at most
};

struct LuaCode {
  std::string text;  ///< with line breaks before it, so that Lua counts lines as the file does
  std::string label;
  std::optional<Expression> body;  ///< of a let: checked to be one expression, before the text is run
};

struct Grammar {
  std::string name;
  DeclaredSymbols declared_symbols;
  SymbolTable alphabet;
  ParameterTable parameters;  ///< those that a search may vary
  std::vector<Constant> constants;
  Names names;
  std::vector<Setting> settings;
  std::vector<LuaCode> lua;
  std::size_t modules = 0;          ///< of axiom and successors
  std::size_t lua_line_breaks = 0;  ///< before all Lua code, that of productions too
  std::vector<SuccessorModule> axiom;
  std::optional<Position> axiom_position;
  std::vector<ProductionTable> tables;
  std::vector<Production> productions, interpretations;
  std::vector<std::string> ignored, considered;  ///< names of symbols, for contexts
  bool has_considered = false;                   ///< then only those count
  std::vector<VolumeDeclaration> volumes;
  std::vector<FieldDeclaration> fields;
  std::vector<FunctionDeclaration> functions;
  std::vector<std::size_t> shades;  ///< volumes that keep light away
  bool has_sun = false;             ///< then sun_x, sun_y and sun_z are constants
  bool uses_light = false;
  std::shared_ptr<const Appearance> appearance;
  bool follow_branches = false;        ///< right contexts look into branches too
  ReadFiles files;                     ///< none of a text, as the bundled ones are
  std::optional<bool> leafy_segments;  ///< none: the file does not say, and they are not
};

}  // namespace espalier::lsystem
