// Overrides of the parameters of a model, at a branch: any row or curve of its table by the key that presets
// have for it, so that nothing here knows a model's names. As values are, they are explicit or relative to
// what is inherited [Boudon et al. 2003, Interactive design of bonsai tree models, §2.1 and §2.2: a node
// holds the parameters of its branching system]. Factors and offsets of curves are curves: they act number by
// number, which is the pointwise sum, and the pointwise product where one of the two is the same everywhere.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <espalier/core/parameter_table.h>
#include <espalier/core/toml/toml_section.h>
#include <espalier/overrides/branch_change.h>

namespace espalier {

struct RowNumber {
  std::uint32_t row = 0;  ///< of the model's table
  double number = 0;
};

/// What one key says.
struct ParameterOverride {
  std::string key;  ///< of a row, of a curve, or of all levels
  Relation relation = Relation::value;
  std::vector<double> numbers;  ///< as given
  bool is_list = false;         ///< whether they were given as an array
  bool is_private = false;      ///< not inherited by the branches below
  std::vector<RowNumber> rows;  ///< what that is in the table
};

/// What a branch says of one row.
struct RowOverride {
  std::uint32_t row = 0;
  Relation relation = Relation::value;
  double number = 0;
  bool is_private = false;
};

/// What all that is said of one row amounts to.
struct RowChange {
  std::uint32_t row = 0;
  ModificationOf<double> change;
};
using RowChanges = std::vector<RowChange>;  ///< by row, each once

/// Adds what `entry` says to what is inherited.
void apply(const RowOverride& entry, RowChanges& changes);

/// `values` with the changes, each rounded and moved into the bounds of its row where a relative one leaves
/// them.
ParameterValues changed_values(const ParameterTable& table, std::span<const double> values,
                               const RowChanges& changes);

/// What an entry of TOML says: a number, or { factor = …, private = true }.
struct SaidInToml {
  Relation relation = Relation::value;
  const toml::node* number = nullptr;
  bool is_private = false;
};
inline constexpr const char* kRelations[] = {"value", "factor", "offset"};  ///< in the order of Relation
SaidInToml read_said(const TomlSection& node, const std::string& key);

/// The keys of the table's rows and curves.
std::vector<std::string> parameter_keys(const ParameterTable& table);

/// Reads one of them. Throws InputError with file, line, key, got and expected for what no branch can have,
/// for numbers that are not valid, and for a factor or an offset of a choice.
ParameterOverride read_parameter(const TomlSection& node, const std::string& key,
                                 const ParameterTable& table);

/// Throws InputError where branches of this level, trunks being 0, cannot have it for themselves: rows of
/// shallower levels act on what bears the branch, or on nothing.
void check_level(const ParameterOverride& entry, int level, const ParameterTable& table,
                 const std::string& where);

/// The line of TOML that reads back to the same bits.
std::string to_toml(const ParameterOverride& entry);

}  // namespace espalier
