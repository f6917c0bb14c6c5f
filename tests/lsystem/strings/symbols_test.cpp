// The alphabet of L-systems: names with numbers of parameters, and what the turtle knows of them.
#include <gtest/gtest.h>

#include <espalier/core/error.h>
#include <espalier/lsystem/strings/turtle_commands.h>

namespace espalier::lsystem {
namespace {

TEST(SymbolTable, ANameWithAnotherNumberOfParametersIsAnotherSymbol) {
  SymbolTable alphabet;
  const SymbolId plain = alphabet.intern("A", 0), pair = alphabet.intern("A", 2);
  EXPECT_NE(plain, pair);
  EXPECT_EQ(alphabet.intern("A", 2), pair);
  EXPECT_EQ(alphabet.size(), 2u);
  EXPECT_EQ(alphabet[pair].arity, 2);
  EXPECT_EQ(alphabet.arities(), (std::vector<std::uint8_t>{0, 2}));
}

TEST(SymbolTable, RefusesMoreParametersThanAModuleHas) {
  SymbolTable alphabet;
  EXPECT_NO_THROW(alphabet.intern("A", kMaxArity));
  EXPECT_THROW(alphabet.intern("A", kMaxArity + 1), InputError);
}

TEST(SymbolTable, ForgetsTheLastSymbols) {
  SymbolTable alphabet;
  alphabet.intern("A", 0);
  const SymbolId other = alphabet.intern("A", 1);
  alphabet.intern("B", 0);
  alphabet.truncate(1);
  EXPECT_EQ(alphabet.size(), 1u);
  EXPECT_EQ(alphabet.arities().size(), 1u);
  EXPECT_EQ(alphabet.intern("B", 0), other);
  EXPECT_EQ(alphabet.intern("A", 0), 0);
  EXPECT_EQ(alphabet.intern("A", 1), 2);
}

TEST(SymbolLength, TheLongestDeclaredNameComesFirst) {
  const DeclaredSymbols declared{"Leaf", "Le"};
  EXPECT_EQ(symbol_length("Leaf(1)", declared), 4u);
  EXPECT_EQ(symbol_length("Lea", declared), 2u);
  EXPECT_EQ(symbol_length("L", declared), 1u);
}

TEST(SymbolLength, QueriesAndSpheresHaveTwoLetters) {
  EXPECT_EQ(symbol_length("?P(1,2)", {}), 2u);
  EXPECT_EQ(symbol_length("?X", {}), 1u);  // the sign that opens an edge
  EXPECT_EQ(symbol_length("@o", {}), 2u);
  EXPECT_EQ(symbol_length("@(1,2,3)", {}), 1u);
  EXPECT_EQ(symbol_length("1", {}), 0u);
}

TEST(TurtleCommands, FollowTheIdsOfTheAlphabet) {
  SymbolTable alphabet;
  const SymbolId unknown = alphabet.intern("A", 1), left = alphabet.intern("+", 1),
                 right = alphabet.intern("-", 0);
  const std::vector<Command> commands = commands_of(alphabet);
  EXPECT_EQ(commands[unknown], Command::none);
  EXPECT_EQ(commands[left], Command::turn_left);
  EXPECT_EQ(commands[right], Command::turn_right);
}

TEST(TurtleCommands, RefuseANumberOfParametersTheyDoNotHave) {
  EXPECT_NO_THROW(check_arity("?P", 3));
  EXPECT_THROW(check_arity("?P", 4), InputError);
  EXPECT_NO_THROW(check_arity(";", 3));
  EXPECT_THROW(check_arity(";", 2), InputError);
  EXPECT_NO_THROW(check_arity("A", 9));  // no command: the turtle passes over it
}

}  // namespace
}  // namespace espalier::lsystem
