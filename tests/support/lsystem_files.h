// L-systems written for a test.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <espalier/models/models.h>

namespace espalier {

/// The model of an L-system with this text, in a file of its own that is called `name`.
inline const Model& lsystem_model_of(const std::string& name, const std::string& text) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "espalier_lsystems";
  std::filesystem::create_directories(folder);
  const std::filesystem::path path = folder / name;
  std::ofstream(path) << text;
  return model_by_name(path.string());
}

}  // namespace espalier
