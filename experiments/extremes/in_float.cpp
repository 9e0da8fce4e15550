#include <thinwall/experiments/extremes/ask.hpp>

namespace thinwall {

std::array<AskExtreme, 4> ask_in_float() { return ask_in<float>(); }

}  // namespace thinwall
