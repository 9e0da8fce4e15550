/// The commands about results: report, cite, merge and reproduce.
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <ostream>
#include <sstream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <thinwall/experiments/check/check.hpp>
#include <thinwall/experiments/lab/comparison.hpp>
#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/program/run.hpp>

namespace thinwall {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* report_examples = R"(  thinwall report results/thin_wall
  thinwall report results/thin_wall --check
  thinwall report results/thin_wall --figures pdf,tex
)";

constexpr const char* report_footer =
    R"(--check reads every file: hashes, missing and unknown files, each CSV against datapackage.json, the report, the figures,
resolved.toml and cite.bib. Each fault is a line; one is enough for exit code 1. A failed self-test is no fault of the folder, and is said.
--figures draws plots/NAME.pdf; with tex, plots/NAME-latex.tex and NAME-latex.pdf, to \input in LaTeX (graphicx, color).
They are not part of the result: the manifest does not name them.
)";

struct ReportText {
  std::string target;
  OptionText figures;
  bool check = false, json = false;
};

ordered_json result_json(const KeptResult& result) {
  return {{"folder", result.folder.string()},
          {"experiment", result.citation.experiment},
          {"run_id", result.citation.run_id},
          {"question", result.citation.question},
          {"answer", result.answer},
          {"summary", result.summary},
          {"self_test_passed", result.self_test_passed},
          {"reproduce", result.reproduce},
          {"report", (result.folder / "report.html").string()}};
}

std::string result_text(const KeptResult& result) {
  std::string out = wrapped(result.question) + "\n" + wrapped(result.answer) + "\n" + summary_text(result.summary);
  if (!result.self_test_passed) out += "The self-test failed: do not cite these numbers.\n\n";
  return out + "report: " + one_line((result.folder / "report.html").string()) + "\n";
}

/// Checks a folder that may hold anything.
int check(const ReportText& text, const Call& call) try {
  if (!fs::is_directory(text.target)) read_result(text.target);  // says why it cannot
  const std::vector<std::string> faults = check_result(text.target);
  const bool whole = faults.empty(), doubtful = whole && !read_result(text.target).self_test_passed;
  if (text.json) {
    ordered_json reply = {{"folder", text.target}, {"whole", whole}, {"faults", faults}};
    if (whole) reply["self_test_passed"] = !doubtful;
    call.out << json_line(reply);
  } else {
    for (const std::string& fault : faults) call.out << fault << "\n";
    call.out << fmt::format("{}: {}\n", one_line(text.target),
                            doubtful ? "whole, but its self-test failed: do not cite its numbers"
                            : whole  ? "whole: no fault was found"
                                     : plural_text(std::ssize(faults), "fault"));
  }
  return whole ? exit_done : exit_failed;
} catch (const fs::filesystem_error& error) {
  refuse_place(error.path1(), "cannot be read: " + error.code().message());
}

int report(const ReportText& text, const Call& call) try {
  if (text.target.empty()) throw UsageError("report: the folder of a result is missing; see thinwall report --help");
  const std::vector<std::string> formats = parse_figures(text.figures);
  DrawnFigures drawn;
  if (!formats.empty()) {
    read_result(text.target);
    FolderLock lock;  // what is drawn must not be replaced meanwhile
    if (!lock.take(text.target, true)) throw UsageError(one_line(text.target) + ": a run is at work here; wait for it");
    drawn = draw_figures(text.target, formats);
    for (const std::string& trouble : drawn.troubles) call.err << one_line(trouble) << "\n";
  }
  const int drawing = drawn.troubles.empty() ? exit_done : exit_failed;
  if (text.check) return std::max(check(text, call), drawing);

  const KeptResult result = read_result(text.target);
  if (text.json) {
    ordered_json reply = result_json(result);
    reply["drawn"] = drawn.files;
    call.out << json_line(reply);
  } else {
    call.out << result_text(result);
    for (const std::string& file : drawn.files)
      call.out << "drawn: " << one_line((result.folder / file).string()) << "\n";
  }
  return drawing;
} catch (const fs::filesystem_error& error) {
  refuse_place(error.path1(), "cannot be written: " + error.code().message());
}

void add_report(CLI::App& self, ReportText& text) {
  self.footer(report_footer);
  add_target(self, "result", text.target, "The folder of a result", "RESULT");
  add_flag(self, "--check", text.check, "Check the whole folder, and name each fault found");
  add_figures(self, text.figures);
  add_json(self, text.json);
}

}  // namespace

void add_figures(CLI::App& self, OptionText& figures) {
  add_text(self, "--figures", figures, "Draw the figures for print as well, from their data", "pdf,tex");
}

std::vector<std::string> parse_figures(const OptionText& figures) {
  constexpr std::array<std::string_view, 2> allowed = {"pdf", "tex"};
  std::vector<std::string> out;
  if (!figures) return out;
  for (const std::string_view part : split(*figures, ',')) {
    const std::string format = parse_choice("--figures", std::string(part), allowed);
    if (std::ranges::find(out, format) == out.end()) out.push_back(format);
  }
  return out;
}

namespace {

constexpr const char* cite_examples = R"(  thinwall cite                      the software
  thinwall cite results/thin_wall    the software, and that result
)";

std::string json_reply(const SoftwareCitation& software, const std::optional<ResultCitation>& result) {
  ordered_json reply = {{"software", json_of(software)}};
  reply["software"]["bibtex"] = bibtex(software);
  if (result) {
    reply["result"] = json_of(*result);
    reply["result"]["bibtex"] = bibtex(*result);
  }
  return json_line(reply);
}

struct CiteText {
  std::string target;
  bool given = false;  ///< the target, be it empty
  bool json = false;
};

