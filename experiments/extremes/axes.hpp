#pragma once
/// The axes that are swept, one at a time, and what a query is like where nothing is extreme.

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall {

class Settings;

enum class ExtremeAxis { scale, distance, speed, thickness, offset, grazing, ratio };
inline constexpr std::size_t axis_count = 7;

/// What a query is made from. R is the size of the pair: the sum of the radii of the balls around its two shapes.
struct Extreme {
  double scale = 1;     ///< [1] all lengths are multiplied by it
  double distance = 3;  ///< [R] the path until first contact
  double speed = 0;     ///< [R] the path in the step; 0: as long as it takes to make contact at 0.3 to 0.9 of the step
  double thickness =
      1;               ///< [1] of the box: its least half width is multiplied by it, and so is the radius of the other
  double offset = 0;   ///< [R] of the pair from the origin
  double grazing = 0;  ///< [1] 1 - b / R, or on the other side b / R - 1; 0: not next to grazing
  double ratio = 1;    ///< [1] the first shape's size is multiplied by it
};

/// An axis: its name as a key of the settings, and what it is.
struct AxisInfo {
  ExtremeAxis axis;
  std::string_view name;   ///< as in the settings
  std::string_view title;  ///< "distance / R"
  double usual;            ///< the value that is no extreme; what lies beside it is farther out
};
const AxisInfo& info(ExtremeAxis axis);
const std::array<AxisInfo, axis_count>& all_axes();

/// One value of one axis.
struct Place {
  ExtremeAxis axis = ExtremeAxis::scale;
  double value = 1;
  bool operator==(const Place&) const = default;
};
std::string key(const Place& place);  ///< "scale 1e-150"
Extreme extreme_at(const Place& place);

/// Every value of every axis that the settings choose, axis by axis, from the least to the greatest. Throws UsageError.
std::vector<Place> make_places(const Settings& settings);

/// An axis from its usual value outward, to one side: along these a method survives, and then breaks.
struct Arm {
  ExtremeAxis axis;
  int side;  ///< +1 to greater values, -1 to lesser
  std::string_view name;
};
const std::vector<Arm>& all_arms();

/// The values of an arm among the places, from the usual outward.
std::vector<double> values_along(const Arm& arm, const std::vector<Place>& places);

}  // namespace thinwall
