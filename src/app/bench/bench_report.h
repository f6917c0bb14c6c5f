// The results of `espalier bench` as text and as JSON, and their ratios to older ones.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <espalier/app/bench/bench_cases.h>
#include <espalier/app/bench/bench_scaling.h>

namespace espalier {

std::string bench_table_head(int threads);
std::string bench_table_row(const BenchResult& result);

/// The report also describes the machine: processor, threads, instruction set, versions.
std::string bench_to_json(const std::vector<BenchResult>& results, const std::vector<ScalingSeries>& scaling,
                          int threads);

/// The exponents in a line.
std::string bench_scaling_line(const std::vector<ScalingSeries>& scaling);

/// Evaluations per second of a case in an older report.
struct OldBench {
  BenchCase of;
  double per_second = 0, per_second_all_threads = 0;
};

/// Throws InputError where the file is no report.
std::vector<OldBench> read_bench_json(const std::filesystem::path& path);

/// Ratios new to old of the cases that are in both.
std::string bench_ratios(const std::vector<BenchResult>& results, const std::vector<OldBench>& old);

}  // namespace espalier
