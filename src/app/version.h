// What this program was built from: its version, its commit, its libraries. Run records hold them.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace espalier {

struct LibraryVersion {
  std::string name, version;
};

/// "0.2.0", from CMakeLists.txt.
std::string program_version();

/// The commit the program was built from: twelve hexadecimal digits, "-dirty" where files differed from
/// it; "unknown" outside a git checkout. Generated when the program is built, by cmake/commit.cmake.
std::string build_commit();

std::vector<LibraryVersion> library_versions();

/// All of these by name, as run records hold them.
std::map<std::string, std::string> recorded_versions();

/// What `espalier --version` prints: several lines, without the last line feed.
std::string version_text();

}  // namespace espalier
