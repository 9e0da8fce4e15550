#pragma once
/// What hitscan's pictures are made of: choices of lines, points by radius, curves through the theory.

#include <functional>
#include <set>
#include <string>
#include <vector>

#include <thinwall/experiments/figure.hpp>
#include <thinwall/experiments/hitscan/line.hpp>

namespace thinwall {

using HitscanLines = std::vector<HitscanLine>;
using HitscanRead = std::function<double(const HitscanLine&)>;
using HitscanBars = std::function<Interval(const HitscanLine&)>;

HitscanLines chosen(const HitscanLines& lines, const std::function<bool(const HitscanLine&)>& choice);
HitscanLines of_rule(const HitscanLines& lines, const HitscanRule& rule);
std::set<double> radii_of(const HitscanLines& lines);

Series empty_series(std::string label, Mark mark);
void add_point(Series& series, double x, double y);

/// Points, one series a radius; without bars if `bars` is empty.
void add_points(Panel& panel, const HitscanLines& lines, const HitscanRead& x, const HitscanRead& y,
                const HitscanBars& bars);

/// A curve through what theory says of each line, for each radius, as one series with gaps.
Series theory_through(HitscanLines lines, const HitscanRead& x, const HitscanRead& y);

Figure missed_figure(const HitscanLines& rays);       ///< of hitscan, all with some deflection
Figure path_error_figure(const HitscanLines& lines);  ///< of every rule, one radius and air
Figure lateness_figure(const HitscanLines& lines);    ///< of every rule; without panels if none has a time

}  // namespace thinwall
