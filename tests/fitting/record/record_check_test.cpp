// A record that is not as it was written is noticed, and can be changed on purpose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/core/error.h>
#include <espalier/core/text/text_hash.h>
#include <espalier/fitting/record/record_check.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kRecord = with_check("format = 1\n", "seed = 7\nmodel = \"weber_penn\"\n");

TEST(RecordCheck, HoldsForWhatWasWritten) { EXPECT_NO_THROW(verify_check(kRecord, "run.toml")); }

TEST(RecordCheck, NoticesEachOtherBitButOfItsOwnLine) {
  const std::size_t own = kRecord.find("check"), own_end = kRecord.find('\n', own);
  for (std::size_t bit = 0; bit < 8 * kRecord.size(); ++bit) {
    if (bit / 8 + 1 >= own && bit / 8 <= own_end) continue;
    std::string other = kRecord;
    other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << bit % 8));
    EXPECT_THROW(verify_check(other, "run.toml"), InputError) << bit;
  }
}

TEST(RecordCheck, SaysHowToChangeARecordOnPurpose) {
  std::string other = kRecord;
  other.replace(other.find("seed = 7"), 8, "seed = 8");
  EXPECT_THAT([&] { verify_check(other, "run.toml"); },
              ThrowsMessage<InputError>(HasSubstr("run.toml:2: check: got a record that was changed since")));
  const std::size_t line = other.find("check");
  other.erase(line, other.find('\n', line) + 1 - line);
  EXPECT_NO_THROW(verify_check(other, "run.toml"));
}

TEST(RecordCheck, FilesAreThoseOfTheRecord) {
  const fs::path folder = fresh_folder("record_files");
  fs::create_directory(folder / "model");
  std::ofstream(folder / "model/fern.lsys") << "F";
  verify_files({{"model/fern.lsys", text_hash("F")}}, folder);
  EXPECT_THAT(
      [&] {
        verify_files({{"model/fern.lsys", text_hash("f")}}, folder);
      },
      ThrowsMessage<InputError>(HasSubstr("fern.lsys: got a file that was changed since the run")));
  for (const char* name : {"model/oak.lsys", "model", "../record_files/model/fern.lsys"})
    EXPECT_THROW(verify_files({{name, text_hash("F")}}, folder), InputError) << name;
  EXPECT_THROW(verify_files({{folder / "model/fern.lsys", text_hash("F")}}, folder), InputError);
}

}  // namespace
}  // namespace espalier
