#include <charconv>
#include <cmath>

#include <espalier/core/field_error.h>
#include <espalier/fitting/record/option_values.h>
#include <espalier/fitting/record/view_record.h>

namespace espalier {

namespace {

constexpr const char* kField = "views";
constexpr const char* kFormat = "FILE:AZIMUTH,ELEVATION in degrees";

void check_angle(double got_deg, double lower_deg, double upper_deg, const char* what) {
  if (std::isfinite(got_deg) && got_deg >= lower_deg && got_deg <= upper_deg) return;
  throw_field_error(kField, "got {}, expected {} in degrees, {}..{}", got_deg, what, lower_deg, upper_deg);
}

float parse_angle(std::string_view text, const std::string& whole) {
  float value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw_field_error(kField, "got '{}', expected {}", whole, kFormat);
  return value;
}

}  // namespace

ViewRecord parse_view(const std::string& text) {
  const auto colon = text.rfind(':');
  ViewRecord record{text.substr(0, colon), {}};
  if (colon == std::string::npos) return record;
  std::vector<float> angles;
  std::string_view rest = std::string_view(text).substr(colon + 1);
  for (auto comma = rest.find(','); comma != rest.npos; comma = rest.find(',')) {
    angles.push_back(parse_angle(rest.substr(0, comma), text));
    rest.remove_prefix(comma + 1);
  }
  angles.push_back(parse_angle(rest, text));
  if (angles.size() < 2 || angles.size() > 3 || record.picture.empty())
    throw_field_error(kField, "got '{}', expected {}", text, kFormat);
  record.view.azimuth_deg = angles[0];
  record.view.elevation_deg = angles[1];
  if (angles.size() == 3) {
    record.view.projection = Projection::perspective;
    record.view.field_of_view_deg = angles[2];
  }
  check_view(record);
  return record;
}

void check_view(const ViewRecord& view) {
  check_angle(view.view.azimuth_deg, -360, 360, "an azimuth");
  check_angle(view.view.elevation_deg, -90, 90, "an elevation");
  check_angle(view.view.field_of_view_deg, 1, 150, "a field of view");
}

ViewRecord read_view(const TomlSection& section) {
  section.expect_only({"picture", "azimuth_deg", "elevation_deg", "perspective", "field_of_view_deg", "bytes",
                       "hash", "copy"});
  ViewRecord record{section.text("picture"), {}};
  record.view.azimuth_deg = static_cast<float>(section.number("azimuth_deg"));
  record.view.elevation_deg = static_cast<float>(section.number("elevation_deg"));
  record.view.projection = section.flag("perspective") ? Projection::perspective : Projection::orthographic;
  record.view.field_of_view_deg = static_cast<float>(section.number("field_of_view_deg"));
  if (section.has("bytes") || section.has("hash"))
    record.content = FileContent{section.whole("bytes"), section.text("hash")};
  record.kept_as = section.text_or("copy", "");
  with_places([&](const std::string&) { return toml_location(section.source, section.table) + ": views"; },
              [&] { check_view(record); });
  return record;
}

std::string view_to_toml(const ViewRecord& view) {
  const std::string content =
      view.content ? fmt::format("bytes = {}  # of the picture, of which the run keeps a copy\nhash = {}\n",
                                 view.content->bytes, quote_toml(view.content->hash))
                   : "";
  const std::string copy =
      view.kept_as.empty() ? ""
                           : fmt::format("copy = {}  # from here on\n", quote_toml(view.kept_as.string()));
  return fmt::format(
      "\n[[views]]\npicture = {}\nazimuth_deg = {}\nelevation_deg = {}\nperspective = {}\n"
      "field_of_view_deg = {}\n{}{}",
      quote_toml(view.picture.string()), toml_number(view.view.azimuth_deg),
      toml_number(view.view.elevation_deg), view.view.projection == Projection::perspective,
      toml_number(view.view.field_of_view_deg), content, copy);
}

}  // namespace espalier
