#include <thinwall/experiments/engines/engine_list.hpp>

namespace thinwall {

std::vector<Engine> engine_list() {
#define THINWALL_MAKE_ENGINE(make) make(),
  return {THINWALL_ENGINES(THINWALL_MAKE_ENGINE)};
#undef THINWALL_MAKE_ENGINE
}

}  // namespace thinwall
