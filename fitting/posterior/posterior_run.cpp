#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include <espalier/core/field_error.h>
#include <espalier/core/files.h>
#include <espalier/fitting/posterior/interval_chart.h>
#include <espalier/fitting/posterior/pair_plot.h>
#include <espalier/fitting/posterior/posterior_run.h>
#include <espalier/fitting/posterior/simulations/silhouette_summaries.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/machine/directory_lock.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSimulations = 1'000'000;
constexpr std::size_t kPlotted = 10;

/// Draws with equal weights, a row each.
Eigen::MatrixXd samples_of(const Posterior& posterior, const std::vector<std::size_t>& rows) {
  Eigen::MatrixXd samples(static_cast<Eigen::Index>(rows.size()), posterior.unknowns.cols());
  for (std::size_t i = 0; i < rows.size(); ++i)
    samples.row(static_cast<Eigen::Index>(i)) = posterior.unknowns.row(static_cast<Eigen::Index>(rows[i]));
  return samples;
}

std::string samples_to_csv(const PlantPrior& prior, const ReferenceTable& table, const Posterior& posterior,
                           const std::vector<std::size_t>& rows, const Eigen::MatrixXd& samples) {
  std::string csv = "species";
  for (const Unknown& unknown : unknowns_of(prior)) csv.append(",").append(unknown.name);
  csv += '\n';
  for (std::size_t i = 0; i < rows.size(); ++i) {
    csv += prior.species()[table.species[posterior.draws[rows[i]]]].name;
    for (const double value : samples.row(static_cast<Eigen::Index>(i))) csv += fmt::format(",{:.6g}", value);
    csv += '\n';
  }
  return csv;
}

std::string intervals_to_csv(const std::vector<UnknownSummary>& unknowns) {
  std::string csv = "unknown,unit,median";
  for (const double share : kIntervals) csv += fmt::format(",lower_{0:g},upper_{0:g}", 100 * share);
  csv += ",prior_lower_90,prior_upper_90,width_share,determination\n";
  for (const UnknownSummary& row : unknowns) {
    csv += fmt::format("{},{},{:.6g}", row.unknown.name, row.unknown.unit, row.median);
    for (const auto& [lower, upper] : row.intervals) csv += fmt::format(",{:.6g},{:.6g}", lower, upper);
    csv += fmt::format(",{:.6g},{:.6g},{:.4f},{}\n", row.prior_90.first, row.prior_90.second, row.width_share,
                       name_of(row.determination));
  }
  return csv;
}

/// What the check compares: the picture's summaries beside those of the posterior's plants.
std::string summaries_to_csv(const std::vector<double>& observed, const Eigen::MatrixXd& replicates) {
  std::string csv = "summary,picture,plants_lower_90,plants_upper_90\n";
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const Eigen::VectorXd column = replicates.col(static_cast<Eigen::Index>(i));
    std::vector<double> values(column.begin(), column.end());
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
      return values.empty()
                 ? NAN
                 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    csv += fmt::format("{},{:.6g},{:.6g},{:.6g}\n", summary_names()[i], observed[i], at(0.05), at(0.95));
  }
  return csv;
}

