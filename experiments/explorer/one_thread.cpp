/// What Debian's runtime library for WebAssembly was compiled to look for.

#include <cstdint>
#include <cstdlib>

extern "C" {
extern const std::uintptr_t __stack_chk_guard = 0x2f8a16c3;  // NOLINT(bugprone-reserved-identifier): theirs
[[noreturn]] void __stack_chk_fail() { std::abort(); }       // NOLINT(bugprone-reserved-identifier): theirs
}
