// Folders for what tests write, and what stands in their files.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace espalier {

inline std::string read_text_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Folders that vanish when the program ends, unless a test failed: then they are there to be looked at.
class TemporaryFolders {
 public:
  ~TemporaryFolders() {
    std::error_code ignored;
    if (testing::UnitTest::GetInstance()->Passed())
      for (const auto& folder : folders_) std::filesystem::remove_all(folder, ignored);
  }
  void add(const std::filesystem::path& folder) { folders_.push_back(folder); }

 private:
  std::vector<std::filesystem::path> folders_;
};

/// A folder of this test process alone, made empty.
inline std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("espalier_" + std::to_string(getpid()) + "_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  static TemporaryFolders made;
  made.add(folder);
  return folder;
}

}  // namespace espalier
