// A fit reads each picture once at each size, whatever its stages ask of the reading. The linker puts the
// counter below in the place of read_picture for this test program (tests/CMakeLists.txt).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>

#include <espalier/fitting/picture/picture_reading.h>
#include <espalier/fitting/run/fit.h>

#include "support/temporary_folders.h"

namespace espalier {

PictureReading read_picture_itself(const Mask& mask) asm("__real__ZN8espalier12read_pictureERKNS_4MaskE");
PictureReading count_and_read(const Mask& mask) asm("__wrap__ZN8espalier12read_pictureERKNS_4MaskE");

namespace {

namespace fs = std::filesystem;

std::mutex mutex;
std::vector<Mask> masks_read;

}  // namespace

PictureReading count_and_read(const Mask& mask) {
  const std::lock_guard lock(mutex);
  masks_read.push_back(mask);
  return read_picture_itself(mask);
}

namespace {

/// How many masks of each size were read by the fit.
std::map<int, int> readings_of(const FitRecord& record, const std::string& name) {
  masks_read.clear();
  fit(record, fresh_folder(name) / "run");
  std::map<int, int> count;
  for (const Mask& mask : masks_read) ++count[mask.width_px()];
  return count;
}

FitRecord record_of_picture(const std::string& kind_of_picture) {
  FitRecord record;
  record.views = {{fs::path(ESPALIER_SOURCE_DIR) / "targets" / kind_of_picture, {}}};
  record.target.size_px = 32;
  record.budget = {40, 0, 0, 2};
  record.growth = {100, 300};
  record.kind = KindChoice::automatic;
  return record;
}

TEST(Readings, APictureIsReadOnceAtEachSize) {
  for (const char* picture : {"tr_birch.png", "tr_crookedtree4.png", "oc_palm.png"})
    for (const bool trained : {false, true}) {
      SCOPED_TRACE(picture);
      FitRecord record = record_of_picture(picture);
      record.train_to_target = trained;
      const std::map<int, int> readings = readings_of(record, "readings");
      EXPECT_TRUE(readings.contains(32));
      EXPECT_GE(readings.size(), 2u);  // stages look at larger masks too
      for (const auto& [size_px, count] : readings) EXPECT_EQ(count, 1) << size_px << " px";
    }
}

TEST(Readings, EachOfTwoViewsIsReadOnceAtEachSize) {
  FitRecord record = record_of_picture("tr_birch.png");
  record.views.push_back({fs::path(ESPALIER_SOURCE_DIR) / "targets/fir.png", {90, 0}});
  for (const auto& [size_px, count] : readings_of(record, "readings_two"))
    EXPECT_EQ(count, 2) << size_px << " px";
}

}  // namespace
}  // namespace espalier
