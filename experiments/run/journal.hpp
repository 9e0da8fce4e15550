#pragma once
/// What a run has finished so far, kept on disk so that an interrupted run continues.
///
/// The file is text. The first row holds the identity of the run; every further one a finished unit: key, seconds, result
/// and a checksum, separated by tabs. A row is written whole, at once, when its unit ends. A torn last row is dropped; a
/// damaged row is named and its unit is computed again.

#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall {

class Journal {
 public:
  struct Row {
    double seconds = 0;
    std::string result;
  };

  /// Opens `file`, or begins it with `identity`, one line of text. An identity other than the file's own is not looked
  /// at: see `identity_in`. Throws std::system_error if the file cannot be written.
  Journal(std::filesystem::path file, const std::string& identity);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// The identity that `file` was begun with; empty if there is no such file or its first row is damaged.
  static std::string identity_in(const std::filesystem::path& file);

  /// What was finished when the file was opened, by the unit's key.
  const std::map<std::string, Row, std::less<>>& finished() const { return finished_; }

  /// A line for each damaged row: which, and what becomes of it.
  const std::vector<std::string>& damage() const { return damage_; }

  /// Thread-safe. The row is in the file when this returns, so that the end of the process loses none; the file is
  /// flushed to the disk about once a second, which is what a power failure may cost. Throws std::system_error if the
  /// row cannot be written.
  void add(const std::string& key, const Row& row);

 private:
  using Clock = std::chrono::steady_clock;

  std::string read(std::string_view text);  // fills finished_ and damage_; returns the undamaged rows of units
  void write(const std::string& text);

  std::filesystem::path file_;
  std::map<std::string, Row, std::less<>> finished_;
  std::vector<std::string> damage_;
  std::mutex mutex_;
  int descriptor_ = -1;
  int broken_ = 0;  // the errno of a failed write
  Clock::time_point synced_ = Clock::now();
};

}  // namespace thinwall
