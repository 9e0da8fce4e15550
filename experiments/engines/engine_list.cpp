#include <thinwall/experiments/engines/engine_list.hpp>

namespace thinwall {

std::vector<Engine> engine_list() {
  return {
      bullet_engine(),
      ode_engine(),
      box2d_engine(),
      own_engine(),
  };
}

}  // namespace thinwall
