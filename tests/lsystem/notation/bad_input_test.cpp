// Files come from strangers: one fault a case, one line that says where, what was found and what was
// expected.
#include <gtest/gtest.h>

#include <algorithm>

#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/grammar_file.h>

#include "support/strings.h"

namespace espalier::lsystem {
namespace {

/// The message of deriving and drawing `text`, or "no error".
std::string message_of(const std::string& text, const Limits& limits = {}) {
  try {
    const Grammar grammar = parse_grammar(text, "bad.lsys");
    Derivation derivation(grammar, limits);
    derivation.start(1);
    derivation.run(20);
    Plant plant;
    build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant);
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
    return message;
  }
  return "no error";
}

struct Fault {
  const char* text;
  const char* expected;  ///< part of the message
};

class BadFiles : public testing::TestWithParam<Fault> {};

TEST_P(BadFiles, AreRefusedWithTheirPlace) {
  const std::string message = message_of(GetParam().text);
  EXPECT_NE(message.find(GetParam().expected), std::string::npos) << GetParam().text << "\n" << message;
}

INSTANTIATE_TEST_SUITE_P(
    Syntax, BadFiles,
    testing::Values(
        Fault{"", "bad.lsys:1:1: got no axiom"},
        Fault{"axiom: A[B\n", "bad.lsys:1:9: got '[', expected a ']'"},
        Fault{"axiom: A]B\n", "bad.lsys:1:9: got ']', expected a '['"},
        Fault{"axiom: A(\n", "bad.lsys:1:10: got the end of the file, expected an expression"},
        Fault{"axiom: A(1\nproductions:\n", "bad.lsys:1:11"},
        Fault{"axiom: \"A\"\n", "bad.lsys:1:8: got '\"', expected a module"},
        Fault{"axiom: A\naxiom: B\n", "bad.lsys:2:7: got a second axiom"},
        Fault{"axiom: A\nA --> B\n", "bad.lsys:2:1: got 'A', expected a keyword"},
        Fault{"axiom: A\nproductions:\n A -> B\n", "bad.lsys:3:2: got 'A', expected a production"},
        Fault{"axiom: A\nproductions:\n A -->\n", "expected modules, or * for none"},
        Fault{"axiom: A\nproductions:\n AB --> C\n", "got 2 modules, expected one predecessor"},
        Fault{"axiom: A\nproductions:\n A(x,x) --> C\n", "got parameter 'x' twice"},
        Fault{"axiom: A\nproductions:\n A[B] < C --> C\n", "bracket in the left context"},
        Fault{"axiom: A\nproductions:\n A(x+1) --> C\n", "bad.lsys:3:5: got '+', expected ')'"},
        Fault{"axiom: A\nproductions:\n A(x) : --> C\n", "expected a condition"},
        Fault{"angel: 90\naxiom: A\n", "bad.lsys:1:1: got 'angel:', expected a keyword"},
        Fault{"angle: 1, 2\naxiom: A\n", "bad.lsys:1:1: setting 'angle': got 2 values, expected 1"},
        Fault{"leaf_shape: 11\naxiom: A\n", "setting 'leaf_shape': got 11, expected 0 to 10"},
        Fault{"param a = 5 in 0 .. 1\naxiom: A\n", "5"},
        Fault{"param a = 0 in 1 .. 0\naxiom: A\n", "lower one first"},
        Fault{"param a = 5 in 0 .. 9 rolle x\naxiom: A\n", "bad.lsys:1:23: got 'rolle', expected integer"},
        Fault{"param a = 5 in 0 .. 9 role\naxiom: A\n", "expected a role"},
        Fault{"param a = 5 in 0 .. 9 role leaf_cuont\naxiom: A\n",
              "bad.lsys:1:28: got role 'leaf_cuont', expected one like 'leaf_count'"},
        Fault{"param a = 5 in 0 .. 9 role branch_count[4]\naxiom: A\n",
              "bad.lsys:1:28: got role 'branch_count[4]', expected a level 1 to 3"},
        Fault{"param a = 5 in 0 .. 9 role leaf_count\nparam b = 5 in 0 .. 9 role leaf_count\naxiom: A\n",
              "bad.lsys:2:8: got role 'leaf_count' for 'b', expected one that 'a' does not bear"},
        Fault{"param a = 5 in 0 .. 9 role length_unit\naxiom: A\n", "that 'unit' does not bear"},
        Fault{"param a = 5 in 0 .. 9 plain 10\naxiom: A\n", "key 'a': got 10, expected a number 0..9"},
        Fault{"const a = 1, a = 2\naxiom: A\n", "got 'a' a second time"},
        Fault{"const end = 1\naxiom: A\n", "got 'end', expected a name"},
        Fault{"include \"x.lsys\"\naxiom: A\n", "bad.lsys:1:9: got an include"},
        Fault{"axiom: ~(\"rose\")\n", "got surface 'rose'"}));

INSTANTIATE_TEST_SUITE_P(
    Expressions, BadFiles,
    testing::Values(
        Fault{"axiom: A(1+)\n", "bad.lsys:1:10: '1+': unexpected symbol"},
        Fault{"axiom: A(q)\n", "bad.lsys:1:10: 'q': got the unknown name 'q'"},
        Fault{"axiom: A(nowhere(1))\n", "unknown name 'nowhere'"},
        Fault{"axiom: A(2)\nproductions:\n p1: A(x) --> A(x-1)F(1/x)\n",
              "bad.lsys:3:2: p1, module A(0): argument '1/x' is inf, expected a finite number"},
        Fault{"axiom: A(0)\nproductions:\n p1: A(x) --> +(x/x)\n", "p1, module A(0): argument 'x/x' is"},
        Fault{"axiom: A(1)\nproductions:\n p1: A(x) --> A(x > 0)\n", "got a boolean, expected a number"},
        Fault{"axiom: A(1)\nproductions:\n p1: A(x) --> A(x+1) : x\n", "sum to 2, expected at most 1"},
        Fault{"axiom: A(1)\nproductions:\n p1: A(x) --> A(x) : -1\n", "probability is -1"},
        Fault{"axiom: A\nproductions:\n p1: A --> B\n p2: A --> C\n",
              "module A: p2 and p1 (bad.lsys:3:2) both apply"},
        Fault{"axiom: A\nproductions:\n p1: A --> B : 0\n p2: A --> C\n",
              "module A: p2 and p1 (bad.lsys:3:2) both apply"},
        Fault{"axiom: ?P(1,2,3,4)\n", "bad.lsys:1:8: module ?P: got 4 parameters, the turtle expects 2 to 3"},
        Fault{"axiom: A\nproductions:\n p1: A --> @(1,2)\n",
              "bad.lsys:3:12: module @: got 2 parameters, the turtle expects at least 3"},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   produce('%', 1)\n", "bad.lsys:3:2: p1, module A"},
        Fault{"let f(a,b) = a + b\naxiom: A(1)\nproductions:\n p1: A(x) --> A(f(x))\n", "bad.lsys:4:"},
        Fault{"axiom: A(1)\nproductions:\n p1: A(x) --> A(sqrt())\n", "bad.lsys:3:"},
        Fault{"axiom: A(1)\nproductions:\n p1: A(x) --> +(sqrt(0-x))\n",
              "bad.lsys:3:2: p1, module A(1): argument 'sqrt(0-x)' is"},
        Fault{"let f(a) = a\naxiom: A(f(1,2))\n", "bad.lsys:2:10: 'f(1,2)': f: got 2 arguments, expected 1"},
        Fault{"axiom: A(sqrt(1,2))\n", "bad.lsys:1:10: 'sqrt(1,2)': sqrt: got 2 arguments, expected 1"},
        Fault{"axiom: A(max())\n", "max: got no arguments"}, Fault{"axiom: f(1e300)F\n", "too far away"},
        Fault{"axiom: F(1,1e300)\n", "too large"}, Fault{"axiom: f(1e300)~('leaf')\n", "too far away"},
        Fault{"segments: leafy\naxiom: F(1,1,1e9)\n",
              "got 1000000000 leaves on a segment, expected at most 1000"},
        Fault{"axiom: A\nproductions:\n p1: A : nothing(1) --> B\n",
              "bad.lsys:3:10: 'nothing(1)': got the unknown name"},
        Fault{"axiom: A}\n", "bad.lsys: module 1 of the string: got '}', expected a '{' before it"},
        Fault{"axiom: {F\n", "got '{' without '}'"}));

INSTANTIATE_TEST_SUITE_P(
    Lua, BadFiles,
    testing::Values(
        Fault{"axiom: A\nlua:\n  x = = 1\n", "bad.lsys:3:"},
        Fault{"axiom: A\nlua:\n\n  error('oops')\n", "bad.lsys:4: oops"},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   produce(1)\n", "argument 1 is a number"},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   produce('[')\n", "got 1 '[' without ']'"},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   produce(']')\n", "got ']', expected a '['"},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   produce('F', 0/0)\n", "expected a finite number"},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   nothing.here = 1\n", "bad.lsys:4:"},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   for i = 1, 2 do produce('F')\n", "bad.lsys:4:"},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   if true then\n     produce('F')\n\n",
              "bad.lsys:5:"},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   produce('F') end\n", "bad.lsys:4:"},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   # no comment of Lua\n   produce('F')\n",
              "bad.lsys:4:"},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   produce('~', 'laef', 1)\n",
              "bad.lsys:3:2: p1, module A: got surface 'laef', expected one of this file or a built-in one, "
              "the "
              "closest is \"leaf\""},
        Fault{"axiom: A\nproductions:\n p1: A --> lua\n   produce('~')\n", "module ~: got 0 parameters"}));

