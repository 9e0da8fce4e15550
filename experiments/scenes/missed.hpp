#pragma once
/// The referee of a scene: contacts that a step went through and did not see.
///
///
/// Between two steps a body that nothing touched moved straight, from where it was to where it is. Of two such bodies,
/// apart at both ends, the closed form says whether they touched on the way. If they did and the step told no contact of
/// theirs, one went through the other: it tunneled. Bodies that were in any contact in the step are not judged against
/// others, for their way may have a corner. Under substeps gravity bends the way, by g dt^2 / 8 at most: a contact less deep
/// than that may be judged wrong.

#include <cstdint>
#include <memory>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/world/world.hpp>
#include <vector>

namespace thinwall {

/// Two bodies that passed through each other.
struct MissedContact {
  std::uint32_t first = 0, second = 0;  ///< ids, first < second
  double time = 0;                      ///< [s] when they first touched

  static constexpr auto fields() {
    using M = MissedContact;
    return record(kept("time", &M::time, "s", "When they first touched."), kept("first_id", &M::first),
                  kept("second_id", &M::second));
  }
};

class MissedContacts {
 public:
  explicit MissedContacts(const World& world);
  ~MissedContacts();
  MissedContacts(const MissedContacts&) = delete;
  MissedContacts& operator=(const MissedContacts&) = delete;

  /// After a step of `dt` [s]: what it missed since the last call, by id.
  std::vector<MissedContact> after_step(const World& world, double dt);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace thinwall
