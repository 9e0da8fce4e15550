// Runs a kernel over rows: whole vectors, then the ragged end in one more that repeats its last row.

#if defined(THINWALL_BATCH_DRIVER) == defined(HWY_TARGET_TOGGLE)
#ifdef THINWALL_BATCH_DRIVER
#undef THINWALL_BATCH_DRIVER
#else
#define THINWALL_BATCH_DRIVER
#endif

#include <algorithm>
#include <cstdint>

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
  const S* of[most_columns];
  explicit EachRowOf(const Rows<S>& rows) { std::copy_n(rows.columns, columns, of); }
  HWY_INLINE EachRow<D> at(D d, std::size_t i) const { return {d, of, i}; }
};
template <class D, std::size_t columns> struct SameRowOf {
  using S = hn::TFromD<D>;
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
  const auto clear = hn::Or(verdict.hit, hn::Or(verdict.apart, verdict.overlapping));
  hn::StoreU(hn::IfThenZeroElse(verdict.overlapping, verdict.time), d, out.time + at);
  if constexpr (requires { verdict.upper; })
    hn::StoreU(hn::IfThenZeroElse(verdict.overlapping, verdict.upper), d, out.upper + at);
  auto* const status = reinterpret_cast<std::int32_t*>(out.status + at);
  auto code = hn::Set(d, static_cast<S>(not_clear));
  code = hn::IfThenElse(verdict.hit, hn::Set(d, static_cast<S>(ToiStatus::hit)), code);
  code = hn::IfThenElse(verdict.apart, hn::Set(d, static_cast<S>(ToiStatus::apart)), code);
  code = hn::IfThenElse(verdict.overlapping, hn::Set(d, static_cast<S>(ToiStatus::overlapping)), code);
  if constexpr (sizeof(S) == 8) {
    hn::StoreU(hn::DemoteTo(di, code), di, status);
  } else {
    hn::StoreU(hn::ConvertTo(di, code), di, status);
  }
  return hn::Lanes(d) - hn::CountTrue(d, clear);
}

template <class Kernel, template <class, std::size_t> class A, template <class, std::size_t> class B, class S>
HWY_INLINE std::size_t run_rows(const Rows<S>& a, const Rows<S>& b, std::size_t n, const Answers<S>& answers) {
  using D = hn::ScalableTag<S>;
  using SideA = A<D, Kernel::columns_a>;
  using SideB = B<D, Kernel::columns_b>;
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  const Kernel kernel;
  const Answers<S> out = answers;
  const SideA side_a(a);
  const SideB side_b(b);
  std::size_t unclear = 0, i = 0;
  for (; i + lanes <= n; i += lanes) unclear += store(d, kernel(d, side_a.at(d, i), side_b.at(d, i)), out, i);
  if (i == n) return unclear;

  constexpr std::size_t most = HWY_MAX_BYTES / sizeof(S);
  S room_a[most_columns][most], room_b[most_columns][most], times[most], uppers[most] = {};
  ToiStatus statuses[most];
  const auto copied = [&](const Rows<S>& rows, S(*room)[most]) {
    Rows<S> end = rows;
    for (std::size_t k = 0; k < rows.count && !rows.is_one; ++k) {
      for (std::size_t lane = 0; lane < lanes; ++lane) room[k][lane] = rows.columns[k][std::min(i + lane, n - 1)];
      end.columns[k] = room[k];
    }
    return end;
  };
  const SideA end_a(copied(a, room_a));
  const SideB end_b(copied(b, room_b));
  store(d, kernel(d, end_a.at(d, 0), end_b.at(d, 0)), Answers<S>{statuses, times, uppers}, 0);
  for (std::size_t lane = 0; i < n; ++i, ++lane) {
    out.time[i] = times[lane];
    if (out.upper != nullptr) out.upper[i] = uppers[lane];
    out.status[i] = statuses[lane];
    unclear += out.status[i] == not_clear ? 1 : 0;
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
