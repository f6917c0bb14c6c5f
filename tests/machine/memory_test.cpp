// A machine has memory.
#include <gtest/gtest.h>

#include <espalier/machine/memory.h>

namespace espalier {
namespace {

TEST(MachineMemory, IsSome) { EXPECT_GT(machine_memory_bytes(), 64e6); }

}  // namespace
}  // namespace espalier
