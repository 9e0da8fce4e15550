#pragma once
/// Bodies, a world that steps them, and the plan of what their scene needs.

#include <thinwall/experiments/world/world.hpp>
