#include <algorithm>
#include <array>

#include <espalier/image/pictures/picture_format.h>

namespace espalier {

namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view bytes;
  std::string_view reader;
};

constexpr std::array<Signature, 9> kSignatures{{{"\x89PNG\r\n\x1a\n"sv, "png"},
                                                {"\xff\xd8\xff"sv, "jpeg"},
                                                {"GIF8"sv, "gif"},
                                                {"II*\0"sv, "tiff"},
                                                {"MM\0*"sv, "tiff"},
                                                {"II+\0"sv, "tiff"},  // of 64 bits
                                                {"MM\0+"sv, "tiff"},
                                                {"BM"sv, "bmp"},
                                                {"\x76\x2f\x31\x01"sv, "openexr"}}};

/// ISO 14496-12, §4.3, and the brands of HEIF (ISO 23008-12) and AVIF.
bool is_heif(std::string_view beginning) {
  constexpr std::array kBrands{"heic"sv, "heix"sv, "heim"sv, "heis"sv, "hevc"sv,
                               "hevx"sv, "mif1"sv, "msf1"sv, "avif"sv, "avis"sv};
  return beginning.size() >= 12 && beginning.substr(4, 4) == "ftyp" &&
         std::find(kBrands.begin(), kBrands.end(), beginning.substr(8, 4)) != kBrands.end();
}

bool is_pnm(std::string_view beginning) {
  return beginning.size() > 2 && beginning[0] == 'P' &&
         "123456fF"sv.find(beginning[1]) != std::string_view::npos &&
         "\t\n\r #"sv.find(beginning[2]) != std::string_view::npos;
}

/// Truevision TGA 2.0: kinds of colour maps, of pictures, and bits of a pixel.
bool can_be_tga(std::string_view beginning) {
  constexpr std::string_view kKinds = "\x01\x02\x03\x09\x0a\x0b"sv, kBits = "\x01\x08\x0f\x10\x18\x20"sv;
  return beginning.size() >= 18 && static_cast<unsigned char>(beginning[1]) <= 1 &&
         kKinds.find(beginning[2]) != std::string_view::npos &&
         kBits.find(beginning[16]) != std::string_view::npos;
}

bool is_tga_extension(std::string extension) {
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension == ".tga" || extension == ".tpic";
}

}  // namespace

std::string picture_format(std::string_view beginning, const std::string& extension) {
  for (const Signature& signature : kSignatures)
    if (beginning.starts_with(signature.bytes)) return std::string(signature.reader);
  if (beginning.starts_with("RIFF") && beginning.size() >= 12 && beginning.substr(8).starts_with("WEBP"))
    return "webp";
  if (is_heif(beginning)) return "heif";
  if (is_pnm(beginning)) return "pnm";
  return is_tga_extension(extension) && can_be_tga(beginning) ? "targa" : "";
}

}  // namespace espalier
