#include <thinwall/experiments/lab/result_folder.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <functional>
#include <iterator>
#include <set>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/report.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/shards.hpp>
#include <thinwall/experiments/lab/table_text.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

namespace fs = std::filesystem;

constexpr const char* old_manifest_name = "manifest.old.json";  // of the result that is being replaced
constexpr std::string_view rank_journal_begin = "journal.rank-", rank_journal_end = ".tsv";
constexpr const char* old_journal_name = "journal.old.tsv";  // begun by another build of the program

/// The key of the row that says that results are being moved into place: what has their names is ours from then on.
constexpr const char* publishing_key = "";

/// What a result is made of: where none of ours lies, none of these may either.
constexpr std::array result_names = {manifest_name, seal_name,       "datapackage.json", "report.html",
                                     "cite.bib",    "resolved.toml", "trace.jsonl",      "data",
                                     "plots",       "tables"};

/// Also of a link that leads nowhere.
bool is_there(const fs::path& path) { return fs::exists(fs::symlink_status(path)); }

bool is_rank_journal(std::string_view name) {
  return name.starts_with(rank_journal_begin) && name.ends_with(rank_journal_end) &&
         parse_count(
             name.substr(rank_journal_begin.size(), name.size() - rank_journal_begin.size() - rank_journal_end.size()));
}

/// The names of those that are there: what a run at work keeps, of this build or another.
std::vector<std::string> journals_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (const std::string name = entry.path().filename().string(); is_journal_name(name)) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

/// A rank's journal that is not there.
fs::path free_rank_journal(const fs::path& folder) {
  int rank = 0;
  while (is_there(ResultFolder::rank_journal(folder, rank))) ++rank;
  return ResultFolder::rank_journal(folder, rank);
}

constexpr std::size_t room_for_a_figure = 1 << 20;  // [byte]

void stage_tables(ResultFolder& folder, const RunRecord& run, const Outcome& outcome) {
  for (const Table& table : outcome.tables) {
    folder.stage("data/" + table.name + ".csv", csv_text(table));
    if (!table.in_report || table.is_timing) continue;  // only data/ may differ from run to run
    folder.stage("tables/" + table.name + ".md", markdown_table(table));
    folder.stage("tables/" + table.name + ".tex", latex_table(table));
  }
  std::string name = "thinwall-" + run.experiment;
  std::ranges::replace(name, '_', '-');
  // Its description holds no number: an answer may speak of run times, and this file is the same in every run.
  const PackageInfo info{name, run.question, "The answer stands in report.html and manifest.json.", run.build.version};
  folder.stage("datapackage.json", datapackage_text(info, outcome.tables));
}

/// The figures that could be drawn; `why_no_svg` says what was wrong with another.
void stage_figures(ResultFolder& folder, const Outcome& outcome, ReportParts& parts) {
  for (const Figure& figure : outcome.figures) {
    const std::string file = "plots/" + figure.name, svg = file + ".svg";
    folder.stage(file + ".gp", plot_script(figure));
    folder.stage(file + ".dat", plot_data(figure));
    folder.stage(file + ".json", figure_json(figure));
    const std::string trouble = draw(folder.staging() / "plots", figure.name);
    if (!trouble.empty()) {
      parts.why_no_svg = trouble;
      folder.stage(svg, std::string(room_for_a_figure, ' '));  // throws if that was the trouble
      fs::remove(folder.staging() / svg);
      continue;
    }
    parts.svgs[figure.name] = file_text(folder.staging() / svg);
  }
}

/// Takes what differs from run to run out of `hashes`, and returns its paths.
std::vector<std::string> take_timings(std::map<std::string, std::string>& hashes, const Outcome& outcome) {
  std::vector<std::string> out;
  const auto take = [&](const std::string& file) {
    if (hashes.erase(file) > 0) out.push_back(file);
  };
  for (const Table& table : outcome.tables) {
    if (table.is_timing) take("data/" + table.name + ".csv");
  }
  for (const Figure& figure : outcome.figures) {
    if (!figure.is_timing) continue;
    for (const char* kind : {".dat", ".gp", ".json", ".svg"}) take("plots/" + figure.name + kind);
  }
  return out;
}

}  // namespace

