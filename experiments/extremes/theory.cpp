#include <thinwall/experiments/extremes/theory.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace thinwall {

namespace {

constexpr std::string_view closed_form = "closed_form", foil = "textbook", forward = "closed_form_forward";
constexpr double infinity = std::numeric_limits<double>::infinity();

/// [u] The contract is held to where contact lasts longer than this share of the path until it; and the forward error to
/// where the path is farther than this from the last that touches.
constexpr double least_contact = 64;

double unit_of(std::size_t precision) { return all_precisions()[precision].unit; }

/// The share of the path until contact for which the contact lasts, at least: below some u of the precision no time can say
/// that there is one.
double contact_share(const Place& place) {
  if (place.axis == ExtremeAxis::distance) return 1 / place.value;
  if (place.axis == ExtremeAxis::thickness) return place.value / extreme_at(place).distance;
  return 1;
}

/// How far the path is from the last that touches, over R: below some u rounding decides, and time is not linear in it.
double grazing_share(const Place& place) { return place.axis == ExtremeAxis::grazing ? place.value : 1; }

/// Coordinates are turned into a box's axes, which are orthonormal to this precision alone, and no wider scalar has the last word.
bool is_turned_alone(const ExtremeRow& row, std::size_t precision) {
  return row.pair->name.find("obb") != std::string_view::npos && all_precisions()[precision].name != "double";
}

/// Counts the cell, and keeps it if it is the worst.
void note(LadderTest& test, const ExtremeRow& row, double measured) {
  ++test.cells;
  if (measured <= test.measured) return;
  test.measured = measured;
  test.where = fmt::format("{}, {} {}", row.pair->name, info(row.place.axis).name, rounded_text(row.place.value, 6));
}

/// The contract, wherever a contact lasts, of the rows that are `turned` alone or of the others.
template <class Measure>
void add_contract(std::vector<LadderTest>& tests, const std::vector<ExtremeRow>& rows, std::size_t precision,
                  std::string_view what, double most, bool turned, const Measure& measure) {
  LadderTest test{.what = fmt::format("{}{}", what, turned ? "_turned" : ""), .precision = precision, .most = most};
  const double least = least_contact * unit_of(precision);
  for (const ExtremeRow& row : rows) {
    if (!ExtremeContender{closed_form, precision, PairSet::all}.has(row) || contact_share(row.place) < least) continue;
    if (what == forward && grazing_share(row.place) < least) continue;
    if (is_turned_alone(row, precision) == turned) note(test, row, measure(row.tally));
  }
  if (test.cells > 0) tests.push_back(test);
}

void add_loss(std::vector<LadderTest>& tests, const std::vector<ExtremeRow>& rows, std::size_t precision,
              const LossTheory& theory) {
  LadderTest bound{.what = "textbook_loss", .precision = precision, .most = theory.most};
  LadderTest spread{.what = "textbook_loss_spread", .precision = precision, .least = 1, .most = theory.spread};
  double least = infinity;
  for (const ExtremeRow& row : two_balls(rows, foil, precision)) {
    const double d = row.place.value;
    if (d < 10 || unit_of(precision) * d * d > 1e-3 || row.tally.timed < 4) continue;  // first order, and enough of it
    const double scaled = std::pow(d, 2 - theory.exponent), rms = row.tally.loss_rms * scaled;
    note(bound, row, row.tally.loss_max * scaled);
    note(spread, row, rms);
    least = std::min(least, rms);
  }
  spread.measured /= least;
  if (bound.cells > 0) tests.push_back(bound);
  if (spread.cells > 1) tests.push_back(spread);
}

/// The first distance at which one verdict in ten is wrong, over 1 / sqrt(u). Infinite where there is none.
void add_threshold(std::vector<LadderTest>& tests, const std::vector<ExtremeRow>& rows, std::size_t precision) {
  const double threshold = 1 / std::sqrt(unit_of(precision));
  const std::vector<ExtremeRow> along = two_balls(rows, foil, precision);  // from near to far
  if (along.empty() || along.front().place.value > threshold / 10) return;
  if (std::ranges::any_of(along, [](const ExtremeRow& row) { return row.tally.queries < 5; })) return;
  const bool reached = along.back().place.value >= 10 * threshold;
  LadderTest test{.what = "textbook_verdicts", .precision = precision, .least = 0.1, .most = reached ? 10 : infinity};
  const auto goes_wrong = [](const ExtremeRow& row) { return 10 * row.tally.far_wrong >= row.tally.queries; };
  const auto first = std::ranges::find_if(along, goes_wrong);
  if (first == along.end()) {
    test.measured = infinity;
  } else {
    note(test, *first, first->place.value / threshold);
  }
  test.cells = static_cast<std::int64_t>(along.size());
  tests.push_back(test);
}

}  // namespace

std::vector<LadderTest> ladder_tests(const std::vector<ExtremeRow>& rows, const LossTheory& theory) {
  std::vector<LadderTest> tests;
  for (const std::size_t p : precisions_of(rows)) {
    for (const bool turned : {false, true}) {
      const double most = turned ? 8 : 4;
      add_contract(tests, rows, p, forward, most, turned, [](const ExtremeTally& t) { return t.forward_max; });
      add_contract(tests, rows, p, "closed_form_backward", most, turned,
                   [](const ExtremeTally& t) { return t.backward_max; });
      add_contract(tests, rows, p, "closed_form_verdicts", break_verdict, turned,
                   [](const ExtremeTally& t) { return t.worst_wrong; });
      add_contract(tests, rows, p, "closed_form_no_answer", 0, turned,
                   [](const ExtremeTally& t) { return static_cast<double>(t.gave_up + t.invalid); });
    }
    add_loss(tests, rows, p, theory);
    add_threshold(tests, rows, p);
  }
  return tests;
}

}  // namespace thinwall
