#pragma once
/// A ball held by a stiff spring at a wall: which steps are stable, what does a bounce do to the energy, and when does the
/// ball get through? See docs/stiff_contact.md.

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Experiment stiff_contact_experiment();

}  // namespace thinwall