bool is_journal_name(std::string_view file) {
  return file == journal_name || file == old_journal_name || is_rank_journal(file);
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool FolderLock::take(const fs::path& folder, bool shared) {
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category());
  const int how = (shared ? LOCK_SH : LOCK_EX) | LOCK_NB;
  int failed = ::flock(descriptor_, how);
  while (failed != 0 && errno == EINTR) failed = ::flock(descriptor_, how);
  if (failed != 0 && errno != EWOULDBLOCK) {  // a file system that is mounted without locks
    throw UsageError(fmt::format("{}: cannot be locked: {}; name a folder on another disk", one_line(folder.string()),
                                 std::generic_category().message(errno)));
  }
  return failed == 0;
}

bool FolderLock::holds(const fs::path& folder) const {
  struct stat ours = {}, named = {};
  return ::fstat(descriptor_, &ours) == 0 && ::stat(folder.c_str(), &named) == 0 && ours.st_dev == named.st_dev &&
         ours.st_ino == named.st_ino;
}

ResultFolder::ResultFolder(fs::path path, const RunIdentity& identity) : path_(std::move(path)), identity_(identity) {
  try {
    fs::create_directories(path_);
    if (!lock_.take(path_)) refuse("another run is at work here; wait for it or name another folder");
    look_at_manifest();
    if (!complete_) look_at_journal();
    remove_leftovers(path_);
  } catch (const std::system_error& error) {
    const std::string why = "cannot be written: " + error.code().message();
    if (error.code() != std::errc::no_space_on_device && error.code().value() != EDQUOT)
      refuse(why + "; name another folder");
    // No fault of the user's words.
    throw std::runtime_error(fmt::format("--out {}: {}", one_line(path_.string()), why));
  }
}

void ResultFolder::refuse(const std::string& why) const {
  throw UsageError(fmt::format("--out {}: {}", one_line(path_.string()), why));
}

void ResultFolder::refuse_foreign(const char* name) const {
  if (is_there(path_ / name)) refuse(fmt::format("holds '{}', which is not ours; name another folder", name));
}

std::optional<Manifest> ResultFolder::manifest_in(const char* name) const {
  if (!is_there(path_ / name)) return std::nullopt;
  if (!holds_file(path_, name)) refuse(fmt::format("holds a {} that is not ours; name another folder", name));
  try {
    return parse_manifest(file_text(path_ / name), name);
  } catch (const UsageError& error) {
    refuse(fmt::format("holds a {} that is not ours ({}); name another folder", name, error.what()));
  }
}

void ResultFolder::require_own() const {
  if (lock_.holds(path_)) return;
  const bool is_kept = is_there(path_);  // else it may have been removed with all that was in it
  throw std::runtime_error(
      fmt::format("{}: was {} while the run was at work{}", one_line(path_.string()),
                  is_kept ? "moved away, and another is in its place," : "removed, or moved away,",
                  is_kept ? fmt::format("; what was finished is in its {}, wherever it is", journal_name) : ""));
}

