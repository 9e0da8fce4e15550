#pragma once
/// Every engine that this experiment knows, in the program or not.

#include <vector>

#include <thinwall/experiments/engines/engine.hpp>

namespace thinwall {

std::vector<Engine> engine_list();

Engine bullet_engine();
Engine ode_engine();
Engine box2d_engine();
Engine own_engine();

}  // namespace thinwall
