#pragma once
/// A result folder: what lies in it, how it is written whole or not at all, how it is read again.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boost/core/noncopyable.hpp>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/journal.hpp>
#include <thinwall/experiments/lab/manifest.hpp>

namespace thinwall {

// ---- The folder of one run: claimed before the run, filled as its units end, complete once its manifest lies there.
//
// While a run lasts the folder holds its journal. Results are written under another name and moved into place when all
// of them are there, the manifest last; then the journal goes. So whatever has its own name is whole, and a folder with a
// manifest is complete, also after the end of the process or of the power at any moment. What this program did not write is
// neither removed nor replaced, and no link is followed.

inline constexpr const char* journal_name = "journal.tsv";
inline constexpr const char* seal_name = "shard.json";

/// What a run at work keeps: journal.tsv, journal.old.tsv, journal.rank-2.tsv.
bool is_journal_name(std::string_view file);

/// Holds a folder for this process alone, as long as it lives.
class FolderLock : boost::noncopyable {
 public:
  ~FolderLock();

  /// `shared`: beside others who share it. False if another process holds it. Throws std::system_error if there is no such
  /// folder, UsageError if its file system has no locks.
  bool take(const std::filesystem::path& folder, bool shared = false);

  /// What was taken still has that name.
  bool holds(const std::filesystem::path& folder) const;

 private:
  int descriptor_ = -1;
};

class ResultFolder : boost::noncopyable {
 public:
  /// Throws UsageError if the folder cannot be written, is in use, or holds anything but this run; it is then unchanged.
  /// Throws std::runtime_error if the disk is full.
  ResultFolder(std::filesystem::path path, const RunIdentity& identity);

  const std::filesystem::path& path() const { return path_; }

  /// The manifest of a result that is whole and by this very program: there is nothing left to compute.
  const std::optional<Manifest>& complete() const { return complete_; }

  /// What the user should know, a line each.
  const std::vector<std::string>& notes() const { return notes_; }

  /// There is one unless the folder is complete.
  Journal& journal() { return *journal_; }

  /// Where files wait until `publish`: there is such a folder once something was staged.
  const std::filesystem::path& staging() const { return staging_->path(); }

  /// Writes a file of the result into `staging`. Throws std::system_error if it cannot.
  void stage(const std::string& file, const std::string& text);

  /// SHA-256 of the staged files, by path.
  std::map<std::string, std::string> staged_hashes() const;

  /// Writes the seal of a finished shard, whose journal stays: whole, even if somebody has removed or cut it off meanwhile.
  void seal(const RunRecord& run);

  /// Moves what other ranks of this run have finished from their journals into ours, and deletes theirs. Those of another run stay.
  void gather_rank_journals(const std::string& identity);

  /// Where a rank keeps what it has finished until it is gathered.
  static std::filesystem::path rank_journal(const std::filesystem::path& folder, int rank);

  /// Moves every staged file into place, the manifest last, and ends the journal.
  void publish();

 private:
  void look_at_manifest();
  void look_at_journal();
  void reopen_journal();                                        // whole, if its file was removed or changed meanwhile
  void require_own() const;                                     // nobody has moved the folder away
  std::optional<Manifest> manifest_in(const char* name) const;  // nothing if there is no file
  void refuse_foreign(const char* name) const;                  // if it is there
  void clear_up();                                              // of what a complete folder does not need
  [[noreturn]] void refuse(const std::string& why) const;

  std::filesystem::path path_;
  FolderLock lock_;
  RunIdentity identity_;
  bool is_fresh_ = false;  // no result of ours was here before
  std::vector<std::string> notes_;
  std::optional<Manifest> complete_, replaced_;
  std::unique_ptr<Journal> journal_;
  std::optional<Workshop> staging_;
};

/// Throws UsageError: the place, in a line that drives no terminal, and what is wrong with it.
[[noreturn]] void refuse_place(const std::filesystem::path& place, const std::string& why);

/// Removes the complete result in `folder`, and the folder if it holds nothing else. Returns false if it stays.
bool remove_result(const std::filesystem::path& folder);

// ---- A complete result, read back from its folder.

/// What manifest.json says of a result, its configuration as its run id was computed from, and how to cite it.
struct KeptResult : Manifest {
  std::filesystem::path folder;
  SoftwareCitation software;
  ResultCitation citation;
};

/// What the manifest in `folder` says. Throws UsageError, naming it as `file`, if it is damaged or not ours.
KeptResult kept_result(const std::filesystem::path& folder, const std::string& file);

/// What a folder without manifest is, if it holds a finished shard or a run that is not finished, and what makes a result of it; else empty.
std::string part_of_run(const std::filesystem::path& folder);

/// Throws UsageError if `folder` holds no complete result.
void require_result(const std::filesystem::path& folder);
KeptResult read_result(const std::filesystem::path& folder);

// ---- Turns the outcome of a run into the files of its result folder. Nothing else in the project writes one.

/// Writes and publishes everything. Returns what the user should know, a line each: a figure that could not be drawn.
/// Throws std::system_error if a file cannot be written; the folder then keeps its journal, and the run can go on.
std::vector<std::string> write_results(ResultFolder& folder, const RunRecord& run, const Outcome& outcome);

}  // namespace thinwall
