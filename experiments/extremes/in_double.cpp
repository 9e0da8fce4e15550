#include <thinwall/experiments/extremes/ask.hpp>

namespace thinwall {

std::array<AskExtreme, 4> ask_in_double() { return ask_in<double>(); }

}  // namespace thinwall
