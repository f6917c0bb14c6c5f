// Laws of the command lsystem, run as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

fs::path write_lsystem(const fs::path& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder / name) << text;
  return folder / name;
}

TEST(LsystemCommand, PrintsTheDerivation) {
  const ProgramRun run = run_espalier("lsystem topiary_2 --steps 3 --string");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "F(3)?P(0,3)-F(2)?P(2,3)-F(1)?P(2,2)-A\n");
}

TEST(LsystemCommand, DrawsAPictureAndASequence) {
  const fs::path folder = fresh_folder("lsystem");
  const std::string size = " --size 40 --samples 1";
  EXPECT_EQ(
      run_espalier("lsystem fern --steps 6 -o '" + (folder / "fern.png").string() + "'" + size).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "fern.png"));
  EXPECT_EQ(
      run_espalier("lsystem raceme --frames 3 -o '" + (folder / "r.png").string() + "'" + size).exit_code, 0);
  for (const char* frame : {"r_000.png", "r_001.png", "r_002.png"})
    EXPECT_TRUE(fs::exists(folder / frame)) << frame;
}

TEST(LsystemCommand, DrawsAnAnimation) {
  const fs::path folder = fresh_folder("lsystem_gif"), gif = folder / "growth.gif";
  const ProgramRun run =
      run_espalier("lsystem raceme --frames 5 --size 40 --samples 1 -o '" + gif.string() + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("5 frames of 40×40 px"), std::string::npos) << run.out;
  std::ifstream file(gif, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(bytes.substr(0, 6), "GIF89a");
  EXPECT_NE(bytes.find("NETSCAPE2.0"), std::string::npos);  // it repeats
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

/// A film of growth ends in the picture that is drawn without it, also where the file counts on its end.
TEST(LsystemCommand, ASequenceEndsInThePicture) {
  const fs::path folder = fresh_folder("lsystem_end");
  const fs::path file = write_lsystem(
      folder, "ends.lsys",
      "steps: 4\naxiom: A\nlua:\n  ended = 0\n  function on_end() ended = 1 end\nproductions:\n"
      "  A : ended == 0 --> F[+(30)F]A\ninterpretation:\n  A : ended == 1 --> ~(\"blossom\", 1)\n");
  for (const int frames : {1, 3, 9}) {
    const std::string start =
        fmt::format("lsystem '{}' --size 40 --samples 1 -o '{}/", file.string(), folder.string());
    EXPECT_EQ(run_espalier(start + "one.png'").exit_code, 0);
    EXPECT_EQ(run_espalier(fmt::format("{}f.png' --frames {}", start, frames)).exit_code, 0);
    EXPECT_EQ(read_text_file((folder / fmt::format("f_{:03}.png", frames - 1)).string()),
              read_text_file((folder / "one.png").string()))
        << frames;
  }
}

TEST(LsystemCommand, ListsTheBundledOnes) {
  const ProgramRun run = run_espalier("lsystem --list");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("\nfern                     A fern: nine axes"), std::string::npos) << run.out;
  EXPECT_EQ(static_cast<std::size_t>(std::count(run.out.begin(), run.out.end(), '\n')),
            static_cast<std::size_t>(
                std::count_if(fs::directory_iterator(ESPALIER_SOURCE_DIR "/src/lsystem/models"), {},
                              [](const auto& entry) { return entry.path().extension() == ".lsys"; })));
}

TEST(LsystemCommand, SaysWhereThereIsNoParameterToSet) {
  const fs::path folder = fresh_folder("lsystem_no_parameter");
  const fs::path file = write_lsystem(folder, "plain.lsys", "axiom: F\n");
  const ProgramRun run = run_espalier("lsystem '" + file.string() + "' --string --set x=1");
  expect_one_clear_error(run);
  EXPECT_NE(run.err.find("--set: got 'x', expected none: plain has no parameters"), std::string::npos)
      << run.err;
}

TEST(LsystemCommand, WarnsOfNumbersThatWereLeaves) {
  const fs::path folder = fresh_folder("lsystem_leaves");
  const fs::path file = write_lsystem(folder, "old.lsys", "axiom: F(1,0.1,3)\n"),
                 plain = write_lsystem(folder, "plain.lsys", "segments: plain\naxiom: F(1,0.1,3)\n");
  const ProgramRun run = run_espalier("lsystem '" + file.string() + "' --string");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.err.find("old: F has 3 parameters, of which length and width are drawn"), std::string::npos);
  EXPECT_EQ(run_espalier("lsystem '" + plain.string() + "' --string").err, "");
}

TEST(LsystemCommand, StepsAreThoseOfOtherCommandsToo) {
  const fs::path folder = fresh_folder("lsystem_steps");
  const auto in_folder = [&](const char* name) { return "'" + (folder / name).string() + "'"; };
  const std::string size = " --size 40 --samples 1 -o ";
  EXPECT_EQ(run_espalier("lsystem raceme --steps 6" + size + in_folder("a.png")).exit_code, 0);
  const ProgramRun render = run_espalier("render raceme.lsys --steps 6" + size + in_folder("b.png"));
  EXPECT_EQ(render.exit_code, 0) << render.err;
  EXPECT_EQ(read_text_file((folder / "a.png").string()), read_text_file((folder / "b.png").string()));
  const ProgramRun none = run_espalier("mesh raceme.lsys --steps 0 -o " + in_folder("c.obj")),
                   tree = run_espalier("mesh apple --steps 3 -o " + in_folder("d.obj"));
  expect_one_clear_error(tree);
  EXPECT_NE(tree.err.find("apple: got 3 steps, expected none"), std::string::npos) << tree.err;
  EXPECT_FALSE(fs::exists(folder / "d.obj"));
  expect_one_clear_error(run_espalier("mesh raceme.lsys --steps=-1 -o " + in_folder("c.obj")));
  for (const char* command : {"mesh", "render", "mask"})
    EXPECT_NE(run_espalier(std::string(command) + " --help").out.find(".lsys file"), std::string::npos)
        << command;
}

