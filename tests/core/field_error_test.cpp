// Whoever throws names the field; whoever catches says it in the words of his caller.
#include <gtest/gtest.h>

#include <espalier/core/field_error.h>
#include <espalier/core/names.h>

namespace espalier {

enum class Side { light, dark };

template <>
inline constexpr auto kNames<Side> = std::to_array<Name<Side>>({{Side::light, "light"},
                                                                {Side::dark, "dark"}});

namespace {

template <typename Work>
std::string message_of(Work work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

[[noreturn]] void complain() { throw_field_error("budget.seconds", "got {}, expected a number", "'long'"); }

TEST(FieldError, NamesTheFieldUnlessItIsCaught) {
  EXPECT_EQ(message_of(complain), "budget.seconds: got 'long', expected a number");
}

TEST(FieldError, IsToldInTheWordsOfTheCaller) {
  const auto place = [](const std::string& field) { return "run.toml:7: key of " + field; };
  EXPECT_EQ(message_of([&] { with_places(place, complain); }),
            "run.toml:7: key of budget.seconds: got 'long', expected a number");
}

TEST(FieldError, AnErrorOfALowerPartGetsTheFieldOfItsCallerAndNoSecondOne) {
  EXPECT_EQ(message_of([] { in_field("kind", [] { throw_input_error("got 'x', expected y"); }); }),
            "kind: got 'x', expected y");
  EXPECT_EQ(message_of([] { in_field("kind", complain); }), message_of(complain));
}

TEST(Names, AreReadAsTheyAreWritten) {
  for (const Side side : {Side::light, Side::dark}) EXPECT_EQ(parse_name<Side>(name_of(side)), side);
}

TEST(Names, AnUnknownOneIsRefusedWithAllThatAreKnown) {
  EXPECT_FALSE(value_named<Side>("left"));
  EXPECT_EQ(message_of([] { parse_name<Side>("left"); }), "got 'left', expected light, dark");
}

TEST(Names, AValueWithoutANameIsAFaultOfOurs) { EXPECT_THROW(name_of(static_cast<Side>(7)), InternalError); }

}  // namespace
}  // namespace espalier
