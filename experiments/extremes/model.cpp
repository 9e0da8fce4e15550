#include <thinwall/experiments/extremes/model.hpp>

#include <algorithm>
#include <cmath>

#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

std::span<const AxisInfo> all_axes() {
  static constexpr std::array<AxisInfo, axis_count> axes{{{"scale", "scale", ""},
                                                          {"distance", "distance / R", " R"},
                                                          {"speed", "speed / R", " R"},
                                                          {"thickness", "thickness", ""},
                                                          {"offset", "offset / R", " R"},
                                                          {"grazing", "grazing 1 - b/R", ""},
                                                          {"ratio", "size ratio", ""}}};
  return axes;
}

const AxisInfo& info(ExtremeAxis axis) { return all_axes()[static_cast<std::size_t>(axis)]; }

std::string key(const Place& place) { return std::string(info(place.axis).name) + " " + rounded_text(place.value, 6); }

Extreme extreme_at(const Place& place) {
  Extreme e;
  switch (place.axis) {
    case ExtremeAxis::scale: e.scale = place.value; break;
    case ExtremeAxis::distance: e.distance = place.value; break;
    case ExtremeAxis::speed: e.speed = place.value; break;
    case ExtremeAxis::thickness: e.thickness = place.value; break;
    case ExtremeAxis::offset: e.offset = place.value; break;
    case ExtremeAxis::grazing: e.grazing = place.value; break;
    case ExtremeAxis::ratio: e.ratio = place.value; break;
  }
  return e;
}

std::vector<Place> make_places(const Settings& settings) {
  // What a query drawn in doubles can be: beyond 1e15 its own rounding would be all that is left of a radius.
  static constexpr std::array<Range, axis_count> ranges{{
      {.lower = 1e-150, .upper = 1e150},                 // scale
      {.lower = 1, .upper = 1e15, .unit = "R"},          // distance
      {.lower = 1e-12, .upper = 1e15, .unit = "R"},      // speed
      {.lower = 1e-16, .upper = 1},                      // thickness
      {.lower = 1, .upper = 1e12, .unit = "R"},          // offset
      {.lower = 1e-15, .upper = 1, .upper_open = true},  // grazing
      {.lower = 1e-15, .upper = 1},                      // ratio
  }};
  std::vector<std::string_view> names;
  for (const AxisInfo& axis : all_axes()) names.push_back(axis.name);
  const std::vector<std::string> chosen = settings.choices_or_all("axis", names);
  std::vector<Place> places;
  for (std::size_t i = 0; i < axis_count; ++i) {
    std::vector<double> values = settings.numbers(names[i], ranges[i]);
    if (std::ranges::find(chosen, names[i]) == chosen.end()) continue;  // its values are checked all the same
    std::ranges::sort(values);
    for (const double value : values) places.push_back({static_cast<ExtremeAxis>(i), value});
  }
  return places;
}

double contact_share(const Place& place) {
  if (place.axis == ExtremeAxis::distance) return 1 / place.value;
  if (place.axis == ExtremeAxis::thickness) return place.value / extreme_at(place).distance;
  return 1;
}

double grazing_share(const Place& place) { return place.axis == ExtremeAxis::grazing ? place.value : 1; }

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

namespace {

bool is_in(const ExtremePair& pair, PairSet pairs) {
  if (pairs == PairSet::all) return true;
  return pair.every_method && (pairs == PairSet::four || pair.rounded == (pairs == PairSet::rounded));
}

}  // namespace

bool matches(const ExtremeRow& row, const RowFilter& f) {
  return row.precision == f.precision && (f.place == nullptr || row.place == *f.place) && is_in(*row.pair, f.pairs) &&
         (f.method.empty() || row.tally.method == f.method);
}

std::vector<std::size_t> precisions_of(const std::vector<ExtremeRow>& rows) {
  std::vector<std::size_t> found;
  for (std::size_t p = 0; p < precision_count; ++p) {
    if (std::ranges::find(rows, p, &ExtremeRow::precision) != rows.end()) found.push_back(p);
  }
  return found;
}

std::vector<std::string_view> methods_of(const std::vector<ExtremeRow>& rows, std::size_t precision, PairSet pairs) {
  std::vector<std::string_view> found = extreme_method_names();
  std::erase_if(found, [&](std::string_view method) {
    const RowFilter filter = {.method = method, .precision = precision, .pairs = pairs};
    return std::ranges::none_of(rows, [&](const ExtremeRow& row) { return matches(row, filter); });
  });
  return found;
}

std::vector<Place> places_of(const std::vector<ExtremeRow>& rows) {
  std::vector<Place> places;
  for (const ExtremeRow& row : rows) {
    if (places.empty() || places.back() != row.place) places.push_back(row.place);
  }
  std::ranges::sort(
      places, [](const Place& a, const Place& b) { return a.axis != b.axis ? a.axis < b.axis : a.value < b.value; });
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
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

Survival survival(const std::vector<ExtremeRow>& rows, const Arm& arm, std::string_view method, std::size_t precision,
                  PairSet pairs) {
  Survival result;
  for (const double value : values_along(arm, places_of(rows))) {
    const Place place = {arm.axis, value};
    bool asked = false;
    for (const ExtremeRow& row : rows) {
      if (!matches(row, {.method = method, .precision = precision, .place = &place, .pairs = pairs}) ||
          row.tally.queries == 0) {
        continue;
      }
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

bool breaks_at_once(const std::vector<ExtremeRow>& rows, std::string_view method, std::size_t precision,
                    PairSet pairs) {
  std::size_t asked = 0, at_once = 0;
  for (const Arm& arm : all_arms()) {
    const Survival s = survival(rows, arm, method, precision, pairs);
    if (s.survived || s.broken) ++asked;
    if (s.broken && !s.survived) ++at_once;
  }
  return 2 * at_once > asked;
}

}  // namespace thinwall
