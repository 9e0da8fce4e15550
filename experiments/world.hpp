#pragma once
/// Bodies, a world that steps them, and the plan of what their scene needs.

#include <thinwall/experiments/world/body.hpp>
#include <thinwall/experiments/world/options.hpp>
#include <thinwall/experiments/world/plan.hpp>
#include <thinwall/experiments/world/step_report.hpp>
#include <thinwall/experiments/world/world.hpp>
