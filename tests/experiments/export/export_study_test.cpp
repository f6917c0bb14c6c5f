// What is exported is read back by the rules of the tools that it is for (IOHanalyzer's readFiles.R; cocopp's
// data sets and data formats), and is what the traces say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/core/error.h>
#include <espalier/experiments/export/export_study.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct TraceRow {
  long evaluations;
  double best, batch_best;
};

struct HandMadeFit {
  std::string target, optimizer, seed;
  std::vector<TraceRow> trace;
  std::string objective = "iou";
};

const std::vector<HandMadeFit> kFits = {
    {"oak", "ga", "3", {{10, 0.4, 0.4}, {20, 0.4, 0.3}, {20, 0.5, 0.5}, {30, 0.75, 0.75}, {40, 0.75, 0.6}}},
    {"oak", "ga", "5", {{10, 0.2, 0.2}, {40, 0.25, 0.25}}},
    {"fir", "ga", "3", {{10, 0.875, 0.875}}},
    {"oak", "cma_es", "3", {{12, 0.5, 0.5}}},
};

fs::path study_of(const std::vector<HandMadeFit>& fits) {
  const fs::path study = fresh_folder("export_study");
  std::ofstream(study / "experiment.toml") << "[fits]\ntargets = ['oak', 'fir']\n";
  std::ofstream results(study / "results.csv"), times(study / "times.csv");
  results
      << "run,target,optimizer,objective,space,start,trained,seed,status,fitness,iou,tolerant_iou,outline_"
         "iou,unseen_iou,unseen_fitness,error\n";
  times << "run,seconds,evaluations\n";
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const HandMadeFit& fit = fits[i];
    const fs::path run = study / "runs" / fmt::format("run{}", i);
    fs::create_directories(run);
    const bool is_done = !fit.trace.empty();
    results << fmt::format("run{},{},{},{},default,auto,plain,{},{},{},,,,,,\n", i, fit.target, fit.optimizer,
                           fit.objective, fit.seed, is_done ? "done" : "failed",
                           is_done ? fmt::format("{}", fit.trace.back().best) : "");
    std::ofstream trace(run / "trace.csv");
    trace << "evaluations,best,batch_best\n";
    for (const TraceRow& row : fit.trace)
      trace << fmt::format("{},{},{}\n", row.evaluations, row.best, row.batch_best);
    std::ofstream(run / "summary.json")
        << R"({"parameters": {"tolerance": 0.1, "determined": ["a", "b"], "open": ["c"]}})";
  }
  return study;
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  for (std::size_t next; (next = text.find(separator, at)) != std::string::npos; at = next + separator.size())
    parts.push_back(text.substr(at, next - at));
  parts.push_back(text.substr(at));
  return parts;
}

/// A record of the third line of an .info file.
struct ReadInstance {
  std::string instance;
  long evaluations = 0;
  double value = 0;
};

struct ReadInfo {
  std::map<std::string, std::string> header;
  fs::path data_file;
  std::vector<ReadInstance> instances;
};

ReadInfo read_info(const fs::path& path) {
  const std::vector<std::string> lines = lines_of(path);
  ReadInfo info;
  if (lines.size() != 3 || lines[1][0] != '%') {
    ADD_FAILURE() << path << ": three lines, the second a comment";
    return info;
  }
  for (const std::string& pair : split(lines[0], ", ")) {
    const std::vector<std::string> sides = split(pair, " = ");
    info.header[sides[0]] = sides[1];
  }
  const std::vector<std::string> records = split(lines[2], ", ");
  info.data_file = path.parent_path() / records[0];
  for (std::size_t i = 1; i < records.size(); ++i) {
    const std::vector<std::string> sides = split(records[i], ":");
    const std::vector<std::string> values = split(sides[1], "|");
    info.instances.push_back({sides[0], std::stol(values[0]), std::stod(values[1])});
  }
  return info;
}

using Block = std::vector<std::vector<double>>;  ///< rows of numbers of one run

std::vector<Block> read_blocks(const fs::path& path, const std::string& separation, std::size_t columns) {
  std::vector<Block> blocks;
  for (const std::string& line : lines_of(path)) {
    if (line.starts_with(separation)) {
      blocks.emplace_back();
      continue;
    }
    std::vector<double> row;
    for (const std::string& cell : split(line, " ")) row.push_back(std::stod(cell));
    EXPECT_EQ(row.size(), columns) << path << ": " << line;
    blocks.back().push_back(row);
  }
  return blocks;
}

/// What both tools ask of a run: it begins at evaluation 1, rises, never gets worse, and ends where .info
/// says.
void expect_run(const Block& block, std::size_t best_column, const ReadInstance& instance, double target) {
  ASSERT_FALSE(block.empty());
  EXPECT_EQ(block.front()[0], 1);
  for (std::size_t i = 1; i < block.size(); ++i) {
    EXPECT_GT(block[i][0], block[i - 1][0]);
    EXPECT_LE(block[i][best_column], block[i - 1][best_column]);
  }
  EXPECT_EQ(block.back()[0], static_cast<double>(instance.evaluations));
  EXPECT_NEAR(block.back()[best_column] - target, instance.value, 1e-6);
}

