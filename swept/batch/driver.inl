// Runs a kernel over rows, a vector of neighbors at a time. If it has a first look, `parts`, which tells most rows apart, and one shape is
// asked against many, the others are put off and asked side by side: what few lanes of a vector need, all take part in.

#if defined(THINWALL_BATCH_DRIVER) == defined(HWY_TARGET_TOGGLE)
#ifdef THINWALL_BATCH_DRIVER
#undef THINWALL_BATCH_DRIVER
#else
#define THINWALL_BATCH_DRIVER
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include <thinwall/swept/batch/lanes.inl>
#include <thinwall/swept/batch/run.hpp>

HWY_BEFORE_NAMESPACE();
namespace thinwall::batch::HWY_NAMESPACE {

/// Reads column k of the vector of rows that begins at `at`.
template <class D> struct EachRow {
  using S = hn::TFromD<D>;
  D d;
  const S* const* columns;
  std::size_t at = 0;
  HWY_INLINE hn::Vec<D> operator()(int k) const { return hn::LoadU(d, columns[k] + at); }
};

/// The same number for every row.
template <class D> struct SameRow {
  using S = hn::TFromD<D>;
  D d;
  const S* numbers;
  HWY_INLINE hn::Vec<D> operator()(int k) const { return hn::Set(d, numbers[k]); }
};

/// One side of a kernel. It holds what it reads by: read through `rows`, every store would make the compiler fetch that again.
template <class D, std::size_t columns> struct EachRowOf {
  using S = hn::TFromD<D>;
  static constexpr bool is_one = false;
  const S* of[most_columns];
  explicit EachRowOf(const Rows<S>& rows) { std::copy_n(rows.columns, columns, of); }
  HWY_INLINE EachRow<D> at(D d, std::size_t i) const { return {d, of, i}; }
};
template <class D, std::size_t columns> struct SameRowOf {
  using S = hn::TFromD<D>;
  static constexpr bool is_one = true;
  S numbers[most_columns];
  explicit SameRowOf(const Rows<S>& rows) {
    for (std::size_t k = 0; k < columns; ++k) numbers[k] = *rows.columns[k];
  }
  HWY_INLINE SameRow<D> at(D d, std::size_t) const { return {d, numbers}; }
};

/// Writes times and verdicts, of a certified kernel both bounds; returns how many rows are not clear.
template <class D, class V>
HWY_INLINE std::size_t store(D d, const V& verdict, const Answers<hn::TFromD<D>>& out, std::size_t at) {
  using S = hn::TFromD<D>;
  static_assert(sizeof(ToiStatus) == sizeof(std::int32_t));
  const hn::Rebind<std::int32_t, D> di;
  hn::StoreU(hn::IfThenZeroElse(verdict.overlapping, verdict.time), d, out.time + at);
  if constexpr (requires { verdict.upper; })
    hn::StoreU(hn::IfThenZeroElse(verdict.overlapping, verdict.upper), d, out.upper + at);
  auto* const status = reinterpret_cast<std::int32_t*>(out.status + at);
  const auto code_of = [d](ToiStatus one) HWY_ATTR { return hn::Set(d, static_cast<S>(one)); };
  auto code = hn::IfThenElse(verdict.hit, code_of(ToiStatus::hit), code_of(ToiStatus::apart));
  code = hn::IfThenElse(verdict.overlapping, code_of(ToiStatus::overlapping), code);
  code = hn::IfThenElse(verdict.clear, code, code_of(not_clear));
  if constexpr (sizeof(S) == 8) {
    hn::StoreU(hn::DemoteTo(di, code), di, status);
  } else {
    hn::StoreU(hn::ConvertTo(di, code), di, status);
  }
  return hn::Lanes(d) - hn::CountTrue(d, verdict.clear);
}

/// Rows that were put off, by their numbers, below 2^16.
struct RowList {
  static constexpr std::size_t most = 512;
  std::uint16_t rows[most + 4];  // four are written at a time
  std::size_t count = 0;

  HWY_INLINE void add(std::size_t row) { rows[count++] = static_cast<std::uint16_t>(row); }
  /// Of the vector that begins at row i, those that are set: four at a time, by a table of which they are.
  template <class D> HWY_INLINE void add(D d, std::size_t i, hn::Mask<D> which) {
    static constexpr auto of_four = [] {
      std::array<std::array<std::uint16_t, 4>, 16> table{};
      for (std::size_t bits = 0; bits < 16; ++bits) {
        for (std::size_t lane = 0, n = 0; lane < 4; ++lane) {
          if ((bits >> lane & 1) != 0) table[bits][n++] = static_cast<std::uint16_t>(lane);
        }
      }
      return table;
    }();
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, which, bytes);
    for (std::size_t lane = 0; lane < hn::Lanes(d); lane += 4) {
      const unsigned bits = bytes[lane / 8] >> lane % 8 & 15U;
      std::uint64_t four;
      std::memcpy(&four, &of_four[bits], sizeof(four));
      four += (i + lane) * 0x0001000100010001U;
      std::memcpy(rows + count, &four, sizeof(four));
      count += static_cast<std::size_t>(std::popcount(bits));
    }
  }
};

