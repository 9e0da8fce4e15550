#pragma once
/// What the fuzz target does when a property fails: says which, prints the input as hex floats and stops, so that the fuzzer keeps
/// the bytes. With THINWALL_FUZZ_KEEP_GOING set it goes on: it prints the first few of each kind and counts the rest.

#include <sstream>
#include <string>
#include <string_view>

#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/toi.hpp>

#include "fuzz/judge.hpp"
#include "fuzz/scene.hpp"

namespace thinwall::fuzz {

template <Scalar S> constexpr std::string_view scalar_name = std::is_same_v<S, float> ? "float" : "double";

template <Scalar S> std::string text(const S& x) {
  std::ostringstream out;
  if (!is_finite(x)) {
    out << (x != x ? "nan" : x > 0 ? "inf" : "-inf");
  } else {
    out << std::hexfloat << x;
  }
  return out.str();
}
template <Scalar S> std::string text(const Vec3<S>& v) {
  return "{" + text(v[0]) + ", " + text(v[1]) + ", " + text(v[2]) + "}";
}
/// Its numbers by their names.
template <class Thing> std::string numbers_of(const Thing& thing) {
  std::string all;
  for_each_named_number(thing, [&](const std::string& name, const auto& x) { all += " " + name + " " + text(x); });
  return all;
}
template <class A> std::string text(const Moving<A>& m) { return std::string(testing::shape_name<A>) + numbers_of(m); }
inline std::string text(ToiStatus status) {
  constexpr const char* names[] = {"apart", "hit", "overlapping", "gave_up", "invalid"};
  return names[static_cast<int>(status)];
}
template <Scalar S> std::string text(const Toi<S>& toi) {
  return text(toi.status) + " at " + text(toi.time) + ", normal " + text(toi.normal) + ", point " + text(toi.point);
}

/// One input of the fuzzer: a pair with `A` as the shape of later rank, at A's scalar. Defined in pairs_of.cpp, which is compiled once for
/// each shape and scalar.
template <class A> void check_one_pair_of(Bytes& bytes);

/// `kind` names the property and the pair; `detail` is the input and what came out.
void report(const std::string& kind, const std::string& detail);

/// Reports what does not hold of one scene.
template <class A, class B> class Check {
 public:
  using S = typename A::Scalar;
  explicit Check(const Scene<A, B>& scene) : scene_(scene) {}

  /// details() says what came out; it is asked only where the property fails.
  template <class Details> bool operator()(bool holds, std::string_view property, const Details& details) const {
    if (holds) return true;
    const std::string kind = std::string(property) + " [" + std::string(testing::shape_name<A>) + ", " +
                             std::string(testing::shape_name<B>) + ", " + std::string(scalar_name<S>) + "]";
    report(kind, "  a = " + text(scene_.a) + "\n  b = " + text(scene_.b) + "\n  " + details() + "\n");
    return false;
  }
  bool operator()(bool holds, std::string_view property) const {
    return (*this)(holds, property, [] { return std::string(); });
  }
  /// The same for what a judge found; `about` names the query in front of the fault.
  template <class Details>
  void no_fault(const Judgment& judgment, std::string_view about, const Details& details) const {
    if (!judgment) return;
    (*this)(false, std::string(about) + judgment->property, [&] { return details() + judgment->details; });
  }

 private:
  const Scene<A, B>& scene_;
};

}  // namespace thinwall::fuzz
