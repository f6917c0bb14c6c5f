// One parallel rewriting step: every module of a string is replaced by the successor of the production that
// applies to it, or stays where none does. Context-sensitive productions come before context-free ones
// [Herbaceous §2.4]. Modules are handled in blocks: first all rules on a block, then its part of the result.
#pragma once
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <espalier/lsystem/derivation/rule.h>

namespace espalier::lsystem {

/// The identities of a rewritten string's modules, where somebody needs them.
struct Lineage {
  const Identities* keys = nullptr;    ///< of the string: random numbers are keyed by them, not by places
  const Identities* string = nullptr;  ///< of the string, for those of the result
  Identities* result = nullptr;
  std::uint64_t step = 0;
};

/// How calls of random() are numbered. Rules of interpretation number their own: where a module becomes
/// another one, the rule of that draws what the rule before drew.
enum class RandomSites : std::uint8_t { of_all_productions, of_each_production };

class Rewriter {
 public:
  Rewriter(const std::vector<Production>& productions, RuleContext& shared, const Limits& limits,
           RandomSites sites = RandomSites::of_all_productions);

  void set_limits(const Limits& limits) { limits_ = limits; }
  /// The alphabet has lost symbols that Lua code made.
  void forget_symbols() { by_name_.clear(); }
  bool is_empty() const { return rules_.empty(); }
  /// Whether a production may draw random numbers.
  bool draws() const;
  /// Rewrites `string` into `result`. `table_is_on` tells by table which productions take part.
  /// Throws InputError where several productions apply equally, a value is no finite number, or the result
  /// exceeds the limits.
  void rewrite(const ModuleString& string, RandomKey key, const std::vector<bool>& table_is_on,
               ModuleString& result, const Lineage& lineage = {});

 private:
  /// The rules for one symbol.
  struct Group {
    std::vector<Rule*> sensitive, free;
    Candidates candidates;
  };
  /// What happens to a module of the block: a rule and which of its hits it is, or none.
  struct Choice {
    const Rule* rule = nullptr;
    std::uint16_t slot = 0;
  };
  enum class Claim : std::uint8_t { none, deterministic, stochastic };

  void prepare_groups(const std::vector<bool>& table_is_on);
  void prepare_skipped();
  void collect(const ModuleString& string, std::size_t begin, std::size_t end);
  void choose(const Group& group, const Rewriting& rewriting);
  void choose_among(const Candidates& candidates, const std::vector<Rule*>& rules,
                    const Rewriting& rewriting);
  void claim_hits(Rule& rule, const Candidates& candidates, const Rewriting& rewriting);
  void check_total(const Candidates& candidates, std::size_t candidate, const std::vector<Rule*>& rules,
                   const Rewriting& rewriting) const;
  void apply(Rule& rule, const Candidates& candidates, const Rewriting& rewriting);
  void emit(const ModuleString& string, std::size_t begin, std::size_t end, ModuleString& result);
  void emit_identities(const ModuleString& string, std::size_t begin, std::size_t end,
                       const SymbolId* successors, const Lineage& lineage);
  [[noreturn]] void fail_conflict(const Rule& rule, const Rule& other, const Candidates& candidates,
                                  std::size_t candidate, const Rewriting& rewriting) const;

  RuleContext& shared_;
  Limits limits_;
  std::vector<std::unique_ptr<Rule>> rules_;
  std::vector<Group> groups_;
  std::vector<std::int32_t> group_of_;  ///< by symbol, -1 for none
  bool needs_index_ = false;
  StringIndex index_;
  std::vector<std::uint8_t> skipped_;  ///< by symbol
  std::set<std::string, std::less<>> ignored_, considered_;
  std::vector<SymbolId> by_name_;  ///< by symbol: the first of its name, where identities are kept
  std::size_t value_offset_ = 0;   ///< of the next block

  // Of the current block
  std::size_t block_begin_ = 0;
  std::vector<Choice> choices_;
  Candidates unclaimed_;
  std::vector<Claim> claims_;           ///< by candidate
  std::vector<Rule*> claimants_;        ///< the rule that claimed a candidate last
  std::vector<Rule*> owners_;           ///< the rule that a candidate gets: none where the draw says so
  std::vector<double> totals_, draws_;  ///< probabilities so far, and what was drawn
  std::vector<std::uint8_t> keep_;
};

}  // namespace espalier::lsystem
