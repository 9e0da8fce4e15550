#pragma once
/// Whom the advice chooses from: every method of the method list, as the thin wall fires it in double, and the certified
/// answers. A method added to the list is here by itself; without a theory in thin_wall/methods.cpp it is never
/// advised.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/advise/wish.hpp>
#include <thinwall/experiments/thin_wall/methods.hpp>

namespace thinwall {

struct Candidate {
  std::string name;  ///< as the thin wall calls it: substeps_8
  int poses;         ///< [1] that it tests a step and nothing else; 0 if it does more
  bool fired;        ///< the thin wall can fire it
  std::function<Theory(const Cell&)> theory;
  std::function<void(std::span<const ShotStep>)> ask;  ///< to be timed
};

/// The numbers of poses a step that are offered: 2, 8, and the fewest that meet the wish if they are 2 to 1000.
std::vector<std::int64_t> offered_poses(const Wish& wish);

std::vector<Candidate> candidates(const Wish& wish);

}  // namespace thinwall
