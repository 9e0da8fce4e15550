#pragma once
/// What a viewer needs: JSON lines, one object each. The first line names the bodies and their shapes; every further one
/// is a frame, with the places of the bodies that move, in the order of their ids.

#include <string>

#include <thinwall/experiments/scenes/scene.hpp>

namespace thinwall {

/// Plays the scene once more, which gives the same bits, and writes down every `trace_every`-th step and the last.
std::string trace_of(const Scene& scene);

}  // namespace thinwall
