// Strings of modules as text, and their buffers.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include <espalier/lsystem/strings/module_string.h>

namespace espalier::lsystem {
namespace {

TEST(ModuleString, IsWrittenWithTheParametersOfEachModule) {
  SymbolTable alphabet;
  ModuleString string;
  const auto add = [&](std::string_view name, std::vector<double> values) {
    string.symbols.push_back(alphabet.intern(name, values.size()));
    string.values.append(values.data(), values.size());
  };
  add("F", {1.25});
  add("?P", {NAN, 1e-12});
  add("A", {});
  add("B", {1.0 / 3, -2e7});
  EXPECT_EQ(to_text(string, alphabet), "F(1.25)?P(*,0)AB(0.333333,-2e+07)");
}

RC_GTEST_PROP(Buffer, HoldsWhatAVectorWouldHold,
              (const std::vector<int>& first, const std::vector<int>& second)) {
  Buffer<int> buffer;
  for (const int value : first) buffer.push_back(value);
  buffer.append(second.data(), second.size());
  buffer.fit();
  std::vector<int> expected = first;
  expected.insert(expected.end(), second.begin(), second.end());
  RC_ASSERT(std::vector<int>(buffer.data(), buffer.data() + buffer.size()) == expected);
  RC_ASSERT(buffer.capacity() == expected.size());
  buffer.truncate(first.size());
  RC_ASSERT(std::vector<int>(buffer.data(), buffer.data() + buffer.size()) == first);
}

}  // namespace
}  // namespace espalier::lsystem
