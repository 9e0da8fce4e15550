#include <thinwall/experiments/program/command.hpp>

#include <filesystem>
#include <memory>
#include <ostream>
#include <sstream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/comparison.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/program/run.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

constexpr const char* reproduce_examples = R"(  thinwall reproduce results/thin_wall
  thinwall reproduce results/thin_wall --json
  thinwall reproduce results/thin_wall --out again --threads 1
)";

constexpr const char* reproduce_footer =
    R"(Runs again what RESULT/manifest.json says, into a folder beside it that is removed if all is the same, and compares every
file that the manifest hashes. Times are not compared, nor the date and commit in cite.bib.
Exit code 0: identical; 1: a file differs.
)";

struct ReproduceText {
  std::string target;
  OptionText out, threads, benchmarks;
  bool json = false;
};

/// A result and where its rerun goes.
struct Rerun {
  fs::path result, out;
  Manifest recorded;
  std::vector<std::string> changed;  ///< files of the result that are not as they were written
  bool stays = false;                ///< the rerun is kept even if it is the same
};

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw UsageError(fmt::format("{}: {}", one_line(path.string()), why));
}

Manifest manifest_in(const fs::path& folder) {
  return parse_manifest(file_text(folder / manifest_name), (folder / manifest_name).string());
}

Rerun prepare(const ReproduceText& text) {
  if (text.target.empty()) {
    throw UsageError("reproduce: the folder of a result is missing; see thinwall reproduce --help");
  }
  Rerun out;
  out.result = fs::path(text.target).lexically_normal();
  if (!out.result.has_filename()) out.result = out.result.parent_path();  // `results/mine/`
  if (!fs::is_directory(out.result)) refuse(out.result, "there is no such folder; name the folder of a result");
  if (!fs::exists(out.result / "manifest.json")) {
    refuse(out.result, "holds no manifest.json; name the folder of a complete result");
  }
  out.recorded = manifest_in(out.result);
  out.changed = files_changed_since(out.result, out.recorded);
  out.out = parse_folder(text.out);
  if (out.out.empty()) {
    const bool named = out.result.filename() != "." && out.result.filename() != "..";
    out.out = (named ? out.result : fs::canonical(out.result)).string() + ".again";
  }
  if (fs::exists(out.out / "manifest.json")) {
    refuse(out.out, "holds a result already; delete it, or name another folder with --out");
  }
  const std::string within = fs::weakly_canonical(out.out).lexically_relative(fs::canonical(out.result)).string();
  if (stays_within(within) || within == ".")
    refuse(out.out, "lies in the result itself; name another folder with --out");
  out.stays = text.out.has_value();
  if (!out.stays && fs::exists(out.out) && !fs::exists(out.out / "journal.tsv")) {  // it would be removed in the end
    refuse(out.out, "is there already; delete it, or name another folder with --out");
  }
  return out;
}

/// Throws UsageError if this build cannot run it.
RunWish wish_of(const Rerun& rerun, const ReproduceText& text, std::span<const Experiment> experiments) {
  RunRecord record;
  static_cast<RunIdentity&>(record) = rerun.recorded.run;
  RunWish wish;
  wish.target = (rerun.result / "resolved.toml").string();  // the same text, unless somebody changed it
  wish.request.text = resolved_toml(record);
  wish.request.options = {rerun.recorded.run.seed, rerun.recorded.run.trials, parse_threads(text.threads)};
  wish.request.benchmarks = text.benchmarks.value_or("");
  wish.out = rerun.out.string();
  wish.launch = Launch{};
  configure_run(wish.target, wish.request, experiments);
  return wish;
}

