// The values of a run's evaluations in their order, on disk: what resuming and repeating a run replays.
// 24 bytes an evaluation (value, seconds since the run began, hash of the candidate, its number, CRC-32 of
// these), after an 8-byte mark. Each batch is written at once, so a killed run loses at most a torn record at
// the end. What is torn, or damaged by a disk, is dropped when the log is opened again, with all behind it:
// the run goes on from there. Logs of version 0.1 have no checks; they are read, and written as those of
// today when a run goes on.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <espalier/core/parameter_table.h>

namespace espalier {

struct LoggedEvaluation {
  double value = 0;
  float seconds = 0;
  std::uint32_t candidate_hash = 0;
  bool operator==(const LoggedEvaluation&) const = default;
};

/// FNV-1a over the bits of the values that say something of the plant (rows_in_use): curves that change
/// nothing are not told apart from none.
std::uint32_t hash_values(const ParameterTable& table, const ParameterValues& values);

struct LogContent {
  std::vector<LoggedEvaluation> evaluations;  ///< all before the first that is torn or damaged
  bool is_damaged = false;                    ///< a whole record is not as it was written
  bool is_of_version_01 = false;
};

/// The file is only read, also while a run writes it. Throws InputError where there is none, or it is no log.
LogContent read_evaluation_log(const std::filesystem::path& path);

class EvaluationLog {
 public:
  /// Starts an empty log, or reads the one there is, and cuts what is torn or damaged. Throws InputError
  /// where the file cannot be opened, read or written, is a link, or is no log.
  explicit EvaluationLog(const std::filesystem::path& path);
  /// Of evaluations to replay alone: it has no file, and none may be appended.
  explicit EvaluationLog(std::vector<LoggedEvaluation> logged) : logged_(std::move(logged)) {}
  ~EvaluationLog();
  EvaluationLog(const EvaluationLog&) = delete;
  EvaluationLog& operator=(const EvaluationLog&) = delete;

  /// What the log held when it was opened.
  const std::vector<LoggedEvaluation>& logged() const { return logged_; }
  /// Throws InputError where the disk is full.
  void append(std::span<const LoggedEvaluation> evaluations);
  /// Brings what was appended to the disk.
  void sync();

 private:
  void read_logged();
  void write_all(const void* bytes, std::size_t size);

  std::filesystem::path path_;
  int file_ = -1;
  std::size_t count_ = 0;  ///< of the records in the file
  std::vector<LoggedEvaluation> logged_;
};

}  // namespace espalier
