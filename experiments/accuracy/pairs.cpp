#include <thinwall/experiments/accuracy/pairs.hpp>

#include <thinwall/experiments/accuracy/ask.hpp>

namespace thinwall {

std::span<const AccuracyPair> accuracy_pairs() {
  static constexpr std::array list{
      AccuracyPair{"sphere_sphere", &ask_pair<Sphere, Sphere>},
      AccuracyPair{"sphere_aabb", &ask_pair<Sphere, Aabb>},
      AccuracyPair{"aabb_aabb", &ask_pair<Aabb, Aabb>},
      AccuracyPair{"sphere_obb", &ask_pair<Sphere, Obb>},
      AccuracyPair{"aabb_obb", &ask_pair<Aabb, Obb>},
      AccuracyPair{"obb_obb", &ask_pair<Obb, Obb>},
      AccuracyPair{"sphere_triangle", &ask_pair<Sphere, Triangle>},
      AccuracyPair{"sphere_capsule", &ask_pair<Sphere, Capsule>},
      AccuracyPair{"capsule_capsule", &ask_pair<Capsule, Capsule>},
      AccuracyPair{"capsule_aabb", &ask_pair<Capsule, Aabb>},
      AccuracyPair{"capsule_obb", &ask_pair<Capsule, Obb>},
      AccuracyPair{"capsule_triangle", &ask_pair<Capsule, Triangle>},
  };
  return list;
}

}  // namespace thinwall
