#include <thinwall/experiments/lab/report.hpp>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <md4c-html.h>
#include <thinwall_embedded.hpp>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/table_text.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

struct Chapter {
  std::string heading;
  std::string markdown;  ///< with its heading
};

/// What stands below each heading of the second level; what comes before the first has an empty one.
std::vector<Chapter> chapters_of(std::string_view page) {
  std::vector<Chapter> chapters(1);
  bool is_code = false;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t end = std::min(page.find('\n', at), page.size());
    const std::string_view line = page.substr(at, end - at);
    if (line.starts_with("```")) is_code = !is_code;
    if (!is_code && line.starts_with("## ")) chapters.push_back({std::string(line.substr(3)), ""});
    chapters.back().markdown += std::string(line) + "\n";
    at = end + 1;
  }
  return chapters;
}

std::string html_of(std::string_view markdown) {
  std::string html;
  const auto append = [](const MD_CHAR* text, MD_SIZE size, void* out) {
    static_cast<std::string*>(out)->append(text, size);
  };
  if (md_html(markdown.data(), static_cast<MD_SIZE>(markdown.size()), append, &html, MD_DIALECT_GITHUB, 0) != 0)
    throw std::runtime_error("a page of docs/ is not Markdown");
  return html;
}

/// As forges do it: `Seen too late` is `seen-too-late`.
std::string anchor_of(std::string_view heading) {
  std::string anchor;
  for (const char letter : heading) {
    const auto byte = static_cast<unsigned char>(letter);
    if (std::isalnum(byte) != 0 || letter == '_' || letter == '-') anchor += static_cast<char>(std::tolower(byte));
    if (letter == ' ') anchor += '-';
  }
  return anchor;
}

/// Calls `change(element, content)` for every `<tag ...>content</tag>`, `tag` with the beginning of what follows it, and puts
/// what it returns in its place.
template <class Change> std::string changed(std::string_view html, std::string_view tag, const Change& change) {
  const std::string open = fmt::format("<{}", tag), close = fmt::format("</{}>", tag.substr(0, tag.find(' ')));
  std::string out;
  for (std::size_t at = 0;;) {
    const std::size_t start = html.find(open, at), head = html.find('>', start);
    const std::size_t end = html.find(close, start);
    if (start == std::string_view::npos || end == std::string_view::npos) return out += html.substr(at);
    out += html.substr(at, start - at);
    out += change(html.substr(start, head - start), html.substr(head + 1, end - head - 1));
    at = end + close.size();
  }
}

/// Headings a level lower and with anchors of their page, links as `link` turns their address, or their words where it gives
/// none; no pictures, which show other runs.
template <class Link> std::string for_report(std::string html, const std::string& page, const Link& link) {
  for (std::size_t at = 0; (at = html.find("<img", at)) != std::string::npos;)
    html.erase(at, html.find('>', at) - at + 1);
  for (const char* level : {"h3", "h2"}) {
    const std::string lower(1, static_cast<char>(level[1] + 1));
    html = changed(html, level, [&](std::string_view, std::string_view words) {
      return fmt::format("<h{0} id=\"{1}\">{2}</h{0}>", lower, page + "." + anchor_of(words), words);
    });
  }
  html = changed(html, "table", [](std::string_view, std::string_view rows) {  // scrolls where the screen is narrow
    return fmt::format("<div class=\"wide\" tabindex=\"0\"><table>{}</table></div>", rows);
  });
  return changed(html, "a href", [&](std::string_view element, std::string_view words) {
    const std::size_t from = element.find('"') + 1;
    const std::string_view address = element.substr(from, element.find('"', from) - from);
    if (address.starts_with("http")) return fmt::format("{} ({})", words, address);  // a report stands alone
    const std::string target = link(address);
    return target.empty() ? std::string(words) : fmt::format("<a href=\"{}\">{}</a>", target, words);
  });
}

/// The page that a link leads to, and the anchor there; no page if it is not one of docs/.
struct Target {
  std::string page, anchor;
};
Target target_of(std::string_view address, const std::string& own_page) {
  const std::size_t hash = address.find('#');
  const std::string anchor(hash == std::string_view::npos ? "" : address.substr(hash + 1));
  const std::string_view file = address.substr(0, hash);
  if (file.empty()) return {own_page, anchor};
  if (!file.ends_with(".md") || file.find('/') != std::string_view::npos) return {};
  const std::string page(file.substr(0, file.size() - 3));
  // Whose numbers this run did not measure.
  const bool is_of_another_experiment = page != own_page && !embedded_toml(page).empty();
  return embedded_page(page).empty() || is_of_another_experiment ? Target() : Target{page, anchor};
}

