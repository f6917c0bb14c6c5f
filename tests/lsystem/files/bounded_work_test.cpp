// Files of a few lines that would take hours or all memory: each is refused by what it counts, with a line
// that names the file.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <espalier/core/error.h>
#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/grammar_file.h>

namespace espalier::lsystem {
namespace {

std::string repeated(const std::string& text, int times, const std::string& between = "") {
  std::string all;
  for (int i = 0; i < times; ++i) all += (i == 0 ? "" : between) + text;
  return all;
}

Limits small_limits() {
  Limits limits;
  limits.work = 1e7;
  limits.lua_instructions = 1e6;
  return limits;
}

/// Why the whole use of a grammar is refused; what it comes to where it is not.
std::string outcome(const Grammar& grammar, const Limits& limits = small_limits()) {
  Derivation derivation(grammar, limits);
  derivation.start(1);
  derivation.run(derivation.settings().steps);
  Plant plant;
  build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant,
              derivation.work());
  return derivation.text();
}
std::string outcome(const std::string& text, const Limits& limits = small_limits()) {
  try {
    return outcome(parse_grammar(text, "any.lsys"), limits);
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string lua_error(const std::string& code, const Limits& limits = small_limits()) {
  return outcome("axiom: A\nlua:\n  " + code + "\n", limits);
}

void expect_too_much_work(const std::string& text) {
  EXPECT_NE(outcome(text).find("any: got more than 1e+07 units of work"), std::string::npos)
      << text.substr(0, 200) << ": " << outcome(text).substr(0, 200);
}

void expect_too_many_instructions(const std::string& code) {
  EXPECT_NE(lua_error(code).find("Lua ran for more than 1000000 instructions"), std::string::npos)
      << code << ": " << lua_error(code).substr(0, 200);
}

TEST(BoundedWork, OfModulesOverAllSteps) {
  expect_too_much_work("axiom: A\nproductions:\n  A : step < 15 --> AA\nsteps: 10000\n");
  expect_too_much_work(
      "axiom: A\nproductions:\n  A : step < 9 --> AA : 0.7\n  A --> A : 0.3\nsteps: 10000\n");
  expect_too_much_work("axiom: A\nproductions:\n  A --> " + repeated("B", 1000) + "\n  B --> " +
                       repeated("C", 1000) + "\n  C --> " + repeated("D", 10) + "\nsteps: 3\n");
}

TEST(BoundedWork, OfContextsThatAreTriedInManyWays) {
  const std::string branches = repeated("[B[B][B][B]]", 32);
  expect_too_much_work("branches: follow\naxiom: A" + branches + "\nproductions:\n  A > " +
                       repeated("[B]", 18) + "C --> A\n");
  expect_too_much_work("axiom: A" + branches + "\nproductions:\n  A > " + repeated("[B]", 18) + "C --> A\n");
  expect_too_much_work("ignore: B\naxiom: C" + repeated("B", 3000) + repeated("[A]", 3000) +
                       "\nproductions:\n  C < A --> D\n");
}

TEST(BoundedWork, OfWhatIsDrawn) {
  for (const char* drawn : {"@o", "F", "~(\"leaf\")", "~(\"maple\")", "{F+F+F+F}"})
    expect_too_much_work(std::string("axiom: A\nproductions:\n  A --> AA\ninterpretation:\n  A --> ") +
                         drawn + "\nsteps: 17\n");
  std::string spiral;
  for (int i = 0; i < 1000; ++i) spiral += fmt::format("f({})+(91)", 0.01 * i);
  expect_too_much_work("axiom: {" + spiral + "}\n");
  expect_too_much_work("axiom: " + repeated("F", 3000) + "?" + repeated("-F#?", 100) + "F#\n");
}

TEST(BoundedWork, OfVolumesAndLight) {
  const std::string balls = "volume v = union(" + repeated("ball(0,0,0,1)", 900, ", ") + ")\n";
  expect_too_much_work(balls + "axiom: " + repeated("A", 500) +
                       "\nproductions:\n  A : inside(v, step, 9, 9) --> B\nsteps: 10000\n");
  expect_too_much_work("axiom: A(0)\nproductions:\n  A(x) --> A(x)A(light(x,0,0))\nsteps: 20\n");
  expect_too_much_work(
      "volume v = ball(0,0,9000,1)\nshade: v\naxiom: A(0)F\nproductions:\n"
      "  A(x) --> A(skylight(x,0,0))\nsteps: 10000\n");
}

TEST(BoundedWork, CountsTheSameEachTime) {
  const Grammar grammar = parse_grammar(
      "axiom: A\nlua:\n  function f(x) return x .. 'abc' end\nproductions:\n"
      "  B --> lua\n    produce('F', step) if random() < 0.5 then produce('C', 1, 2, 3) end\n"
      "  A --> A[A]BF(#f(step)) : 0.5\n  A --> AF : 0.5\nsteps: 9\n",
      "any.lsys");
  Derivation derivation(grammar);
  std::vector<double> work, instructions;
  for (const Seed seed : {3, 4, 3}) {
    derivation.start(seed);
    derivation.run(9);
    work.push_back(derivation.work().done());
    instructions.push_back(derivation.lua_instructions());
  }
  EXPECT_EQ(work[0], work[2]);
  EXPECT_NE(work[0], work[1]);
  EXPECT_GT(work[0], 1000);
}

TEST(BoundedWork, OfVolumesInVolumes) {
  std::string text = "volume v0 = union(" + repeated("ball(0,0,0,1)", 100, ", ") + ")\n";
  for (int i = 1; i < 4; ++i)
    text += fmt::format("volume v{} = blend(1, {})\n", i, repeated(fmt::format("v{}", i - 1), 100, ", "));
  EXPECT_NE(outcome(text + "axiom: A\n").find("any.lsys:3:13: got a volume of"), std::string::npos)
      << outcome(text + "axiom: A\n");
  text = "volume v0 = ball(0,0,0,1)\n";
  for (int i = 1; i < 8; ++i)
    text += fmt::format("volume v{} = {}v{}{}\n", i, repeated("turned(1,", 90), i - 1, repeated(")", 90));
  EXPECT_NE(outcome(text + "axiom: A\n").find("got volumes in 501 volumes, expected in at most 500"),
            std::string::npos)
      << outcome(text + "axiom: A\n");
}

TEST(BoundedWork, OfFunctionsInFunctions) {
  for (const char* sign : {" + ", " and "}) {
    std::string text = "let f0(x) = x\n";
    for (int i = 1; i < 14; ++i)
      text += fmt::format("let f{}(x) = {}\n", i, repeated(fmt::format("f{}(x)", i - 1), 12, sign));
    const std::string message = outcome(text + "axiom: A(f13(1))\n");
    EXPECT_NE(message.find("any.lsys:15:"), std::string::npos) << message;
  }
}

TEST(BoundedLua, LongStringsCountForMore) {
  const std::string grow = "local s = '1' for i = 1, 12 do s = s .. s end ";
  for (const char* code : {"local u = s .. i", "local u = s < s .. 'a'", "local u = s + 1", "local u = -s",
                           "tonumber(s)", "math.floor(s)"})
    expect_too_many_instructions(grow + "for i = 1, 1e4 do " + code + " end");
  expect_too_many_instructions("local s = '" + std::string(4000, '1') +
                               "' for i = 1, 1e4 do local u = s + 1 end");
  expect_too_many_instructions("local s = [[" + std::string(40000, 'a') +
                               "]] for i = 1, 1e4 do local u = s < s end");
  EXPECT_EQ(lua_error("for i = 1, 1e4 do local u = 'a' .. i end"), "A");
  EXPECT_NE(lua_error("local s = 'x' while true do s = s .. s end", {}).find("any.lsys: not enough memory"),
            std::string::npos);
}

TEST(BoundedLua, LargeTablesCountForMore) {
  const std::string fill = "local t = {} for i = 1, 1e4 do t[i] = i end ";
  for (const char* code : {"table.insert(t, 1, i)", "table.remove(t, 1) t[1e4] = i", "table.concat(t)",
                           "table.sort(t)", "table.maxn(t)", "next(t)", "for k in pairs(t) do break end",
                           "unpack(t, 1, 1000)", "local u = {unpack(t, 1, 500)}"})
    expect_too_many_instructions(fill + "for i = 1, 2000 do " + code + " end");
  expect_too_many_instructions(fill + "for i = 1, 1e4 do t[i] = nil end for i = 1, 2000 do next(t) end");
  expect_too_many_instructions("for i = 1, 1000 do local t = {" + repeated("1", 3000, ",") + "} end");
}

TEST(BoundedLua, TablesAreGoneThroughInOrder) {
  const std::string table =
      "local t = {30, 20, b = 1, a = 2, ab = 3, [1.5] = 4, [true] = 5, [-1] = 6} local s = '' ";
  const std::string expected = "any.lsys:3: -1 1 1.5 2 a ab b true ";
  EXPECT_EQ(lua_error(table + "for k in pairs(t) do s = s .. tostring(k) .. ' ' end error(s)"), expected);
  EXPECT_EQ(
      lua_error(
          table +
          "local k = next(t) while k ~= nil do s = s .. tostring(k) .. ' ' k = next(t, k) end error(s)"),
      expected);
  EXPECT_EQ(
      lua_error(
          "local t = {1, 2, 3, 4} local n = 0 for k in pairs(t) do t[k + 1] = nil n = n + k end error(n)"),
      "any.lsys:3: 4");
  EXPECT_NE(lua_error("for k in pairs({[{}] = 1}) do end").find("a key that is a table"), std::string::npos);
  EXPECT_EQ(lua_error("error(tostring({}) .. tostring(random) .. tostring(nil) .. tostring(0.5))"),
            "any.lsys:3: tablefunctionnil0.5");
}

TEST(BoundedLua, TableFunctionsDoWhatTheyShould) {
  EXPECT_EQ(lua_error("local t = {3, 1, 2, 5, 4} table.sort(t) error(table.concat(t, ','))"),
            "any.lsys:3: 1,2,3,4,5");
  EXPECT_EQ(
      lua_error("local t = {3, 1, 2} table.sort(t, function(a, b) return a > b end) error(table.concat(t))"),
      "any.lsys:3: 321");
  EXPECT_EQ(
      lua_error("local t = {'a', 'b', 'c'} local x = table.remove(t, 1) table.insert(t, 2, x) "
                "error(table.concat(t) .. table.remove(t) .. #t .. table.concat({1, 2, 3}, '-', 2, 3))"),
      "any.lsys:3: bacc22-3");
  EXPECT_EQ(
      lua_error(
          "local a, b, c = unpack({1, 2, 3}, 2) error(a .. b .. tostring(c) .. select('#', unpack({})))"),
      "any.lsys:3: 23nil0");
}

TEST(BoundedLua, LetFunctionsAreOneExpression) {
  EXPECT_NE(outcome("let f(x) = x end error('outside') function g(x) return x\naxiom: A(f(1))\n")
                .find("any.lsys:1:12: 'x end error"),
            std::string::npos);
  EXPECT_NE(outcome("let f(x) = x; error('outside')\naxiom: A\n").find("expected a Lua expression"),
            std::string::npos);
  EXPECT_EQ(outcome("let f(x) = (x) -- as it is\naxiom: A(f(1))\nlua:\n  y = f(2)\n"), "A(1)");
}

TEST(ManyNames, AreRightOrRefused) {
  EXPECT_EQ(outcome("axiom: A(" + repeated("1", 65600, " and ") + " and 7)\n"), "A(7)");
  std::string constants;
  for (int i = 0; i < 20001; ++i) constants += fmt::format("const c{} = {}\n", i, i);
  EXPECT_NE(outcome(constants + "axiom: A\n").find("any.lsys:20001:7: got more than 20000 constants"),
            std::string::npos);
  std::string rules;
  for (int i = 0; i < 9000; ++i) rules += fmt::format("  s{}(a) --> s{}(a+1)\n  s{} --> B\n", i, i, i);
  std::string symbols = "symbols:";
  for (int i = 0; i < 9000; ++i) symbols += fmt::format(" s{}", i);
  Limits limits;
  EXPECT_EQ(outcome(symbols + "\naxiom: s17 s8999(1) s8999\nproductions:\n" + rules, limits), "Bs8999(2)B");
}

TEST(ManyNames, OfSymbolsAndPiecesOfCodeAreRefused) {
  EXPECT_NE(
      outcome("symbols: " + std::string(41, 'a') + "\naxiom: A\n").find("any.lsys:1:10: got a symbol of 41"),
      std::string::npos);
  EXPECT_NE(outcome(repeated("lua: x = 1\n", 3000) + "axiom: A\n")
                .find("got too much Lua code after too many lines"),
            std::string::npos);
  EXPECT_NE(outcome("axiom: A" + repeated("[", 10001) + repeated("]", 10001) + "\n")
                .find("any.lsys:1:10009: got 10001 brackets in each other"),
            std::string::npos);
  EXPECT_NE(outcome("axiom: A\nproductions:\n  A > " + repeated("B", 1001) + " --> A\n").find("1000 modules"),
            std::string::npos);
  EXPECT_NE(outcome("axiom: " + repeated("A(1)", 50001) + "\n").find("got more than 50000 expressions"),
            std::string::npos);
}

class ReadFilesOfAnyKind : public testing::Test {
 protected:
  ReadFilesOfAnyKind() { std::filesystem::create_directories(folder_); }
  ~ReadFilesOfAnyKind() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  static std::string read(const std::string& path) {
    try {
      read_grammar(path);
      return "read";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / fmt::format("bounded_{}", ::getpid());
};

TEST_F(ReadFilesOfAnyKind, PipesAndDevicesAreRefused) {
  const std::string pipe = (folder_ / "pipe.lsys").string(), zero = (folder_ / "zero.lsys").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", zero);
  for (const std::string& path : {pipe, zero, write("a.lsys", "include \"pipe.lsys\"\naxiom: A\n"),
                                  write("b.lsys", "include \"zero.lsys\"\naxiom: A\n"),
                                  write("c.lsys", "plant p = \"pipe.lsys\"\naxiom: A\n")})
    EXPECT_NE(read(path).find("is a pipe or a device, expected a file"), std::string::npos) << read(path);
}

TEST_F(ReadFilesOfAnyKind, IncludesAreBounded) {
  for (int i = 0; i < 70; ++i)
    write(fmt::format("chain{}.lsys", i), fmt::format("include \"chain{}.lsys\"\naxiom: A\n", i + 1));
  write("chain70.lsys", "axiom: A\n");
  EXPECT_NE(read((folder_ / "chain0.lsys").string()).find("chain64.lsys:1:9: got more than"),
            std::string::npos);
  for (int i = 6; i < 70; ++i)
    write(fmt::format("chain{}.lsys", i), fmt::format("include \"chain{}.lsys\"\n", i + 1));
  EXPECT_EQ(read((folder_ / "chain6.lsys").string()), "read");
  const std::string comment = "# " + std::string(1'500'000, 'x') + "\n";
  for (int i = 0; i < 3; ++i) write(fmt::format("big{}.lsys", i), comment);
  EXPECT_EQ(read(write("two.lsys", "include \"big0.lsys\"\ninclude \"big1.lsys\"\naxiom: A\n")), "read");
  EXPECT_NE(read(write("three.lsys",
                       "include \"big0.lsys\"\ninclude \"big1.lsys\"\ninclude \"big2.lsys\"\naxiom: A\n"))
                .find("big2.lsys: got more than 4 MB"),
            std::string::npos);
}

TEST_F(ReadFilesOfAnyKind, NamesOverSeveralLinesAreRefused) {
  const std::string message = read(write("lines.lsys", "include \"a\nb.lsys\"\naxiom: A\n"));
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_NE(message.find("lines.lsys:1:10: "), std::string::npos) << message;
}

TEST_F(ReadFilesOfAnyKind, PlantsOfAFileShareTheirLimits) {
  write("p.lsys", "axiom: A\nlua:\n  for i = 1, 4e7 do end\n");
  const std::string path =
      write("many.lsys", "plant a = \"p.lsys\"\nplant b = \"p.lsys\"\nplant c = \"p.lsys\"\naxiom: A\n");
  EXPECT_NE(read(path).find("many.lsys:3:"), std::string::npos) << read(path);
}

}  // namespace
}  // namespace espalier::lsystem