void ResultFolder::look_at_manifest() {
  for (const char* name : result_names) {
    if (fs::is_symlink(path_ / name)) refuse_foreign(name);
  }
  auto manifest = manifest_in(manifest_name);
  const bool half_replaced = !manifest;  // if there is an old one
  if (half_replaced) manifest = manifest_in(old_manifest_name);
  if (!manifest) return;
  if (const auto difference = identity_difference(manifest->run, identity_); !difference.empty()) {
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
    if (!is_there(path_ / file)) {
      missing = file;
    } else if (!is_unchanged(path_, file, hash)) {
      changed = file;
    }
  }
  for (const std::string& file : manifest->unhashed) {
    if (!fs::exists(path_ / file)) missing = file;
  }
  const bool ours = manifest->run.program == identity_.program;
  if (ours && missing.empty() && holds_file(path_, "report.html") && !fs::is_empty(path_ / "report.html")) {
    complete_ = manifest;
    clear_up();  // after a run that was killed while it did
    const std::string remedy =
        changed.empty() ? "" : fmt::format(" ({} was changed since: thinwall report DIR --check says more)", changed);
    notes_.push_back(fmt::format("{}: complete already; nothing was computed{}", one_line(path_.string()), remedy));
    return;
  }
  manifest_in(old_manifest_name);  // which would be overwritten
  if (!changed.empty()) refuse(changed + " was changed since the run wrote it; name another folder, or move it away");
  replaced_ = manifest;
  notes_.push_back(fmt::format("{}: {}; its result is replaced when this run ends", one_line(path_.string()),
                               ours ? "incomplete" : "computed by another build of the program"));
}

void ResultFolder::look_at_journal() {
  const fs::path file = path_ / journal_name, old = path_ / old_journal_name;
  const std::string ours = identity_text(identity_);
  std::map<std::string, std::string> identities;  // of all that are there, by name
  bool was_publishing = false;
  for (const std::string& name : journals_in(path_)) {
    if (!Journal::is_one(path_ / name)) refuse_foreign(name.c_str());
    const JournalText text = read_journal(path_ / name);
    identities[name] = text.identity;
    was_publishing = was_publishing || text.rows.contains(publishing_key);
  }
  const bool is_begun = identities.contains(journal_name), is_set_aside = identities.contains(old_journal_name);
  const std::string found = identities[journal_name], set_aside = identities[old_journal_name];
  const auto theirs = parse_identity(found);
  const std::string difference = theirs          ? identity_difference(*theirs, identity_)
                                 : found.empty() ? ""
                                                 : "something that cannot be read";
  if (!difference.empty())
    refuse(fmt::format("holds another run ({}); name another folder, or delete this one", difference));
  const bool is_theirs = is_begun && found != ours;
  for (const auto& [name, of_rank] : identities) {
    if (is_rank_journal(name) && of_rank != ours && of_rank != found)
      refuse(fmt::format("holds {}, which is damaged, or of another run; delete it, or name another folder", name));
  }
  if (is_theirs && is_set_aside && set_aside != ours) {
    refuse(
        fmt::format("holds two journals that this program cannot go on with, {} and {}; delete one of them, or name "
                    "another folder",
                    journal_name, old_journal_name));
  }
  is_fresh_ = !replaced_ && !was_publishing;
  if (is_fresh_) {
    const auto seal = parse_seal(file_text(path_ / seal_name));
    const bool is_of_run = theirs || (seal && identity_difference(seal->identity, identity_).empty());
    const bool has_seal = !identity_.shard.empty() && is_of_run && holds_file(path_, seal_name);
    for (const char* name : result_names) {
      if (!has_seal || name != std::string_view(seal_name)) refuse_foreign(name);
    }
  }
  if (theirs) gather_rank_journals(found);
  if (set_aside == ours) fs::rename(old, free_rank_journal(path_));  // it is gathered below
  if (is_theirs) {
    fs::rename(file, old);
    notes_.push_back(fmt::format("{}: {}; it is kept as {}{}", one_line(file.string()),
                                 theirs ? "begun by another build of the program" : "its first row is damaged",
                                 old_journal_name, theirs ? " until this run ends" : ": delete it if it is of no use"));
  }
  journal_ = std::make_unique<Journal>(file, ours);
  for (const std::string& line : journal_->damage()) notes_.push_back(line);
  gather_rank_journals(ours);
}

