#pragma once
/// A published query of two shapes that turn, as a line of CSV. docs/data/README.md says what the columns are.

#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "support/numbers_of.hpp"

namespace thinwall::testing {

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
