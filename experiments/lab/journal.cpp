#include <thinwall/experiments/lab/journal.hpp>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <limits>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

using nlohmann::json;

json to_json(const RunIdentity& identity) {
  json out = {{"experiment", identity.experiment},
              {"config", json::parse(identity.config)},
              {"seed", identity.seed},
              {"trials", identity.trials ? json(*identity.trials) : json()},
              {"program", identity.program}};
  if (!identity.shard.empty()) out["shard"] = identity.shard;
  return out;
}

/// Of a configuration: what a TOML file can hold.
bool is_toml(const json& value) {
  if (value.is_structured()) return std::ranges::all_of(value, is_toml);
  if (value.is_number_unsigned()) return value.get<std::uint64_t>() <= std::numeric_limits<std::int64_t>::max();
  return !value.is_null();
}

bool is_name(std::string_view text) {
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string_view::npos;
}

std::string difference(const std::string& name, const json& theirs, const json& ours) {
  const auto shown = [](const json& value) { return value.is_null() ? "none" : clipped(value.dump(), 40); };
  return name + " = " + shown(theirs) + ", not " + shown(ours);
}

constexpr std::string_view family = "thinwall-journal-", magic = "thinwall-journal-2";

/// `run`: the SHA-256 of the run's identity, so that a row of another run is none of ours; empty for the row that says it.
std::string checksum(std::string_view fields, const std::string& run) {
  return sha256(fmt::format("{}\n{}", run, fields)).substr(0, 16);
}

/// A row of fields that are already separated by tabs.
std::string sealed(const std::string& fields, const std::string& run) {
  return fields + "\t" + checksum(fields, run) + "\n";
}

/// The fields of a row that was sealed; nothing if it is damaged, or of another run.
std::optional<std::vector<std::string>> unsealed(std::string_view row, const std::string& run) {
  const auto last = row.rfind('\t');
  if (last == std::string_view::npos) return std::nullopt;
  if (checksum(row.substr(0, last), run) != row.substr(last + 1)) return std::nullopt;
  std::vector<std::string> fields;
  for (const std::string_view field : split(row.substr(0, last), '\t')) fields.push_back(tsv_unescaped(field));
  return fields;
}

std::string header_row(const std::string& identity) {
  return sealed(fmt::format("{}\t{}", magic, tsv_escaped(identity)), "");
}

std::string unit_row(const std::string& key, const Journal::Row& row, const std::string& run) {
  return sealed(fmt::format("{}\t{}\t{}", tsv_escaped(key), exact_text(row.seconds), tsv_escaped(row.result)), run);
}

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw std::system_error(errno, std::generic_category(), file.string());
}

/// Of the first row; empty if that is damaged.
std::string identity_of(const std::optional<std::vector<std::string>>& fields) {
  return fields && fields->size() == 2 && fields->front() == magic ? fields->back() : std::string();
}

JournalText parse_journal(const std::string& text, const std::filesystem::path& file) {
  JournalText out;
  std::string run;
  std::string_view rest = text;
  for (int line = 1; rest.find('\n') != std::string_view::npos; ++line) {  // a last row without its end is torn
    const std::string_view row = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(row.size() + 1);
    const auto fields = unsealed(row, run);
    if (line == 1) {
      out.identity = identity_of(fields);
      run = sha256(out.identity);
      continue;
    }
    if (fields && fields->size() == 3) {
      out.rows[fields->front()] = {parsed<double>((*fields)[1]).value_or(0), fields->back()};
      out.good_rows.append(row).append("\n");
    } else {
      const std::string key = tsv_unescaped(row.substr(0, std::min<std::size_t>(row.find('\t'), 256)));
      out.damage.push_back(fmt::format("{}:{}: the row of '{}' is damaged, or of another run", one_line(file.string()),
                                       line, clipped(one_line(key), 80)));
    }
  }
  return out;
}

}  // namespace

std::string identity_text(const RunIdentity& identity) { return to_json(identity).dump(); }