void ResultFolder::gather_rank_journals(const std::string& identity) {
  require_own();
  std::unique_ptr<Journal> other;
  for (const std::string& name : journals_in(path_)) {
    if (!is_rank_journal(name)) continue;
    if (!Journal::is_one(path_ / name)) refuse_foreign(name.c_str());
    const JournalText text = read_journal(path_ / name);
    if (text.identity != identity) continue;
    for (const std::string& line : text.damage) notes_.push_back(line + "; that unit is computed again");
    if (!journal_ && !other) other = std::make_unique<Journal>(path_ / journal_name, identity);
    (journal_ ? *journal_ : *other).add(text.rows);
    fs::remove(path_ / name);
  }
}

void ResultFolder::reopen_journal() {
  auto again = std::make_unique<Journal>(path_ / journal_name, identity_text(identity_));
  again->add(journal_->finished());
  journal_ = std::move(again);
}

void ResultFolder::seal(const RunRecord& run) {
  require_own();
  reopen_journal();
  stage(seal_name, seal_text(run, sha256_of_file(path_ / journal_name)));
  fs::rename(staging() / seal_name, path_ / seal_name);
  staging_.reset();
  clear_up();
}

fs::path ResultFolder::rank_journal(const fs::path& folder, int rank) {
  return folder / fmt::format("{}{}{}", rank_journal_begin, rank, rank_journal_end);
}

void ResultFolder::stage(const std::string& file, const std::string& text) {
  require_own();
  if (!staging_) staging_.emplace(path_);
  const fs::path target = staging() / file;
  fs::create_directories(target.parent_path());
  write_file(target, text);
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
  require_own();
  for (const char* name : result_names) {  // what was put here meanwhile
    if ((is_fresh_ && is_there(path_ / name)) || fs::is_symlink(path_ / name))
      refuse(fmt::format("'{}' has come while the run was at work; move it away, and the same command goes on", name));
  }
  reopen_journal();
  const auto staged = staged_hashes();
  journal_->add({{publishing_key, {}}});
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
  if (replaced_) remove_drawn_figures(path_, *replaced_);  // they show the old result
  for (const auto& [file, hash] : staged) {
    if (file != manifest_name) move(file);
  }
  if (replaced_) {
    for (const auto& [file, hash] : replaced_->hashes) {
      if (!staged.contains(file) && is_unchanged(path_, file, hash)) fs::remove(path_ / file);
    }
    for (const std::string& file : replaced_->unhashed) {
      if (!staged.contains(file) && holds_file(path_, file)) fs::remove(path_ / file);
    }
  }
  for (const fs::path& folder : folders) flush_to_disk(folder);
  move(manifest_name);
  flush_to_disk(path_);
  journal_.reset();
  staging_.reset();
  clear_up();
}

/// A shard keeps its journal. What another build has begun goes, as was said, unless that build is at a run of its own; what cannot be read
/// stays, and so does another run's.
void ResultFolder::clear_up() {
  remove_leftovers(path_);
  std::map<std::string, bool> is_ours;  // of the journals of this run: else another build's
  for (const std::string& name : journals_in(path_)) {
    if (!Journal::is_one(path_ / name)) continue;
    const auto whose = parse_identity(read_journal(path_ / name).identity);
    if (whose && identity_difference(*whose, identity_).empty()) is_ours[name] = whose->program == identity_.program;
  }
  const auto begun = is_ours.find(journal_name);
  const bool is_ended = begun == is_ours.end() || begun->second;
  for (const auto& [name, ours] : is_ours) {
    const bool is_kept = name == journal_name && !identity_.shard.empty();
    if (!is_kept && (ours || is_ended)) fs::remove(path_ / name);
  }
  if (!is_ended) {
    notes_.push_back(fmt::format("{}: begun by another build of the program, whose command continues it",
                                 one_line((path_ / journal_name).string())));
  }
  if (!identity_.shard.empty()) return;
  try {
    if (manifest_in(old_manifest_name)) fs::remove(path_ / old_manifest_name);
  } catch (const UsageError&) {  // not ours
  }
}

