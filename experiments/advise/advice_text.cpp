#include <thinwall/experiments/advise/advice_text.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/advise/words.hpp>
#include <thinwall/experiments/thin_wall/model.hpp>

namespace thinwall {

namespace {

constexpr const char* limits =
    "Holds for one infinite wall at rest, straight flight without rotation, and a first contact that is anywhere in its "
    "step alike. At a wall that ends, a ray from the center misses what only the rim meets, and tested poses are "
    "never safe.";

constexpr const char* header =
    "                           chance of  seen late by up to  time a step [ns]          longest step\n"
    "  method                   tunneling  [m]       [steps]   clear        contact      that does\n";

/// A median with as many decimals as its interval bears out.
std::string time_text(const QueryTime& time) {
  const double half = std::max(time.spread.upper - time.median, time.median - time.spread.lower);
  if (half > 9.9) return fmt::format("{:.0f} +-{:.0f}", time.median, std::ceil(half));
  return fmt::format("{:.1f} +-{:.1f}", time.median, std::max(0.1, std::ceil(10 * half) / 10));
}

std::string step_text(const std::optional<double>& step) {
  if (!step) return "none";
  return *step == allowed_step.upper ? "any" : rounded_down_text(*step, 4) + " s";
}

std::string row_text(const AdviceRow& row, const char* mark, double step_length) {
  const std::optional<double>& chance = row.theory.probability;
  const bool never_seen = chance && *chance == 1;
  const std::optional<double> latest = never_seen ? std::nullopt : row.theory.largest_lateness();
  return fmt::format("{} {:<24} {:<10} {:<9} {:<9} {:<12} {:<12} {}\n", mark, row.method.name,
                     chance ? percent_text(*chance) : "-", latest ? rounded_text(*latest, 3) : "-",
                     latest ? rounded_text(*latest / step_length, 3) : "-", time_text(row.cost.clear),
                     time_text(row.cost.contact), step_text(row.longest_step));
}

std::string table_text(const Advice& advice) {
  std::string text = header;
  bool met = true;
  for (const AdviceRow& row : advice.rows) {
    if (met && !row.meets) text += "These do not meet the wish at this step:\n";
    met = row.meets;
    text += row_text(row, &row == advice.advised() ? ">" : " ", step_length(advice.wish.cell));
  }
  return text;
}

/// One line for all numbers of poses.
std::string formulas_text(const Advice& advice) {
  std::vector<std::string> lines;
  for (const AdviceRow& row : advice.rows) {
    const std::string name = row.method.poses > 1 ? "substeps_n" : row.method.name;
    const bool known = row.theory.probability.has_value();
    const std::string line = fmt::format("  {:<26}{:<41}{}\n", name, known ? row.theory.why : "no formula",
                                         known ? row.theory.why_late : "no formula");
    if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
  }
  std::string text =
      "Formulas: v speed, h step, n poses a step, w thickness, r radius, a angle: docs/tunneling_theory.md.\n"
      "  method                    chance of tunneling                      seen late by up to [m]\n";
  for (const std::string& line : lines) text += line;
  return text;
}

}  // namespace

std::string advice_text(const Advice& advice) {
  return question_words(advice.wish) + wrapped("Wanted: " + wanted_words(advice.wish) + ".") + "\n" +
         wrapped(advice_sentence(advice)) + "\n" + table_text(advice) +
         wrapped(
             "A clear step ends before the wall, in the next is contact; a query of each, on this machine: the median and a "
             "95 % interval. A method counts by the dearer of the two.") +
         "\n" + formulas_text(advice) + "\n" + wrapped(limits);
}

}  // namespace thinwall
