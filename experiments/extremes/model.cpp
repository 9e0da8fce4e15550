#include <thinwall/experiments/extremes/model.hpp>

#include <algorithm>

#include <thinwall/experiments/lab/settings.hpp>

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

}  // namespace

const AxisInfo& info(ExtremeAxis axis) { return axes[static_cast<std::size_t>(axis)]; }

Extreme extreme_at(const Place& place) {
  Extreme e;
  e.*info(place.axis).factor = place.value;
  return e;
}

std::vector<Place> make_places(const Settings& settings) {
  std::vector<std::string_view> names;
  for (const AxisInfo& axis : axes) names.push_back(axis.name);
  const std::vector<std::string> chosen = settings.choices_or_all("axis", names);
  std::vector<Place> places;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    std::vector<double> values = settings.numbers(names[i], axes[i].allowed);
    if (std::ranges::find(chosen, names[i]) == chosen.end()) continue;  // its values are checked all the same
    std::ranges::sort(values);
    for (const double value : values) places.push_back({static_cast<ExtremeAxis>(i), value});
  }
  return places;
}

std::span<const Arm> all_arms() {
  static constexpr std::array<Arm, 9> arms{{{ExtremeAxis::scale, -1, "small"},
                                            {ExtremeAxis::scale, 1, "large"},
                                            {ExtremeAxis::distance, 1, "far"},
                                            {ExtremeAxis::speed, -1, "slow"},
                                            {ExtremeAxis::speed, 1, "fast"},
                                            {ExtremeAxis::thickness, -1, "thin"},
                                            {ExtremeAxis::offset, 1, "offset"},
                                            {ExtremeAxis::grazing, -1, "graze"},
                                            {ExtremeAxis::ratio, -1, "unequal"}}};
  return arms;
}

std::vector<double> values_along(const Arm& arm, const std::vector<Place>& places) {
  std::vector<double> values;
  for (const Place& place : places) {
    if (place.axis == arm.axis && (arm.side > 0 ? place.value >= 1 : place.value <= 1)) values.push_back(place.value);
  }
  if (arm.side < 0) std::ranges::reverse(values);
  return values;
}

bool is_in(const ExtremePair& pair, PairSet pairs) {
  if (pairs == PairSet::all) return true;
  return pair.every_method() && (pairs == PairSet::four || pair.rounded == (pairs == PairSet::rounded));
}

bool ExtremeContender::has(const ExtremeRow& row) const {
  return row.precision == precision && row.tally.method == method && row.tally.queries > 0 && is_in(*row.pair, pairs);
}

std::vector<std::size_t> precisions_of(const std::vector<ExtremeRow>& rows) {
  std::vector<std::size_t> found = distinct(rows, &ExtremeRow::precision);
  std::ranges::sort(found);
  return found;
}

std::vector<Place> places_of(const std::vector<ExtremeRow>& rows) {
  std::vector<Place> places = distinct(rows, &ExtremeRow::place);
  std::ranges::sort(places);
  return places;
}

std::vector<ExtremeRow> two_balls(const std::vector<ExtremeRow>& rows, std::string_view method, std::size_t precision) {
  return only(rows, [&](const ExtremeRow& row) {
    const bool is_it = row.pair->name == "sphere_sphere" && row.place.axis == ExtremeAxis::distance;
    return is_it && ExtremeContender{method, precision}.has(row);
  });
}

std::string_view name(Flaw flaw) {
  constexpr std::array<std::string_view, 4> names{"verdict", "error", "nan", "gave_up"};
  return names[static_cast<std::size_t>(flaw)];
}

std::optional<Flaw> flaw_of(const ExtremeTally& tally) {
  if (tally.worst_wrong > break_verdict) return Flaw::verdict;
  if (tally.forward_max > break_error) return Flaw::error;
  if (tally.invalid > 0) return Flaw::nan;
  if (tally.gave_up > 0) return Flaw::gave_up;
  return {};
}

Survival survival(const std::vector<ExtremeRow>& rows, const Arm& arm, const ExtremeContender& whose) {
  Survival result = {whose, &arm};
  for (const double value : values_along(arm, places_of(rows))) {
    bool asked = false;
    for (const ExtremeRow& row : rows) {
      if (row.place != Place{arm.axis, value} || !whose.has(row)) continue;
      asked = true;
      const std::optional<Flaw> flaw = flaw_of(row.tally);
      if (!flaw || (result.broken && *flaw >= result.flaw)) continue;
      result.broken = value;
      result.flaw = *flaw;
      result.pair = row.pair->name;
    }
    if (result.broken) return result;
    if (asked) result.survived = value;
  }
  return result;
}

}  // namespace thinwall
