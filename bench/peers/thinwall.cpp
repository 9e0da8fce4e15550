/// Our own front door, in the same run.

#include <thinwall/discrete/manifold.hpp>

#include "peers/peer.hpp"

namespace thinwall::bench {

bool add_thinwall() {
  const auto as_it_is = [](const auto& query) { return query; };
  for_each_cast([&](const std::string& pair, auto set, const Operations& least) {
    add_row("time_of_impact/" + pair + "/thinwall", set, least, as_it_is, [](const auto& q) {
      const Toi<double> toi = time_of_impact(q.a, q.b);
      return toi.status == ToiStatus::apart ? never : toi.time;
    });
  });
  for_each_ray([&](const std::string& shape, auto set, const Operations& least) {
    add_row("raycast/" + shape + "/thinwall", set, least, as_it_is, [](const auto& q) {
      const auto hit = raycast(q.ray, q.shape);
      return hit ? hit->t : never;
    });
  });
  for_each_pose([&](const std::string& pair, auto set) {
    add_row("contact/" + pair + "/thinwall", set, {}, as_it_is, [](const auto& q) {
      const auto found = contact(q.a, q.b);
      return found ? found->penetration : never;
    });
    add_row("overlaps/" + pair + "/thinwall", set, {}, as_it_is,
            [](const auto& q) { return overlaps(q.a, q.b) ? -1.0 : never; });
  });
  return true;
}

}  // namespace thinwall::bench