/// The numbers of up to `most` listed rows, side by side; where the last vector has room the last row is repeated.
template <class S, std::size_t columns> struct CopiedRows {
  static constexpr std::size_t most = 64;  // a multiple of any vector's lanes
  static_assert(HWY_MAX_BYTES / sizeof(S) <= most);
  S numbers[columns][most];

  HWY_INLINE Rows<S> of(const Rows<S>& all, const std::uint16_t* rows, std::size_t count, std::size_t lanes) {
    if (all.is_one) return all;
    Rows<S> out{{}, columns, false};
    for (std::size_t k = 0; k < columns; ++k) {
      for (std::size_t j = 0; j < count; ++j) numbers[k][j] = all.columns[k][rows[j]];
      for (std::size_t j = count; j % lanes != 0; ++j) numbers[k][j] = numbers[k][count - 1];
      out.columns[k] = numbers[k];
    }
    return out;
  }
};

/// Answers listed rows; returns how many are not clear.
template <class Kernel, template <class, std::size_t> class A, template <class, std::size_t> class B, class D, class S>
HWY_INLINE std::size_t answer_listed(D d, const Rows<S>& rows_a, const Rows<S>& rows_b, const RowList& list,
                                     const Answers<S>& out) {
  using CopiedA = CopiedRows<S, Kernel::columns_a>;
  const std::size_t lanes = hn::Lanes(d);
  CopiedA copied_a;
  CopiedRows<S, Kernel::columns_b> copied_b;
  S times[CopiedA::most], uppers[CopiedA::most] = {};
  ToiStatus statuses[CopiedA::most];
  std::size_t unclear = 0;
  for (std::size_t begin = 0; begin < list.count; begin += CopiedA::most) {
    const std::uint16_t* const rows = list.rows + begin;
    const std::size_t count = std::min(CopiedA::most, list.count - begin);
    const A<D, Kernel::columns_a> a(copied_a.of(rows_a, rows, count, lanes));
    const B<D, Kernel::columns_b> b(copied_b.of(rows_b, rows, count, lanes));
    for (std::size_t j = 0; j < count; j += lanes)
      store(d, Kernel()(d, a.at(d, j), b.at(d, j)), Answers<S>{statuses, times, uppers}, j);
    for (std::size_t j = 0; j < count; ++j) {
      out.time[rows[j]] = times[j];
      if (out.upper != nullptr) out.upper[rows[j]] = uppers[j];
      out.status[rows[j]] = statuses[j];
      unclear += statuses[j] == not_clear ? 1 : 0;
    }
  }
  return unclear;
}

template <class Kernel, template <class, std::size_t> class A, template <class, std::size_t> class B, class S>
HWY_INLINE std::size_t run_rows(const Rows<S>& rows_a, const Rows<S>& rows_b, std::size_t n,
                                const Answers<S>& answers) {
  using D = hn::ScalableTag<S>;
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  const A<D, Kernel::columns_a> a(rows_a);
  const B<D, Kernel::columns_b> b(rows_b);
  constexpr bool looks_first = (decltype(a)::is_one || decltype(b)::is_one) && requires { Kernel::looks_first; };
  RowList list;
  std::size_t unclear = 0;
  for (std::size_t begin = 0; begin < n; begin += RowList::most) {
    const std::size_t count = std::min(n - begin, RowList::most);
    const Answers<S> out = answers.from(begin);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
      if constexpr (looks_first) {
        const auto apart = Kernel::parts(d, a.at(d, begin + i), b.at(d, begin + i));
        hn::StoreU(hn::Set(d, S(1)), d, out.time + i);
        std::fill_n(out.status + i, lanes, ToiStatus::apart);
        list.add(d, i, hn::Not(apart));
      } else {
        unclear += store(d, Kernel()(d, a.at(d, begin + i), b.at(d, begin + i)), out, i);
      }
    }
    for (; i < count; ++i) list.add(i);
    unclear += answer_listed<Kernel, A, B>(d, rows_a.from(begin), rows_b.from(begin), list, out);
    list.count = 0;
  }
  return unclear;
}

template <class Kernel, class S>
HWY_ATTR std::size_t run_target(const Rows<S>& a, const Rows<S>& b, std::size_t n, const Answers<S>& out) {
  if (a.is_one) return run_rows<Kernel, SameRowOf, EachRowOf>(a, b, n, out);
  if (b.is_one) return run_rows<Kernel, EachRowOf, SameRowOf>(a, b, n, out);
  return run_rows<Kernel, EachRowOf, EachRowOf>(a, b, n, out);
}

}  // namespace thinwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
