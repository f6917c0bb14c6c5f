// How a run notices that its record, or a file that it keeps, is not as it was written: by a disk, a copy cut
// off, a hand.
#pragma once
#include <filesystem>
#include <map>
#include <string>

namespace espalier {

inline constexpr const char* kCheckKey = "check";

/// `head` and `rest` with the line `check = "…"` between, which holds the hash of both.
std::string with_check(const std::string& head, const std::string& rest);

/// Throws InputError where the text has such a line, and is not what it was made of. Whoever changes a record
/// on purpose takes the line out; records of earlier versions have none.
void verify_check(const std::string& text, const std::string& source);

/// Names from `directory` on, and hashes. Throws InputError for a file that is not there, or another one.
void verify_files(const std::map<std::string, std::string>& files, const std::filesystem::path& directory);

}  // namespace espalier
