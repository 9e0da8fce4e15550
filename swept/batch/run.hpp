#pragma once
/// What passes between the front door of a batch and its vector code.

#include <cstddef>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall::batch {

inline constexpr std::size_t most_columns = 18;

/// The arrays of one side, or one number each, in the order of RowsOf::columns.
template <class S> struct Rows {
  const S* columns[most_columns];
  std::size_t count;
  bool is_one;  ///< one shape against every row of the other side
};

/// Where the answers to n rows go.
template <class S> struct Answers {
  ToiStatus* status;
  S* time;
  S* upper = nullptr;  ///< of a certified batch, whose `time` is the lower bound

  Answers from(std::size_t i) const { return {status + i, time + i, upper == nullptr ? nullptr : upper + i}; }
};

/// Marks a row that rounding might turn. The closed form never gives up on the pairs that have a batch.
inline constexpr ToiStatus not_clear = ToiStatus::gave_up;

/// Answers n rows by the widest vectors that this machine has, or that use_vectors() chose, and
/// returns how many of them are not_clear. Defined for the pairs of batch.hpp, in their order, for float and double.
template <class ItemA, class ItemB, class S>
std::size_t run(const Rows<S>& a, const Rows<S>& b, std::size_t n, const Answers<S>& out);

/// The same for certified answers of two spheres.
std::size_t run_certified_spheres(const Rows<double>& a, const Rows<double>& b, std::size_t n,
                                  const Answers<double>& out);

}  // namespace thinwall::batch
