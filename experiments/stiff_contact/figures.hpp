#pragma once
/// The pictures of the stiff contact.

#include <vector>

#include <thinwall/experiments/figure.hpp>
#include <thinwall/experiments/stiff_contact/line.hpp>
#include <thinwall/experiments/stiff_contact/race.hpp>

namespace thinwall {

/// The headline: measured and predicted limits of a spring that holds both ways.
Figure stability_figure(const StiffPlan& plan, const std::vector<LimitLine>& limits);

/// A wall that only pushes: energy, who gets through, and what splitting the step changes.
Figure bounce_figure(const StiffPlan& plan, const std::vector<ContactLine>& bounces);
Figure escape_figure(const StiffPlan& plan, const std::vector<ContactLine>& bounces);
Figure detection_figure(const StiffPlan& plan, const std::vector<ContactLine>& bounces);

Figure race_figure(const StiffPlan& plan, const std::vector<StiffRacer>& racers);  ///< differs from run to run

}  // namespace thinwall
