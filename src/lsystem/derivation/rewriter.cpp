#include <algorithm>

#include <espalier/lsystem/derivation/rewriter.h>

namespace espalier::lsystem {

namespace {

constexpr std::size_t kMostValues = 30'000'000;  // of a string: 240 MB

}  // namespace

Rewriter::Rewriter(const std::vector<Production>& productions, RuleContext& shared, const Limits& limits,
                   RandomSites sites)
    : shared_(shared),
      limits_(limits),
      ignored_(shared.grammar.ignored.begin(), shared.grammar.ignored.end()),
      considered_(shared.grammar.considered.begin(), shared.grammar.considered.end()) {
  for (const Production& production : productions) {
    const std::uint32_t before = shared.random_sites;
    if (sites == RandomSites::of_each_production) shared.random_sites = 1;
    const std::uint32_t first = shared.random_sites;
    rules_.push_back(std::make_unique<Rule>(production, shared));
    shared.random_sites = before + (shared.random_sites - first);
  }
}

/// The groups of the productions that take part in this step.
void Rewriter::prepare_groups(const std::vector<bool>& table_is_on) {
  groups_.clear();
  needs_index_ = false;
  group_of_.assign(shared_.alphabet.size(), -1);
  for (const auto& rule : rules_) {
    const Production& production = rule->production();
    if (production.table >= 0 && !table_is_on[static_cast<std::size_t>(production.table)]) continue;
    std::int32_t& group = group_of_[production.predecessor.symbol];
    if (group < 0) {
      group = static_cast<std::int32_t>(groups_.size());
      groups_.emplace_back();
    }
    auto& members = groups_[static_cast<std::size_t>(group)];
    (production.is_context_sensitive() ? members.sensitive : members.free).push_back(rule.get());
    needs_index_ = needs_index_ || production.is_context_sensitive();
  }
}

void Rewriter::prepare_skipped() {
  const bool has_considered = shared_.grammar.has_considered;
  skipped_.assign(shared_.alphabet.size(), 0);
  for (std::size_t id = 0; id < skipped_.size(); ++id) {
    const std::string& name = shared_.alphabet[static_cast<SymbolId>(id)].name;
    skipped_[id] = ignored_.contains(name) || (has_considered && !considered_.contains(name));
  }
}

bool Rewriter::draws() const {
  return std::any_of(rules_.begin(), rules_.end(), [](const auto& rule) { return rule->draws(); });
}

void Rewriter::rewrite(const ModuleString& string, RandomKey key, const std::vector<bool>& table_is_on,
                       ModuleString& result, const Lineage& lineage) {
  shared_.work.add(work_of::kSymbol * static_cast<double>(shared_.alphabet.size() + rules_.size()));
  prepare_groups(table_is_on);
  if (needs_index_) {
    shared_.work.add(work_of::kModule * static_cast<double>(string.size()));
    const SymbolId open = shared_.alphabet.intern("[", 0), close = shared_.alphabet.intern("]", 0);
    prepare_skipped();
    index_.build(string, shared_.alphabet, open, close, skipped_, shared_.grammar.follow_branches);
  }
  result.clear();
  if (lineage.result) lineage.result->clear();
  value_offset_ = 0;
  const Rewriting rewriting{string, index_, key, lineage.keys};
  for (std::size_t begin = 0; begin < string.size(); begin += kBlockSize) {
    const std::size_t end = std::min(begin + kBlockSize, string.size());
    shared_.work.add(work_of::kModule * static_cast<double>(end - begin + groups_.size()));
    collect(string, begin, end);
    for (Group& group : groups_)
      if (group.candidates.size() > 0) choose(group, rewriting);
    const std::size_t written = result.size();
    emit(string, begin, end, result);
    if (lineage.result) emit_identities(string, begin, end, result.symbols.data() + written, lineage);
  }
  result.symbols.fit();
  result.values.fit();
}

/// Sorts the modules of a block by group.
void Rewriter::collect(const ModuleString& string, std::size_t begin, std::size_t end) {
  block_begin_ = begin;
  choices_.assign(end - begin, {});
  for (Group& group : groups_) group.candidates.clear();
  const std::uint8_t* arities = shared_.alphabet.arities().data();
  std::size_t offset = value_offset_;
  for (std::size_t i = begin; i < end; ++i) {
    const SymbolId symbol = string.symbols[i];
    const std::int32_t group = symbol < group_of_.size() ? group_of_[symbol] : -1;
    if (group >= 0) {
      Candidates& candidates = groups_[static_cast<std::size_t>(group)].candidates;
      candidates.module.push_back(static_cast<std::uint32_t>(i));
      candidates.values.push_back(static_cast<std::uint32_t>(offset));
    }
    offset += arities[symbol];
  }
}

void Rewriter::choose(const Group& group, const Rewriting& rewriting) {
  const Candidates* candidates = &group.candidates;
  if (!group.sensitive.empty()) {
    choose_among(*candidates, group.sensitive, rewriting);
    if (group.free.empty()) return;
    unclaimed_.clear();
    for (std::size_t i = 0; i < candidates->size(); ++i) {
      if (claims_[i] != Claim::none) continue;
      unclaimed_.module.push_back(candidates->module[i]);
      unclaimed_.values.push_back(candidates->values[i]);
    }
    candidates = &unclaimed_;
  }
  if (candidates->size() > 0) choose_among(*candidates, group.free, rewriting);
}

/// Lets these rules claim candidates; who gets none stays, or is left to other rules.
void Rewriter::choose_among(const Candidates& candidates, const std::vector<Rule*>& rules,
                            const Rewriting& rewriting) {
  const std::size_t count = candidates.size();
  claims_.assign(count, Claim::none);
  if (rules.size() == 1 && !rules[0]->production().probability) {
    rules[0]->match(candidates, rewriting, shared_);
    for (const std::uint16_t hit : rules[0]->hits()) claims_[hit] = Claim::deterministic;
    return apply(*rules[0], candidates, rewriting);
  }
  owners_.assign(count, nullptr);
  claimants_.assign(count, nullptr);
  totals_.assign(count, 0);
  draws_.assign(count, -1);
  for (Rule* rule : rules) {
    rule->match(candidates, rewriting, shared_);
    claim_hits(*rule, candidates, rewriting);
  }
  for (std::size_t i = 0; i < count; ++i)
    if (totals_[i] > 1 + 1e-9) check_total(candidates, i, rules, rewriting);
  for (Rule* rule : rules) {
    keep_.clear();
    for (const std::uint16_t hit : rule->hits()) keep_.push_back(owners_[hit] == rule);
    rule->keep_hits(keep_);
    apply(*rule, candidates, rewriting);
  }
}

/// A stochastic rule gets a candidate where the draw falls into its share of [0, 1).
void Rewriter::claim_hits(Rule& rule, const Candidates& candidates, const Rewriting& rewriting) {
  const bool stochastic = rule.production().probability.has_value();
  shared_.work.add(2 * work_of::kCandidate * static_cast<double>(rule.hits().size()));
  for (std::size_t slot = 0; slot < rule.hits().size(); ++slot) {
    const std::size_t i = rule.hits()[slot];
    const bool shared = stochastic && claims_[i] == Claim::stochastic;
    if (claims_[i] != Claim::none && !shared) fail_conflict(rule, *claimants_[i], candidates, i, rewriting);
    claimants_[i] = &rule;
    if (!stochastic) {
      claims_[i] = Claim::deterministic;
      owners_[i] = &rule;
      continue;
    }
    if (claims_[i] == Claim::none) draws_[i] = random_unit(rewriting.module_key(candidates.module[i]), 0);
    claims_[i] = Claim::stochastic;
    const double before = totals_[i];
    totals_[i] += rule.weights()[slot];
    if (before <= draws_[i] && draws_[i] < totals_[i]) owners_[i] = &rule;
  }
}

namespace {

std::string text_of(const Candidates& candidates, std::size_t candidate, const Rewriting& rewriting,
                    const SymbolTable& alphabet) {
  const Symbol& symbol = alphabet[rewriting.string.symbols[candidates.module[candidate]]];
  return module_text(symbol, rewriting.string.values.data() + candidates.values[candidate]);
}

}  // namespace

void Rewriter::check_total(const Candidates& candidates, std::size_t candidate,
                           const std::vector<Rule*>& rules, const Rewriting& rewriting) const {
  throw_at(rules[0]->production().position,
           "module {}: the probabilities of {} and the others sum to {}, expected at most 1",
           text_of(candidates, candidate, rewriting, shared_.alphabet), rules[0]->production().name,
           totals_[candidate]);
}

void Rewriter::fail_conflict(const Rule& rule, const Rule& other, const Candidates& candidates,
                             std::size_t candidate, const Rewriting& rewriting) const {
  throw_at(rule.production().position, "module {}: {} and {} ({}) both apply, expected one of them",
           text_of(candidates, candidate, rewriting, shared_.alphabet), rule.production().name,
           other.production().name, describe(other.production().position));
}

void Rewriter::apply(Rule& rule, const Candidates& candidates, const Rewriting& rewriting) {
  if (rule.hits().empty()) return;
  rule.compute_successor(candidates, rewriting, shared_);
  for (std::size_t slot = 0; slot < rule.hits().size(); ++slot)
    if (rule.replaces(slot))
      choices_[candidates.module[rule.hits()[slot]] - block_begin_] = {&rule,
                                                                       static_cast<std::uint16_t>(slot)};
}

/// Writes the block's part of the result: successors, and runs of modules that stay.
void Rewriter::emit(const ModuleString& string, std::size_t begin, std::size_t end, ModuleString& result) {
  const std::uint8_t* arities = shared_.alphabet.arities().data();
  const SymbolId* symbols = string.symbols.data();
  const double* values = string.values.data() + value_offset_;
  std::size_t symbol_count = 0, value_count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const Choice& choice = choices_[i - begin];
    symbol_count += choice.rule ? choice.rule->symbol_count(choice.slot) : 1;
    value_count += choice.rule ? choice.rule->value_count(choice.slot) : arities[symbols[i]];
    value_offset_ += arities[symbols[i]];
  }
  if (result.values.size() + value_count > kMostValues)
    throw TooManyModules(fmt::format("{}: the string has more than {} parameters, expected fewer",
                                     shared_.grammar.name, kMostValues));
  if (result.size() + symbol_count > limits_.modules)
    throw TooManyModules(
        fmt::format("{}: the string has more than {} modules, expected fewer (--max-modules)",
                    shared_.grammar.name, limits_.modules));
  shared_.work.add(work_of::kModule * static_cast<double>(symbol_count) +
                   work_of::kValue * static_cast<double>(value_count));
  SymbolId* symbol_end = result.symbols.grow(symbol_count);
  double* value_end = result.values.grow(value_count);
  for (std::size_t i = begin; i < end; ++i) {
    const Choice& choice = choices_[i - begin];
    const std::size_t arity = arities[symbols[i]];
    if (choice.rule) {
      choice.rule->write(choice.slot, symbol_end, value_end);
    } else {
      *symbol_end++ = symbols[i];
      for (std::size_t v = 0; v < arity; ++v) *value_end++ = values[v];
    }
    values += arity;
  }
}

/// Writes the identities of the block's part of the result, whose symbols start at `successors`.
void Rewriter::emit_identities(const ModuleString& string, std::size_t begin, std::size_t end,
                               const SymbolId* successors, const Lineage& lineage) {
  // Lua bodies make symbols while the string is rewritten.
  if (by_name_.size() != shared_.alphabet.size()) {
    shared_.work.add(work_of::kSymbol * static_cast<double>(shared_.alphabet.size()));
    by_name_ = symbols_by_name(shared_.alphabet);
  }
  for (std::size_t i = begin; i < end; ++i) {
    const Choice& choice = choices_[i - begin];
    const std::size_t count = choice.rule ? choice.rule->symbol_count(choice.slot) : 1;
    const std::uint64_t identity = (*lineage.string)[i];
    if (choice.rule)
      append_identities(identity, string.symbols[i], {successors, count}, by_name_, lineage.step,
                        *lineage.result);
    else
      lineage.result->push_back(identity);
    successors += count;
  }
}

}  // namespace espalier::lsystem
