#include <thinwall/experiments/extremes/figures.hpp>

#include <algorithm>
#include <cmath>

#include <thinwall/experiments/extremes/heat_map.hpp>

namespace thinwall {

namespace {

using BinOfSum = std::function<std::optional<std::size_t>(const CellSum&)>;

/// In every list each bin is darker than the one before, so that the order holds in gray.
const std::vector<HeatBin>& share_bins() {
  static const std::vector<HeatBin> bins = {{"none", "#e6eef6"},
                                            {"up to 1 %", "#f2b36b"},
                                            {"up to 10 %", "#e77a44"},
                                            {"up to half", "#d7301f"},
                                            {"more", "#7f0000"}};
  return bins;
}
const std::vector<HeatBin>& error_bins() {
  static const std::vector<HeatBin> bins = {{"up to 1", "#e6eef6"},   {"up to 4", "#b4d6ee"},
                                            {"up to 100", "#eaa838"}, {"up to 1e4", "#dc741a"},
                                            {"up to 1e8", "#b43f0a"}, {"more than 1e8", "#571c06"}};
  return bins;
}
std::optional<std::size_t> share_bin(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return {};
  return bin_of(static_cast<double>(part) / static_cast<double>(whole), {0, 0.01, 0.1, 0.5});
}
std::optional<std::size_t> error_bin(double error, const CellSum& sum) {
  if (sum.timed == 0) return {};
  return bin_of(error, {1, 4, 100, 1e4, 1e8});
}

std::string label_of(std::string_view method) { return method == "textbook" ? "textbook (foil)" : std::string(method); }

/// A panel a precision, a row a method.
Figure by_method(const std::vector<ExtremeLine>& lines, PairSet pairs, std::string name, std::string title,
                 std::string caption, const std::vector<HeatBin>& bins, const BinOfSum& bin_of_sum) {
  Figure figure{std::move(name), std::move(title), std::move(caption), {}};
  const std::vector<Place> places = places_of(lines);
  for (const std::size_t p : precisions_of(lines)) {
    const std::vector<std::string_view> methods = methods_of(lines, p, pairs);
    std::vector<std::string> rows;
    for (const std::string_view method : methods) rows.push_back(label_of(method));
    if (rows.empty()) continue;
    figure.panels.push_back(heat_panel(
        std::string(all_precisions()[p].title), places, rows, bins, figure.panels.empty(),
        [&](std::size_t row, const Place& place) {
          return bin_of_sum(sum_of(lines, {.method = methods[row], .precision = p, .place = &place, .pairs = pairs}));
        }));
  }
  return figure;
}

/// The closed form on every pair: a panel a precision, a row a pair.
Figure by_pair(const std::vector<ExtremeLine>& lines) {
  Figure figure{
      "closed_form_pairs",
      "The closed form on every pair: largest forward error [u kappa t]",
      "A row is a pair of shapes. White: no hit to time, or a value that does not concern the pair, or that the "
      "precision cannot hold.",
      {}};
  const std::vector<Place> places = places_of(lines);
  for (const std::size_t p : precisions_of(lines)) {
    std::vector<std::string> rows;
    std::vector<const ExtremePair*> pairs;
    for (const ExtremePair& pair : extreme_pairs()) {
      if (std::none_of(lines.begin(), lines.end(), [&](const ExtremeLine& l) {
            return l.pair == &pair && l.precision == p && l.tally.method == "closed_form";
          })) {
        continue;
      }
      rows.emplace_back(pair.name);
      pairs.push_back(&pair);
    }
    if (rows.empty()) continue;
    figure.panels.push_back(heat_panel(
        std::string(all_precisions()[p].title), places, rows, error_bins(), figure.panels.empty(),
        [&](std::size_t row, const Place& place) -> std::optional<std::size_t> {
          for (const ExtremeLine& l : lines) {
            if (l.pair != pairs[row] || l.precision != p || l.tally.method != "closed_form" || l.place != place)
              continue;
            if (l.tally.timed == 0) return {};
            return bin_of(l.tally.forward_max, {1, 4, 100, 1e4, 1e8});
          }
          return {};
        }));
  }
  return figure;
}

/// What rounding the input changes, whatever the method: a row a precision.
Figure changed_by_rounding(const std::vector<ExtremeLine>& lines) {
  const std::vector<std::size_t> precisions = precisions_of(lines);
  std::vector<std::string> rows;
  for (const std::size_t p : precisions) rows.emplace_back(all_precisions()[p].title);
  return {
      "representation",
      "Verdicts that rounding the input alone changes",
      "Share of the queries, drawn in doubles, whose true answer is another one once they are rounded to the precision. No "
      "method is at fault: every method is judged by the answer to the rounded query.",
      {heat_panel("precision", places_of(lines), rows, share_bins(), true, [&](std::size_t row, const Place& place) {
        const CellSum sum =
            sum_of(lines, {.method = {}, .precision = precisions[row], .place = &place, .pairs = PairSet::all});
        return share_bin(sum.changed, sum.queries);
      })}};
}

/// The foil's loss between two balls, with u (d/R)^2 / 2.
Figure loss_figure(const std::vector<ExtremeLine>& lines) {
  Figure figure{
      "textbook_loss",
      "What the textbook's quadratic loses between two balls",
      "Root mean square of the error of the place of contact along the normal, over the radius, where it finds one. The "
      "lines are u (d/R)^2 / 2, one a precision; points leave them where verdicts go wrong, at d/R = 1/sqrt(u). The closed "
      "form's stay at u d/R, whose slope is half.",
      {Panel{"distance / R [1]", "error along the normal / R [1]", true, true, 1, {}}}};
  for (const std::size_t p : precisions_of(lines)) {
    const double u = all_precisions()[p].unit;
    Series theory{"theory", Mark::line, {}, {}, {}, {}};
    for (const std::string_view method : {"textbook", "closed_form"}) {
      Series points{std::string(all_precisions()[p].title) + (method == "textbook" ? ", textbook" : ", closed form"),
                    Mark::points,
                    {},
                    {},
                    {},
                    {}};
      for (const ExtremeLine& l : lines) {
        if (l.pair->name != "sphere_sphere" || l.precision != p || l.place.axis != ExtremeAxis::distance) continue;
        if (l.tally.method != method || l.tally.timed == 0 || l.place.value < 10) continue;
        const double d = l.place.value, unit = u * d * d / 2;
        if (method == "textbook") {
          theory.x.push_back(d);
          theory.y.push_back(unit);
        }
        if (l.tally.loss_rms > 0) {
          points.x.push_back(d);
          points.y.push_back(l.tally.loss_rms * unit);
        }
      }
      figure.panels[0].series.push_back(points);
    }
    figure.panels[0].series.push_back(theory);
  }
  return figure;
}

}  // namespace

std::vector<Figure> extreme_figures(const std::vector<ExtremeLine>& lines) {
  const std::string columns =
      " Columns are the values of seven axes, one extreme at a time; rows are methods. White: not asked, as the precision cannot "
      "hold the query or the axis does not concern the pair.";
  const std::string timed = " White, too: no hit to time.", balls = " Three pairs with a ball, together.",
                    boxes = " Two boxes, which have no radius to give them a normal where they touch.";
  const BinOfSum verdict = [](const CellSum& s) { return share_bin(s.far_wrong, s.queries); };
  const BinOfSum forward = [](const CellSum& s) { return error_bin(s.forward_max, s); };
  const BinOfSum backward = [](const CellSum& s) { return error_bin(s.backward_max, s); };
  const BinOfSum silence = [](const CellSum& s) -> std::optional<std::size_t> {
    if (s.queries == 0) return {};
    if (s.invalid > 0) return 10 * s.invalid > s.queries ? 4 : 3;
    if (s.gave_up > 0) return 10 * s.gave_up > s.queries ? 2 : 1;
    return 0;
  };
  const std::vector<HeatBin> silences = {{"all answered", "#e6eef6"},
                                         {"gave up, up to 10 %", "#9e9ac8"},
                                         {"gave up, more", "#54278f"},
                                         {"NaN or invalid, up to 10 %", "#f5c48a"},
                                         {"NaN or invalid, more", "#d95f02"}};
  std::vector<Figure> figures;
  const auto add = [&](Figure figure) {
    if (!figure.panels.empty()) figures.push_back(std::move(figure));
  };
  add(by_method(lines, PairSet::rounded, "verdicts", "Wrong verdicts, by more than 4 u",
                "Share of the queries whose verdict is wrong by more than 4 u of its input." + balls + columns,
                share_bins(), verdict));
  add(by_method(lines, PairSet::rounded, "forward", "Largest forward error of the time of a hit [u kappa t]",
                "The contract of the closed form is 4." + balls + columns + timed, error_bins(), forward));
  add(by_method(lines, PairSet::rounded, "backward", "Largest backward error of a hit [u]",
                "The contract of the closed form is 4." + balls + columns + timed, error_bins(), backward));
  add(by_method(lines, PairSet::four, "no_answer", "NaN, invalid, and gave up",
                "Of all four pairs. Where both occur, the NaN is shown." + columns, silences, silence));
  add(by_method(lines, PairSet::boxes, "verdicts_boxes", "Two boxes: wrong verdicts, by more than 4 u",
                "Share of the queries whose verdict is wrong by more than 4 u of its input." + boxes + columns,
                share_bins(), verdict));
  add(by_method(lines, PairSet::boxes, "forward_boxes",
                "Two boxes: largest forward error of the time of a hit [u kappa t]",
                "The contract of the closed form is 4." + boxes + columns + timed, error_bins(), forward));
  add(by_pair(lines));
  if (!lines.empty()) figures.push_back(changed_by_rounding(lines));
  const Figure loss = loss_figure(lines);
  if (std::any_of(loss.panels[0].series.begin(), loss.panels[0].series.end(),
                  [](const Series& s) { return s.mark == Mark::points && !s.x.empty(); })) {
    figures.push_back(loss);
  }
  return figures;
}

}  // namespace thinwall
