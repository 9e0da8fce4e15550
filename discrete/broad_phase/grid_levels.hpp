#pragma once
/// The grids of UniformGrid: one for each size of body, how wide its cells are and which cell a coordinate lies in.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>

namespace thinwall {

/// The bodies whose widest side lies between one power of two and the next, and of one kind.
/// A body lies in the cell of its low corner. A cell is wider than every body of the grid, so a body that another one
/// touches lies at most one cell further. The cells wrap around: far bodies may share a cell and are told apart by
/// their boxes, so that memory depends on the number of bodies alone, and an escaped body costs nothing.
struct GridLevel {
  int kind = 0;  ///< 0: its bodies may meet; else none of one kind meets another of that kind, here or in other grids
  bool bounded = true;                                  ///< false: boxes of no size a cell could have, all in one cell
  int size_class = 0;                                   ///< binary exponent of the widest side
  std::uint32_t count = 0;                              ///< of bodies
  std::uint32_t first_cell = 0;                         ///< of this grid, among the cells of all
  std::array<std::uint32_t, 3> cells{1, 1, 1};          ///< along each axis: 1, or a power of two >= 4
  std::array<double, 3> origin{}, per_cell{};           ///< [length], [1 / length]
  std::array<double, 3> least{}, greatest{}, widest{};  ///< [length] of the low corners; of the boxes' sides
};

namespace grid {

inline constexpr std::uint16_t no_level = 0xffff;
inline constexpr double farthest_cell = 0x1p42;  ///< [cells] from the origin; beyond lies one cell
inline constexpr double cell_margin = 0x1p-8;    ///< cells are this much wider than bodies: docs/broad_phase.md
inline constexpr int unbounded_class = 1001;     ///< sides of 2^1000 and more: their cells could overflow

/// The number of the cell that holds x, never falling as x grows.
inline std::int64_t cell_at(double x, double origin, double per_cell) {
  const double cells = (x - origin) * per_cell;
  const double near = cells < farthest_cell ? (cells > -farthest_cell ? cells : -farthest_cell) : farthest_cell;
  const auto toward_zero = static_cast<std::int64_t>(near);
  return toward_zero - (near < static_cast<double>(toward_zero) ? 1 : 0);
}

inline int size_class_of(const Vec3<double>& sides) {
  const double widest = std::max(sides[0], std::max(sides[1], sides[2]));
  const double sum = sides[0] + sides[1] + sides[2];  // NaN for a box that lies at infinity
  if (!(sum < 0x1p1000)) return unbounded_class;
  return static_cast<int>(std::bit_cast<std::uint64_t>(widest + 0.0) >> 52) - 1023;  // + 0.0: the zero without a sign
}

/// Tells apart the bodies that never meet their like: static ones, and those of a group that their own mask leaves out,
/// such as debris. So a heap of them costs nothing.
class Kinds {
 public:
  static constexpr int most = 4;

  int of(const Proxy& p) {
    if (p.is_static) return 1;
    if ((p.group & p.mask) != 0) return 0;
    for (int k = 2; k < used_; ++k) {
      if (known_[static_cast<std::size_t>(k)] == std::pair{p.group, p.mask}) return k;
    }
    if (used_ == most) return 0;  // held against each other, for nothing
    known_[static_cast<std::size_t>(used_)] = {p.group, p.mask};
    return used_++;
  }

