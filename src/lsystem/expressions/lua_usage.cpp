#include <algorithm>
#include <bit>
#include <cstdlib>
#include <lua.hpp>

#include <espalier/lsystem/expressions/lua_usage.h>

namespace espalier::lsystem {

namespace {

constexpr std::size_t kLongestString = 1 << 20;
constexpr double kAllocation = 32, kAllocatedPerInstruction = 4;
// A string is copied and compared fast, and read as a number slowly.
constexpr double kBytesPerInstruction = 32, kDigitsPerInstruction = 4;
constexpr std::size_t kLargeTable = 256 << 10;
constexpr double kOutOfCaches = 3;

/// LuaJIT puts strings together in one buffer, whose size is doubled until they fit; nothing else grows from
/// one power of two to another (parts of tables have room for one more).
bool is_buffer(std::size_t old_size, std::size_t new_size) {
  return old_size >= 32 && std::has_single_bit(old_size) && std::has_single_bit(new_size);
}

/// The end of the long bracket that opens at `i`, "[[" or "[=[" …; `i` where none does.
std::size_t long_bracket_end(std::string_view code, std::size_t i) {
  std::size_t level = i + 1;
  while (level < code.size() && code[level] == '=') ++level;
  if (code[i] != '[' || level >= code.size() || code[level] != '[') return i;
  const std::string close = fmt::format("]{:=<{}}]", "", level - i - 1);
  const std::size_t end = code.find(close, level + 1);
  return end == std::string_view::npos ? code.size() : end + close.size();
}

/// Whether Lua's code runs, rather than a function of ours that it has called.
bool is_in_lua(lua_State* state) {
  lua_Debug where;
  return lua_getstack(state, 0, &where) != 0 && lua_getinfo(state, "S", &where) != 0 && *where.what != 'C';
}

std::size_t quoted_end(std::string_view code, std::size_t i) {
  const char quote = code[i++];
  while (i < code.size() && code[i] != quote) i += code[i] == '\\' ? 2 : 1;
  return std::min(i + 1, code.size());
}

/// What an instruction on the string may take, which stands in its quotes.
double reading_of(std::string_view literal) {
  const bool may_be_number =
      literal.find_first_not_of("0123456789abcdefABCDEFxXpP.+- \t\r\n\\\"'[]=z") == std::string_view::npos;
  return static_cast<double>(literal.size()) / (may_be_number ? kDigitsPerInstruction : kBytesPerInstruction);
}

std::size_t comment_end(std::string_view code, std::size_t i) {
  const std::size_t begin = i + 2;
  if (begin < code.size() && long_bracket_end(code, begin) > begin) return long_bracket_end(code, begin);
  return std::min(code.find('\n', begin), code.size());
}

}  // namespace

double literal_instructions(std::string_view code) {
  double most = 0;
  for (std::size_t i = 0; i < code.size();) {
    std::size_t end = i;
    if (code.substr(i).starts_with("--")) {
      i = comment_end(code, i);
      continue;
    }
    if (code[i] == '"' || code[i] == '\'') end = quoted_end(code, i);
    if (code[i] == '[') end = long_bracket_end(code, i);
    most = std::max(most, reading_of(code.substr(i, end - i)));
    i = std::max(end, i + 1);
  }
  return most;
}

void* allocate_lua(void* data, void* block, std::size_t old_size, std::size_t new_size) {
  auto* usage = static_cast<LuaUsage*>(data);
  if (new_size == 0) {
    usage->bytes -= old_size;
    std::free(block);
    return nullptr;
  }
  if (!block) old_size = 0;
  const bool buffer = !usage->is_loading && is_buffer(old_size, new_size);
  const std::size_t bytes = usage->bytes - old_size + new_size;
  if (new_size > old_size && usage->is_running && !usage->is_ending) {
    usage->instructions += kAllocation + static_cast<double>(new_size) / kAllocatedPerInstruction;
    const bool is_too_long = buffer && new_size > kLongestString;
    if (bytes > usage->limits.lua_memory_bytes || is_too_long || usage->is_over()) return nullptr;
  }
  void* moved = std::realloc(block, new_size);
  if (!moved) return nullptr;
  usage->bytes = bytes;
  usage->largest_block = std::max(usage->largest_block, new_size);
  if (buffer) usage->buffer_bytes = new_size;
  usage->longest_buffer = std::max(usage->longest_buffer, usage->buffer_bytes);
  return moved;
}

LuaUsage& usage_of(lua_State* state) {
  void* data = nullptr;
  lua_getallocf(state, &data);
  return *static_cast<LuaUsage*>(data);
}

void charge_lua(lua_State* state, double instructions) {
  LuaUsage& usage = usage_of(state);
  usage.instructions += instructions;
  if (!usage.is_over()) return;
  usage.is_ending = true;
  luaL_where(state, is_in_lua(state) ? 0 : 1);
  lua_pushfstring(state, "%sLua ran for more than %f instructions, expected it to end sooner",
                  lua_tostring(state, -1), usage.limits.lua_instructions);
  lua_error(state);
}

void charge_instructions(lua_State* state, int count) {
  const LuaUsage& usage = usage_of(state);
  const double strings =
      std::max(usage.literal_instructions, static_cast<double>(usage.longest_buffer) / kDigitsPerInstruction);
  charge_lua(state, count * (1 + strings + (usage.largest_block > kLargeTable ? kOutOfCaches : 0)));
}

void charge_string(lua_State* state, int index) {
  if (lua_type(state, index) == LUA_TSTRING)
    charge_lua(state, static_cast<double>(lua_objlen(state, index)) / kDigitsPerInstruction);
}

void charge_new_string(lua_State* state, std::size_t length) {
  if (length > kLongestString)
    luaL_error(state, "got a string of more than %d bytes, expected a shorter one",
               static_cast<int>(kLongestString));
  LuaUsage& usage = usage_of(state);
  usage.longest_buffer = std::max(usage.longest_buffer, length);
}

}  // namespace espalier::lsystem