std::string result_to_json(const PosteriorRequest& request, const PosteriorResult& result,
                           std::size_t near_draws) {
  nlohmann::ordered_json json = {{"picture", request.picture},        {"model", request.model},
                                 {"height_m", request.height_m},      {"seed", request.seed},
                                 {"simulations", result.simulations}, {"near_draws", near_draws},
                                 {"version", request.version}};
  if (!request.prior.species.empty()) json["prior"]["species"] = request.prior.species;
  if (!request.prior.free.empty()) json["prior"]["free"] = request.prior.free;
  json["check"] = {{"distance", result.check.distance},
                   {"usual_distance", result.check.usual},
                   {"tail_share", result.check.tail_share},
                   {"near_tail_share", result.check.near_tail_share},
                   {"likely", result.check.is_likely()}};
  for (const SpeciesShare& species : result.species) json["species"][species.species] = species.share;
  for (const UnknownSummary& row : result.unknowns)
    json["unknowns"][row.unknown.name] = {
        {"unit", row.unknown.unit},
        {"median", row.median},
        {"interval_90", {row.intervals.back().first, row.intervals.back().second}},
        {"width_share", row.width_share},
        {"determination", name_of(row.determination)},
        {"at_prior_end", row.is_at_prior_end}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_chart(const PosteriorChart& chart, const fs::path& stem) {
  write_file_atomically(fs::path(stem).replace_extension(".svg"),
                        layout_to_svg(chart.layout, chart.width_px, chart.height_px));
  write_png(fs::path(stem).replace_extension(".png"),
            layout_to_picture(chart.layout, chart.width_px, chart.height_px));
}

/// The table as it is kept, extended to what is asked for; saved now and then.
ReferenceTable extended_table(const PosteriorRequest& request, const PlantPrior& prior, const fs::path& path,
                              int threads, const TableProgress& progress) {
  ReferenceTable table = read_table(path, prior, request.seed, request.height_m);
  const std::size_t step = std::max<std::size_t>(1024, request.simulations / 8);
  bool goes_on = true;
  while (goes_on && table.size() < request.simulations) {
    const std::size_t before = table.size();
    extend_table(
        prior, std::min(request.simulations, before + step), threads,
        [&](std::size_t done, std::size_t) { return goes_on = progress(done, request.simulations); }, table);
    if (table.size() > before) write_table(path, prior, table);
  }
  return table;
}

bool is_picture_of(const fs::path& path, const Mask& mask) {
  const DecodedPicture picture = decode_picture(path);
  if (picture.width_px != mask.width_px() || picture.height_px != mask.height_px()) return false;
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if ((picture.at(x, y)[0] > 0.5F) != mask.get(x, y)) return false;
  return true;
}

/// What would be lost, or fail after all plants were drawn.
void check_places(const fs::path& directory, const fs::path& table, const Mask& silhouette) {
  std::error_code ignored;
  const fs::path earlier = directory / "silhouette.png";
  if (fs::exists(earlier, ignored) && !is_picture_of(earlier, silhouette))
    throw_input_error("{}: got the posterior of another picture, expected a directory of its own",
                      directory.string());
  const fs::path folder = table.parent_path();  // of a table that was named
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    throw_field_error("table", "got '{}', expected a file in a folder that exists", table.string());
}

std::vector<std::string> names_of(const std::vector<UnknownSummary>& unknowns, Determination determination) {
  std::vector<std::string> names;
  for (const std::size_t i : chart_order(unknowns))
    if (unknowns[i].determination == determination && !unknowns[i].unknown.is_quantity)
      names.push_back(unknowns[i].unknown.name);
  return names;
}

/// What a picture at the end of what the prior knows makes of the unknowns; nothing for others.
std::string ends_in_words(const std::vector<UnknownSummary>& unknowns) {
  std::vector<std::string> names;
  for (const std::size_t i : chart_order(unknowns))
    if (unknowns[i].is_at_prior_end) names.push_back(unknowns[i].unknown.name);
  return names.empty()
             ? ""
             : fmt::format("at the end of the prior, so perhaps beyond it: {}\n", fmt::join(names, ", "));
}

}  // namespace

void check_request(const PosteriorRequest& request) {
  if (request.simulations < kLeastTableSize || request.simulations > kMostSimulations)
    throw_field_error("simulations",
                      "got {}, expected {} to {}: fewer draws of the prior have too few near the picture",
                      request.simulations, kLeastTableSize, kMostSimulations);
  if (!(request.height_m >= 0.01 && request.height_m <= 1000))
    throw_field_error("height", "got {:g}, expected 0.01 to 1000 m", request.height_m);
  if (request.samples < 1 || request.samples > kMostSimulations)
    throw_field_error("samples", "got {}, expected 1 to {}", request.samples, kMostSimulations);
}

bool holds_other_things(const fs::path& directory) {
  constexpr std::array kOwn{"table",     "silhouette", "samples", "intervals",
                            "summaries", "parameters", "pairs",   "posterior"};
  std::error_code ignored;
  return holds_other_files(
      directory,
      [&](const fs::path& name) { return std::find(kOwn.begin(), kOwn.end(), name.stem()) != kOwn.end(); },
      ignored);
}

PosteriorResult compute_posterior(const PosteriorRequest& request, const Mask& mask,
                                  const fs::path& directory, int threads, const TableProgress& progress) {
  check_request(request);
  const PlantPrior prior(model_by_name(request.model), request.prior);
  const Mask framed = framed_for_summaries(mask);
  const std::vector<double> observed = summaries_of(framed);
  const fs::path path = request.table.empty() ? directory / "table.bin" : request.table;
  check_places(directory, request.table, framed);
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw_input_error("{}: cannot be made: {}", directory.string(), error.message());
  const DirectoryLock lock(directory);
  remove_temporary_files(directory);
  ReferenceTable table = extended_table(request, prior, path, threads, progress);
  PosteriorResult result{.unknowns = {}, .species = {}, .check = {}, .simulations = table.size()};
  if (table.size() < request.simulations) return result;
  const auto rows_asked = static_cast<Eigen::Index>(request.simulations);  // a kept table may have more
  const PosteriorEstimator estimator(table.unknowns.topRows(rows_asked), table.summaries.topRows(rows_asked),
                                     request.training, threads);
  Posterior posterior = estimator.estimate(observed);
  const Eigen::MatrixXd replicates = replicated_summaries(prior, table, posterior, threads);
  result.check = check_prediction(replicates, table.summaries.topRows(rows_asked), observed);
  result.check.near_tail_share = near_tail_share(table.summaries.topRows(rows_asked), observed);
  if (!result.check.is_likely()) posterior = prior_as_posterior(table.unknowns.topRows(rows_asked));
  result.simulations = request.simulations;
  result.unknowns = summarize(estimator, posterior, unknowns_of(prior));
  result.species = species_shares(prior, table.species, posterior);
  const std::vector<std::size_t> rows = equal_draws(posterior, request.samples);
  const Eigen::MatrixXd samples = samples_of(posterior, rows);
  write_mask_png(directory / "silhouette.png", framed);
  write_file_atomically(directory / "samples.csv", samples_to_csv(prior, table, posterior, rows, samples));
  write_file_atomically(directory / "intervals.csv", intervals_to_csv(result.unknowns));
  write_file_atomically(directory / "summaries.csv", summaries_to_csv(observed, replicates));
  write_chart(draw_intervals(estimator, result.unknowns), directory / "parameters");
  write_chart(draw_pairs(samples, result.unknowns, plotted_unknowns(result.unknowns, kPlotted)),
              directory / "pairs");
  write_file_atomically(directory / "posterior.json",
                        result_to_json(request, result, posterior.draws.size()));
  return result;
}

std::string posterior_in_words(const PosteriorResult& result) {
  std::string text;
  if (!result.check.is_likely())
    text += fmt::format(
        "no plant of the prior makes such a picture: of the plants of its posterior {:.1f} % are as odd, of "
        "those of the "
        "prior {:.1f} % as alone; what follows is the prior\n",
        100 * result.check.tail_share, 100 * result.check.near_tail_share);
  for (const UnknownSummary& row : result.unknowns)
    if (row.unknown.is_quantity)
      text += fmt::format("{:<13} {:<32} {}\n", row.unknown.name, interval_in_words(row),
                          name_of(row.determination));
  text += ends_in_words(result.unknowns);
  std::vector<std::string> species;
  for (const SpeciesShare& share : result.species)
    if (species.size() < 3) species.push_back(fmt::format("{} {:.0f} %", share.species, 100 * share.share));
  text += fmt::format("near species: {}\n", fmt::join(species, ", "));
  const auto determined = names_of(result.unknowns, Determination::determined),
             partly = names_of(result.unknowns, Determination::partly),
             open = names_of(result.unknowns, Determination::open);
  text +=
      fmt::format("parameters: {} determined{}{}, {} partly, {} open\n", determined.size(),
                  determined.empty() ? "" : ": ", fmt::join(determined, ", "), partly.size(), open.size());
  return text;
}

}  // namespace espalier
