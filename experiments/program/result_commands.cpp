#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <ostream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/check/check.hpp>
#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>
#include <thinwall/experiments/lab/settings.hpp>
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
  std::string out = result.citation.question + "\n\n" + result.answer + "\n\n";
  if (!result.summary.empty()) out += result.summary + (result.summary.ends_with('\n') ? "\n" : "\n\n");
  if (!result.self_test_passed) out += "The self-test failed: do not cite these numbers.\n\n";
  return out + "report: " + one_line((result.folder / "report.html").string()) + "\n";
}

/// Checks a folder that may hold anything.
int check(const ReportText& text, const Call& call) {
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
                            doubtful             ? "whole, but its self-test failed: do not cite its numbers"
                            : whole              ? "whole: no fault was found"
                            : faults.size() == 1 ? "1 fault"
                                                 : fmt::format("{} faults", faults.size()));
  }
  return whole ? exit_done : exit_failed;
}

int report(const ReportText& text, const Call& call) {
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
}

Action declare_report(CLI::App& self) {
  const auto text = std::make_shared<ReportText>();
  self.footer(report_footer);
  add_target(self, "result", text->target, "The folder of a result", "RESULT");
  add_flag(self, "--check", text->check, "Check the whole folder, and name each fault found");
  add_figures(self, text->figures);
  add_json(self, text->json);
  return [text](const Call& call) { return report(*text, call); };
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

Command report_command() {
  return {"report", "Print what a result says, check its folder, draw its figures for print", report_examples,
          declare_report};
}

namespace {

constexpr const char* cite_examples = R"(  thinwall cite                      the software
  thinwall cite results/thin_wall    the software, and that result
)";

std::string json_reply(const SoftwareCitation& software, const std::optional<ResultCitation>& result) {
  ordered_json reply = {{"software",
                         {{"title", software.title},
                          {"authors", software.authors},
                          {"version", software.version},
                          {"date", software.date},
                          {"license", software.license},
                          {"bibtex", bibtex(software)}}}};
  if (result) {
    reply["result"] = {{"experiment", result->experiment},
                       {"title", result->question},
                       {"run_id", result->run_id},
                       {"seed", result->seed},
                       {"commit", result->commit},
                       {"dirty", result->dirty},
                       {"date", result->date},
                       {"bibtex", bibtex(*result)}};
  }
  return json_line(reply);
}

struct CiteText {
  std::string target;
  bool given = false;  ///< the target, be it empty
  bool json = false;
};

int cite(const CiteText& text, std::ostream& out) {
  SoftwareCitation software = this_software();
  std::optional<ResultCitation> result;
  if (text.given && text.target.empty()) throw UsageError("cite: the folder of a result is empty; name one, or none");
  if (text.given) {
    const KeptResult kept = read_result(text.target);
    software = kept.software;
    result = kept.citation;
  }
  if (text.json) {
    out << json_reply(software, result);
  } else {
    out << (result ? bibtex(software, *result) : bibtex(software));
  }
  return exit_done;
}

Action declare_cite(CLI::App& self) {
  const auto text = std::make_shared<CiteText>();
  add_target(self, "result", text->target, "The folder of a result; without one the software alone is cited", "RESULT");
  self.get_option("result")->each([text](const std::string&) { text->given = true; });
  add_json(self, text->json);
  return [text](const Call& call) { return cite(*text, call.out); };
}

}  // namespace

Command cite_command() {
  return {"cite", "Print BibTeX for the software, and for a result", cite_examples, declare_cite};
}

namespace {

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

Action declare_merge(CLI::App& self) {
  const auto text = std::make_shared<MergeText>();
  self.footer(merge_footer);
  self.add_option("shards", text->folders, "The folders that thinwall run --shard left, in any order")
      ->option_text("SHARD...");
  add_out(self, text->out);
  add_json(self, text->json);
  return [text](const Call& call) { return merge(*text, call); };
}

}  // namespace

Command merge_command() { return {"merge", "Make one result of the shards of a run", merge_examples, declare_merge}; }

}  // namespace thinwall
