#pragma once
/// Every number of a shape, of one that moves or turns, or of a ray, by the name of its column in docs/data/README.md:
///   each_number(thing, [](const std::string& name, double& number) { ... });

#include <array>
#include <charconv>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/discrete/triangle.hpp>
#include <thinwall/swept/turning.hpp>

namespace thinwall::testing {

constexpr std::array<std::string_view, 5> names_by_rank = {"Sphere", "Aabb", "Obb", "Triangle", "Capsule"};
template <class A> constexpr std::string_view shape_name = names_by_rank[A::rank];

template <class S, class F> void each_number(const std::string& name, Vec3<S>& v, const F& f) {
  for (int k = 0; k < 3; ++k) f(name + "_" + "xyz"[k], v[k]);
}
template <class S, class F> void each_number(Sphere<S>& s, const F& f) {
  each_number("center", s.center, f);
  f("radius", s.radius);
}
template <class S, class F> void each_number(Aabb<S>& box, const F& f) {
  each_number("center", box.center, f);
  each_number("half", box.half_extents, f);
}
template <class S, class F> void each_number(Obb<S>& box, const F& f) {
  each_number("center", box.center, f);
  each_number("half", box.half_extents, f);
  for (int k = 0; k < 9; ++k) f("axis" + std::to_string(k / 3 + 1) + "_" + "xyz"[k % 3], box.axes(k % 3, k / 3));
}
template <class S, class F> void each_number(Triangle<S>& t, const F& f) {
  each_number("p", t.a, f);
  each_number("q", t.b, f);
  each_number("r", t.c, f);
}
template <class S, class F> void each_number(Capsule<S>& c, const F& f) {
  each_number("p", c.a, f);
  each_number("q", c.b, f);
  f("radius", c.radius);
}
template <class S, class F> void each_number(Ray<S>& ray, const F& f) {
  each_number("origin", ray.origin, f);
  each_number("direction", ray.direction, f);
  f("max_t", ray.max_t);
}
template <class A, class F> void each_number(Moving<A>& m, const F& f) {
  each_number(m.shape, f);
  each_number("displacement", m.displacement, f);
}
template <class A, class F> void each_number(Turning<A>& m, const F& f) {
  each_number(m.shape, f);
  each_number("displacement", m.displacement, f);
  each_number("rotation", m.rotation, f);
}
template <class Thing, class F> void each_number(const Thing& thing, const F& f) {
  Thing copy = thing;
  each_number(copy, f);
}

/// What a failing case prints.
template <class Thing> std::string describe(const Thing& thing) {
  std::ostringstream out;
  each_number(thing, [&]<class S>(const std::string& name, const S& number) {
    out.precision(std::numeric_limits<S>::max_digits10);
    out << name << " " << number << " ";
  });
  return out.str();
}

// ---- A published query of two shapes that turn, as a line of CSV.

/// The shortest text that reads back as the same bits.
inline std::string shortest_text(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// What is asked and what is proven of it.
struct TurningAnswer {
  std::string verdict;    ///< apart, hit or overlapping
  std::string time;       ///< [1] 30 decimals of first contact; none of what stays apart
  std::string clearance;  ///< [length] a power of ten that they stay more than apart; none of what touches
};

template <class A, class B> std::string turning_header(const Turning<A>& a, const Turning<B>& b) {
  std::string line = "query,motion,aim,verdict,time,clearance";
  each_number(a, [&](const std::string& name, double) { line += ",a_" + name; });
  each_number(b, [&](const std::string& name, double) { line += ",b_" + name; });
  return line;
}

template <class A, class B>
std::string turning_row(int query, std::string_view motion, std::string_view aim, const TurningAnswer& answer,
                        const Turning<A>& a, const Turning<B>& b) {
  std::string line = std::to_string(query);
  for (const std::string_view word : {motion, aim, std::string_view(answer.verdict), std::string_view(answer.time),
                                      std::string_view(answer.clearance)})
    line.append(",").append(word);
  const auto add = [&](const std::string&, double number) { line += "," + shortest_text(number); };
  each_number(a, add);
  each_number(b, add);
  return line;
}

}  // namespace thinwall::testing
