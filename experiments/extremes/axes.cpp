#include <thinwall/experiments/extremes/axes.hpp>

#include <algorithm>

#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

const std::array<AxisInfo, axis_count>& all_axes() {
  static constexpr std::array<AxisInfo, axis_count> axes{{
      {ExtremeAxis::scale, "scale", "scale", 1},
      {ExtremeAxis::distance, "distance", "distance / R", 1},
      {ExtremeAxis::speed, "speed", "speed / R", 1},
      {ExtremeAxis::thickness, "thickness", "thickness", 1},
      {ExtremeAxis::offset, "offset", "offset / R", 1},
      {ExtremeAxis::grazing, "grazing", "grazing 1 - b/R", 1},
      {ExtremeAxis::ratio, "ratio", "size ratio", 1},
  }};
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
  std::vector<std::string_view> allowed;
  for (const AxisInfo& axis : all_axes()) allowed.push_back(axis.name);
  allowed.emplace_back("all");
  const std::vector<std::string> chosen = settings.choices("axis", allowed);
  const auto has = [&](std::string_view name) { return std::find(chosen.begin(), chosen.end(), name) != chosen.end(); };
  std::vector<Place> places;
  for (const AxisInfo& axis : all_axes()) {
    std::vector<double> values = settings.numbers(axis.name, ranges[static_cast<std::size_t>(axis.axis)]);
    if (!has(axis.name) && !has("all")) continue;  // its values are checked all the same
    std::sort(values.begin(), values.end());
    for (const double value : values) places.push_back({axis.axis, value});
  }
  return places;
}

const std::vector<Arm>& all_arms() {
  static const std::vector<Arm> arms = {
      {ExtremeAxis::scale, -1, "small"},  {ExtremeAxis::scale, 1, "large"},    {ExtremeAxis::distance, 1, "far"},
      {ExtremeAxis::speed, -1, "slow"},   {ExtremeAxis::speed, 1, "fast"},     {ExtremeAxis::thickness, -1, "thin"},
      {ExtremeAxis::offset, 1, "offset"}, {ExtremeAxis::grazing, -1, "graze"}, {ExtremeAxis::ratio, -1, "unequal"},
  };
  return arms;
}

std::vector<double> values_along(const Arm& arm, const std::vector<Place>& places) {
  std::vector<double> values;
  for (const Place& place : places) {
    if (place.axis != arm.axis) continue;
    const double usual = info(arm.axis).usual;
    if (arm.side > 0 ? place.value >= usual : place.value <= usual) values.push_back(place.value);
  }
  if (arm.side < 0) std::reverse(values.begin(), values.end());
  return values;
}

}  // namespace thinwall
