#include <fmt/format.h>
#include <hwy/targets.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include <espalier/app/bench/bench_report.h>
#include <espalier/app/version.h>
#include <espalier/core/error.h>
#include <espalier/core/files.h>

namespace espalier {

namespace {

using Json = nlohmann::ordered_json;

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

/// The best that this processor has and the program was compiled for.
std::string instruction_set() {
  const std::int64_t targets = hwy::SupportedTargets();
  return hwy::TargetName(targets & -targets);
}

std::string name_of(const BenchCase& of) {
  return fmt::format("{}/{}/{}", of.species, of.size_px, of.leaves ? "leaves" : "bare");
}

Json to_json(const BenchResult& r) {
  return {{"species", r.of.species},
          {"size_px", r.of.size_px},
          {"leaves", r.of.leaves},
          {"evaluations_per_second", r.per_second},
          {"evaluations_per_second_all_threads", r.per_second_all_threads},
          {"grow_s", r.grow_s},
          {"draw_s", r.draw_s},
          {"compare_s", r.compare_s},
          {"mean_stems", r.stems},
          {"mean_leaves", r.leaf_count},
          {"bytes_per_thread", r.bytes_per_thread},
          {"embree_differing_pixels", r.differing_px},
          {"set_pixels", r.set_px}};
}

}  // namespace

std::string bench_table_head(int threads) {
  return fmt::format("{:28} {:>9} {:>9} {:>8} {:>8} {:>8} {:>9} {:>9}\n", "species/size/leaves", "1 thread",
                     fmt::format("{} thr.", threads), "grow", "draw", "compare", "memory", "differ") +
         fmt::format("{:28} {:>9} {:>9} {:>8} {:>8} {:>8} {:>9} {:>9}\n", "", "1/s", "1/s", "ms", "ms", "ms",
                     "MB/thread", "% of px");
}

std::string bench_table_row(const BenchResult& r) {
  const double differ =
      100.0 * static_cast<double>(r.differing_px) / std::max<double>(1, static_cast<double>(r.set_px));
  return fmt::format("{:28} {:9.0f} {:9.0f} {:8.3f} {:8.3f} {:8.4f} {:9.2f} {:9.3f}\n", name_of(r.of),
                     r.per_second, r.per_second_all_threads, 1e3 * r.grow_s, 1e3 * r.draw_s,
                     1e3 * r.compare_s, static_cast<double>(r.bytes_per_thread) / 1e6, differ);
}

std::string bench_scaling_line(const std::vector<ScalingSeries>& scaling) {
  std::string line = "time of the aspen grows with";
  for (const ScalingSeries& series : scaling)
    line += fmt::format("{} {}^{:.2f}", &series == scaling.data() ? "" : ",", series.quantity,
                        scaling_exponent(series));
  return line + "\n";
}

std::string bench_to_json(const std::vector<BenchResult>& results, const std::vector<ScalingSeries>& scaling,
                          int threads) {
  Json libraries;
  for (const LibraryVersion& library : library_versions()) libraries[library.name] = library.version;
  Json report = {{"machine",
                  {{"processor", processor_name()},
                   {"threads", threads},
                   {"instruction_set", instruction_set()},
                   {"espalier", program_version()},
                   {"commit", build_commit()},
                   {"libraries", libraries}}},
                 {"cases", Json::array()},
                 {"scaling", Json::array()}};
  for (const BenchResult& result : results) report["cases"].push_back(to_json(result));
  for (const ScalingSeries& series : scaling)
    report["scaling"].push_back(
        {{"quantity", series.quantity}, {"exponent", scaling_exponent(series)}, {"points", series.points}});
  return report.dump(2) + "\n";
}

std::vector<OldBench> read_bench_json(const std::filesystem::path& path) {
  constexpr std::uintmax_t kMostBytes = 4 << 20;
  const std::string text = read_file(path, kMostBytes);
  try {
    const Json report = Json::parse(text);
    std::vector<OldBench> old;
    for (const Json& c : report.at("cases"))
      old.push_back({{c.at("species"), c.at("size_px"), c.at("leaves"), {}},
                     c.at("evaluations_per_second"),
                     c.at("evaluations_per_second_all_threads")});
    return old;
  } catch (const Json::exception&) {
    throw_input_error("{}: got something else, expected a report of espalier bench --json", path.string());
  }
}

std::string bench_ratios(const std::vector<BenchResult>& results, const std::vector<OldBench>& old) {
  std::string text = fmt::format("{:28} {:>9} {:>9}\n", "new / old", "1 thread", "all");
  double log_sum = 0;
  int count = 0;
  for (const BenchResult& r : results)
    for (const OldBench& o : old) {
      if (name_of(r.of) != name_of(o.of) || !(o.per_second > 0) || !(o.per_second_all_threads > 0)) continue;
      text += fmt::format("{:28} {:9.2f} {:9.2f}\n", name_of(r.of), r.per_second / o.per_second,
                          r.per_second_all_threads / o.per_second_all_threads);
      log_sum += std::log(r.per_second / o.per_second);
      ++count;
    }
  if (count == 0) return "no case is in both reports\n";
  return text + fmt::format("{:28} {:9.2f}\n", "geometric mean", std::exp(log_sum / count));
}

}  // namespace espalier
