#include <algorithm>
#include <cmath>
#include <limits>

#include <espalier/lsystem/derivation/rule.h>

namespace espalier::lsystem {

namespace {

/// Each holds kBlockSize numbers: 240 MB.
constexpr std::size_t kMostColumns = 60'000;

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

void append_parameters(std::vector<std::string>& names, std::span<const PatternModule> modules) {
  for (const PatternModule& module : modules)
    names.insert(names.end(), module.parameters.begin(), module.parameters.end());
}

}  // namespace

Rule::Rule(const Production& production, RuleContext& shared) : production_(&production) {
  append_parameters(parameters_, production.left);
  own_begin_ = parameters_.size();
  append_parameters(parameters_, std::span(&production.predecessor, 1));
  own_end_ = parameters_.size();
  append_parameters(parameters_, production.right);
  if (production.condition) condition_.emplace(*production.condition, parameters_, true, shared);
  if (production.probability) probability_.emplace(*production.probability, parameters_, false, shared);
  for (const SuccessorModule& module : production.successor) {
    successor_.push_back(module.symbol);
    for (const Expression& argument : module.arguments) {
      const bool query = is_query(shared.alphabet[module.symbol].name);
      argument_of_value_.push_back(query ? -1 : static_cast<int>(arguments_.size()));
      if (!query) arguments_.emplace_back(argument, parameters_, false, shared);
    }
  }
  if (production.lua_body) body_ = shared.functions.compile_body(*production.lua_body, parameters_);
  column_data_.resize(parameters_.size());
  needs_keys_ = body_ || (condition_ && condition_->draws()) || (probability_ && probability_->draws()) ||
                std::any_of(arguments_.begin(), arguments_.end(), [](const auto& a) { return a.draws(); });
  count_columns(shared);
}

/// Rules keep their columns from block to block.
void Rule::count_columns(RuleContext& shared) const {
  shared.columns += parameters_.size();
  for (const auto* expression : {&condition_, &probability_})
    if (*expression) shared.columns += (*expression)->columns();
  for (const BlockExpression& argument : arguments_) shared.columns += argument.columns();
  if (shared.columns > kMostColumns)
    throw_at(production_->position,
             "got productions of more than {} parameters and operations, expected fewer", kMostColumns);
}

/// Keeps the candidates whose contexts fit, with the places of the modules there.
void Rule::match_contexts(const Candidates& candidates, const StringIndex& index, RuleContext& shared) {
  const std::size_t left = production_->left.size(), contexts = left + production_->right.size();
  hits_.resize(candidates.size());
  if (contexts == 0) {
    for (std::size_t i = 0; i < hits_.size(); ++i) hits_[i] = static_cast<std::uint16_t>(i);
    return;
  }
  shared.matched.resize(candidates.size() * contexts);
  std::uint32_t* matched = shared.matched.data();
  std::size_t hits = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const std::size_t module = candidates.module[i];
    if (!index.match_left(module, production_->left, matched, shared.work) ||
        !index.match_right(module, production_->right, matched + left, shared.work))
      continue;
    hits_[hits++] = static_cast<std::uint16_t>(i);
    matched += contexts;
  }
  hits_.resize(hits);
}

/// Fills the columns for the hits.
void Rule::gather(const Candidates& candidates, const Rewriting& rewriting, const RuleContext& shared) {
  const std::size_t count = hits_.size();
  const double* values = rewriting.string.values.data();
  for (auto& column : column_data_)
    if (column.size() < count) column.resize(kBlockSize);
  for (std::size_t c = own_begin_; c < own_end_; ++c) {
    double* column = column_data_[c].data();
    for (std::size_t slot = 0; slot < count; ++slot)
      column[slot] = values[candidates.values[hits_[slot]] + (c - own_begin_)];
  }
  const std::size_t contexts = production_->left.size() + production_->right.size();
  std::size_t c = 0;
  for (std::size_t k = 0; k < contexts; ++k) {
    if (k == production_->left.size()) c = own_end_;
    const PatternModule& pattern = k < production_->left.size()
                                       ? production_->left[k]
                                       : production_->right[k - production_->left.size()];
    for (std::size_t p = 0; p < pattern.parameters.size(); ++p, ++c)
      for (std::size_t slot = 0; slot < count; ++slot)
        column_data_[c][slot] = values[rewriting.index.value_offset(shared.matched[slot * contexts + k]) + p];
  }
  columns_.clear();
  for (const auto& column : column_data_) columns_.push_back({column.data(), 1});
}

void Rule::match(const Candidates& candidates, const Rewriting& rewriting, RuleContext& shared) {
  bodies_.clear();
  shared.work.add(work_of::kBlock + work_of::kCandidate * static_cast<double>(candidates.size()));
  match_contexts(candidates, rewriting.index, shared);
  if (hits_.empty()) return;
  shared.work.add(work_of::kValue * static_cast<double>(hits_.size() * parameters_.size()));
  gather(candidates, rewriting, shared);
  make_keys(candidates, rewriting);
  if (condition_) apply_condition(candidates, rewriting, shared);
  if (!probability_ || hits_.empty()) return;
  weights_ = compute(*probability_, "probability", candidates, rewriting, shared);
  for (std::size_t slot = 0; slot < hits_.size(); ++slot)
    if (weights_[slot] < 0)
      fail(candidates, rewriting, slot, shared,
           fmt::format("probability is {}, expected none below 0", weights_[slot]));
}

