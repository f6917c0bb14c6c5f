#include <map>
#include <nlohmann/json.hpp>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/experiments/runner/experiment_directory.h>
#include <espalier/experiments/runner/move_runs.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// First all runs leave their places, then all of them come to the new ones: a place may be another's old
/// one.
struct MoveJournal {
  bool have_left = false;
  std::vector<RunMove> moves;
  std::string declaration;
};

fs::path journal_path(const fs::path& directory) { return directory / "move_runs.json"; }

/// Where runs are between the two.
fs::path halfway(const fs::path& directory, std::size_t move) {
  return directory / "moving_runs" / fmt::format("{}", move);
}

void write_journal(const fs::path& directory, const MoveJournal& journal) {
  Json moves = Json::array();
  for (const RunMove& move : journal.moves) moves.push_back({move.from, move.to});
  const Json json{{"have_left", journal.have_left}, {"moves", moves}, {"declaration", journal.declaration}};
  write_file_atomically(journal_path(directory), json.dump(2) + "\n");
}

MoveJournal read_journal(const fs::path& directory) {
  try {
    const Json json = Json::parse(read_file(journal_path(directory)));
    MoveJournal journal{json.at("have_left"), {}, json.at("declaration")};
    for (const Json& move : json.at("moves")) journal.moves.push_back({move.at(0), move.at(1)});
    return journal;
  } catch (const nlohmann::json::exception& error) {
    throw_input_error("{}: got no list of moves ({}), expected one", journal_path(directory).string(),
                      error.what());
  }
}

/// Whether there was something to move.
bool rename_existing(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (!fs::exists(from, error)) return false;
  fs::create_directories(to.parent_path(), error);
  fs::rename(from, to, error);
  if (error)
    throw_input_error("{}: got '{}', expected to move it to {}", from.string(), error.message(), to.string());
  return true;
}

void leave_old_places(const fs::path& directory, const MoveJournal& journal,
                      const std::function<void()>& after_step) {
  for (std::size_t i = 0; i < journal.moves.size(); ++i)
    if (rename_existing(run_directory(directory, journal.moves[i].from), halfway(directory, i))) after_step();
}

void come_to_new_places(const fs::path& directory, const MoveJournal& journal,
                        const std::function<void()>& after_step) {
  for (std::size_t i = 0; i < journal.moves.size(); ++i)
    if (rename_existing(halfway(directory, i), run_directory(directory, journal.moves[i].to))) after_step();
}

std::map<Row, std::string> names_by_labels(const Plan& plan) {
  std::map<Row, std::string> names;
  for (const PlannedRun& run : plan.runs) names.emplace(run.labels, run.name);
  return names;
}

}  // namespace

std::vector<RunMove> renamed_runs(const Plan& was, const Plan& is) {
  const auto names = names_by_labels(is);
  std::vector<RunMove> moves;
  for (const PlannedRun& run : was.runs)
    if (const auto found = names.find(run.labels); found != names.end() && found->second != run.name)
      moves.push_back({run.name, found->second});
  return moves;
}

void move_runs(const fs::path& directory, const std::vector<RunMove>& moves, const std::string& declaration,
               const std::function<void()>& after_step) {
  write_journal(directory, {false, moves, declaration});
  after_step();
  finish_moves(directory, after_step);
}

void finish_moves(const fs::path& directory, const std::function<void()>& after_step) {
  std::error_code error;
  if (!fs::exists(journal_path(directory), error)) return;
  MoveJournal journal = read_journal(directory);
  if (!journal.have_left) {
    leave_old_places(directory, journal, after_step);
    journal.have_left = true;
    write_journal(directory, journal);
    after_step();
  }
  come_to_new_places(directory, journal, after_step);
  write_declared_text(directory, journal.declaration);
  after_step();
  fs::remove(directory / "moving_runs", error);
  fs::remove(journal_path(directory), error);
}

}  // namespace espalier
