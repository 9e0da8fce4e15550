#pragma once
/// The referee of a world: contacts that a step went through and did not see.
///
/// Between two steps a body that nothing touched moved straight, from where it was to where it is, and turned at the rate that it still
/// has. Of two such bodies, apart at both ends, the closed form says whether they touched on the way, or where one turns its sweep. If they did and
/// the step told no contact of theirs, it went unseen: one tunneled through the other or, of what turns, dipped in and out. Bodies that were in any contact in the step are not judged against
/// others, for their way may have a corner. Under substeps gravity bends the way, by g dt^2 / 8 at most: a contact less deep than that may be judged
/// wrong.

#include <cstdint>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

/// Two bodies, and when they first touched.
struct Meeting {
  std::uint32_t first = 0, second = 0;  ///< ids, first < second
  double time = 0;                      ///< [s]

  static constexpr auto fields() {
    using M = Meeting;
    return record(kept("time", &M::time, "s", "When they first touched."), kept("first_id", &M::first),
                  kept("second_id", &M::second));
  }
  bool operator==(const Meeting&) const = default;
};

class Referee {
 public:
  explicit Referee(const World& world) : before_(world.bodies()) {}

  /// After a step of `dt` [s]: whom it let through each other since the last call, by id.
  std::vector<Meeting> missed_by(const World& world, double dt);

 private:
  std::vector<Body> before_;
  std::vector<Proxy> proxies_;  // of the ways since then; kept for their memory, as the pairs are
  std::vector<ProxyPair> pairs_;
};

}  // namespace thinwall
