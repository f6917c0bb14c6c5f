// The log and what is replayed from it: nothing is computed twice, nothing lost, nothing taken for another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fstream>

#include <espalier/core/error.h>
#include <espalier/fitting/search/logged_scorer.h>

#include "support/fakes.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<ParameterValues> candidates(int count) {
  std::vector<ParameterValues> list;
  for (int i = 0; i < count; ++i) list.push_back({static_cast<double>((i * 7) % 11), 0.5});
  return list;
}

/// Of candidates: two numbers each.
const ParameterTable& two_rows() {
  static const ParameterTable kTable{"test", {{.name = "a"}, {.name = "b"}}};
  return kTable;
}

struct LoggedRun {
  std::vector<double> scores;
  BestCandidate best;
  long computed = 0, evaluations = 0;
};

/// Scores `total` candidates in batches of `batch`, with the log in `folder`.
LoggedRun run_logged(const fs::path& folder, int total, int batch, long limit = 0) {
  SumScorer inner;
  EvaluationLog log(folder / "evaluations.bin");
  LoggedScorer scorer(
      inner, two_rows(), log, limit, [] { return 1.5; }, [](const ScoredBatch&) {});
  const auto all = candidates(total);
  LoggedRun result;
  result.scores.resize(all.size());
  for (int first = 0; first < total; first += batch) {
    const auto count = static_cast<std::size_t>(std::min(batch, total - first));
    scorer.score(std::span(all).subspan(static_cast<std::size_t>(first), count),
                 std::span(result.scores).subspan(static_cast<std::size_t>(first), count));
  }
  result.best = scorer.best();
  result.computed = inner.scored;
  result.evaluations = scorer.evaluations();
  return result;
}