int cite(const CiteText& text, const Call& call) {
  SoftwareCitation software = this_software();
  std::optional<ResultCitation> result;
  if (text.given && text.target.empty()) throw UsageError("cite: the folder of a result is empty; name one, or none");
  if (text.given) {
    const KeptResult kept = read_result(text.target);
    if (!kept.self_test_passed) call.err << "its self-test failed: do not cite its numbers\n";
    software = kept.software;
    result = kept.citation;
  }
  call.out << (text.json ? json_reply(software, result) : result ? bibtex(software, *result) : bibtex(software));
  return exit_done;
}

void add_cite(CLI::App& self, CiteText& text) {
  add_target(self, "result", text.target, "The folder of a result; without one the software alone is cited", "RESULT");
  self.get_option("result")->each([&text](const std::string&) { text.given = true; });
  add_json(self, text.json);
}

constexpr const char* merge_examples = R"(  thinwall run thin_wall --shard 1/2 --out part1
  thinwall run thin_wall --shard 2/2 --out part2     on another machine
  thinwall merge part1 part2 --out results/mine
)";

constexpr const char* merge_footer =
    R"(The result is that of one run, to the byte, but for times. Every shard must be there once, whole, of the same
configuration, seed and --trials, by the same build of the program as this one.
)";

struct MergeText {
  std::vector<std::string> folders;
  OptionText out;
  bool json = false;
};

int merge(const MergeText& text, const Call& call) {
  if (text.folders.empty()) throw UsageError("merge: the folders of the shards are missing; see thinwall merge --help");
  RunWish wish;
  wish.out = parse_folder(text.out);
  wish.json = text.json;
  wish.launch = Launch{};
  wish.merged = read_shards(text.folders, this_program_sha256());
  return perform_run(wish, call);
}

void add_merge(CLI::App& self, MergeText& text) {
  self.footer(merge_footer);
  self.add_option("shards", text.folders, "The folders that thinwall run --shard left, in any order")
      ->option_text("SHARD...");
  add_out(self, text.out);
  add_json(self, text.json);
}

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

Manifest manifest_in(const fs::path& folder) {
  return parse_manifest(file_text(folder / manifest_name), (folder / manifest_name).string());
}

Rerun prepare(const ReproduceText& text) try {
  if (text.target.empty()) {
    throw UsageError("reproduce: the folder of a result is missing; see thinwall reproduce --help");
  }
  Rerun out;
  out.result = fs::path(text.target).lexically_normal();
  if (!out.result.has_filename()) out.result = out.result.parent_path();  // `results/mine/`
  require_result(out.result);
  out.recorded = manifest_in(out.result);
  out.changed = files_changed_since(out.result, out.recorded);
  out.out = parse_folder(text.out);
  if (out.out.empty()) {
    const bool named = out.result.filename() != "." && out.result.filename() != "..";
    out.out = (named ? out.result : fs::canonical(out.result)).string() + ".again";
  }
  if (fs::exists(out.out / "manifest.json")) {
    refuse_place(out.out, "holds a result already; delete it, or name another folder with --out");
  }
  const std::string within = fs::weakly_canonical(out.out).lexically_relative(fs::canonical(out.result)).string();
  if (stays_within(within) || within == ".")
    refuse_place(out.out, "lies in the result itself; name another folder with --out");
  out.stays = text.out.has_value();
  if (!out.stays && fs::exists(out.out) && !fs::exists(out.out / "journal.tsv")) {  // it would be removed in the end
    refuse_place(out.out, "is there already; delete it, or name another folder with --out");
  }
  return out;
} catch (const fs::filesystem_error& error) {
  refuse_place(error.path1(), "cannot be read: " + error.code().message());
}

/// Throws UsageError if this build cannot run it.
RunWish wish_of(const Rerun& rerun, const ReproduceText& text, std::span<const Experiment> experiments) {
  RunWish wish;
  wish.target = (rerun.result / manifest_name).string() + " (config as TOML)";
  wish.request.text = config_toml(rerun.recorded.run);
  wish.request.options = {rerun.recorded.run.seed, rerun.recorded.run.trials, parse_threads(text.threads)};
  wish.request.benchmarks = text.benchmarks.value_or("");
  wish.out = rerun.out.string();
  wish.launch = Launch{};
  configure_run(wish.target, wish.request, experiments);
  return wish;
}

std::string json_reply(const Rerun& rerun, const RerunComparison& found) {
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
    using Kind = FileDifference::Kind;
    const bool cell = difference.kind == Kind::cell, row = cell || difference.kind == Kind::row;
    const ordered_json none, number = difference.row;
    reply["differences"].push_back({{"file", difference.file},
                                    {"row", row ? number : none},
                                    {"column", cell ? ordered_json(difference.column) : none},
                                    {"line", difference.kind == Kind::line ? number : none},
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

void add_reproduce(CLI::App& self, ReproduceText& text) {
  self.footer(reproduce_footer);
  add_target(self, "result", text.target, "The folder of a complete result", "RESULT");
  add_text(self, "--out", text.out, "Where the rerun goes, and stays (default: RESULT.again, removed if identical)",
           "DIR");
  add_threads(self, text.threads);
  add_benchmarks(self, text.benchmarks);
  add_json(self, text.json);
}

}  // namespace

std::vector<Command> result_commands() {
  return {{"merge", "Make one result of the shards of a run", merge_examples, options(add_merge, merge)},
          {"report", "Print what a result says, check its folder, draw its figures for print", report_examples,
           options(add_report, report)},
          {"reproduce", "Run a result again from its manifest, and say what differs", reproduce_examples,
           options(add_reproduce, reproduce)},
          {"cite", "Print BibTeX for the software, and for a result", cite_examples, options(add_cite, cite)}};
}

}  // namespace thinwall
