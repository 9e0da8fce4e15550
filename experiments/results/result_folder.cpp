#include <thinwall/experiments/results/result_folder.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include <thinwall/experiments/results/drawn_figures.hpp>
#include <thinwall/experiments/results/durable.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/file_text.hpp>
#include <thinwall/experiments/text/sha256.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

constexpr const char* old_manifest_name = "manifest.old.json";  // of the result that is being replaced
constexpr const char* rank_journal_prefix = "journal.rank-";
constexpr const char* old_journal_name = "journal.old.tsv";  // begun by another build of the program

/// What a result is made of: where none of ours lies, none of these may either.
constexpr std::array result_names = {manifest_name, seal_name,       "datapackage.json",
                                     "report.html", "resolved.toml", "cite.bib",
                                     "data",        "plots",         "tables"};

}  // namespace

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool FolderLock::take(const fs::path& folder) {
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category());
  return ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
}

ResultFolder::ResultFolder(fs::path path, const RunIdentity& identity) : path_(std::move(path)) {
  try {
    fs::create_directories(path_);
    if (!lock_.take(path_)) refuse("another run is at work here; wait for it or name another folder");
    look_at_manifest(identity);
    if (!complete_) look_at_journal(identity);
    fs::remove_all(staging());  // of a run that was killed while it wrote its results
  } catch (const std::system_error& error) {
    const std::string why = "cannot be written: " + error.code().message();
    if (error.code() != std::errc::no_space_on_device && error.code().value() != EDQUOT) refuse(why);
    throw std::runtime_error(
        fmt::format("--out {}: {}", one_line(path_.string()), why));  // no fault of the user's words
  }
}

ResultFolder::~ResultFolder() {
  std::error_code none;
  fs::remove_all(staging(), none);
}

void ResultFolder::refuse(const std::string& why) const {
  throw UsageError(fmt::format("--out {}: {}", one_line(path_.string()), why));
}

void ResultFolder::look_at_manifest(const RunIdentity& identity) {
  const bool half_replaced = !fs::exists(path_ / manifest_name);  // if there is an old one
  const char* const name = half_replaced ? old_manifest_name : manifest_name;
  if (!fs::exists(path_ / name)) return;
  const auto manifest = parse_manifest(file_text(path_ / name));
  if (!manifest) refuse(fmt::format("holds a {} that is not ours; name another folder", name));
  if (const auto difference = identity_difference(manifest->identity, identity); !difference.empty()) {
    refuse(fmt::format("holds another run ({}); name another folder, or delete this one", difference));
  }
  if (half_replaced) {
    replaced_ = manifest;
    notes_.push_back(one_line(path_.string()) +
                     ": an earlier result was being replaced here; it is when this run ends");
    return;
  }
  std::string changed, missing;
  for (const auto& [file, hash] : manifest->hashes) {
    if (!fs::exists(path_ / file)) {
      missing = file;
    } else if (sha256_of_file(path_ / file) != hash) {
      changed = file;
    }
  }
  for (const std::string& file : manifest->unhashed) {
    if (!fs::exists(path_ / file)) missing = file;
  }
  const bool ours = same_program(manifest->identity, identity);
  if (ours && missing.empty() && fs::exists(path_ / "report.html")) {
    complete_ = manifest;
    clear_up();  // after a run that was killed while it did
    notes_.push_back(fmt::format("{}: complete already; nothing was computed{}", one_line(path_.string()),
                                 changed.empty() ? "" : " (" + changed + " was changed since)"));
    return;
  }
  if (!changed.empty()) refuse(changed + " was changed since the run wrote it; name another folder, or move it away");
  replaced_ = manifest;
  notes_.push_back(fmt::format("{}: {}; its result is replaced when this run ends", one_line(path_.string()),
                               ours ? "incomplete" : "computed by another build of the program"));
}

