// Laws of the commands mask and render, run as a user runs them: files, exit codes, one line of error.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>

#include <espalier/image/pictures/picture.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/camera.h>
#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/silhouette.h>

#include "support/object_files.h"
#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

class RenderCommand : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() /
                 (std::string("espalier_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
                  std::to_string(getpid()));
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  fs::path path(const std::string& name) const { return directory_ / name; }

  /// Exit code 2, one line on stderr that holds `text`, and no picture.
  void expect_refused(const std::string& arguments, const std::string& text) const {
    SCOPED_TRACE(arguments);
    const ProgramRun run = run_espalier(arguments + " -o '" + path("x.png").string() + "'");
    expect_one_clear_error(run);
    EXPECT_NE(run.err.find(text), std::string::npos) << run.err;
    EXPECT_FALSE(fs::exists(path("x.png")));
  }

 private:
  fs::path directory_;
};

/// Width and height in the header of a PNG, which follow 16 bytes of signature and chunk.
std::pair<int, int> png_size(const std::string& bytes) {
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(i));
    return value;
  };
  return {number(16), number(20)};
}

TEST_F(RenderCommand, BackgroundsAndSunAreAsToldAndGroundThatCannotBeSeenIsSaid) {
  const std::string render = "render palm --size 32 --samples 2 -o '" + path("x.png").string() + "' ";
  const auto drawn = [&](const std::string& options) {
    EXPECT_EQ(run_espalier(render + options).exit_code, 0) << options;
    return read_text_file(path("x.png"));
  };
  constexpr std::size_t kColorType = 25;  // of a PNG's header: 6 has alpha
  EXPECT_EQ(drawn("--background transparent").at(kColorType), 6);
  EXPECT_EQ(drawn("--background white").at(kColorType), 2);
  EXPECT_NE(drawn("--background white"), drawn(""));
  EXPECT_NE(drawn("--sun 60,20"), drawn(""));
  EXPECT_EQ(drawn("--sun -50,42"), drawn(""));
  EXPECT_NE(run_espalier(render + "--ground").err.find("--ground has no effect: "), std::string::npos);
  EXPECT_EQ(run_espalier(render + "--ground --elevation 10").err, "");
  EXPECT_EQ(run_espalier(render + "--ground --perspective").err, "");
  fs::remove(path("x.png"));
  expect_refused("render palm --background pink",
                 "--background: got 'pink', expected sky, white or transparent");
  expect_refused("render palm --sun 10,-5", "--sun: got '10,-5', expected azimuth,elevation");
  expect_refused("render palm --sun noon", "--sun: got 'noon'");
}

TEST_F(RenderCommand, MaskWritesWhatTheRendererDraws) {
  ASSERT_EQ(run_espalier("mask palm --seed 3 --size 96x128 -o '" + path("x.png").string() + "'").exit_code,
            0);
  const Preset preset = load_preset("palm");
  Plant plant;
  ASSERT_TRUE(model_by_name(preset.model).generate(preset.values, 3, {}, plant).grown);
  Mask mask;
  make_embree_renderer()->draw(plant, frame_bounds(bounds(plant), {}, 96, 128), mask);
  write_mask_png(path("expected.png"), mask);
  EXPECT_EQ(read_text_file(path("x.png")), read_text_file(path("expected.png")));
}

TEST_F(RenderCommand, TheSeedAndTheViewChangeTheMask) {
  const auto mask_of = [&](const std::string& options) {
    EXPECT_EQ(run_espalier("mask palm --size 96 -o '" + path("x.png").string() + "' " + options).exit_code,
              0);
    return read_text_file(path("x.png"));
  };
  const std::string front = mask_of("--seed 1");
  EXPECT_EQ(mask_of("--seed 1"), front);
  EXPECT_NE(mask_of("--seed 2"), front);
  EXPECT_NE(mask_of("--seed 1 --view 90,0"), front);
  EXPECT_EQ(mask_of("--seed 1 --view 90,20"), mask_of("--seed 1 --azimuth 90 --elevation 20"));
  EXPECT_NE(mask_of("--seed 1 --perspective"), front);
}

TEST_F(RenderCommand, RenderWritesAPictureOfTheStatedSize) {
  const ProgramRun run =
      run_espalier("render palm --seed 1 --size 80x60 --samples 2 --view 30,10 --ground -o '" +
                   path("x.png").string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(png_size(read_text_file(path("x.png"))), (std::pair{80, 60}));
}

TEST_F(RenderCommand, ObjectsAndSeasonsChangeThePicture) {
  write_box_obj(path("wall.obj"), {1, -1, 0}, {3, 1, 9});
  const auto picture_of = [&](const std::string& options) {
    EXPECT_EQ(run_espalier("render palm --size 48 --samples 2 -o '" + path("x.png").string() + "' " + options)
                  .exit_code,
              0);
    return read_text_file(path("x.png"));
  };
  const std::string alone = picture_of("");
  EXPECT_EQ(picture_of("--season summer"), alone);
  EXPECT_NE(picture_of("--season winter"), alone);
  EXPECT_NE(picture_of("--object 'mesh:" + path("wall.obj").string() + "'"), alone);
}

TEST_F(RenderCommand, BadObjectsAndSeasonsAreRefused) {
  write_box_obj(path("open.obj"), {1, -1, 0}, {3, 1, 9}, false);
  const std::string open = "mesh:" + path("open.obj").string();
  expect_refused("render palm --object mesh:none.obj", "--object: got 'mesh:none.obj'");
  expect_refused("render palm --object ball:0,0,0,1", "expected mesh:FILE");
  expect_refused("render palm --object '" + open + "'", "3 of 18 edges are open");
  expect_refused("render palm --season monsoon", "--season: got 'monsoon', expected one of: summer");
}

TEST_F(RenderCommand, AnUnknownSpeciesIsRefusedWithTheClosestName) {
  expect_refused("mask quaking_aspn --seed 1", "quaking_aspen");
  expect_refused("render quaking_aspn --seed 1", "quaking_aspen");
}

TEST_F(RenderCommand, BadSizesAreRefused) {
  for (const char* size :
       {"0", "5000", "-3", "abc", "10x", "x10", "10x0", "4097x10", "1e3", "10x10x10", "nan"})
    expect_refused(std::string("mask palm --size=") + size, size);
}

TEST_F(RenderCommand, BadViewsAreRefused) {
  expect_refused("mask palm --view=abc", "abc");
  expect_refused("mask palm --view=0,100", "100");
  expect_refused("mask palm --view=nan,0", "nan");
  expect_refused("mask palm --elevation=-91", "-91");
  expect_refused("mask palm --azimuth=inf", "inf");
  expect_refused("mask palm --perspective --field-of-view=0", "--field-of-view");
}

TEST_F(RenderCommand, BadSamplesAreRefused) {
  expect_refused("render palm --samples=0", "0");
  expect_refused("render palm --samples=100000", "100000");
}

TEST_F(RenderCommand, OutputsThatCannotBeWrittenAreRefusedBeforeAnyWork) {
  for (const std::string output : {"/nonexistent/x.png", "/proc/x.png", "x.jpg", "."}) {
    SCOPED_TRACE(output);
    const ProgramRun run = run_espalier("mask weeping_willow -o '" + output + "'");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.err.find(output), std::string::npos) << run.err;
  }
}

TEST_F(RenderCommand, PlantsOverTheBudgetAreRefused) {
  expect_refused("mask quaking_aspen --set 'branches[1]=500' --set 'branches[2]=500' --set 'branches[3]=500'",
                 "times as many");
}

}  // namespace
}  // namespace espalier
