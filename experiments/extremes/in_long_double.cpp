#include <thinwall/experiments/extremes/ask.hpp>

namespace thinwall {

std::array<AskExtreme, 4> ask_in_long_double() { return ask_in<long double>(); }

}  // namespace thinwall
