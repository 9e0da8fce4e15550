#pragma once
/// The rules that the shots are put to: which way the bullet is taken to fly, whether it has a radius, and when a hit
/// is reported.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/hitscan/placement.hpp>
#include <thinwall/experiments/hitscan/tally.hpp>

namespace thinwall {

enum class FlightPath {
  line,      ///< along the line of fire, at once and without end
  tangents,  ///< every step along the velocity at its start, as far as the bullet would get in the step
  chords,    ///< every step straight to where the bullet is at its end
};

enum class ReportTime {
  firing,       ///< when the gun goes off
  end_of_step,  ///< at the next frame
  in_step,      ///< when the rule says that they touch
};

struct HitscanRule {
  std::string_view name;
  FlightPath path;
  bool has_radius;  ///< the bullet is swept as a ball, by `time_of_impact`; otherwise its center, by `raycast`
  ReportTime report;
};

inline constexpr HitscanRule hitscan_ray = {"hitscan", FlightPath::line, false, ReportTime::firing};
inline constexpr HitscanRule hitscan_ball = {"hitscan_ball", FlightPath::line, true, ReportTime::firing};
inline constexpr HitscanRule next_frame = {"next_frame", FlightPath::tangents, false, ReportTime::end_of_step};
inline constexpr HitscanRule swept_steps = {"swept_steps", FlightPath::chords, true, ReportTime::in_step};

std::vector<std::string_view> hitscan_rule_names();
std::vector<HitscanRule> hitscan_rules(std::span<const std::string> names);  ///< those named, in the order above

/// A straight bit of the way a rule takes the bullet to fly. A line takes no time.
struct FlightPiece {
  Vec3<double> start, displacement;  ///< [m]
  double from, until;                ///< [s] since firing
};
/// Those that may come near the target.
std::vector<FlightPiece> flight_pieces(FlightPath path, const HitscanCell& c, double phase);

struct HitscanAnswer {
  bool hit = false;
  double time = 0;                               ///< [s] of the report, since firing
  Vec3<double> point = Vec3<double>::Zero();     ///< [m] on the target
  Vec3<double> at_range = Vec3<double>::Zero();  ///< [m] where the path crosses the plane of the target's center
};
HitscanAnswer answer_of(const HitscanRule& rule, const HitscanCell& c, const Placement& placement);

/// The units of a cell's sums.
double time_unit(const HitscanCell& c);    ///< [s]
double length_unit(const HitscanCell& c);  ///< [m]

/// All shots of a cell, put to every rule; as long as `rules`.
std::vector<HitscanTally> shoot(std::span<const HitscanRule> rules, const HitscanCell& c, std::uint64_t seed,
                                std::int64_t shots);

}  // namespace thinwall
