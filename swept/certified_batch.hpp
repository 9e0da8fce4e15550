#pragma once
/// Certified times of impact of many spheres at once. A row that the lanes' filter does not prove goes through the stages of
/// certified_time_of_impact, so every row is proven. Link thinwall::batch and thinwall::certified.

#include <thinwall/swept/batch.hpp>
#include <thinwall/swept/certified.hpp>

namespace thinwall {

/// Where certified answers go, a row each: as CertifiedToi.
struct CertifiedRows {
  std::span<ToiStatus> verdict;
  std::span<double> lower, upper;  ///< [1]
};

/// certified_time_of_impact of every sphere of A with that of B, or with the one that A or B is: each is a
/// RowsOf<Moving<Sphere<double>>> or a Moving<Sphere<double>>, and at least one is rows.
/// Throws std::invalid_argument as time_of_impact of rows does.
template <batch::BatchSide A, batch::BatchSide B>
  requires std::same_as<batch::ItemOf<A>, Moving<Sphere<double>>> &&
           std::same_as<batch::ItemOf<B>, Moving<Sphere<double>>>
BatchReport certified_time_of_impact(const A& a, const B& b, const CertifiedRows& out, BatchOptions options = {}) {
  const batch::Side<A> side_a(a);
  const batch::Side<B> side_b(b);
  const std::array columns = {batch::column_of(out.verdict, "the verdicts"),
                              batch::column_of(out.lower, "the lower bounds"),
                              batch::column_of(out.upper, "the upper bounds")};
  const std::size_t rows = batch::checked_rows(side_a, side_b, columns);
  return batch::in_blocks(rows, options, [&](std::size_t begin, std::size_t end) {
    const batch::Answers<double> answers{out.verdict.data(), out.lower.data(), out.upper.data()};
    const std::size_t unclear = batch::run_certified_spheres(side_a.rows_from(begin), side_b.rows_from(begin),
                                                             end - begin, answers.from(begin));
    for (std::size_t i = begin; unclear != 0 && i < end; ++i) {
      if (out.verdict[i] != batch::not_clear) continue;
      const CertifiedToi toi = certified_time_of_impact(side_a.item(i), side_b.item(i));
      out.verdict[i] = toi.verdict;
      out.lower[i] = toi.lower;
      out.upper[i] = toi.upper;
    }
    return unclear;
  });
}

}  // namespace thinwall
