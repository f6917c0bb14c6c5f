// Laws of reading TOML: what cannot be read is one clear line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <fstream>

#include <espalier/core/error.h>
#include <espalier/core/toml/toml_file.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// A file in the test's own folder, written anew.
fs::path write_file(const std::string& name, const std::string& content) {
  const fs::path path = fs::path(testing::TempDir()) / ("toml_file_test_" + name);
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

std::string reading_error(const fs::path& path) {
  try {
    parse_toml(read_toml_text(path), path.string());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TomlFile, AMissingFileIsNamed) {
  EXPECT_EQ(reading_error("/no/such.toml"), "/no/such.toml: no such file");
}

TEST(TomlFile, ADirectoryIsNoFile) {
  EXPECT_THAT(reading_error(testing::TempDir()), testing::HasSubstr("got a directory"));
}

TEST(TomlFile, ADeviceIsNoFile) {
  EXPECT_THAT(reading_error("/dev/zero"), testing::HasSubstr("got no regular file"));
}

TEST(TomlFile, AnEmptyFileIsRefused) {
  EXPECT_THAT(reading_error(write_file("empty", "")), testing::HasSubstr("got an empty file"));
}

TEST(TomlFile, ABinaryFileIsRefused) {
  EXPECT_THAT(reading_error(write_file("binary", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16))),
              testing::HasSubstr("got a binary file"));
}

TEST(TomlFile, AHugeFileIsRefused) {
  EXPECT_EQ(reading_error(write_file("full", std::string(kMaxTomlBytes, '\n'))), "");
  EXPECT_THAT(reading_error(write_file("huge", std::string(kMaxTomlBytes + 1, '\n'))),
              testing::HasSubstr("got more than 1000000 bytes"));
}

TEST(TomlFile, BadSyntaxNamesFileAndLine) {
  const fs::path path = write_file("syntax", "a = 1\nb = [1, \n");
  EXPECT_THAT(reading_error(path), testing::HasSubstr(path.string() + ":2: got bad TOML"));
}

TEST(TomlFile, ADuplicateKeyIsBadSyntax) {
  const fs::path path = write_file("duplicate", "a = 1\na = 2\n");
  EXPECT_THAT(reading_error(path), testing::HasSubstr(path.string() + ":2: got bad TOML"));
}

TEST(TomlFile, AnyBytesAreReadOrRefusedInOneLine) {
  EXPECT_TRUE(rc::check([] {
    const auto text = *rc::gen::container<std::string>(rc::gen::arbitrary<char>());
    try {
      parse_toml(text, "bytes");
    } catch (const InputError& error) {
      RC_ASSERT(std::string(error.what()).find('\n') == std::string::npos);
    }
  }));
}

TEST(TomlFile, QuotedTextReadsBackToItself) {
  EXPECT_TRUE(rc::check([] {
    const auto text = *rc::gen::container<std::string>(rc::gen::inRange<char>(1, 127)) + '\x7f';
    const toml::table table = parse_toml("text = " + quote_toml(text), "quoted");
    RC_ASSERT(table["text"].value<std::string>() == text);
  }));
}

TEST(TomlFile, QuotedBytesThatAreNoUtf8AreReadAsTheyAreShown) {
  const toml::table table = parse_toml("text = " + quote_toml("a\xff\\.png"), "quoted");
  EXPECT_EQ(table["text"].value<std::string>(), "a\\xff\\.png");
}

}  // namespace
}  // namespace espalier
