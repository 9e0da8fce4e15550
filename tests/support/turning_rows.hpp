#pragma once
/// A published query of two shapes that turn, as a line of CSV. docs/data/README.md says what the columns are.

#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/triangle.hpp>
#include <thinwall/swept/turning.hpp>

namespace thinwall::testing {

/// The shortest text that reads back as the same bits.
inline std::string shortest_text(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

// Calls f(name, number) for each number of a shape, in the order of the columns.

template <class F> void each_number(std::string_view name, const Vec3<double>& v, const F& f) {
  for (int k = 0; k < 3; ++k) f(std::string(name) + "_" + "xyz"[k], v[k]);
}
template <class F> void each_number(const Sphere<double>& s, const F& f) {
  each_number("center", s.center, f);
  f("radius", s.radius);
}
template <class F> void each_number(const Capsule<double>& c, const F& f) {
  each_number("p", c.a, f);
  each_number("q", c.b, f);
  f("radius", c.radius);
}
template <class F> void each_number(const Obb<double>& box, const F& f) {
  each_number("center", box.center, f);
  each_number("half", box.half_extents, f);
  for (int k = 0; k < 3; ++k) each_number("axis" + std::to_string(k + 1), box.axes.col(k), f);
}
template <class F> void each_number(const Triangle<double>& t, const F& f) {
  each_number("p", t.a, f);
  each_number("q", t.b, f);
  each_number("r", t.c, f);
}
template <class A, class F> void each_number(const Turning<A>& m, const F& f) {
  each_number(m.shape, f);
  each_number("displacement", m.displacement, f);
  each_number("rotation", m.rotation, f);
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