 private:
  int used_ = 2;
  std::array<std::pair<std::uint32_t, std::uint32_t>, most> known_{};
};

/// Puts every body that is not skipped into a grid; fills `levels`, in no order of size, and `level_of`.
inline void sort_by_size(std::span<const Proxy> proxies, std::vector<GridLevel>& levels,
                         std::vector<std::uint16_t>& level_of) {
  constexpr std::size_t classes = unbounded_class + 1024;
  std::array<std::uint16_t, Kinds::most * classes> level_at;  // filled below
  Kinds kinds;
  level_at.fill(no_level);
  levels.clear();
  level_of.assign(proxies.size(), no_level);
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const Proxy& p = proxies[i];
    if (p.skipped) continue;
    const Vec3<double> sides = p.high - p.low;
    const int size_class = size_class_of(sides);
    const int kind = kinds.of(p);
    std::uint16_t& at =
        level_at[static_cast<std::size_t>(kind) * classes + static_cast<std::size_t>(size_class + 1023)];
    if (at == no_level) {
      at = static_cast<std::uint16_t>(levels.size());
      GridLevel& fresh = levels.emplace_back();
      fresh.kind = kind;
      fresh.bounded = size_class != unbounded_class;
      fresh.size_class = size_class;
      for (std::size_t k = 0; k < 3; ++k) fresh.least[k] = fresh.greatest[k] = p.low[static_cast<int>(k)];
    }
    level_of[i] = at;
    GridLevel& level = levels[at];
    ++level.count;
    for (std::size_t k = 0; k < 3; ++k) {
      const double low = p.low[static_cast<int>(k)];
      level.least[k] = std::min(level.least[k], low);
      level.greatest[k] = std::max(level.greatest[k], low);
      level.widest[k] = std::max(level.widest[k], sides[static_cast<int>(k)]);
    }
  }
}

/// Where most bodies of a grid are along one axis.
struct Spread {
  double middle = 0;  ///< [length]
  double width = 0;   ///< [length] holds the middle three quarters
};

/// From at most `most` bodies taken at even distances in the list: an escaped body changes nothing.
inline std::vector<std::array<Spread, 3>> spreads_of(std::span<const Proxy> proxies,
                                                     const std::vector<GridLevel>& levels,
                                                     const std::vector<std::uint16_t>& level_of) {
  constexpr std::uint32_t most = 64;
  std::vector<std::vector<std::size_t>> sample(levels.size());
  std::vector<std::uint32_t> wait(levels.size(), 1);
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const std::uint16_t l = level_of[i];
    if (l == no_level || --wait[l] > 0) continue;
    wait[l] = (levels[l].count + most - 1) / most;
    sample[l].push_back(i);
  }
  std::vector<std::array<Spread, 3>> spreads(levels.size());
  std::vector<double> lows;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    for (std::size_t k = 0; k < 3; ++k) {
      lows.clear();
      for (const std::size_t i : sample[l]) lows.push_back(proxies[i].low[static_cast<int>(k)]);
      std::sort(lows.begin(), lows.end());
      const std::size_t n = lows.size();
      const double width = lows[n - 1 - n / 8] - lows[n / 8];
      spreads[l][k] = {lows[n / 2], std::min(width, std::numeric_limits<double>::max())};
    }
  }
  return spreads;
}

/// Chooses the width of the grid's cells and their number: at most twice the number of bodies.
inline void lay_cells(GridLevel& level, const std::array<Spread, 3>& spread) {
  if (!level.bounded) return;
  for (std::size_t k = 0; k < 3; ++k) {
    const double width = std::max({level.widest[k] * (1 + cell_margin), spread[k].width * (2 / farthest_cell),
                                   std::numeric_limits<double>::min()});
    level.origin[k] = spread[k].middle;
    level.per_cell[k] = 1 / width;
    const double wanted = (level.greatest[k] - level.least[k]) / width + 1;
    if (wanted >= 2)
      level.cells[k] = std::bit_ceil(static_cast<std::uint32_t>(std::min(std::max(wanted, 4.0), 0x1p30)));
  }
  const auto total = [&] {
    return static_cast<double>(level.cells[0]) * static_cast<double>(level.cells[1]) *
           static_cast<double>(level.cells[2]);
  };
  while (total() > 2.0 * level.count && total() > 1) {
    std::uint32_t& most = *std::max_element(level.cells.begin(), level.cells.end());
    most = most == 4 ? 1 : most / 2;  // with 2 or 3 cells around, the next and the last would be one
  }
}

}  // namespace grid
}  // namespace thinwall
