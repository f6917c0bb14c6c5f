#include <espalier/core/error.h>
#include <espalier/environment/picture_envelope.h>
#include <espalier/image/reading/read_target.h>
#include <espalier/models/grown_into.h>

namespace espalier {

namespace {

double positive(const TomlSection& section, const char* key) {
  const double number = section.number(key);
  if (!(number > 0 && number < 1e6)) section.fail(key, "a positive number");
  return number;
}

GrownInto read_one(const TomlSection& section, const std::filesystem::path& folder) {
  section.expect_only({"outline", "metres_per_px", "base_row_px", "azimuth_deg", "elevation_deg",
                       "perspective", "field_of_view_deg"});
  GrownInto picture;
  picture.outline = folder / section.text("outline");
  picture.metres_per_px = static_cast<float>(positive(section, "metres_per_px"));
  picture.base_row_px = static_cast<float>(positive(section, "base_row_px"));
  picture.view.azimuth_deg = static_cast<float>(section.number_or("azimuth_deg", 0));
  picture.view.elevation_deg = static_cast<float>(section.number_or("elevation_deg", 0));
  if (section.has("perspective") && section.flag("perspective"))
    picture.view.projection = Projection::perspective;
  picture.view.field_of_view_deg = static_cast<float>(section.number_or("field_of_view_deg", 40));
  return picture;
}

}  // namespace

std::vector<GrownInto> read_grown_into(const TomlSection& preset, const std::filesystem::path& folder) {
  std::vector<GrownInto> pictures;
  for (const TomlSection& section : preset.sections(kGrownIntoKey))
    pictures.push_back(read_one(section, folder));
  return pictures;
}

std::string grown_into_to_toml(const std::vector<GrownInto>& pictures) {
  std::string text;
  for (const GrownInto& picture : pictures)
    text += fmt::format(
        "\n[[{}]]\noutline = {}\nmetres_per_px = {}\nbase_row_px = {}\nazimuth_deg = {}\nelevation_deg = {}\n"
        "perspective = {}\nfield_of_view_deg = {}\n",
        kGrownIntoKey, quote_toml(picture.outline.filename().string()), picture.metres_per_px,
        picture.base_row_px, picture.view.azimuth_deg, picture.view.elevation_deg,
        picture.view.projection == Projection::perspective, picture.view.field_of_view_deg);
  return text;
}

std::unique_ptr<Volume> envelope_of(const std::vector<GrownInto>& pictures) {
  std::vector<PictureOutline> outlines;
  for (const GrownInto& picture : pictures) {
    const Mask mask = read_mask(picture.outline, {}).mask;
    outlines.push_back({frame_base({0, 0, 0}, picture.view, picture.metres_per_px, mask.width_px(),
                                   mask.height_px(), picture.base_row_px),
                        mask});
  }
  return outlines.empty() ? nullptr : make_picture_envelope(outlines);
}

}  // namespace espalier
