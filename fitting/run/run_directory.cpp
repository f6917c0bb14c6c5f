#include <algorithm>
#include <system_error>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/fitting/run/run_directory.h>
#include <espalier/fitting/run/run_pictures.h>
#include <espalier/fitting/run/run_summary.h>
#include <espalier/fitting/search/evaluation_log.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/image/reading/frame.h>
#include <espalier/image/reading/room_to_grow.h>
#include <espalier/machine/directory_lock.h>
#include <espalier/models/preset.h>
#include <espalier/render/embree/embree_renderer.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

constexpr int kOverlayPx = 512;  ///< overlays are enlarged to about this

constexpr const char* kBranchesFile = "branches.json";

/// "best.png" for the first mask, "best_2.png" for the second.
fs::path numbered(const fs::path& directory, const std::string& stem, std::size_t index) {
  return directory / (index == 0 ? stem + ".png" : fmt::format("{}_{}.png", stem, index + 1));
}

Picture enlarged(const Picture& picture, int factor) {
  Picture large(picture.width_px * factor, picture.height_px * factor);
  for (int y = 0; y < large.height_px; ++y)
    for (int x = 0; x < large.width_px; ++x) large.at(x, y) = picture.at(x / factor, y / factor);
  return large;
}

/// The outlines a trained tree was grown into, as its preset names them: files beside it.
std::vector<GrownInto> grown_into(const RunState& state) {
  std::vector<GrownInto> pictures;
  if (!state.task.growth.train) return pictures;
  for (std::size_t i = 0; i < state.task.views.size(); ++i) {
    const TargetView& view = state.task.views[i];
    pictures.push_back({numbered({}, "outline", i), state.record.views[i].view, view.metres_per_px,
                        base_row_px(view.camera.height_px)});
  }
  return pictures;
}

/// What the tree needs besides its species; nothing is known of it while the run goes on.
std::string beyond_its_species(const RunState& state) {
  if (state.resemblances.empty() || !state.portrait) return "";
  return fmt::format("; {:.2f} standard deviations from {}, and {} numbers of branches",
                     state.resemblances.front().departure, state.resemblances.front().species,
                     state.portrait->override_numbers);
}

std::string best_to_toml(const RunState& state) {
  const std::string stem = state.record.views.front().picture.stem().string();
  return preset_to_toml(
      {stem + "_fit",
       fmt::format("fitted to {} with {}, seed {}: fitness {:.4f}{}",
                   state.record.views.front().picture.filename().string(), state.record.optimizer,
                   state.record.seed, 1 - state.best.score, beyond_its_species(state)),
       state.record.model, state.best.values, best_overrides(state), grown_into(state), best_seed(state)},
      state.task.model->table());
}

/// An L-system that the run keeps is named from its directory on.
std::string model_seen_from_the_archive(const std::string& model) {
  const bool is_kept = fs::path(model).has_parent_path() && fs::path(model).is_relative();
  return is_kept ? (".." / fs::path(model)).string() : model;
}

std::string archived_to_toml(const RunState& state, std::size_t index) {
  const ArchivedSolution& solution = state.archive->solutions()[index];
  Preset preset;
  preset.name = fmt::format("{}_{}", state.record.views.front().picture.stem().string(), index + 1);
  preset.description =
      fmt::format("solution {} of the search: fitness {:.4f}, {:.2f} from the best", index + 1,
                  1 - solution.score, distance_between(solution, state.archive->solutions().front()));
  preset.model = model_seen_from_the_archive(state.record.model);
  preset.values = solution.values;
  preset.overrides = state.task.overrides;
  preset.grown_into = grown_into(state);
  preset.seed = state.task.plant_seeds.front();
  return preset_to_toml(preset, state.task.model->table());
}

/// Whether a run writes it before its record, so that one that was killed may have left it alone.
bool is_of_a_beginning(const fs::path& name) {
  return name == "model" || name == "presets" || name.stem() == "picture" ||
         name.string().starts_with("picture_");
}

/// The outlines that trained trees are grown into.
void write_outlines(const fs::path& directory, const RunState& state) {
  for (std::size_t i = 0; i < state.task.views.size() && state.task.growth.train; ++i) {
    const auto& target = state.task.views[i].target;
    write_mask_png(numbered(directory, "outline", i), room_to_grow(target.outline(), target.mask()));
  }
}

/// archive/1.toml and so on, the best first; what an earlier state left there goes.
void write_archive(const fs::path& directory, const RunState& state) {
  if (!state.archive) return;
  const fs::path folder = directory / "archive";
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  if (!fs::exists(folder / "outline.png", ignored)) write_outlines(folder, state);
  const std::vector<ArchivedSolution>& solutions = state.archive->solutions();
  for (std::size_t i = 0; i < solutions.size(); ++i)
    write_file_atomically(folder / fmt::format("{}.toml", i + 1), archived_to_toml(state, i));
  for (std::size_t i = solutions.size() + 1; fs::remove(folder / fmt::format("{}.toml", i), ignored); ++i) {
  }
}

std::optional<FitOutcome> outcome_of(const RunState& state) {
  if (!state.stopped_by) return std::nullopt;
  const BranchRounds& branches = state.branches;
  const long finish_from = branches.finish_from >= 0 ? branches.finish_from : branches.rounds;
  return FitOutcome{state.evaluations, branches.rounds, finish_from, *state.stopped_by};
}

