// The values of a run's evaluations in their order, on disk: what resuming and repeating a run replays.
// 16 bytes an evaluation (value, seconds since the run began, hash of the candidate), after an 8-byte
// mark. Each batch is written at once, so a killed run loses at most a torn record at the end, which
// is dropped when the log is opened again.
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

/// What a log holds, without its torn tail. The file is only read, also while a run writes it. Throws
/// InputError where there is none, or it is no log.
std::vector<LoggedEvaluation> read_evaluation_log(const std::filesystem::path& path);

class EvaluationLog {
 public:
  /// Starts an empty log, or reads the one there is, without its torn tail. Throws InputError where
  /// the file cannot be opened, read or written, or is no log.
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

 private:
  void read_logged();
  void write_all(const void* bytes, std::size_t size);

  std::filesystem::path path_;
  int file_ = -1;
  std::vector<LoggedEvaluation> logged_;
};

}  // namespace espalier