void ResultFolder::look_at_journal(const RunIdentity& identity) {
  const fs::path file = path_ / journal_name;
  for (const char* name : {journal_name, old_journal_name}) {
    if (fs::exists(path_ / name) && !Journal::is_one(path_ / name)) {
      refuse(fmt::format("holds '{}', which is not ours; name another folder", name));
    }
  }
  if (fs::exists(file)) {
    const std::string theirs = Journal::identity_in(file);
    const std::string difference = theirs.empty() ? "" : identity_difference(theirs, identity);
    if (!difference.empty()) {
      refuse(fmt::format("holds another run ({}); name another folder, or delete this one", difference));
    }
    if (!theirs.empty()) gather_rank_journals(theirs);
    if (theirs.empty() || !same_program(theirs, identity)) {
      fs::rename(file, path_ / old_journal_name);
      notes_.push_back(fmt::format(
          "{}: {}; it is kept as {} until this run ends", one_line(file.string()),
          theirs.empty() ? "its first row is damaged" : "begun by another build of the program", old_journal_name));
    }
  } else if (!replaced_ && !fs::exists(path_ / old_journal_name)) {
    for (const char* name : result_names) {
      if (fs::exists(path_ / name)) refuse(fmt::format("holds '{}', which is not ours; name another folder", name));
    }
  }
  journal_ = std::make_unique<Journal>(file, identity_text(identity));
  for (const std::string& line : journal_->damage()) notes_.push_back(line);
}

void ResultFolder::gather_rank_journals(const std::string& identity) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path_)) {
    if (entry.path().filename().string().starts_with(rank_journal_prefix)) files.push_back(entry.path());
  }
  if (files.empty()) return;
  std::unique_ptr<Journal> other;
  if (!journal_) other = std::make_unique<Journal>(path_ / journal_name, identity);
  for (const fs::path& file : files) {
    const JournalText text = read_journal(file);
    for (const std::string& line : text.damage) notes_.push_back(line + "; that unit is computed again");
    if (text.identity == identity) (journal_ ? *journal_ : *other).add(text.rows);
    fs::remove(file);
  }
}

void ResultFolder::seal(const std::string& text) {
  stage(seal_name, text);
  fs::rename(staging() / seal_name, path_ / seal_name);
  fs::remove(path_ / old_journal_name);
  fs::remove_all(staging());
}

fs::path ResultFolder::rank_journal(const fs::path& folder, int rank) {
  return folder / fmt::format("{}{}.tsv", rank_journal_prefix, rank);
}

void ResultFolder::stage(const std::string& file, const std::string& text) {
  const fs::path target = staging() / file;
  fs::create_directories(target.parent_path());
  errno = 0;
  std::ofstream out(target, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::system_error(errno ? errno : EIO, std::generic_category(), target.string());
}

std::map<std::string, std::string> ResultFolder::staged_hashes() const {
  std::map<std::string, std::string> hashes;
  for (const auto& entry : fs::recursive_directory_iterator(staging())) {
    if (!entry.is_regular_file()) continue;
    hashes[entry.path().lexically_relative(staging()).generic_string()] = sha256_of_file(entry.path());
  }
  return hashes;
}

void ResultFolder::publish() {
  const auto staged = staged_hashes();
  std::set<fs::path> folders = {path_};
  for (const auto& [file, hash] : staged) {  // whatever may lack space does so before a name has changed
    flush_to_disk(staging() / file);
    fs::create_directories((path_ / file).parent_path());
    folders.insert((path_ / file).parent_path());
  }
  const auto move = [&](const std::string& file) { fs::rename(staging() / file, path_ / file); };
  if (fs::exists(path_ / manifest_name)) {
    fs::rename(path_ / manifest_name, path_ / old_manifest_name);
    flush_to_disk(path_);
  }
  remove_drawn_figures(path_);  // they show the old result
  for (const auto& [file, hash] : staged) {
    if (file != manifest_name) move(file);
  }
  if (replaced_) {
    for (const auto& [file, hash] : replaced_->hashes) {
      if (!staged.contains(file)) fs::remove(path_ / file);
    }
    for (const std::string& file : replaced_->unhashed) {
      if (!staged.contains(file)) fs::remove(path_ / file);
    }
  }
  for (const fs::path& folder : folders) flush_to_disk(folder);
  move(manifest_name);
  flush_to_disk(path_);
  journal_.reset();
  clear_up();
}

void ResultFolder::clear_up() const {
  for (const char* name : {journal_name, old_journal_name, old_manifest_name}) fs::remove(path_ / name);
  fs::remove_all(staging());
  remove_half_drawn_figures(path_);
}

}  // namespace thinwall
