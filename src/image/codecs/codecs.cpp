#include <dlfcn.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/image/codecs/codecs.h>

/// Of image/openimageio: null where that room is not linked.
extern "C" const espalier::PictureCodecs* espalier_openimageio_codecs() __attribute__((weak));

namespace espalier {

namespace {

namespace fs = std::filesystem;

constexpr const char* kModule = "espalier_openimageio.so";
constexpr const char* kEntry = "espalier_openimageio_codecs";

/// Beside a program in bin/, wherever that was moved to; where Espalier was installed; where it was built.
std::vector<fs::path> module_places() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  return {program.parent_path().parent_path() / ESPALIER_MODULE_FOLDER / kModule,
          fs::path(ESPALIER_INSTALLED_MODULE_FOLDER) / kModule,
          fs::path(ESPALIER_BUILT_MODULE_FOLDER) / kModule};
}

void* load_module() {
  std::vector<std::string> looked;
  for (const fs::path& place : module_places()) {
    std::error_code none;
    looked.push_back(place.string());
    if (!fs::exists(place, none)) continue;
    if (void* module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL)) return module;
    throw InternalError(fmt::format("{}: cannot be loaded ({})", place.string(), dlerror()));
  }
  throw InternalError(
      fmt::format("got no module '{}', which reads and writes pictures, expected it at one of {}", kModule,
                  fmt::join(looked, ", ")));
}

const PictureCodecs& find_codecs() {
  if (espalier_openimageio_codecs) return *espalier_openimageio_codecs();
  void* entry = dlsym(load_module(), kEntry);  // the module stays loaded
  if (!entry) throw InternalError(fmt::format("the module '{}' is of another version of Espalier", kModule));
  return *reinterpret_cast<const PictureCodecs* (*)()>(entry)();
}

}  // namespace

const PictureCodecs& picture_codecs() {
  static const PictureCodecs& codecs = find_codecs();
  return codecs;
}

std::shared_mutex& picture_codecs_in_use() {
  static std::shared_mutex in_use;
  return in_use;
}

}  // namespace espalier
