// Wrong command lines: each is told in one line which word is wrong and what to write instead, and ends with
// exit code 2.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include <espalier/app/main/program.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

using testing::HasSubstr;

struct WrongLine {
  const char* words;  ///< with single spaces between them; PALM is a picture
  const char* wrong;  ///< the word or option that the message names
  const char* cure;   ///< what it says to write instead, or what was expected
};

void PrintTo(const WrongLine& line, std::ostream* out) { *out << "espalier " << line.words; }

constexpr WrongLine kWrongLines[] = {
    // Commands.
    {"fitt PALM", "'fitt'", "did you mean 'espalier fit'?"},
    {"Fit PALM", "'Fit'", "did you mean 'espalier fit'?"},
    {"rendr palm -o a.png", "'rendr'", "did you mean 'espalier render'?"},
    {"exp run a.toml", "'exp'", "did you mean 'espalier experiment'?"},
    {"grow palm", "'grow'", "did you mean 'espalier render'?"},
    {"list", "'list'", "did you mean 'espalier species'?"},
    {"export palm", "'export'", "did you mean 'espalier mesh'?"},
    {"help", "'help'", "did you mean 'espalier --help'?"},
    {"version", "'version'", "did you mean 'espalier --version'?"},
    {"run a.toml", "'run'", "did you mean 'espalier experiment run'?"},
    {"unicorn", "'unicorn'", "expected one of: fit, "},
    {"PALM", "which is no command", "did you mean 'espalier fit "},
    {"--seconds 3 PALM", "'--seconds'", "it is one of fit, bench"},
    {"--verson", "'--verson'", "did you mean --version?"},
    {"experiment runn a.toml", "'runn'", "did you mean 'espalier experiment run'?"},
    {"experiment repot runs/a", "'repot'", "did you mean 'espalier experiment report'?"},
    {"experiment a.toml", "'a.toml'", "expected one of: run, report, check, compare, export"},
    // Options.
    {"fit PALM --freee x", "'--freee'", "did you mean --free? (see: espalier fit --help)"},
    {"fit PALM --second 3", "'--second'", "did you mean --seconds?"},
    {"fit PALM --sed=4", "'--sed'", "did you mean --seed?"},
    {"fit PALM --time 3", "'--time'", "did you mean --seconds?"},
    {"fit PALM --iterations 3", "'--iterations'", "did you mean --evaluations?"},
    {"fit PALM --optimiser cma_es", "'--optimiser'", "did you mean --optimizer?"},
    {"fit PALM -seconds 3", "'-seconds'", "did you mean --seconds?"},
    {"fit PALM -q", "'-q'", "did you mean --quiet?"},
    {"fit PALM --ground", "'--ground'", "it is one of lsystem, render"},
    {"fit PALM --zebra", "'--zebra'", "see: espalier fit --help"},
    {"render palm -o a.png --sample 4", "'--sample'", "did you mean --samples?"},
    {"render palm -o a.png --angle 4", "'--angle'", "did you mean --azimuth?"},
    {"mask palm -o a.png --seeds 1", "'--seeds'", "did you mean --seed?"},
    {"mesh palm -o a.glb --lod 1", "'--lod'", "did you mean --detail?"},
    {"lsystem fern -o a.png --step 3", "'--step'", "did you mean --steps?"},
    {"compare a.png b.png --jsn", "'--jsn'", "did you mean --json?"},
    {"experiment run a.toml --threads 3", "'--threads'", "did you mean --jobs?"},
    {"params --fromat json", "'--fromat'", "did you mean --format?"},
    {"space map.svg --gird 7x7", "'--gird'", "did you mean --grid?"},
    {"blend palm apple --stripe 3 a.png", "'--stripe'", "did you mean --strip?"},
    {"posterior PALM --sample 10", "'--sample'", "did you mean --samples?"},
    {"trials runs/a --outptu a.csv", "'--outptu'", "did you mean --output?"},
    // Words that are missing, or too many.
    {"fit PALM --seconds", "--seconds", "got no value, expected"},
    {"fit PALM --output", "--output", "got no value, expected"},
    {"render", "got no preset", "expected a bundled preset"},
    {"render palm", "got no --output", "the PNG to write"},
    {"mesh palm", "got no --output", "chooses the format"},
    {"compare a.png", "got no target", "espalier compare --help"},
    {"posterior", "got no image", "the picture"},
    {"trials", "got no run", "the directory of a run"},
    {"completion", "got no shell", "bash, zsh or fish"},
    {"experiment run", "got no file", "the experiment: a TOML file"},
    {"fit PALM b.png", "'b.png'", "one word too many"},
    {"fit PALM seconds 5", "'seconds'", "did you mean --seconds?"},
    {"render palm apple -o a.png", "'apple'", "one word too many"},
    {"lsystem --string", "got no file", "see: espalier lsystem"},
    // Values.
    {"fit PALM --threads abc", "--threads: got 'abc'", "expected 0 to 1024"},
    {"fit PALM --threads 5000", "--threads: got '5000'", "expected 0 to 1024"},
    {"fit PALM --seconds abc", "--seconds: got 'abc'", "expected a number"},
    {"fit PALM --optimizer cma", "--optimizer: got", "cma_es"},
    {"fit PALM --kind bush", "--kind: got 'bush'", "leafy"},
    {"fit PALM --views PALM:90", "--views: got", "FILE:AZIMUTH,ELEVATION"},
    {"fit PALM --objective iuo", "--objective: got 'iuo'", "iou"},
    {"fit PALM --picture a.png", "--picture", "neither --resume nor --repeat"},
    {"params --format jsn", "--format: got 'jsn'", "did you mean json?"},
    {"completion powershell", "shell: got 'powershell'", "expected one of: bash, zsh, fish"},
    {"reference optimisers", "topic: got 'optimisers'", "did you mean optimizers?"},
    {"render plam -o a.png", "'plam'", "palm"},
    {"render topiary_6 -o a.png", "'topiary_6'", "'topiary_6.lsys'"},
    {"render palm -o a.png --size big", "--size", "expected N or WxH"},
    {"render palm -o a.png --view x", "--view", "such as 30,10"},
    {"render palm -o a.jpg", "--output a.jpg", "ends in .png"},
    {"render palm -o /nowhere/a.png", "/nowhere", "is no directory"},
    {"render palm -o a.png --season fall", "'fall'", "autumn"},
    {"render palm -o a.png --set levls=2", "'levls'", "levels"},
    {"render palm -o a.png --seed -1", "--seed", "expected a whole number from 0"},
    {"render palm -o a.png --elevation 100", "elevation", "from -90 to 90"},
    {"render palm -o a.png --samples 0", "--samples", "expected 1 to 1024"},
    {"render palm -o a.png --azimuth north", "--azimuth: got 'north'", "expected a number"},
    {"mesh palm -o a.fbx", "a.fbx", "glb"},
    {"mesh palm -o a.glb --detail fine", "--detail fine", "expected low, medium, high"},
    {"lsystem frn", "'frn'", "fern"},
    {"lsystem fern", "neither --string and --output", "expected one of them"},
    {"experiment run nothing.toml", "nothing.toml", "no such file"},
    {"trials /nowhere", "/nowhere", "expected that of a run"},
    // Options that contradict each other.
    {"fit --resume a --seed 3", "--seed and --resume", "expected one of the two"},
    {"fit --resume a --repeat b", "--re", "expected one of the two"},
    {"fit PALM --repeat a", "--repeat", "expected one of the two"},
    {"species palm --check a.toml", "--check", "expected one of the two"},
    {"render palm -o a.png --view 3,3 --azimuth 3", "--view", "expected one of the two"},
    {"lsystem fern --string --frames 3", "--string and --frames", "expected one of them"},
};
static_assert(std::size(kWrongLines) >= 60);