INSTANTIATE_TEST_SUITE_P(
    Headings, BadFiles,
    testing::Values(
        Fault{"axiom: A\nproductions:\n A --> B\nhomomorphism:\n  B --> F\n",
              "bad.lsys:4:1: got the unknown heading 'homomorphism', expected productions, interpretation, "
              "table "
              "or lua, the closest is 'interpretation'"},
        Fault{"axiom: A\nproductions:\n A --> B\nhomomorphism:\n  B --> F\n  A --> F\n",
              "bad.lsys:4:1: got the unknown heading 'homomorphism'"},
        Fault{"axiom: A\nproductions:\n A --> B\nhomomorphism: B --> F\n", "the closest is 'interpretation'"},
        Fault{"axiom: A\nproductions:\n A --> B\ndecomposition:\n  B --> F\n",
              "the closest is 'productions'"},
        Fault{"axiom: A\nproductions:\n A --> B\ninterpretations:\n  B --> F\n",
              "unknown heading 'interpretations', expected productions, interpretation, table or lua, the "
              "closest "
              "is 'interpretation'"},
        Fault{"axiom: A\nproductions:\n A --> B\nIntrepretation:\nB --> F\n",
              "the closest is 'interpretation'"},
        Fault{"axiom: A\nproduction:\n  A --> B\n", "bad.lsys:2:1: got the unknown heading 'production'"},
        Fault{"axiom: A\nproductions :\n  A --> B\n", "bad.lsys:2:1: got the unknown heading 'productions'"},
        Fault{"axiom: A\nproductions:\n A --> B\ntabel late when step > 2:\n  B --> F\n",
              "bad.lsys:4:1: got the unknown heading 'tabel'"},
        Fault{"axiom: A\nproductions:\n A --> B\nStartEach:\n  x = 1\n",
              "got the unknown heading 'StartEach'"},
        Fault{"derivation length: 3\naxiom: A\n",
              "bad.lsys:1:1: got 'derivation length:', expected a keyword"},
        Fault{"axiom: A\nproductions:\n A --> B\nhomomorphism\n  B --> F\n",
              "bad.lsys:4:1: got the unknown heading 'homomorphism'"},
        Fault{"derivation length: 3\naxiom: A\n", "the closest is 'steps'"},
        Fault{"Axiom: A\n", "the closest is 'axiom'"},
        Fault{"axiom: A\nproductions:\n A --> B\nsegmants: leafy\n", "the closest is 'segments'"},
        Fault{"axiom: A\nsegments: green\n", "bad.lsys:2:11: got 'g', expected 'plain' or 'leafy'"}));

