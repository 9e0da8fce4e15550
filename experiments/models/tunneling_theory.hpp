#pragma once
/// How often a moving ball passes through a wall unseen, and how late it is seen otherwise. No simulation in here:
/// these are the formulas that the experiments are held against. All are derived in docs/tunneling_theory.md, where
/// each one's conditions are. Lengths are in any one unit; probabilities and cosines have none.

#include <optional>

#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// The chance that poses `spacing` > 0 apart along a line, at a uniform phase, all miss a chord of it of length
/// `chord`.
double miss_probability(double chord, double spacing);

/// The mean of max(0, 1 - depth / (spacing cos a)) over the angles a in [0, angle_deg]. `depth` and `spacing` > 0.
double mean_miss_probability(double depth, double spacing, double angle_deg);

/// What a line cuts from a wall without end, thickened by the ball's radius. `cosine`: of the angle of incidence, > 0.
double slab_chord(double thickness, double radius, double cosine);

/// A box thickened by a ball: where the ball's center is when the two touch or overlap.
struct RoundedBox {
  Vec3<double> half_extents;  ///< [length] each >= 0, of the box
  double radius;              ///< [length] >= 0, of the ball
};

double volume(const RoundedBox& box);                                        ///< [length^3]
double shadow(const RoundedBox& box, const Vec3<double>& direction);         ///< [length^2] `direction` is unit
double longest_chord(const RoundedBox& box, const Vec3<double>& direction);  ///< [length] `direction` is unit

/// The same chance for a wall that ends, averaged over lines that are uniform over its shadow, rim included.
/// Empty where spacing < longest_chord, because there some lines cannot be missed and the average is another.
std::optional<double> miss_probability(const RoundedBox& box, const Vec3<double>& direction, double spacing);

/// The chance that poses `spacing` apart see nothing, or see the ball first where the shortest way out of the wall does
/// not lead back against its motion: ahead, or to a side across it. Averaged as above, and empty where that is. `box` is
/// flat along x and square, at least as wide as thick, and `direction` lies in the plane of x and y.
std::optional<double> unturned_probability(const RoundedBox& box, const Vec3<double>& direction, double spacing);

/// The chance of a miss for a ray from the ball's center, with an overlap test at the start of each step, head-on along the x axis:
/// the ray sees every line that meets the box itself; the overlap test gets the rest. Empty where step < longest chord.
std::optional<double> center_ray_miss_probability(const RoundedBox& box, double step);

/// [length] How far past first contact the ball is when it is detected, if it is.
struct Lateness {
  double mean;
  double deviation;  ///< standard
  double largest;
};

Lateness pose_lateness(double chord, double spacing);  ///< tests at poses `spacing` apart

/// A ray from the center, cast over one step, that meets the wall a distance `lead` past first contact; or the step's
/// end, whichever comes first. On an infinite wall lead = radius / cosine.
Lateness center_ray_lateness(double lead, double step);

}  // namespace thinwall