void refuse_place(const fs::path& place, const std::string& why) {
  throw UsageError(fmt::format("{}: {}", one_line(place.string()), why));
}

bool remove_result(const fs::path& folder) {
  const Manifest manifest = parse_manifest(file_text(folder / manifest_name), (folder / manifest_name).string());
  std::vector<std::string> files = {manifest_name, "report.html"};
  std::ranges::copy(manifest.files(), std::back_inserter(files));
  std::set<fs::path, std::greater<>> folders = {folder};  // what lies in a folder comes before it
  for (const std::string& file : files) {
    if (!holds_file(folder, file)) continue;
    fs::remove(folder / file);
    for (fs::path above = fs::path(file).parent_path(); !above.empty(); above = above.parent_path())
      folders.insert(folder / above);
  }
  std::error_code not_empty;
  for (const fs::path& each : folders) fs::remove(each, not_empty);
  return !fs::exists(folder);
}

KeptResult kept_result(const fs::path& folder, const std::string& file) {
  KeptResult out;
  static_cast<Manifest&>(out) = parse_manifest(file_text(folder / manifest_name), file);
  out.folder = folder;
  out.run.config = exact_text(nlohmann::json::parse(out.run.config), ",", ":");
  out.software = this_software();
  out.software.version = out.version;
  if (!out.release_date.empty()) out.software.date = out.release_date;
  out.citation = {.experiment = out.run.experiment,
                  .question = out.question,
                  .run_id = out.run_id,
                  .seed = out.run.seed,
                  .commit = out.commit,
                  .dirty = out.dirty,
                  .date = out.finished.substr(0, 10)};
  return out;
}

std::string part_of_run(const fs::path& folder) {
  if (const auto seal = parse_seal(file_text(folder / seal_name)))
    return fmt::format("is shard {} of a run; thinwall merge makes a result of all of them", to_text(seal->shard));
  if (!fs::exists(folder / journal_name)) return "";
  return "holds a run that is not finished; the run's own command continues it";
}

void require_result(const fs::path& folder) {
  if (!fs::exists(folder)) refuse_place(folder, "there is no such folder; name the folder of a result");
  if (!fs::is_directory(folder)) refuse_place(folder, "is not a folder; name the folder of a result");
  const fs::path file = folder / manifest_name;
  if (!fs::exists(file)) {
    const std::string part = part_of_run(folder);
    refuse_place(folder, part.empty()
                             ? "holds no manifest.json; name the folder of a result, as `thinwall run` leaves it"
                             : part);
  }
  if (!fs::is_regular_file(file)) refuse_place(folder, "its manifest.json is not a file");
}

KeptResult read_result(const fs::path& folder) try {
  require_result(folder);
  return kept_result(folder, (folder / manifest_name).string());
} catch (const fs::filesystem_error& error) {
  refuse_place(error.path1(), "cannot be read: " + error.code().message());
}

std::vector<std::string> write_results(ResultFolder& folder, const RunRecord& run, const Outcome& outcome) {
  ReportParts parts;
  parts.citation = bibtex(this_software(), citation_of(run));
  stage_tables(folder, run, outcome);
  stage_figures(folder, outcome, parts);
  for (const TextFile& file : outcome.files) folder.stage(file.name, file.text);
  folder.stage("cite.bib", parts.citation);
  folder.stage("resolved.toml", resolved_toml(run));

  auto hashes = folder.staged_hashes();
  parts.files = {"manifest.json"};
  for (const auto& [file, hash] : hashes) parts.files.push_back(file);
  folder.stage("report.html", report_page(run, outcome, parts));
  const std::vector<std::string> unhashed = take_timings(hashes, outcome);
  folder.stage("manifest.json", manifest_text(run, outcome, hashes, unhashed));
  folder.publish();
  if (parts.why_no_svg.empty()) return {};
  return {"figures were not drawn: " + parts.why_no_svg};
}

}  // namespace thinwall