std::string json_reply(const Rerun& rerun, const RerunComparison& found) {
  using nlohmann::ordered_json;
  const bool same = found.differences.empty();
  ordered_json reply = {{"result", rerun.result.string()},
                        {"out", same && !rerun.stays ? ordered_json() : ordered_json(rerun.out.string())},
                        {"identical", same},
                        {"files", found.files},
                        {"changed_since_written", rerun.changed},
                        {"differences", ordered_json::array()},
                        {"explained_by_hand", found.explained_by_hand},
                        {"facts", ordered_json::array()}};
  for (const FileDifference& difference : found.differences) {
    const bool cell = difference.kind == FileDifference::Kind::cell,
               line = difference.kind == FileDifference::Kind::line;
    const bool row = cell || difference.kind == FileDifference::Kind::row;
    reply["differences"].push_back({{"file", difference.file},
                                    {"row", row ? ordered_json(difference.row) : ordered_json()},
                                    {"column", cell ? ordered_json(difference.column) : ordered_json()},
                                    {"line", line ? ordered_json(difference.row) : ordered_json()},
                                    {"recorded", difference.recorded},
                                    {"rerun", difference.rerun},
                                    {"text", to_text(difference)}});
  }
  for (const FactChange& change : found.facts) {
    reply["facts"].push_back({{"fact", change.fact}, {"recorded", change.recorded}, {"rerun", change.rerun}});
  }
  return json_line(reply);
}

std::string facts_text(const std::vector<FactChange>& facts) {
  std::string out;
  for (const FactChange& change : facts) {
    out += fmt::format("  {}: recorded {}, rerun {}\n", change.fact, one_line(change.recorded), one_line(change.rerun));
  }
  return out;
}

std::string text_reply(const Rerun& rerun, const RerunComparison& found) {
  const std::string result = one_line(rerun.result.string());
  if (found.differences.empty()) {
    const std::string facts = facts_text(found.facts);
    return fmt::format("identical: {} files of {} came out the same\n", found.files, result) +
           (facts.empty() ? "by the same program on the same machine\n" : "although these differ:\n" + facts) +
           (rerun.stays ? fmt::format("The rerun is in {}\n", one_line(rerun.out.string())) : "");
  }
  std::string out = fmt::format("differs: {} of {} files of {}\n", found.differences.size(), found.files, result);
  for (const FileDifference& difference : found.differences) out += "  " + to_text(difference) + "\n";
  if (found.explained_by_hand) {
    out += "The changes made since it was written explain it: as it was written, the result came out the same.\n";
  } else if (!found.facts.empty()) {
    out += "What may explain it:\n" + facts_text(found.facts);
  } else {
    out += "Nothing recorded explains it: the same program, on a machine of the same name.\n";
  }
  return out + fmt::format("The rerun is kept in {}\n", one_line(rerun.out.string()));
}

int reproduce(const ReproduceText& text, const Call& call) {
  const Rerun rerun = prepare(text);
  const RunWish wish = wish_of(rerun, text, call.experiments);
  for (const std::string& file : rerun.changed) {
    const bool lost = !fs::exists(rerun.result / file);
    call.err << fmt::format("{}: {} since it was written\n", one_line((rerun.result / file).string()),
                            lost ? "was lost" : "was changed");
  }
  std::ostringstream unread;
  const int status = perform_run(wish, {call.experiments, call.argv, unread, call.err});
  if (status == exit_interrupted) return status;
  const RerunComparison found =
      compare_rerun(rerun.result, rerun.recorded, rerun.changed, rerun.out, manifest_in(rerun.out));
  call.out << (text.json ? json_reply(rerun, found) : text_reply(rerun, found));
  if (!found.differences.empty()) return exit_failed;
  if (!rerun.stays && !remove_result(rerun.out)) {
    call.err << fmt::format("{}: stays, for it holds what the rerun did not write\n", one_line(rerun.out.string()));
  }
  return exit_done;
}

Action declare_reproduce(CLI::App& self) {
  const auto text = std::make_shared<ReproduceText>();
  self.footer(reproduce_footer);
  add_target(self, "result", text->target, "The folder of a complete result", "RESULT");
  add_text(self, "--out", text->out, "Where the rerun goes, and stays (default: RESULT.again, removed if identical)",
           "DIR");
  add_threads(self, text->threads);
  add_benchmarks(self, text->benchmarks);
  add_json(self, text->json);
  return [text](const Call& call) { return reproduce(*text, call); };
}

}  // namespace

Command reproduce_command() {
  return {"reproduce", "Run a result again from its manifest, and say what differs", reproduce_examples,
          declare_reproduce};
}

}  // namespace thinwall
