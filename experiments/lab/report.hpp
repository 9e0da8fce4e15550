#pragma once
/// The report: one page of HTML that holds all it shows, its prose from docs/.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/manifest.hpp>

namespace thinwall {

// ---- What docs/NAME.md says about an experiment, for its report: the page is embedded in the program as its defaults are.

struct Prose {
  std::string method;  ///< HTML of its sections, but for its results, which are of another run, and its limits
  std::string limits;  ///< HTML of the section "Limits"
  std::string pages;   ///< HTML of the pages that those link to, folded: a report needs no other file
};

/// Links lead to the section or the page in the report; one to another file of the project becomes its words, one to the web its
/// words and the address.
/// Empty where there is no such page.
Prose prose_of(std::string_view experiment);

// ---- The result as one HTML page that stands alone: no script, no request to anywhere.

struct ReportParts {
  std::map<std::string, std::string> svgs;  ///< by the figure's name; one that could not be drawn is missing
  std::string why_no_svg;                   ///< empty if every figure was drawn
  std::vector<std::string> files;           ///< paths of the other files of the result, to link to
  std::string citation;                     ///< BibTeX
};

std::string report_page(const RunRecord& run, const Outcome& outcome, const ReportParts& parts);

// ---- How the report looks, on a screen of any width and on paper.

inline constexpr std::string_view report_style = R"css(
:root { color-scheme: light; --ink: #1b1b1b; --soft: #595959; --line: #d9d9d9; --tint: #f5f6f8; --link: #005a9c; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: var(--ink); font: 17px/1.55 system-ui, "Segoe UI", Roboto, Helvetica, Arial, sans-serif;
  overflow-wrap: break-word; }
main { max-width: 56rem; margin: 0 auto; padding: 2rem 1.1rem 4rem; }
h1 { font-size: 1.75rem; line-height: 1.25; margin: .2rem 0 1rem; text-wrap: balance; }
h2 { font-size: 1.2rem; margin: 2.4rem 0 .6rem; padding-top: 1.2rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.02rem; margin: 1.6rem 0 .3rem; }
p { margin: .7rem 0; max-width: 46rem; }
li { max-width: 44rem; }
summary { cursor: pointer; margin: .5rem 0; }
details[open] { border-left: 2px solid var(--line); padding-left: 1rem; }
h4 { font-size: .95rem; margin: 1.3rem 0 .3rem; }
figcaption { max-width: 46rem; }
a { color: var(--link); }
.kicker { color: var(--soft); margin: 0; font-size: .9rem; }
.answer { font-size: 1.15rem; }
.verdict { border-left: 4px solid #009e73; background: var(--tint); padding: .5rem .8rem; }
.verdict.failed { border-color: #d55e00; }
figure { margin: 1.6rem 0; }
figure svg { display: block; width: 100%; height: auto; }
figcaption, .caption { color: var(--soft); font-size: .92rem; }
figcaption { margin-top: .5rem; }
.caption { margin: 1.8rem 0 .4rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .88rem; font-variant-numeric: tabular-nums; }
thead th { border-top: 2px solid var(--ink); border-bottom: 1px solid var(--ink); vertical-align: bottom; }
tbody tr:last-child td { border-bottom: 2px solid var(--ink); }
th, td { padding: .25rem .7rem .25rem 0; text-align: left; font-weight: normal; }
thead th { font-weight: 600; }
th.n, td.n { text-align: right; }
td.n { white-space: nowrap; }
.wide th:first-child, .wide td:first-child { position: sticky; left: 0; background: #fff; }
.u { white-space: nowrap; }
.i { color: var(--soft); }
tbody tr:hover { background: var(--tint); }
pre { background: var(--tint); padding: .7rem .9rem; overflow-x: auto; font-size: .85rem; line-height: 1.45; }
code { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; }
dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: .25rem 1.2rem; font-size: .92rem; }
dt { color: var(--soft); }
dd { margin: 0; overflow-wrap: anywhere; }
sup { line-height: 0; }
ul { padding-left: 1.2rem; columns: 17rem; }
.caption a { white-space: nowrap; }
@media (max-width: 40rem) {
  body { font-size: 16px; }
  h1 { font-size: 1.4rem; }
  figure .wide svg { min-width: 34rem; }
  figure .wide::before { content: "Wider than this screen: move it sideways \2192"; position: sticky; left: 0; font-size: .8rem; color: var(--soft); }
  dl { grid-template-columns: minmax(0, 1fr); }
  dd { margin-bottom: .4rem; }
}
@media print {
  figure svg { max-height: 14.5cm; }
  body { font-size: 10pt; }
  main { max-width: none; padding: 0; }
  a { color: inherit; text-decoration: none; }
  .wide, pre { overflow: visible; }
  pre { white-space: pre-wrap; }
  table { font-size: 7.5pt; }
  th, td { padding-right: .4rem; }
  .wide table.many { font-size: 5.5pt; }
  figure, tr, pre { break-inside: avoid; }
  h2, h3, .caption { break-after: avoid; }
  thead { display: table-header-group; }
}
)css";

}  // namespace thinwall
