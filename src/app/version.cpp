#include <assimp/version.h>
#include <embree3/rtcore_config.h>
#include <fmt/format.h>
#include <spdlog/version.h>
#include <toml++/toml.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <nlopt.hpp>

#include <espalier/app/version.h>
#include <espalier/libm/libm.h>

namespace espalier {

namespace {

std::string dotted(int major, int minor, int patch) { return fmt::format("{}.{}.{}", major, minor, patch); }

}  // namespace

std::string program_version() { return ESPALIER_VERSION; }

std::vector<LibraryVersion> library_versions() {
  return {
      {"Embree", RTC_VERSION_STRING},
      {"OpenImageIO", ESPALIER_OPENIMAGEIO_VERSION},
      {"NLopt", dotted(nlopt::version_major(), nlopt::version_minor(), nlopt::version_bugfix())},
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"SLEEF", sleef_version()},
      {"Assimp", dotted(static_cast<int>(aiGetVersionMajor()), static_cast<int>(aiGetVersionMinor()),
                        static_cast<int>(aiGetVersionPatch()))},
      {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"spdlog", dotted(SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)},
      {"toml++", dotted(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
      {"nlohmann/json",
       dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"CLI11", CLI11_VERSION},
      {"compiler", __VERSION__},
  };
}

std::map<std::string, std::string> recorded_versions() {
  std::map<std::string, std::string> versions{{"espalier", program_version()}, {"commit", build_commit()}};
  for (const LibraryVersion& library : library_versions()) versions[library.name] = library.version;
  return versions;
}

std::string version_text() {
  std::string text = fmt::format("espalier {} (commit {})", program_version(), build_commit());
  for (const LibraryVersion& library : library_versions())
    text += fmt::format("\n  {} {}", library.name, library.version);
  return text;
}

}  // namespace espalier
