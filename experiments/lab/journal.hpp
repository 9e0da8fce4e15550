#pragma once
/// The journal of a run, and the identity that binds each row to it.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boost/core/noncopyable.hpp>

namespace thinwall {

// ---- What makes two runs the same run: only then do their results go together.

class JsonReader;

struct RunIdentity {
  std::string experiment;
  std::string config;  ///< canonical JSON
  std::uint64_t seed = 0;
  std::optional<std::int64_t> trials;  ///< as given on the command line
  std::string program;                 ///< SHA-256 of the program, which knows its commit
  std::string shard = {};              ///< as in `2/4`; empty: the whole run
};

/// One line of canonical JSON.
std::string identity_text(const RunIdentity& identity);

/// The run that the keys experiment, config, seed and trials of an object name, but for its program. Throws UsageError.
RunIdentity read_identity(const JsonReader& object);

/// The identity that `identity_text` wrote; nothing if `text` is none.
std::optional<RunIdentity> parse_identity(std::string_view text);

/// How their run differs from ours: `seed 1, not 2`. Empty if it does not, or only in the program that computed it.
std::string identity_difference(const RunIdentity& theirs, const RunIdentity& ours);

// ---- What a run has finished so far, kept on disk so that an interrupted run continues.
//
// The file is text. The first row holds the identity of the run; every further one a finished unit: key, seconds, result
// and a checksum, which covers the identity too, separated by tabs. A row is written whole, at once, when its unit ends. A
// torn last row is dropped; a row that is damaged, or of another run, is named and its unit is computed again.

class Journal : boost::noncopyable {
 public:
  struct Row {
    double seconds = 0;
    std::string result;
  };
  using Rows = std::map<std::string, Row, std::less<>>;  ///< by the unit's key

  /// Opens `file`, or begins it with `identity`, one line of text; a journal of another identity is begun anew: see
  /// `read_journal`. Throws std::system_error if the file cannot be written, or is no journal.
  Journal(std::filesystem::path file, const std::string& identity);
  ~Journal();

  /// True of a file, not of a link to one, that begins as a journal does, damaged or not.
  static bool is_one(const std::filesystem::path& file);

  /// What is finished.
  const Rows& finished() const { return finished_; }

  /// A line for each damaged row: which, and what becomes of it.
  const std::vector<std::string>& damage() const { return damage_; }

  /// Thread-safe. The row is in the file when this returns, so that the end of the process loses none; the file is
  /// flushed to the disk about once a second, which is what a power failure may cost. Throws std::system_error if the
  /// row cannot be written.
  void add(const std::string& key, const Row& row);

  /// Adds those rows that are not there yet, all at once.
  void add(const Rows& rows);

 private:
  using Clock = std::chrono::steady_clock;

  void write(const std::string& text);
  void sync();

  std::filesystem::path file_;
  std::string run_;  // the SHA-256 of its identity
  Rows finished_;
  std::vector<std::string> damage_;
  std::mutex mutex_;
  int descriptor_ = -1;
  int broken_ = 0;  // the errno of a failed write
  Clock::time_point synced_ = Clock::now();
};

/// What lies in the file of a journal.
struct JournalText {
  std::string identity;  ///< empty if there is no such file or its first row is damaged
  Journal::Rows rows;
  std::string good_rows;            ///< `rows` as they stand in the file
  std::vector<std::string> damage;  ///< a line for each damaged row
};

/// Reads and changes nothing.
JournalText read_journal(const std::filesystem::path& file);

}  // namespace thinwall
