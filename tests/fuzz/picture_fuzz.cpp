// libFuzzer's target for pictures from strangers: what their first bytes say. With ESPALIER_FUZZ_WHOLE they
// are decoded, too; anything but a picture or one InputError of one line is a find.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <espalier/core/error.h>
#include <espalier/image/pictures/claimed_size.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/pictures/file_chunks.h>
#include <espalier/image/pictures/jpeg_scans.h>
#include <espalier/image/pictures/picture_format.h>

namespace {

void look_at(std::string_view bytes) {
  for (const char* extension : {".png", ".tga"})
    espalier::claimed_size(bytes, espalier::picture_format(bytes, extension));
  for (const char* format : {"png", "jpeg", "gif", "webp", "bmp", "tiff", "openexr", "heif", "pnm", "targa"})
    espalier::claimed_size(bytes, format);
  espalier::is_jpeg_without_end(bytes);
  espalier::count_jpeg_scans(bytes);
  espalier::webp_orientation(bytes);
  espalier::png_palette(bytes);
}

void decode(std::string_view bytes) {
  static const std::string path =
      std::filesystem::temp_directory_path() / ("espalier_fuzz_" + std::to_string(getpid()) + ".tga");
  std::ofstream(path, std::ios::binary) << bytes;
  try {
    espalier::decode_picture(path);
  } catch (const espalier::InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool is_whole = std::getenv("ESPALIER_FUZZ_WHOLE") != nullptr;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  look_at(bytes);
  if (is_whole) decode(bytes);
  return 0;
}
