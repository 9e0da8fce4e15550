#pragma once
/// The numbers of a shape, of one that moves or turns, or of a ray, as text.

#include <array>
#include <charconv>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>

#include <thinwall/swept/members.hpp>
#include <thinwall/swept/turning.hpp>

namespace thinwall::testing {

constexpr std::array<std::string_view, 5> names_by_rank = {"Sphere", "Aabb", "Obb", "Triangle", "Capsule"};
template <class A> constexpr std::string_view shape_name = names_by_rank[A::rank];

/// What a failing case prints.
template <class Thing> std::string describe(const Thing& thing) {
  std::ostringstream out;
  for_each_named_number(thing, [&]<class S>(const std::string& name, const S& number) {
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
  for_each_named_number(a, [&](const std::string& name, double) { line += ",a_" + name; });
  for_each_named_number(b, [&](const std::string& name, double) { line += ",b_" + name; });
  return line;
}

template <class A, class B>
std::string turning_row(int query, std::string_view motion, std::string_view aim, const TurningAnswer& answer,
                        const Turning<A>& a, const Turning<B>& b) {
  std::string line = std::to_string(query);
  for (const std::string_view word : {motion, aim, std::string_view(answer.verdict), std::string_view(answer.time),
                                      std::string_view(answer.clearance)})
    line.append(",").append(word);
  const auto add = [&](double number) { line += "," + shortest_text(number); };
  for_each_number(a, add);
  for_each_number(b, add);
  return line;
}

}  // namespace thinwall::testing
