// What a Lua state uses, in the measure of its instructions. One instruction may do more than another: what
// it allocates is charged by size, and where strings are long, each instruction as if it read the longest one
// (to concatenate it, compare it or read a number from it). Our own functions charge what they do.
#pragma once
#include <cstddef>
#include <string_view>

#include <espalier/lsystem/strings/limits.h>

struct lua_State;

namespace espalier::lsystem {

struct LuaUsage {
  Limits limits;
  std::size_t bytes = 0;
  double instructions = 0;
  bool sealed = false;
  bool is_running = false;          ///< inside of a protected call: errors may be raised
  bool is_loading = false;          ///< code is read, not run
  bool is_ending = false;           ///< an error of ours is on its way, and needs some memory
  double literal_instructions = 0;  ///< more for each instruction, for the longest string in the code
  std::size_t buffer_bytes = 0;     ///< what strings are put together in, now
  std::size_t longest_buffer = 0;   ///< and at most, since instructions were counted anew
  std::size_t largest_block = 0;    ///< of a table or a string, since then

  bool is_over() const { return instructions > limits.lua_instructions; }
};

/// An allocator (lua_Alloc) that counts, and refuses what goes beyond the limits; its data is a LuaUsage.
void* allocate_lua(void* usage, void* block, std::size_t old_size, std::size_t new_size);

LuaUsage& usage_of(lua_State* state);

/// Raises a Lua error where it is too much.
void charge_lua(lua_State* state, double instructions);
/// Charges these instructions, which were just run.
void charge_instructions(lua_State* state, int count);
/// For reading a string on the stack from end to end; anything else costs nothing.
void charge_string(lua_State* state, int index);
/// For a string of this length that will be made. Raises an error where it is too long.
void charge_new_string(lua_State* state, std::size_t length);

/// How many more instructions one may count for that uses the longest string in the code.
double literal_instructions(std::string_view code);

}  // namespace espalier::lsystem
