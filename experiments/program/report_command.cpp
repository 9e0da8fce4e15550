#include <thinwall/experiments/program/report_command.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <ostream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/check/check.hpp>
#include <thinwall/experiments/program/exit_codes.hpp>
#include <thinwall/experiments/results/drawn_figures.hpp>
#include <thinwall/experiments/results/kept_result.hpp>
#include <thinwall/experiments/results/result_folder.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>

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
resolved.toml and cite.bib. Each fault is a line; one is enough for exit code 1.
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
  if (text.json) {
    const ordered_json reply = {{"folder", text.target}, {"whole", faults.empty()}, {"faults", faults}};
    call.out << reply.dump(-1, ' ', false, ordered_json::error_handler_t::replace) << "\n";
  } else {
    for (const std::string& fault : faults) call.out << fault << "\n";
    call.out << fmt::format("{}: {}\n", one_line(text.target),
                            faults.empty()       ? "whole: no fault was found"
                            : faults.size() == 1 ? "1 fault"
                                                 : fmt::format("{} faults", faults.size()));
  }
  return faults.empty() ? exit_done : exit_failed;
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
    call.out << reply.dump(-1, ' ', false, ordered_json::error_handler_t::replace) << "\n";
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
  for (std::size_t at = 0; at <= figures->size();) {
    const auto end = std::min(figures->find(',', at), figures->size());
    const std::string format = parse_choice("--figures", figures->substr(at, end - at), allowed);
    if (std::ranges::find(out, format) == out.end()) out.push_back(format);
    at = end + 1;
  }
  return out;
}

Command report_command() {
  return {"report", "Print what a result says, check its folder, draw its figures for print", report_examples,
          declare_report};
}

}  // namespace thinwall