// A colon follows an id at once, with its production beside it; that of a condition may end a line.
TEST(GoodFiles, IdsAndConditionsAreNoHeadings) {
  EXPECT_EQ(message_of("axiom: A(1)\nproductions:\n  shade1: A(x) :\n      x > 9 --> B\n"
                       "  table_2: A(x) : x <= 9\n      --> C\n"),
            "no error");
  EXPECT_EQ(message_of("symbols: Product Production\naxiom: Production\nproductions:\n"
                       "  Production : step > 1 --> Product\n  product: Product --> A\n"),
            "no error");
}

TEST(Sandbox, HasNoWayOut) {
  for (const char* name :
       {"io",     "os",         "package", "debug",        "ffi",          "jit",      "require",
        "load",   "loadstring", "dofile",  "loadfile",     "pcall",        "xpcall",   "coroutine",
        "string", "setfenv",    "getfenv", "getmetatable", "setmetatable", "newproxy", "_ENV"})
    EXPECT_EQ(
        message_of(std::string("axiom: A\nlua:\n  if ") + name + " ~= nil then error('is there') end\n"),
        "no error")
        << name;
  EXPECT_NE(message_of("axiom: A\nlua:\n  x = (\"a\"):rep(10)\n"), "no error");
}

TEST(Sandbox, LoopsEnd) {
  Limits limits;
  limits.lua_instructions = 1e6;
  for (const char* code : {"lua:\n  while true do end\n", "lua:\n  repeat until false\n",
                           "lua:\n  for i = 1, 1e12 do end\n", "lua:\n  function f() return f() end f()\n",
                           "lua:\n  function f(x) while true do end end\nproductions:\n A : f(1) --> B\n"}) {
    const std::string message = message_of(std::string("axiom: A\n") + code, limits);
    EXPECT_NE(message.find("more than 1000000 instructions"), std::string::npos) << code << ": " << message;
  }
}