std::vector<std::string> words_of_line(std::string line) {
  for (auto at = line.find("PALM"); at != std::string::npos; at = line.find("PALM"))
    line.replace(at, 4, ESPALIER_SOURCE_DIR "/targets/oc_palm.png");
  std::istringstream words(line);
  std::vector<std::string> split = {"espalier"};
  for (std::string word; words >> word;) split.push_back(word);
  return split;
}

struct WrongWords : testing::TestWithParam<WrongLine> {};

TEST_P(WrongWords, AreNamedWithTheirCure) {
  const std::vector<std::string> words = words_of_line(GetParam().words);
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int exit_code = run_program(static_cast<int>(arguments.size()), arguments.data());
  const std::string out = testing::internal::GetCapturedStdout(),
                    err = testing::internal::GetCapturedStderr();
  EXPECT_EQ(exit_code, 2);
  EXPECT_EQ(out, "");
  EXPECT_THAT(err, testing::MatchesRegex("espalier: [^\n]+\n"));
  EXPECT_THAT(err, HasSubstr(GetParam().wrong));
  EXPECT_THAT(err, HasSubstr(GetParam().cure));
}

INSTANTIATE_TEST_SUITE_P(CommandLines, WrongWords, testing::ValuesIn(kWrongLines));

}  // namespace
}  // namespace espalier