RunIdentity read_identity(const JsonReader& object) {
  const json& config = object.value("config");
  if (!config.is_object() || !is_toml(config))
    object.complain("config", "an object of what TOML can hold: no null, no whole number above 2^63 - 1");
  constexpr std::uint64_t most_trials = std::numeric_limits<std::int64_t>::max();
  const bool has_trials = !object.value("trials").is_null();
  return {.experiment = object.text("experiment", is_name, "a name of a-z, 0-9 and _"),
          .config = config.dump(),
          .seed = object.whole("seed", 0, std::numeric_limits<std::uint64_t>::max()),
          .trials = has_trials ? std::optional(static_cast<std::int64_t>(object.whole("trials", 1, most_trials)))
                               : std::nullopt,
          .program = {}};
}

std::optional<RunIdentity> parse_identity(std::string_view text) {
  try {
    const JsonReader object(text, "identity");
    RunIdentity identity = read_identity(object);
    identity.program = object.text("program");
    if (object.has("shard")) identity.shard = object.text("shard");
    return identity;
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

std::string identity_difference(const RunIdentity& theirs, const RunIdentity& ours) {
  const json a = to_json(theirs), b = to_json(ours);
  for (const char* name : {"experiment", "seed", "trials", "shard"}) {
    const json left = a.value(name, json()), right = b.value(name, json());
    if (left != right) return difference(name, left, right);
  }
  const json& config = a.at("config");
  for (const auto& [key, value] : b.at("config").items()) {
    if (config.value(key, json()) != value) return difference(key, config.value(key, json()), value);
  }
  return config == b.at("config") ? "" : "keys that are unknown here";
}

bool Journal::is_one(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(file))) return false;
  std::ifstream in(file, std::ios::binary);
  std::string start(family.size(), ' ');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == family;
}

JournalText read_journal(const std::filesystem::path& file) { return parse_journal(file_text(file), file); }

Journal::Journal(std::filesystem::path file, const std::string& identity)
    : file_(std::move(file)), run_(sha256(identity)) {
  if (std::filesystem::exists(std::filesystem::symlink_status(file_)) && !is_one(file_))
    throw std::system_error(EEXIST, std::generic_category(), file_.string());  // not ours to write into
  const std::string text = file_text(file_);
  JournalText kept = parse_journal(text, file_);
  if (kept.identity != identity) kept = {};
  finished_ = std::move(kept.rows);
  for (const std::string& line : kept.damage) damage_.push_back(line + "; that unit is computed again");
  const std::string good_rows = header_row(identity) + kept.good_rows;
  if (text.starts_with(good_rows)) {  // what follows is torn; cutting it off needs no space, also where there is none
    descriptor_ = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOFOLLOW);
    if (descriptor_ < 0) fail(file_);
    if (text.size() > good_rows.size() && ::ftruncate(descriptor_, static_cast<off_t>(good_rows.size())) != 0)
      fail(file_);
    return;
  }
  const std::filesystem::path fresh = file_.parent_path() / temporary_name();
  descriptor_ = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(fresh);
  try {
    write(good_rows);
    if (::fsync(descriptor_) != 0 && errno != EINVAL) fail(fresh);
  } catch (const std::system_error&) {
    ::close(descriptor_);
    std::error_code none;
    std::filesystem::remove(fresh, none);
    throw;
  }
  std::filesystem::rename(fresh, file_);
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::add(const std::string& key, const Row& row) {
  const std::string text = unit_row(key, row, run_);
  const std::scoped_lock lock(mutex_);
  write(text);
  finished_[key] = row;
  constexpr auto pause = std::chrono::seconds(1);
  const auto now = Clock::now();
  if (now - synced_ < pause) return;
  synced_ = now;
  sync();
}

void Journal::add(const Rows& rows) {
  const std::scoped_lock lock(mutex_);
  std::string text;
  for (const auto& [key, row] : rows) {
    if (finished_.emplace(key, row).second) text += unit_row(key, row, run_);
  }
  if (text.empty()) return;
  write(text);
  sync();
}

void Journal::sync() {
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL) fail(file_);  // EINVAL: a device that keeps nothing
}

void Journal::write(const std::string& text) {
  if (broken_) throw std::system_error(broken_, std::generic_category(), file_.string());
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t wrote = ::write(descriptor_, text.data() + done, text.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) {
      broken_ = errno;  // the last row may be torn: nothing may follow it
      fail(file_);
    }
    done += static_cast<std::size_t>(wrote);
  }
}

}  // namespace thinwall
