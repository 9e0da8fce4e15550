#pragma once
/// Included before all else where the page is compiled: what libraries look for that WebAssembly, without threads or exceptions, has not.

#include <cstdlib>
#include <exception>

namespace std {  // NOLINT(cert-dcl58-cpp): libc++ has none here, and Boost.Math guards its tables with one
struct mutex {
  void lock() {}
  void unlock() {}
};
}  // namespace std

namespace boost {
struct source_location;
[[noreturn]] inline void throw_exception(const std::exception&) { std::abort(); }
[[noreturn]] inline void throw_exception(const std::exception&, const source_location&) { std::abort(); }
}  // namespace boost