TEST(Sandbox, LimitsNameTheirPlace) {
  Limits limits;
  limits.lua_instructions = 1e6;
  limits.lua_memory_bytes = 4 << 20;
  EXPECT_EQ(message_of("axiom: A\nlua:\n  while true do end\n", limits).find("bad.lsys:3: Lua ran"), 0u);
  EXPECT_EQ(
      message_of("axiom: A\nlua:\n  function on_end() while true do end end\n", limits).find("bad.lsys:3: "),
      0u);
  limits.lua_instructions = 1e8;
  EXPECT_EQ(
      message_of("axiom: A\nlua:\n  x = 'x' while true do x = x .. x end\n", limits).find("bad.lsys: not en"),
      0u);
  EXPECT_EQ(
      message_of("axiom: A\nlua:\n  function on_start() local x = 'x' while true do x = x .. x end end\n",
                 limits),
      "on_start: not enough memory, expected Lua to need at most 4 MB, and strings of 1 MB");
}

TEST(BadFilesOfSize, AreQuotedInPart) {
  const std::string deep = std::string(50000, '(') + "1" + std::string(50000, ')');
  EXPECT_LT(message_of("axiom: F(" + deep + ")\n").size(), 700u);
}

TEST(Sandbox, MemoryEnds) {
  Limits limits;
  limits.lua_memory_bytes = 4 << 20;
  EXPECT_NE(message_of("axiom: A\nlua:\n  t = {} for i = 1, 1e9 do t[i] = i end\n", limits).find("memory"),
            std::string::npos);
}

TEST(Sandbox, DoublingEnds) {
  Limits limits;
  limits.modules = 10000;
  EXPECT_NE(message_of("axiom: A\nproductions:\n A --> AA\n", limits).find("more than 10000 modules"),
            std::string::npos);
  limits.steps = 3;
  EXPECT_NE(message_of("axiom: A\n", limits).find("got step 4, expected at most 3"), std::string::npos);
  limits = {};
  limits.modules = 10000;
  EXPECT_NE(message_of("axiom: A\nproductions:\n A --> lua\n   while true do produce('B') end\n", limits)
                .find("10000"),
            std::string::npos);
}

}  // namespace
}  // namespace espalier::lsystem
