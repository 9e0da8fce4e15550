/// The instantiations that the compiled.hpp of discrete and of capsule announce.
#define THINWALL_INSTANTIATION template
#include <thinwall/capsule/compiled.hpp>