std::string error_of_log(const fs::path& path) {
  try {
    EvaluationLog log(path);
    log.append(std::vector<LoggedEvaluation>(10));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

RC_GTEST_PROP(EvaluationLog, ARunCutAtAnyByteResumesToTheUnbrokenRun, ()) {
  const int total = *rc::gen::inRange(1, 40), batch = *rc::gen::inRange(1, 9);
  const fs::path folder = fresh_folder("log");
  const LoggedRun unbroken = run_logged(folder, total, batch);
  const auto bytes = read_text_file(folder / "evaluations.bin");
  const auto kept = *rc::gen::inRange<std::size_t>(0, bytes.size() + 1);
  fs::resize_file(folder / "evaluations.bin", kept);
  const LoggedRun resumed = run_logged(folder, total, batch);
  RC_ASSERT(resumed.scores == unbroken.scores);
  RC_ASSERT(resumed.best.values == unbroken.best.values &&
            resumed.best.evaluation == unbroken.best.evaluation);
  RC_ASSERT(resumed.computed == total - (kept < 8 ? 0 : static_cast<long>((kept - 8) / 24)));
  RC_ASSERT(read_text_file(folder / "evaluations.bin") == bytes);
  fs::remove_all(folder);
}

RC_GTEST_PROP(EvaluationLog, ARunWithAnyBitFlippedGoesOnFromBeforeItToTheUnbrokenRun, ()) {
  const fs::path folder = fresh_folder("log"), file = folder / "evaluations.bin";
  const LoggedRun unbroken = run_logged(folder, 20, 6);
  const std::string bytes = read_text_file(file);
  const auto bit =
      *rc::gen::inRange<std::size_t>(8 * 8, bytes.size() * 8);  // one in the mark is another kind of file
  std::string flipped = bytes;
  flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
  std::ofstream(file, std::ios::binary) << flipped;
  const std::size_t before = (bit / 8 - 8) / 24;
  const LogContent content = read_evaluation_log(file);
  RC_ASSERT(content.is_damaged);
  RC_ASSERT(content.evaluations.size() == before);
  const LoggedRun resumed = run_logged(folder, 20, 6);
  RC_ASSERT(resumed.scores == unbroken.scores);
  RC_ASSERT(resumed.computed == static_cast<long>(20 - before));
  RC_ASSERT(read_text_file(file) == bytes);
  fs::remove_all(folder);
}

/// As a file system leaves what was not synced before the power went.
RC_GTEST_PROP(EvaluationLog, ALogWhoseEndIsZerosGoesOnToTheUnbrokenRun, ()) {
  const fs::path folder = fresh_folder("zeros"), file = folder / "evaluations.bin";
  const LoggedRun unbroken = run_logged(folder, 20, 6);
  const std::string bytes = read_text_file(file);
  const auto kept = *rc::gen::element<std::size_t>(0, 8, 8 + 24, 8 + 24 * 7);
  const auto size = *rc::gen::inRange<std::size_t>(kept, bytes.size() + 1);
  std::ofstream(file, std::ios::binary) << bytes.substr(0, kept) << std::string(size - kept, '\0');
  const LoggedRun resumed = run_logged(folder, 20, 6);
  RC_ASSERT(resumed.scores == unbroken.scores);
  RC_ASSERT(resumed.computed == static_cast<long>(20 - (kept < 8 ? 0 : (kept - 8) / 24)));
  RC_ASSERT(read_text_file(file) == bytes);
  fs::remove_all(folder);
}

TEST(EvaluationLog, RecordsInAnotherOrderAreDamaged) {
  const fs::path folder = fresh_folder("order"), file = folder / "evaluations.bin";
  run_logged(folder, 4, 2);
  const std::string bytes = read_text_file(file);
  std::ofstream(file, std::ios::binary) << bytes.substr(0, 8) << bytes.substr(32, 24) << bytes.substr(8, 24);
  EXPECT_TRUE(read_evaluation_log(file).is_damaged);
  EXPECT_TRUE(read_evaluation_log(file).evaluations.empty());
}

TEST(EvaluationLog, OfVersion01IsReadAndBecomesOneOfToday) {
  const fs::path folder = fresh_folder("old_log"), file = folder / "evaluations.bin";
  const LoggedRun unbroken = run_logged(folder, 9, 3);
  const std::string bytes = read_text_file(file);
  std::ofstream old(file, std::ios::binary | std::ios::trunc);
  old << "espfit01";
  for (std::size_t record = 0; record < 7; ++record) old << bytes.substr(8 + record * 24, 16);
  old << "torn";
  old.close();
  EXPECT_EQ(read_evaluation_log(file).evaluations.size(), 7u);
  const LoggedRun resumed = run_logged(folder, 9, 3);
  EXPECT_EQ(resumed.scores, unbroken.scores);
  EXPECT_EQ(resumed.computed, 2);
  EXPECT_EQ(read_text_file(file), bytes);
}

TEST(EvaluationLog, IsNoLink) {
  const fs::path folder = fresh_folder("link");
  std::ofstream(folder / "precious") << "espfit02";
  fs::create_symlink("precious", folder / "evaluations.bin");
  EXPECT_THAT(error_of_log(folder / "evaluations.bin"), HasSubstr("expected a log that can be written"));
  EXPECT_EQ(read_text_file(folder / "precious"), "espfit02");
}

TEST(LoggedScorer, StopsEvaluatingAtTheLimitInsideABatch) {
  const LoggedRun cut = run_logged(fresh_folder("limit"), 30, 8, 13),
                  whole = run_logged(fresh_folder("no_limit"), 30, 8);
  EXPECT_EQ(cut.computed, 13);
  EXPECT_EQ(cut.evaluations, 13);
  for (std::size_t i = 0; i < 30; ++i)
    EXPECT_EQ(cut.scores[i], i < 13 ? whole.scores[i] : kNotEvaluated) << i;
}

TEST(LoggedScorer, KeepsTheFirstOfEqualBests) {
  EXPECT_EQ(run_logged(fresh_folder("ties"), 30, 4).best.evaluation, 1);
}

TEST(LoggedScorer, RefusesALogOfOtherCandidates) {
  const fs::path folder = fresh_folder("other");
  run_logged(folder, 10, 5);
  SumScorer inner;
  EvaluationLog log(folder / "evaluations.bin");
  LoggedScorer scorer(
      inner, two_rows(), log, 0, [] { return 0.0; }, [](const ScoredBatch&) {});
  double score = 0;
  EXPECT_THROW(scorer.score(std::vector<ParameterValues>{{3.0, 0.25}}, {&score, 1}), InputError);
}

TEST(EvaluationLog, TheHashOfACandidateIsThatOfItsValuesInUse) {
  const ParameterTable table{
      "test",
      {{.name = "a"}, {.name = "b"}, {.name = "part", .part_of = "part"}, {.name = "of", .part_of = "part"}}};
  const std::uint32_t plain = hash_values(two_rows(), {3.0, 0.25});
  EXPECT_NE(plain, hash_values(two_rows(), {3.0, 0.5}));
  EXPECT_EQ(plain, hash_values(table, {3.0, 0.25, 0, 7}));
  EXPECT_NE(plain, hash_values(table, {3.0, 0.25, 1, 7}));
  EXPECT_NE(hash_values(table, {3.0, 0.25, 1, 8}), hash_values(table, {3.0, 0.25, 1, 7}));
}

TEST(EvaluationLog, ReportsAFullDisk) { EXPECT_THAT(error_of_log("/dev/full"), HasSubstr("No space left")); }

TEST(EvaluationLog, RefusesAnotherKindOfFile) {
  const fs::path path = fresh_folder("kind") / "evaluations.bin";
  std::ofstream(path) << "a shopping list";
  EXPECT_THAT(error_of_log(path), HasSubstr("expected a log of evaluations"));
}

TEST(EvaluationLog, ReportsAFolderThatIsNotThere) {
  EXPECT_THAT(error_of_log("/nowhere/evaluations.bin"), HasSubstr("No such file"));
}

}  // namespace
}  // namespace espalier
