/// The instantiations that compiled.hpp announces.
#include <thinwall/capsule/compiled.hpp>
#undef THINWALL_INSTANTIATION
#define THINWALL_INSTANTIATION template
#include <thinwall/swept/compiled.hpp>