TEST(ExportStudy, IohprofilerReadsBackWhatTheTracesSay) {
  const fs::path out = fresh_folder("export_ioh") / "out";
  EXPECT_EQ(export_study(study_of(kFits), "iohprofiler", out).size(), 2u);
  const ReadInfo info = read_info(out / "ga" / "IOHprofiler_f1.info");
  EXPECT_EQ(info.header.at("funcId"), "1");
  EXPECT_EQ(info.header.at("DIM"), "3");
  EXPECT_EQ(info.header.at("algId"), "'ga'");
  EXPECT_EQ(info.header.at("maximization"), "'F'");
  const std::vector<Block> blocks = read_blocks(info.data_file, "\"function evaluation\" ", 5);
  ASSERT_EQ(blocks.size(), 2u);
  ASSERT_EQ(info.instances.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) expect_run(blocks[i], 2, info.instances[i], 0);
  EXPECT_EQ(info.instances[0].instance, "3");
  ASSERT_EQ(blocks[0].size(), 5u) << "two rows of 20 evaluations are one";
  EXPECT_NEAR(blocks[0][1][2], 0.6, 1e-9);
  EXPECT_NEAR(blocks[0][2][2], 0.5, 1e-9);
  EXPECT_NEAR(blocks[0][4][1], 0.4, 1e-9) << "the last batch";
  EXPECT_NEAR(blocks[0][4][2], 0.25, 1e-9) << "the best";
}

TEST(ExportStudy, CocoReadsBackWhatTheTracesSay) {
  constexpr double kPrecision = 1e-8;
  const fs::path out = fresh_folder("export_coco") / "out";
  export_study(study_of(kFits), "coco", out);
  const ReadInfo info = read_info(out / "ga" / "bbobexp_f1.info");
  EXPECT_EQ(info.header.at("suite"), "'bbob'");
  EXPECT_EQ(info.header.at("data_format"), "'bbob-new'");
  EXPECT_EQ(info.header.at("DIM"), "3");
  ASSERT_EQ(info.instances.size(), 2u);
  for (const char* ending : {".dat", ".tdat"}) {
    const auto blocks =
        read_blocks(fs::path(info.data_file).replace_extension(ending), "% f evaluations | ", 5);
    ASSERT_EQ(blocks.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      expect_run(blocks[i], 2, info.instances[i], kPrecision);
      for (const auto& row : blocks[i]) EXPECT_EQ(row[1], 0) << "no constraints";
    }
    EXPECT_EQ(blocks[0].size(), 5u) << ending << ": the last row is there, though it is no better";
  }
  EXPECT_EQ(read_info(out / "ga" / "bbobexp_f2.info").instances.size(), 1u);
  EXPECT_FALSE(fs::exists(out / "cma_es" / "bbobexp_f2.info")) << "which it did not fit";
}

TEST(ExportStudy, FunctionsAreNamedInAFileThatNoToolTakesForData) {
  const fs::path out = fresh_folder("export_names") / "out";
  export_study(study_of(kFits), "iohprofiler", out);
  EXPECT_THAT(read_text_file(out / "functions.md"), HasSubstr("| 2 | fir |"));
  for (const auto& entry : fs::recursive_directory_iterator(out))
    if (entry.is_regular_file()) {
      EXPECT_THAT(entry.path().extension().string(), testing::AnyOf(".info", ".dat", ".md")) << entry.path();
    }
}

std::string error_of(const std::vector<HandMadeFit>& fits, const std::string& format, const fs::path& out) {
  try {
    export_study(study_of(fits), format, out);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ExportStudy, RefusesWhatTheToolsWouldMisread) {
  const fs::path out = fresh_folder("export_refused") / "out";
  std::vector<HandMadeFit> fits = kFits;
  EXPECT_THAT(error_of(fits, "nevergrad", out), HasSubstr("got 'nevergrad', expected a format: iohprofiler"));
  fits[1].objective = "dice";
  EXPECT_THAT(error_of(fits, "coco", out), HasSubstr("got the objectives iou and dice"));
  EXPECT_THAT(error_of({{"oak", "ga", "1", {}}}, "coco", out), HasSubstr("got no finished run"));
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(error_of(kFits, "coco", out), "no error");
  EXPECT_THAT(error_of(kFits, "coco", out), HasSubstr("got a directory with files"));
}

TEST(ExportCommand, ExportsAStudyThatRan) {
  const fs::path folder = fresh_folder("export_ran");
  std::ofstream(folder / "study.toml")
      << "[fits]\ntargets = ['oc_palm']\nevaluations = 120\nsize = 32\nmax_stems = 300\nmax_leaves = 3000\n";
  const std::string study = (folder / "study").string();
  ASSERT_EQ(
      run_espalier("experiment run '" + (folder / "study.toml").string() + "' --quiet --out '" + study + "'")
          .exit_code,
      0);
  for (const std::string& format : export_formats()) {
    const ProgramRun run = run_espalier("experiment export '" + study + "' --format " + format + " --out '" +
                                        (folder / format).string() + "'");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("cma_es"));
  }
  const ReadInfo info = read_info(folder / "coco" / "cma_es" / "bbobexp_f1.info");
  EXPECT_GT(std::stoi(info.header.at("DIM")), 5);
  ASSERT_EQ(info.instances.size(), 1u);
  EXPECT_GE(info.instances[0].evaluations, 120);
  expect_one_clear_error(
      run_espalier("experiment export '" + study + "' --format csv --out '" + (folder / "x").string() + "'"));
}

}  // namespace
}  // namespace espalier