/// The first seed's masks of all views.
void write_best_pictures(const fs::path& directory, RunState& state) {
  const auto draw = [&](SilhouetteRenderer& renderer) {
    return draw_candidate(state.task, state.best.values, renderer, best_overrides(state));
  };
  const std::vector<Mask> best = draw(*state.task.make_renderer()), reference = draw(*make_embree_renderer());
  state.embree_disagreement_px = 0;
  for (std::size_t i = 0; i < state.task.views.size(); ++i) {
    const Mask& target = state.task.views[i].target.mask();
    state.embree_disagreement_px += differing_px(best[i], reference[i]);
    write_mask_png(numbered(directory, "best", i), best[i]);
    write_png(numbered(directory, "overlay", i),
              enlarged(overlay(best[i], target), std::max(1, kOverlayPx / target.width_px())));
  }
}

void write_full_size(const fs::path& directory, const FullSize& seen) {
  for (std::size_t i = 0; i < seen.best.size(); ++i)
    write_png(numbered(directory, "overlay_full_size", i), overlay(seen.best[i], seen.targets[i]));
}

void write_history(const fs::path& directory, const RunState& state) {
  const bool is_priced = expects_leaves(state.task) || state.task.depth_price > 0;
  const std::string fitness = fitness_in_words(state.task.objective, is_priced ? "prices" : "");
  const LineChart chart = convergence_chart(state.trace.rows(), fitness);
  write_file_atomically(directory / "trace.csv", trace_to_csv(state.trace.rows()));
  write_file_atomically(directory / "convergence.svg", chart_to_svg(chart));
  write_png(directory / "convergence.png", chart_to_picture(chart));
}

}  // namespace

const Overrides& best_overrides(const RunState& state) {
  return state.branches.copies.empty() ? state.task.overrides : state.branches.best().overrides;
}

Seed best_seed(const RunState& state) {
  return state.branches.copies.empty() ? state.task.plant_seeds.front() : state.branches.best().plant_seed;
}

std::optional<BranchRounds> read_branch_rounds(const fs::path& directory, const ParameterTable& table) {
  const fs::path file = directory / kBranchesFile;
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  return branch_rounds_from_json(read_file(file), table, file.string());
}

std::vector<std::string> mend_run_directory(const fs::path& directory, const ParameterTable& table) {
  remove_temporary_files(directory);
  remove_temporary_files(directory / "archive");
  std::vector<std::string> found;
  const fs::path log_file = directory / "evaluations.bin", state_file = directory / kBranchesFile;
  std::error_code error;
  const LogContent log = fs::exists(log_file, error) ? read_evaluation_log(log_file) : LogContent{};
  const std::size_t evaluations = log.evaluations.size();
  if (log.is_damaged)
    found.push_back(fmt::format("{}: evaluation {} is damaged: the run goes on from the {} before it",
                                log_file.string(), evaluations + 1, evaluations));
  std::string reason;
  try {
    const auto state = read_branch_rounds(directory, table);
    if (state && state->search_evaluations > static_cast<long>(evaluations))
      reason = fmt::format("{}: got the state after {} evaluations, of which the log holds {}",
                           state_file.string(), state->search_evaluations, evaluations);
  } catch (const InputError& damage) {
    reason = damage.what();
  }
  if (!reason.empty()) {
    found.push_back(reason + ": the refinement begins anew");
    fs::remove(state_file, error);
  }
  return found;
}

void check_new_directory(const fs::path& directory) {
  std::error_code error;
  const fs::file_status status = fs::status(directory, error);
  if (status.type() == fs::file_type::not_found) return;
  if (status.type() != fs::file_type::directory)
    throw_input_error("{}: got {}, expected a directory to make", directory.string(),
                      error ? error.message() : "a file");
  if (holds_other_files(directory, is_of_a_beginning, error))
    throw_input_error("{}: got a directory with files in it, expected a new one, or to resume the run in it",
                      directory.string());
  if (error)
    throw_input_error("{}: got '{}', expected a directory that can be read", directory.string(),
                      error.message());
}

void check_run_directory(const fs::path& directory) {
  std::error_code error;
  if (!fs::is_directory(directory, error))
    throw_input_error("{}: got no directory, expected that of a run", directory.string());
  for (const auto& entry : fs::recursive_directory_iterator(directory, error))
    if (entry.is_symlink(error))
      throw_input_error("{}: got a link, expected a file of the run", entry.path().string());
  if (!fs::exists(directory / "run.toml", error))
    throw_input_error("{}: got a directory without run.toml, expected that of a run", directory.string());
}

void begin_run_directory(const fs::path& directory, const RunState& state,
                         const std::vector<RunFile>& files) {
  keep_pictures(state.record, directory);
  keep_files(files, directory);
  write_file_atomically(directory / "run.toml", record_to_toml(state.record, std::nullopt));
  for (std::size_t i = 0; i < state.task.views.size(); ++i)
    write_mask_png(numbered(directory, "target", i), state.task.views[i].target.mask());
  write_outlines(directory, state);
}

void write_run_directory(const fs::path& directory, RunState& state) {
  write_best_pictures(directory, state);
  if (state.full_size) write_full_size(directory, *state.full_size);
  write_file_atomically(directory / "best.toml", best_to_toml(state));
  if (!state.branches.copies.empty())
    write_file_atomically(
        directory / kBranchesFile,
        branch_rounds_to_json(stored(state.branches, state.task.model->table()), state.record.model));
  write_history(directory, state);
  write_archive(directory, state);
  if (state.sheet) write_png(directory / "tree.png", *state.sheet);
  write_file_atomically(directory / "summary.json", run_summary(state));
  write_file_atomically(directory / "run.toml", record_to_toml(state.record, outcome_of(state)));
}

}  // namespace espalier
