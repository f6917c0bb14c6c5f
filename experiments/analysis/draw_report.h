// Hands the tables of a report to experiments/report/report.py, which draws them with Matplotlib.
#pragma once
#include <filesystem>

namespace espalier {

/// Prints one line that says what to install where there is no Python. Throws InternalError where the script
/// fails.
void draw_report(const std::filesystem::path& report_directory);

}  // namespace espalier
