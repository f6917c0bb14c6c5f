#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <string>

#include <espalier/core/error.h>
#include <espalier/fitting/search/evaluation_log.h>

namespace espalier {

namespace {

constexpr char kMark[9] = "espfit01";
constexpr std::size_t kMarkBytes = 8;
static_assert(sizeof(LoggedEvaluation) == 16);

/// Reads what is there; nothing from a device, which may never end.
std::string read_all(int file) {
  std::string bytes;
  struct stat status;
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return bytes;
  char buffer[1 << 16];
  for (ssize_t got; (got = ::read(file, buffer, sizeof buffer)) > 0;)
    bytes.append(buffer, static_cast<std::size_t>(got));
  return bytes;
}

/// The whole records of a log.
std::vector<LoggedEvaluation> records_of(const std::string& bytes, const std::filesystem::path& path) {
  if (std::memcmp(bytes.data(), kMark, std::min(bytes.size(), kMarkBytes)) != 0)
    throw_input_error("{}: got another kind of file, expected a log of evaluations", path.string());
  const std::size_t count =
      bytes.size() < kMarkBytes ? 0 : (bytes.size() - kMarkBytes) / sizeof(LoggedEvaluation);
  std::vector<LoggedEvaluation> records(count);
  if (count > 0) std::memcpy(records.data(), bytes.data() + kMarkBytes, count * sizeof(LoggedEvaluation));
  return records;
}

}  // namespace

std::vector<LoggedEvaluation> read_evaluation_log(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0)
    throw_input_error("{}: got '{}', expected a log of evaluations", path.string(), std::strerror(errno));
  const std::string bytes = read_all(file);
  ::close(file);
  return records_of(bytes, path);
}

std::uint32_t hash_values(const ParameterTable& table, const ParameterValues& values) {
  const std::vector<bool> in_use = rows_in_use(table, values);
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!in_use[row]) continue;
    for (std::uint64_t bits = std::bit_cast<std::uint64_t>(values[row]), i = 0; i < 8; ++i, bits >>= 8)
      hash = (hash ^ (bits & 0xff)) * 0x100000001b3ull;
  }
  return static_cast<std::uint32_t>(hash ^ (hash >> 32));
}

EvaluationLog::EvaluationLog(const std::filesystem::path& path) : path_(path) {
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0)
    throw_input_error("{}: got '{}', expected a log that can be written", path.string(),
                      std::strerror(errno));
  try {
    read_logged();
  } catch (...) {
    ::close(file_);
    throw;
  }
}

EvaluationLog::~EvaluationLog() {
  if (file_ >= 0) ::close(file_);
}

void EvaluationLog::read_logged() {
  const std::string bytes = read_all(file_);
  logged_ = records_of(bytes, path_);
  if (bytes.size() < kMarkBytes) {  // new, or torn inside the mark
    ::lseek(file_, 0, SEEK_SET);
    write_all(kMark, kMarkBytes);
  }
  const auto end = static_cast<off_t>(kMarkBytes + logged_.size() * sizeof(LoggedEvaluation));
  if (bytes.size() > static_cast<std::size_t>(end) && ::ftruncate(file_, end) != 0)
    throw_input_error("{}: got '{}', expected a log that can be written", path_.string(),
                      std::strerror(errno));
  ::lseek(file_, end, SEEK_SET);
}

void EvaluationLog::append(std::span<const LoggedEvaluation> evaluations) {
  ESPALIER_CHECK_EQ(file_ >= 0, true);
  write_all(evaluations.data(), evaluations.size_bytes());
}

void EvaluationLog::write_all(const void* bytes, std::size_t size) {
  const char* next = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t written = ::write(file_, next, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0)
      throw_input_error("{}: got '{}', expected room to write", path_.string(), std::strerror(errno));
    next += written;
    size -= static_cast<std::size_t>(written);
  }
}

}  // namespace espalier
