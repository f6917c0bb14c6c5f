// From the files that an experiment left to the tables of its report, and to its page. Reads files only: a
// report can be made anywhere, at any time, also of an experiment that is still running.
#pragma once
#include <filesystem>
#include <map>
#include <string>

namespace espalier {

struct ReportOptions {
  std::map<std::string, std::string> versions;  ///< of the program and its libraries, for the page
};

/// Replaces `directory`/report: tables as CSV, meta.json, and what experiments/report/report.py draws of
/// them. Returns the page. Throws InputError where the directory is no experiment's, or nothing in it is
/// done.
std::filesystem::path write_report(const std::filesystem::path& directory, const ReportOptions& options = {});

}  // namespace espalier
