#pragma once
/// Every engine that this experiment knows, in the program or not.

#include <vector>

#include <thinwall/experiments/engines/engine.hpp>

namespace thinwall {

/// An engine is a line here, and a file of its own that defines this function.
#define THINWALL_ENGINES(line) line(bullet_engine) line(ode_engine) line(box2d_engine) line(own_engine)

#define THINWALL_DECLARE_ENGINE(make) Engine make();
THINWALL_ENGINES(THINWALL_DECLARE_ENGINE)
#undef THINWALL_DECLARE_ENGINE

std::vector<Engine> engine_list();

}  // namespace thinwall
