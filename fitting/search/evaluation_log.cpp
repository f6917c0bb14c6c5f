#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <boost/crc.hpp>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/core/text/text_hash.h>
#include <espalier/fitting/search/evaluation_log.h>

namespace espalier {

namespace {

constexpr std::string_view kMark = "espfit02", kMarkOf01 = "espfit01";
constexpr std::size_t kMarkBytes = 8;

/// As it stands in the file.
struct Record {
  LoggedEvaluation evaluation;
  std::uint32_t number = 0;  ///< from 0
  std::uint32_t check = 0;   ///< CRC-32 of what stands before it
};
static_assert(sizeof(LoggedEvaluation) == 16 && sizeof(Record) == 24);

std::uint32_t check_of(const Record& record) {
  boost::crc_32_type crc;
  crc.process_bytes(&record, offsetof(Record, check));
  return crc.checksum();
}

Record record_of(const LoggedEvaluation& evaluation, std::size_t number) {
  Record record{evaluation, static_cast<std::uint32_t>(number)};
  record.check = check_of(record);
  return record;
}

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

template <typename Value>
Value value_at(std::string_view bytes, std::size_t at) {
  Value value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

LogContent content_of_01(std::string_view records) {
  LogContent content{.is_of_version_01 = true};
  for (std::size_t at = 0; at + sizeof(LoggedEvaluation) <= records.size(); at += sizeof(LoggedEvaluation))
    content.evaluations.push_back(value_at<LoggedEvaluation>(records, at));
  return content;
}

/// As a power cut leaves a log that was not brought to the disk yet: as long as it was, of zeros.
bool is_without_mark(std::string_view bytes) {
  return bytes.substr(0, kMarkBytes).find_first_not_of('\0') == std::string_view::npos;
}

LogContent content_of(std::string_view bytes, const std::filesystem::path& path) {
  const std::string_view mark = bytes.substr(0, kMarkBytes);
  if (is_without_mark(bytes)) return {.is_damaged = bytes.size() > kMarkBytes};
  if (!kMark.starts_with(mark) && mark != kMarkOf01)
    throw_input_error("{}: got another kind of file, expected a log of evaluations", path.string());
  if (mark.size() < kMarkBytes) return {};
  const std::string_view records = bytes.substr(kMarkBytes);
  if (mark == kMarkOf01) return content_of_01(records);
  LogContent content;
  for (std::size_t at = 0; at + sizeof(Record) <= records.size() && !content.is_damaged;
       at += sizeof(Record)) {
    const auto record = value_at<Record>(records, at);
    content.is_damaged = record.check != check_of(record) || record.number != content.evaluations.size();
    if (!content.is_damaged) content.evaluations.push_back(record.evaluation);
  }
  return content;
}

std::string bytes_of(std::span<const Record> records) {
  return {reinterpret_cast<const char*>(records.data()), records.size_bytes()};
}

std::vector<Record> records_of(std::span<const LoggedEvaluation> evaluations, std::size_t first) {
  std::vector<Record> records;
  records.reserve(evaluations.size());
  for (const LoggedEvaluation& evaluation : evaluations) records.push_back(record_of(evaluation, first++));
  return records;
}

/// A log of version 0.1 becomes one with checks.
void write_as_of_today(const std::filesystem::path& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, none))) return;
  const LogContent content = read_evaluation_log(path);
  if (content.is_of_version_01)
    write_file_atomically(path, std::string(kMark) + bytes_of(records_of(content.evaluations, 0)));
}

[[noreturn]] void throw_cannot_write(const std::filesystem::path& path) {
  throw_input_error("{}: got '{}', expected a log that can be written", path.string(), std::strerror(errno));
}

}  // namespace

LogContent read_evaluation_log(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0)
    throw_input_error("{}: got '{}', expected a log of evaluations", path.string(), std::strerror(errno));
  const std::string bytes = read_all(file);
  ::close(file);
  return content_of(bytes, path);
}

std::uint32_t hash_values(const ParameterTable& table, const ParameterValues& values) {
  const std::vector<bool> in_use = rows_in_use(table, values);
  std::uint64_t hash = kHashOfNothing;
  for (std::size_t row = 0; row < values.size(); ++row)
    if (in_use[row]) hash = hash_on(hash, {reinterpret_cast<const char*>(&values[row]), sizeof values[row]});
  return static_cast<std::uint32_t>(hash ^ (hash >> 32));
}

EvaluationLog::EvaluationLog(const std::filesystem::path& path) : path_(path) {
  write_as_of_today(path);
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644);
  if (file_ < 0) throw_cannot_write(path);
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
  LogContent content = content_of(bytes, path_);
  logged_ = std::move(content.evaluations);
  count_ = logged_.size();
  if (!bytes.starts_with(kMark)) {  // new, torn inside the mark, or lost by a power cut
    ::lseek(file_, 0, SEEK_SET);
    write_all(kMark.data(), kMarkBytes);
  }
  const std::size_t end = kMarkBytes + count_ * sizeof(Record);
  if (bytes.size() > end && ::ftruncate(file_, static_cast<off_t>(end)) != 0) throw_cannot_write(path_);
  ::lseek(file_, static_cast<off_t>(end), SEEK_SET);
}

void EvaluationLog::append(std::span<const LoggedEvaluation> evaluations) {
  ESPALIER_CHECK_EQ(file_ >= 0, true);
  const std::vector<Record> records = records_of(evaluations, count_);
  write_all(records.data(), records.size() * sizeof(Record));
  count_ += records.size();
}

void EvaluationLog::sync() {
  if (file_ >= 0) ::fdatasync(file_);  // where a file system cannot, there is nothing more to be done
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
