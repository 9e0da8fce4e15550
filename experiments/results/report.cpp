#include <thinwall/experiments/results/report.hpp>

#include <fmt/format.h>

#include <thinwall/experiments/figures/plot.hpp>
#include <thinwall/experiments/results/prose.hpp>
#include <thinwall/experiments/results/report_style.hpp>
#include <thinwall/experiments/results/resolved_toml.hpp>
#include <thinwall/experiments/tables/shown_table.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {
namespace {

/// Paragraphs are separated by an empty line.
std::string paragraphs(const std::string& text, const std::string& attributes = {}) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find("\n\n", at), text.size());
    if (end > at) out += fmt::format("<p{}>{}</p>\n", attributes, html_escaped(text.substr(at, end - at)));
    at = end + 2;
  }
  return out;
}

std::string figure_html(const Figure& figure, const ReportParts& parts) {
  const auto svg = parts.svgs.find(figure.name);
  std::string picture;
  if (svg != parts.svgs.end()) {
    picture = "<div class=\"wide\" tabindex=\"0\">" + inline_svg(svg->second, figure.name, figure.title) + "</div>";
  } else {
    picture = fmt::format(
        "<p class=\"verdict failed\">{}: not drawn ({}). To draw it: <code>cd plots &amp;&amp; gnuplot {}.gp</code></p>",
        html_escaped(figure.title), html_escaped(parts.why_no_svg), figure.name);
  }
  return fmt::format("<figure>\n{}\n<figcaption>{}</figcaption>\n</figure>\n", picture, html_escaped(figure.caption));
}

std::string fact(std::string_view name, std::string_view value) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_escaped(name), html_escaped(value));
}

std::string provenance(const RunRecord& run) {
  const BuildRecord& build = run.build;
  std::string libraries;
  for (const auto& [name, version] : build.libraries) {
    libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
  }
  const std::string changes = build.dirty ? ", with changes that are not committed" : "";
  return "<dl>\n" + fact("Program", fmt::format("thinwall {}, commit {}{}", build.version, build.commit, changes)) +
         fact("Compiler", fmt::format("{}, {} ({})", build.compiler, build.flags, build.build_type)) +
         fact("Libraries", libraries) +
         fact("Machine",
              fmt::format("{}, {} hardware threads, {}", run.machine.cpu, run.machine.cores, run.machine.system)) +
         fact("Run", fmt::format("{} to {}, {} thread{}", utc_text(run.started), utc_text(run.finished), run.threads,
                                 run.threads == 1 ? "" : "s")) +
         fact("Size", fmt::format("{} units, {} trials", grouped_text(static_cast<std::int64_t>(run.units)),
                                  grouped_text(run.total_trials))) +
         fact("Seed", std::to_string(run.seed)) + fact("Run id", run_id(run)) + fact("Command", shell_line(run.argv)) +
         "</dl>\n";
}

std::string file_links(const std::vector<std::string>& files) {
  std::string out = "<ul>\n";
  for (const std::string& file : files) out += fmt::format("<li><a href=\"{0}\">{0}</a></li>\n", html_escaped(file));
  return out + "</ul>\n";
}

std::string reproduction(const RunRecord& run) {
  const char* where = run.default_config ? "" : "<p>From inside this folder:</p>\n";
  return fmt::format(
      "{}<pre><code>{}</code></pre>\n<p>The same program gives the same counts and times of impact to the bit, for any "
      "number of threads. Timings differ from run to run.</p>\n",
      where, html_escaped(reproduce_line(run)));
}

std::string configuration(const RunRecord& run) {
  return fmt::format(
      "<p>Every setting, as <a href=\"resolved.toml\">resolved.toml</a> holds it.</p>\n<pre><code>{}</code></pre>\n",
      html_escaped(resolved_toml(run)));
}

std::string section(std::string_view heading, const std::string& html) {
  return html.empty() ? "" : fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", html_escaped(heading), html);
}

std::string verdict(bool passed) {
  return passed
             ? "<p class=\"verdict\">The self-test passed.</p>\n"
             : "<p class=\"verdict failed\"><strong>The self-test failed:</strong> the numbers below do not agree with "
               "what they were tested against. Do not cite them. Chance fails one correct run in a hundred or fewer: another "
               "seed tells.</p>\n";
}

}  // namespace

std::string report_page(const RunRecord& run, const Outcome& outcome, const ReportParts& parts) {
  const Prose prose = prose_of(run.experiment);
  std::string figures, tables, method = prose.method, limits = prose.limits;
  for (std::size_t i = 1; i < outcome.figures.size(); ++i) figures += figure_html(outcome.figures[i], parts);
  for (const Table& table : outcome.tables) tables += table.in_report ? html_table(table) : "";
  for (const Section& part : outcome.sections) {
    if (part.heading == "Limits") continue;
    if (part.heading != "Method") method += fmt::format("<h3>{}</h3>\n", html_escaped(part.heading));
    method += paragraphs(part.text);
  }
  for (const Section& part : outcome.sections) limits += part.heading == "Limits" ? paragraphs(part.text) : "";
  return fmt::format(
             "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" href=\"data:,\">\n"
             "<title>{0}: {1}</title>\n<style>{2}</style>\n</head>\n<body>\n<main>\n"
             "<p class=\"kicker\" id=\"top\">thinwall {3} &middot; {0} &middot; {4}</p>\n<h1>{1}</h1>\n",
             html_escaped(run.experiment), html_escaped(run.question), report_style, html_escaped(run.build.version),
             utc_text(run.finished).substr(0, 10)) +
         paragraphs(outcome.answer, " class=\"answer\"") + verdict(outcome.self_test_passed) +
         (outcome.figures.empty() ? "" : figure_html(outcome.figures.front(), parts)) +
         section("More figures", figures) + section("Tables", tables) + section("Method", method) +
         section("Limits", limits) + section("How to reproduce", reproduction(run)) +
         section("Configuration", configuration(run)) + section("Provenance", provenance(run)) +
         section("Background", prose.pages) + section("Files", file_links(parts.files)) +
         section("How to cite", fmt::format("<pre><code>{}</code></pre>\n", html_escaped(parts.citation))) +
         "</main>\n</body>\n</html>\n";
}

}  // namespace thinwall
