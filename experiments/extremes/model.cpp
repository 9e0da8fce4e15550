#include <thinwall/experiments/extremes/model.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace thinwall {

namespace {

/// Allowed is what a query drawn in doubles can be: beyond 1e15 its own rounding would be all that is left of a radius.
constexpr auto axes = std::to_array<AxisInfo>({
    {"scale", "scale", &Extreme::scale, {.lower = 1e-150, .upper = 1e150}},
    {"distance", "distance / R", &Extreme::distance, {.lower = 1, .upper = 1e15, .unit = "R"}},
    {"speed", "speed / R", &Extreme::speed, {.lower = 1e-12, .upper = 1e15, .unit = "R"}},
    {"thickness", "thickness", &Extreme::thickness, {.lower = 1e-16, .upper = 1}},
    {"offset", "offset / R", &Extreme::offset, {.lower = 1, .upper = 1e12, .unit = "R"}},
    {"grazing", "grazing 1 - b/R", &Extreme::grazing, {.lower = 1e-15, .upper = 1, .upper_open = true}},
    {"ratio", "size ratio", &Extreme::ratio, {.lower = 1e-15, .upper = 1}},
});

constexpr double infinity = std::numeric_limits<double>::infinity();

/// [u] The contract is held to where contact lasts longer than this share of the path until it; and the forward error to
/// where the path is farther than this from the last that touches.
constexpr double least_contact = 64;

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
bool is_turned_alone(const ExtremeRow& row) {
  return row.pair->name.find("obb") != std::string_view::npos && row.precision != Precision::in_double;
}

/// What the closed form promises wherever a contact lasts.
struct Clause {
  std::string_view what;
  double most, most_turned;  ///< of all rows but those turned alone; of those
  double (*measure)(const ExtremeTally& tally);
  double (*share)(const Place& place) = contact_share;  ///< besides: of how much there must be `least_contact`
};
constexpr auto contract = std::to_array<Clause>({
    {"closed_form_forward", 4, 8, [](const ExtremeTally& t) { return t.forward_max; }, grazing_share},
    {"closed_form_backward", 4, 8, [](const ExtremeTally& t) { return t.backward_max; }},
    {"closed_form_verdicts", break_verdict, break_verdict, [](const ExtremeTally& t) { return t.worst_wrong; }},
    {"closed_form_no_answer", 0, 0, [](const ExtremeTally& t) { return static_cast<double>(t.gave_up + t.invalid); }},
});

/// Counts the cell, and keeps it if it is the worst.
void note(LadderTest& test, const ExtremeRow& row, double measured) {
  ++test.cells;
  if (measured <= test.measured) return;
  test.measured = measured;
  test.where = fmt::format("{}, {} {}", row.pair->name, info(row.place.axis).name, rounded_text(row.place.value, 6));
}

/// Of the rows that are `turned` alone or of the others.
LadderTest contract_test(const std::vector<ExtremeRow>& rows, Precision precision, const Clause& clause, bool turned) {
  LadderTest test{.what = fmt::format("{}{}", clause.what, turned ? "_turned" : ""),
                  .precision = precision,
                  .most = turned ? clause.most_turned : clause.most};
  const double least = least_contact * unit_of(precision);
  for (const ExtremeRow& row : rows) {
    const bool lasts = contact_share(row.place) >= least && clause.share(row.place) >= least;
    const bool is_its = row.tally.method == "closed_form" && row.precision == precision;
    if (lasts && is_its && is_turned_alone(row) == turned) note(test, row, clause.measure(row.tally));
  }
  return test;
}

void add_loss(std::vector<LadderTest>& tests, const std::vector<ExtremeRow>& along, Precision precision,
              const LossTheory& theory) {
  LadderTest bound{.what = "textbook_loss", .precision = precision, .most = theory.most};
  LadderTest spread{.what = "textbook_loss_spread", .precision = precision, .least = 1, .most = theory.spread};
  double least = infinity;
  for (const ExtremeRow& row : along) {
    const double d = row.place.value;
    if (d < 10 || unit_of(precision) * d * d > 1e-3 || row.tally.timed < 4) continue;  // first order, and enough of it
    const double scaled = std::pow(d, 2 - theory.exponent), rms = row.tally.loss_rms * scaled;
    note(bound, row, row.tally.loss_max * scaled);
    note(spread, row, rms);
    least = std::min(least, rms);
  }
  spread.measured /= least;
  tests.push_back(bound);
  if (spread.cells > 1) tests.push_back(spread);
}

/// The first distance at which one verdict in ten is wrong, over 1 / sqrt(u). Infinite where there is none.
void add_threshold(std::vector<LadderTest>& tests, const std::vector<ExtremeRow>& along, Precision precision) {
  const double threshold = 1 / std::sqrt(unit_of(precision));
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
  test.cells = std::ssize(along);
  tests.push_back(test);
}

}  // namespace

