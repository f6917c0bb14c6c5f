// Laws of every row of the table of commands, of those to come too. That a row is there for each name, in
// order, the compiler checks.
#include <gtest/gtest.h>

#include <set>

#include <espalier/core/error.h>
#include <espalier/lsystem/strings/turtle_commands.h>

namespace espalier::lsystem {
namespace {

std::vector<std::string_view> symbols_of(const CommandInfo& info) {
  std::vector<std::string_view> symbols{info.symbol};
  if (!info.other_symbol.empty()) symbols.push_back(info.other_symbol);
  return symbols;
}

TEST(TurtleCommands, EachSymbolIsGivenOnce) {
  std::set<std::string_view> seen;
  for (const CommandInfo& info : kCommands)
    for (const std::string_view symbol : symbols_of(info))
      EXPECT_TRUE(!symbol.empty() && seen.insert(symbol).second) << symbol;
}

TEST(TurtleCommands, ASymbolIsReadWholeAndFoundByItsName) {
  for (const CommandInfo& info : kCommands)
    for (const std::string_view symbol : symbols_of(info)) {
      EXPECT_EQ(symbol_length(std::string(symbol) + "(1)", {}), symbol.size()) << symbol;
      ASSERT_NE(find_command(symbol), nullptr) << symbol;
      EXPECT_EQ(find_command(symbol)->command, info.command) << symbol;
    }
}

TEST(TurtleCommands, TakeAsManyParametersAsTheirRowSays) {
  for (const CommandInfo& info : kCommands) {
    EXPECT_NO_THROW(check_arity(info.symbol, static_cast<std::size_t>(info.least))) << info.symbol;
    EXPECT_NO_THROW(check_arity(info.symbol, static_cast<std::size_t>(info.most))) << info.symbol;
    const auto more = [&] { check_arity(info.symbol, static_cast<std::size_t>(info.most) + 1); };
    if (info.ignores_more)
      EXPECT_NO_THROW(more()) << info.symbol;
    else
      EXPECT_THROW(more(), InputError) << info.symbol;
    if (info.least == 0) continue;
    EXPECT_THROW(check_arity(info.symbol, static_cast<std::size_t>(info.least) - 1), InputError)
        << info.symbol;
  }
}

/// Those of cpfg and L-Py carry ages and other numbers of the model. Brackets and cuts are read by the
/// derivation, surfaces, colours and queries mean something by how many they have.
TEST(TurtleCommands, IgnoreMoreParametersWhereTheseCannotMeanAnything) {
  for (const char* symbol :
       {"F", "G", "f", "+", "-", "&", "^", "/", "\\", "|", "$", "!", "_", "@o", "{", ".", "}"})
    EXPECT_NO_THROW(check_arity(symbol, 7)) << symbol;
  for (const char* symbol : {"[", "]", "%", "~", ";", ",", "?P", "?H"})
    EXPECT_THROW(check_arity(symbol, 7), InputError) << symbol;
}

TEST(TurtleCommands, SymbolsOfTheFileMeanNothingToTheTurtle) {
  SymbolTable alphabet;
  alphabet.intern("A", 2);
  alphabet.intern("F", 1);
  EXPECT_EQ(commands_of(alphabet), (std::vector{Command::none, Command::draw}));
}

}  // namespace
}  // namespace espalier::lsystem
