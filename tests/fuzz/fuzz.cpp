// The fuzz target: bytes become two moving shapes, every query is put to them, and the answers are held to what they
// promise for any input. CONTRIBUTING.md says how to run it.

#include <cstdio>
#include <cstdlib>
#include <map>

#include <thinwall/swept/shapes.hpp>

#include "fuzz/finding.hpp"

namespace thinwall::fuzz {
namespace {

/// How often each kind of finding came up; printed at the end where the target keeps going.
class Tally {
 public:
  ~Tally() {
    for (const auto& [kind, count] : counts_) std::fprintf(stderr, "%8ld x %s\n", count, kind.c_str());
  }
  long add(const std::string& kind) { return ++counts_[kind]; }

 private:
  std::map<std::string, long> counts_;
};

template <Scalar S> void check_one_pair(Bytes& bytes) {
  const int wanted = bytes.below(8);  // the capsule, the richest in pairs, three times as often
  int index = 0;
  for_each_type(Shapes<S>{}, [&]<class A>(TypeTag<A>) {
    const bool last = std::is_same_v<A, Capsule<S>>;
    if (index == wanted || (last && wanted > index)) check_one_pair_of<A>(bytes);
    ++index;
  });
}

}  // namespace

void report(const std::string& kind, const std::string& detail) {
  constexpr long shown = 3;
  static Tally tally;
  const char* keep_going = std::getenv("THINWALL_FUZZ_KEEP_GOING");  // NOLINT(concurrency-mt-unsafe): one thread
  if (tally.add(kind) <= shown) std::fprintf(stderr, "\nFINDING %s\n%s", kind.c_str(), detail.c_str());
  if (keep_going == nullptr) std::abort();
}

}  // namespace thinwall::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  thinwall::fuzz::Bytes bytes(data, size);
  if (bytes.below(3) == 0) {
    thinwall::fuzz::check_one_pair<float>(bytes);
  } else {
    thinwall::fuzz::check_one_pair<double>(bytes);
  }
  return 0;
}