const AxisInfo& info(ExtremeAxis axis) { return axes[static_cast<std::size_t>(axis)]; }

Extreme extreme_at(const Place& place) {
  Extreme e;
  e.*info(place.axis).factor = place.value;
  return e;
}

std::vector<Place> make_places(const Settings& settings) {
  const std::vector<std::string_view> names = names_of(axes);
  const std::vector<std::string> chosen = settings.choices_or_all("axis", names);
  std::vector<Place> places;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::vector<double> values = settings.numbers(names[i], axes[i].allowed);
    if (std::ranges::find(chosen, names[i]) == chosen.end()) continue;  // its values are checked all the same
    for (const double value : values) places.push_back({static_cast<ExtremeAxis>(i), value});
  }
  std::ranges::sort(places);
  return places;
}

std::vector<ExtremeRow> two_balls(const std::vector<ExtremeRow>& rows, std::string_view method, Precision precision) {
  return only(rows, [&](const ExtremeRow& row) {
    return row.pair->name == "sphere_sphere" && row.place.axis == ExtremeAxis::distance && row.tally.method == method &&
           row.precision == precision;
  });
}

std::optional<Flaw> flaw_of(const ExtremeTally& tally) {
  if (tally.worst_wrong > break_verdict) return Flaw::verdict;
  if (tally.forward_max > break_error) return Flaw::error;
  if (tally.invalid > 0) return Flaw::nan;
  if (tally.gave_up > 0) return Flaw::gave_up;
  return {};
}

Survival survival(const std::vector<ExtremeRow>& rows, const Arm& arm, const ExtremeContender& whose) {
  std::vector<ExtremeRow> along = only(rows, [&](const ExtremeRow& row) {
    return row.place.axis == arm.axis && arm.side * row.place.value >= arm.side;
  });
  const auto outward = [&](const ExtremeRow& row) { return arm.side * row.place.value; };
  std::ranges::stable_sort(along, {}, outward);
  Survival result = {whose, &arm};
  for (const Group<ExtremeRow>& there : group_by(along, outward)) {
    for (const ExtremeRow* row : there) {
      const std::optional<Flaw> flaw = flaw_of(row->tally);
      if (!flaw || (result.flaw && *flaw >= *result.flaw)) continue;
      result.broken = row->place.value;
      result.flaw = flaw;
      result.pair = row->pair->name;
    }
    if (result.broken) return result;
    result.survived = there[0]->place.value;
  }
  return result;
}

std::vector<LadderTest> ladder_tests(const std::vector<ExtremeRow>& rows, const LossTheory& theory) {
  std::vector<LadderTest> tests;
  for (const Precision precision : all_precisions) {
    for (const bool turned : {false, true}) {
      for (const Clause& clause : contract) tests.push_back(contract_test(rows, precision, clause, turned));
    }
    const std::vector<ExtremeRow> along = two_balls(rows, "textbook", precision);  // from near to far
    add_loss(tests, along, precision, theory);
    add_threshold(tests, along, precision);
  }
  std::erase_if(tests, [](const LadderTest& test) { return test.cells == 0; });
  return tests;
}

}  // namespace thinwall