TEST(LsystemCommand, ReadsSurfacesOfTheSameFolder) {
  const fs::path folder = fresh_folder("lsystem_surface");
  write_lsystem(folder, "flag.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const fs::path file =
      write_lsystem(folder, "flag.lsys", "surface flag = \"flag.obj\"\naxiom: F;(4)~(\"flag\")\n");
  const std::string png = (folder / "flag.png").string(), glb = (folder / "flag.glb").string();
  EXPECT_EQ(run_espalier("lsystem '" + file.string() + "' --size 40 --samples 1 -o '" + png + "'").exit_code,
            0);
  const ProgramRun mesh = run_espalier("mesh '" + file.string() + "' -o '" + glb + "'");
  EXPECT_EQ(mesh.exit_code, 0) << mesh.err;
  std::ifstream exported(glb, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(exported), {}};
  EXPECT_NE(bytes.find("leaf_c8342b"), std::string::npos);
}

TEST(LsystemCommand, ReadsIncludesOfTheSameFolder) {
  const fs::path folder = fresh_folder("lsystem_include");
  write_lsystem(folder, "rules.lsys", "productions:\n  A --> AB\n");
  const fs::path file = write_lsystem(folder, "main.lsys", "axiom: A\ninclude \"rules.lsys\"\n");
  EXPECT_EQ(run_espalier("lsystem '" + file.string() + "' --steps 2 --string").out, "ABB\n");
  const fs::path out = write_lsystem(folder, "out.lsys", "axiom: A\ninclude \"../etc/passwd\"\n");
  expect_one_clear_error(run_espalier("lsystem '" + out.string() + "' --steps 2 --string"));
}

TEST(LsystemCommand, BadInputIsOneClearLine) {
  const fs::path folder = fresh_folder("lsystem_bad");
  const fs::path loop = write_lsystem(folder, "loop.lsys", "axiom: A\nlua:\n  while true do end\n");
  const fs::path grows = write_lsystem(folder, "grows.lsys", "axiom: A\nproductions:\n  A --> AA\n");
  const std::string looping = fmt::format("'{}' --string", loop.string());
  const std::string growing = fmt::format("'{}' --string --steps 60 --max-modules 1000", grows.string());
  for (const char* arguments :
       {"nowhere.lsys --string", "ferm --string", "fern", "fern --string --steps=-1",
        "fern --string --frames 3", "fern --frames 0 -o /tmp/x.gif",
        "fern --frames 3 --frame-seconds 0 -o /tmp/x.gif", "fern --frames 3 -o /tmp/x.mp4",
        "fern -o /tmp/x.gif", "fern --frames 3 -o /nowhere/x.gif", "fern --string --set x=1",
        "topiary_6 --string --set box=1000", looping.c_str(), growing.c_str()}) {
    SCOPED_TRACE(arguments);
    expect_one_clear_error(run_espalier(fmt::format("lsystem {}", arguments)));
  }
}

TEST(LsystemCommand, LsystemsAreModels) {
  const fs::path folder = fresh_folder("lsystem_model");
  const std::string mask = (folder / "mask.png").string(), run = (folder / "run").string();
  EXPECT_EQ(run_espalier("mask monopodial.lsys --size 64 --set branch_angle=50 -o '" + mask + "'").exit_code,
            0);
  const ProgramRun fit =
      run_espalier("fit '" + mask +
                   "' --model monopodial.lsys --free branch_angle,trunk_ratio --evaluations 30 --size 64 "
                   "--branch-rounds 1 --out '" +
                   run + "'");
  EXPECT_EQ(fit.exit_code, 0) << fit.err;
  // Its plants are within the budget: they were drawn and compared.
  EXPECT_EQ(fit.out.find("IoU 0.0000"), std::string::npos) << fit.out;
  EXPECT_EQ(run_espalier("mask '" + run + "/best.toml' -o '" + mask + "'").exit_code, 0);
}

// The examples of the documentation, with small pictures.
TEST(LsystemCommand, ExamplesWorkAsTheyStand) {
  const fs::path folder = fresh_folder("lsystem_examples");
  const std::string models = ESPALIER_SOURCE_DIR "/src/lsystem/models/";
  const auto in_folder = [&](const char* name) { return " '" + (folder / name).string() + "'"; };
  const std::string small = " --size 32 --samples 1";
  EXPECT_EQ(run_espalier("lsystem '" + models + "topiary_6.lsys' --steps 27 --seed 3 -o" +
                         in_folder("topiary.png") + small)
                .exit_code,
            0);
  EXPECT_EQ(run_espalier("lsystem '" + models + "raceme.lsys' --steps 2 --string").out,
            "I(1)[I(1)Flower(1)]I(0)[I(0)Flower(0)]A\n");
  EXPECT_EQ(
      run_espalier("lsystem '" + models + "mycelis.lsys' --frames 6 -o" + in_folder("growth.gif") + small)
          .exit_code,
      0);
  const ProgramRun fit = run_espalier(
      "fit '" ESPALIER_SOURCE_DIR "/targets/fir.png' --model '" + models +
      "small_pine.lsys' --free branch_angle,reach --evaluations 20 --size 32 --branch-rounds 1 --out" +
      in_folder("run"));
  EXPECT_EQ(fit.exit_code, 0) << fit.err;
}

}  // namespace
}  // namespace espalier
