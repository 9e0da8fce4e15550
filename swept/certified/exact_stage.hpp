#pragma once
/// The last stage: the same question in integers, whose answer is right for every finite input.
///
/// Whether the shapes have touched by a time t is one exact predicate; two of them give the verdict, and a search among the
/// doubles around a guess gives two neighbors that enclose the first contact.

#include <bit>
#include <cstdint>

#include <thinwall/swept/certified/gjk.hpp>

namespace thinwall {

/// True if the shapes share a point at some time in [0, time]. Where the exponents of the input are too far apart for the
/// fixed width, coordinates are cut off there first: no corner moves by as much as 64 units, so a reach that much longer or
/// shorter decides all but a near-touch.
inline bool touched_by(const ExactCore& query, double time) {
  constexpr int fixed = 1024, coordinate_bits = 126, moved = 64;
  static_assert(SweptCore::bits_for(coordinate_bits) <= fixed);
  const SweptCore core(query, time);
  if (core.integer_bits() <= fixed) return touches_origin(IntegerPolytope<FixedInteger<fixed>>(core));

  IntegerPolytope<FixedInteger<fixed>> cut(core, core.low_for(coordinate_bits));
  cut.reach += moved;
  if (!touches_origin(cut)) return false;
  cut.reach -= 2 * moved;
  if (cut.reach >= 0 && touches_origin(cut)) return true;
  return touches_origin(IntegerPolytope<UnboundedInteger>(core));
}

/// The neighboring doubles that enclose the first contact of shapes that do not touch at 0 and have touched by 1.
/// Errors: none; `lower` < first contact <= `upper`. A good guess saves rounds and changes nothing else.
inline CertifiedToi exact_bracket(const ExactCore& query, double guess) {
  const auto number = [](double time) { return std::bit_cast<std::uint64_t>(time); };  // doubles >= 0 in their order
  std::uint64_t lower = number(0.0), upper = number(1.0);
  const auto probe = [&](std::uint64_t at) {
    if (at > lower && at < upper) (touched_by(query, std::bit_cast<double>(at)) ? upper : lower) = at;
  };
  const std::uint64_t center = guess > 0 && guess <= 1 ? number(guess) : number(1.0);
  for (std::uint64_t step = 1; lower + 1 < upper && step <= center / 16; step *= 16) {  // out from the guess
    probe(center - step);
    probe(center + step);
    if (lower + step >= center && upper <= center + step) break;
  }
  while (lower + 1 < upper) probe(lower + (upper - lower) / 2);
  return {ToiStatus::hit, std::bit_cast<double>(lower), std::bit_cast<double>(upper), DecidedBy::exact};
}

inline CertifiedToi exact_answer(const ExactCore& query, double guess) {
  if (touched_by(query, 0)) return {ToiStatus::overlapping, 0, 0, DecidedBy::exact};
  if (!touched_by(query, 1)) return {ToiStatus::apart, 1, 1, DecidedBy::exact};
  return exact_bracket(query, guess);
}

}  // namespace thinwall