void Rule::make_keys(const Candidates& candidates, const Rewriting& rewriting) {
  keys_.clear();
  if (!needs_keys_) return;
  for (const std::uint16_t hit : hits_) keys_.push_back(rewriting.module_key(candidates.module[hit]));
}

void Rule::apply_condition(const Candidates& candidates, const Rewriting& rewriting, RuleContext& shared) {
  const Column holds = compute(*condition_, "condition", candidates, rewriting, shared);
  std::vector<std::uint8_t> keep(hits_.size());
  for (std::size_t slot = 0; slot < keep.size(); ++slot) keep[slot] = holds[slot] != 0;
  compress(keep);
}

/// Drops the hits that are not kept, with their columns and keys.
void Rule::compress(std::span<const std::uint8_t> keep) {
  std::size_t kept = 0;
  for (std::size_t slot = 0; slot < keep.size(); ++slot) {
    if (!keep[slot]) continue;
    if (kept != slot) {
      hits_[kept] = hits_[slot];
      if (needs_keys_) keys_[kept] = keys_[slot];
      for (auto& column : column_data_) column[kept] = column[slot];
    }
    ++kept;
  }
  hits_.resize(kept);
  if (needs_keys_) keys_.resize(kept);
}

void Rule::keep_hits(std::span<const std::uint8_t> keep) {
  if (std::find(keep.begin(), keep.end(), 0) != keep.end()) compress(keep);
}

void Rule::compute_successor(const Candidates& candidates, const Rewriting& rewriting, RuleContext& shared) {
  if (body_) return run_bodies(candidates, rewriting, shared);
  results_.clear();
  for (BlockExpression& argument : arguments_)
    results_.push_back(compute(argument, "argument", candidates, rewriting, shared));
}

void Rule::run_bodies(const Candidates& candidates, const Rewriting& rewriting, RuleContext& shared) {
  produced_.clear();
  for (std::size_t slot = 0; slot < hits_.size(); ++slot) {
    shared.work.add(work_of::kLuaCall);
    try {
      const bool produced = shared.functions.run_body(*body_, columns_, slot, keys_[slot], produced_);
      bodies_.push_back({produced, static_cast<std::uint32_t>(produced_.symbols.size()),
                         static_cast<std::uint32_t>(produced_.values.size())});
    } catch (const InputError& error) {
      fail(candidates, rewriting, slot, shared, error.what());
    }
  }
}

Column Rule::compute(BlockExpression& expression, const char* what, const Candidates& candidates,
                     const Rewriting& rewriting, RuleContext& shared) {
  const auto text = [&](const std::string& problem) {
    return fmt::format("{} '{}' {}", what, shortened(expression.source().text), problem);
  };
  Column column;
  try {
    column = expression.compute(columns_, needs_keys_ ? keys_.data() : nullptr, hits_.size(), shared);
  } catch (const TooMuchWork&) {
    throw;
  } catch (const InputError& all) {
    // Which module it was: one by one.
    for (std::size_t slot = 0; slot < hits_.size(); ++slot) try {
        std::vector<Column> one;
        for (const Column& c : columns_) one.push_back({c.data + slot * c.stride, 0});
        expression.compute(one, needs_keys_ ? keys_.data() + slot : nullptr, 1, shared);
      } catch (const InputError& error) {
        fail(candidates, rewriting, slot, shared, text(error.what()));
      }
    throw;
  }
  if (const auto bad = BlockExpression::first_not_finite(column, hits_.size()))
    fail(candidates, rewriting, *bad, shared,
         text(fmt::format("is {}, expected a finite number (a division by zero?)", column[*bad])));
  return column;
}

void Rule::fail(const Candidates& candidates, const Rewriting& rewriting, std::size_t slot,
                const RuleContext& shared, const std::string& message) const {
  const std::size_t hit = hits_[slot], module = candidates.module[hit];
  const Symbol& symbol = shared.alphabet[rewriting.string.symbols[module]];
  const std::string text = module_text(symbol, rewriting.string.values.data() + candidates.values[hit]);
  throw_at(production_->position, "{}, module {}: {}", production_->name, text, message);
}

std::size_t Rule::symbol_count(std::size_t slot) const {
  if (!body_) return successor_.size();
  return bodies_[slot].symbols_end - (slot == 0 ? 0 : bodies_[slot - 1].symbols_end);
}

std::size_t Rule::value_count(std::size_t slot) const {
  if (!body_) return argument_of_value_.size();
  return bodies_[slot].values_end - (slot == 0 ? 0 : bodies_[slot - 1].values_end);
}

void Rule::write(std::size_t slot, SymbolId*& symbols, double*& values) const {
  const std::size_t symbol_number = symbol_count(slot), value_number = value_count(slot);
  if (body_) {
    const Body& body = bodies_[slot];
    std::copy_n(produced_.symbols.data() + body.symbols_end - symbol_number, symbol_number, symbols);
    std::copy_n(produced_.values.data() + body.values_end - value_number, value_number, values);
  } else {
    std::copy_n(successor_.data(), symbol_number, symbols);
    for (std::size_t v = 0; v < value_number; ++v) {
      const int argument = argument_of_value_[v];
      values[v] = argument < 0 ? kUndefined : results_[static_cast<std::size_t>(argument)][slot];
    }
  }
  symbols += symbol_number;
  values += value_number;
}

}  // namespace espalier::lsystem