bool is_of_another_run(std::string_view heading) { return heading == "Results" || heading == "What to read from it"; }

/// What docs/NAME.md says about an experiment, for its report: the page is embedded in the program as its defaults are.
struct Prose {
  std::string method;  ///< HTML of its sections, but for its results, which are of another run, and its limits
  std::string limits;  ///< HTML of the section "Limits"
  std::string pages;   ///< HTML of the pages that those link to, folded: a report needs no other file
};

/// Links lead to the section or the page in the report; one to another file of the project becomes its words, one to the web its
/// words and the address. Empty where there is no such page.
Prose prose_of(std::string_view experiment) {
  const std::string own(experiment);
  std::vector<std::string> linked;
  const auto in_report = [&](bool follow, const std::string& page) {
    return [&, follow, page](std::string_view address) -> std::string {
      const Target target = target_of(address, page);
      if (target.page.empty()) return "";
      if (follow && target.page != own && std::ranges::find(linked, target.page) == linked.end())
        linked.push_back(target.page);
      const bool is_there = target.page == own || std::ranges::find(linked, target.page) != linked.end();
      if (!is_there) return "";
      if (target.page == own && target.anchor.empty()) return "#top";
      return "#" + target.page + (target.anchor.empty() ? "" : "." + target.anchor);
    };
  };
  Prose prose;
  for (const Chapter& chapter : chapters_of(embedded_page(experiment))) {
    if (chapter.heading.empty() || is_of_another_run(chapter.heading)) continue;
    const bool is_limits = chapter.heading == "Limits";
    std::string markdown = chapter.markdown;
    if (is_limits) markdown = markdown.substr(markdown.find('\n') + 1);  // the report has a heading for it
    (is_limits ? prose.limits : prose.method) += for_report(html_of(markdown), own, in_report(true, own));
  }
  for (const std::string& page : linked) {
    const std::string_view text = embedded_page(page);
    const std::string_view title = text.substr(2, text.find('\n') - 2);  // after `# `
    std::string html;
    for (const Chapter& chapter : chapters_of(text.substr(text.find('\n') + 1))) {
      if (!is_of_another_run(chapter.heading)) html += html_of(chapter.markdown);
    }
    prose.pages += fmt::format("<details id=\"{}\">\n<summary>{}</summary>\n{}</details>\n", page, html_escaped(title),
                               for_report(html, page, in_report(false, page)));
  }
  return prose;
}

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
  std::vector<std::string> libraries;
  for (const auto& [name, version] : build.libraries) libraries.push_back(name + " " + version);
  const std::string changes = build.dirty ? ", with changes that are not committed" : "";
  return "<dl>\n" + fact("Program", fmt::format("thinwall {}, commit {}{}", build.version, build.commit, changes)) +
         fact("Compiler", fmt::format("{}, {} ({})", build.compiler, build.flags, build.build_type)) +
         fact("Libraries", fmt::format("{}", fmt::join(libraries, ", "))) +
         fact("Machine",
              fmt::format("{}, {} hardware threads, {}", run.machine.cpu, run.machine.cores, run.machine.system)) +
         fact("Run", fmt::format("{} to {}, {}", utc_text(run.started), utc_text(run.finished),
                                 plural_text(run.threads, "thread"))) +
         fact("Size", fmt::format("{}, {}", plural_text(static_cast<std::int64_t>(run.units), "unit"),
                                  plural_text(run.total_trials, "trial"))) +
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
      "{}<pre><code>{}</code></pre>\n<p>The same program gives the same results to the bit, for any number of threads. "
      "Timings differ from run to run.</p>\n",
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
    if (!part.link.empty()) method += fmt::format("<p><a href=\"{0}\">{0}</a></p>\n", html_escaped(part.link));
  }
  for (const Section& part : outcome.sections) limits += part.heading == "Limits" ? paragraphs(part.text) : "";
  return fmt::format(
             "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" href=\"data:,\">\n"
             "<title>{0}: {1}</title>\n<style>\n{2}</style>\n</head>\n<body>\n<main>\n"
             "<p class=\"kicker\" id=\"top\">thinwall {3} &middot; {0} &middot; {4}</p>\n<h1>{1}</h1>\n",
             html_escaped(run.experiment), html_escaped(run.question), embedded_report_style(),
             html_escaped(run.build.version), utc_text(run.finished).substr(0, 10)) +
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
