#pragma once
/// The grids of UniformGrid: one for each size of body, how wide its cells are and which cell a coordinate lies in.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
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
  const double way = x - origin, cells = is_finite(way) ? way * per_cell : (x / 2 - origin / 2) * per_cell * 2;
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

// ---- Sorts bodies into the cells of uniform grids, one grid for each size of body, and looks at neighboring cells only.

/// Time linear in bodies and pairs while bodies of like size do not pile up; memory linear in bodies, whatever the
/// world's size. A mix of k sizes (a size: a factor of two) costs up to k looks a body.
/// Degenerate: boxes of a side of 2^1000 or more, or infinite, are looked at by all others.
/// Source: derived in docs/broad_phase.md; cells in sorted order are the linked-cell method of molecular dynamics.
struct UniformGrid {
  static constexpr std::string_view name = "uniform_grid";
  struct Memory;
};

namespace grid {

struct Box {
  std::array<double, 3> low, high;
};

/// Every comparison is made: on short lists a branch guessed wrong costs more than five comparisons.
inline bool touch(const Box& a, const Box& b) {
  return static_cast<bool>(static_cast<int>(a.low[0] <= b.high[0]) & static_cast<int>(b.low[0] <= a.high[0]) &
                           static_cast<int>(a.low[1] <= b.high[1]) & static_cast<int>(b.low[1] <= a.high[1]) &
                           static_cast<int>(a.low[2] <= b.high[2]) & static_cast<int>(b.low[2] <= a.high[2]));
}

}  // namespace grid

struct UniformGrid::Memory {
  PairMemory pairs;
  std::vector<GridLevel> levels;
  std::vector<std::uint16_t> level_of;  ///< of each body
  std::vector<std::uint32_t> cell_of;   ///< of each body
  std::vector<std::uint32_t> starts;    ///< of each cell in the sorted order; one more at the end
  std::vector<std::uint32_t> ids;       ///< of the bodies in that order
  std::vector<grid::Box> boxes;         ///< in that order
  std::size_t bytes() const {
    return pairs.bytes() + bytes_of(levels) + bytes_of(level_of) + bytes_of(cell_of) + bytes_of(starts) +
           bytes_of(ids) + bytes_of(boxes);
  }
};

namespace grid {

/// Sorts the bodies by cell, by counting.
inline void sort_by_cell(std::span<const Proxy> proxies, UniformGrid::Memory& m) {
  const std::vector<std::array<Spread, 3>> spreads = spreads_of(proxies, m.levels, m.level_of);
  std::uint32_t cells = 0, bodies = 0;
  for (std::size_t l = 0; l < m.levels.size(); ++l) {
    GridLevel& level = m.levels[l];
    lay_cells(level, spreads[l]);
    level.first_cell = cells;
    cells += level.cells[0] * level.cells[1] * level.cells[2];
    bodies += level.count;
  }
  m.starts.assign(cells + std::size_t{2}, 0);  // counts begin two places on, so that places are starts in the end
  m.cell_of.resize(proxies.size());
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    if (m.level_of[i] == no_level) continue;
    const GridLevel& level = m.levels[m.level_of[i]];
    std::array<std::uint32_t, 3> c{};
    for (std::size_t k = 0; k < 3 && level.bounded; ++k) {
      const std::int64_t at = cell_at(proxies[i].low[static_cast<int>(k)], level.origin[k], level.per_cell[k]);
      c[k] = static_cast<std::uint32_t>(at) & (level.cells[k] - 1);
    }
    m.cell_of[i] = level.first_cell + c[0] + level.cells[0] * (c[1] + level.cells[1] * c[2]);
    ++m.starts[m.cell_of[i] + std::size_t{2}];
  }
  for (std::size_t c = 2; c < m.starts.size(); ++c) m.starts[c] += m.starts[c - 1];
  m.boxes.resize(bodies);
  m.ids.resize(bodies);
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    if (m.level_of[i] == no_level) continue;
    const std::uint32_t place = m.starts[m.cell_of[i] + std::size_t{1}]++;
    const Proxy& p = proxies[i];
    m.boxes[place] = {{p.low[0], p.low[1], p.low[2]}, {p.high[0], p.high[1], p.high[2]}};
    m.ids[place] = static_cast<std::uint32_t>(i);
  }
}

/// Holds one body against runs of others and passes on what it touches.
class Scanner {
 public:
  Scanner(const UniformGrid::Memory& m, PairSink& sink) : m_(m), sink_(sink) {}

  /// Body `a` against the bodies from `begin` to `end`, all by their place in the sorted order.
  void scan(std::uint32_t a, std::uint32_t begin, std::uint32_t end) {
    while (begin < end) {
      const std::uint32_t stop = end - begin > half ? begin + half : end;
      if (held_ > half) flush();
      const Box box = m_.boxes[a];
      std::size_t held = held_;
      for (std::uint32_t b = begin; b < stop; ++b) {
        touching_[held] = {a, b};
        held += std::size_t{touch(box, m_.boxes[b])};
      }
      held_ = held;
      begin = stop;
    }
  }

  /// Body `a` against the cells from `x` on, `count` of them, in the row that begins at cell `row`.
  void scan_cells(std::uint32_t a, std::uint32_t row, std::uint32_t row_cells, std::uint32_t x, std::uint32_t count) {
    const std::uint32_t before_wrap = std::min(count, row_cells - x);
    scan(a, m_.starts[row + x], m_.starts[row + x + before_wrap]);
    if (before_wrap < count) scan(a, m_.starts[row], m_.starts[row + count - before_wrap]);
  }

  void flush() {
    for (std::size_t k = 0; k < held_; ++k) sink_.add(m_.ids[touching_[k].first], m_.ids[touching_[k].second]);
    held_ = 0;
  }

 private:
  static constexpr std::uint32_t half = 256;

  const UniformGrid::Memory& m_;
  PairSink& sink_;
  std::size_t held_ = 0;
  std::array<ProxyPair, 2 * half + 1> touching_{};
};

/// The pairs within one grid. Each row of cells is held against itself and four of its eight neighbors.
inline void scan_level(const GridLevel& level, const UniformGrid::Memory& m, Scanner& scanner) {
  const auto [nx, ny, nz] = level.cells;
  const auto row_at = [&, columns = nx, rows = ny, layers = nz](std::uint32_t y, std::uint32_t z) {
    return level.first_cell + columns * ((y & (rows - 1)) + rows * (z & (layers - 1)));
  };
  for (std::uint32_t z = 0; z < nz; ++z) {
    for (std::uint32_t y = 0; y < ny; ++y) {
      std::array<std::uint32_t, 4> rows{};
      std::size_t row_count = 0;
      if (ny > 1) rows[row_count++] = row_at(y + 1, z);
      if (nz > 1) rows[row_count++] = row_at(y, z + 1);
      if (ny > 1 && nz > 1) rows[row_count++] = row_at(y + 1, z + 1);
      if (ny > 1 && nz > 1) rows[row_count++] = row_at(y - 1, z + 1);
      const std::uint32_t own = row_at(y, z);
      for (std::uint32_t x = 0; x < nx; ++x) {
        const std::uint32_t end = m.starts[own + x + 1];
        const std::uint32_t cells_around = nx == 1 ? 1 : 3;
        for (std::uint32_t a = m.starts[own + x]; a < end; ++a) {
          const bool wraps = x + 1 == nx;
          scanner.scan(a, a + 1, wraps ? end : m.starts[own + x + 2]);
          if (wraps && nx > 1) scanner.scan(a, m.starts[own], m.starts[own + 1]);
          for (std::size_t r = 0; r < row_count; ++r) {
            scanner.scan_cells(a, rows[r], nx, (x - 1) & (nx - 1), cells_around);
          }
        }
      }
    }
  }
}

/// The pairs of a body with those of another grid, whatever the sizes of either.
inline void scan_other_level(std::uint32_t a, const GridLevel& other, const UniformGrid::Memory& m, Scanner& scanner) {
  const Box& box = m.boxes[a];
  std::array<std::uint32_t, 3> from{}, count{1, 1, 1};
  for (std::size_t k = 0; k < 3 && other.bounded; ++k) {
    const std::int64_t first = cell_at(box.low[k], other.origin[k], other.per_cell[k]) - 1;
    const std::int64_t last = cell_at(box.high[k], other.origin[k], other.per_cell[k]);
    count[k] = static_cast<std::uint32_t>(std::min<std::int64_t>(last - first + 1, other.cells[k]));
    from[k] = static_cast<std::uint32_t>(first) & (other.cells[k] - 1);
  }
  for (std::uint32_t z = 0; z < count[2]; ++z) {
    for (std::uint32_t y = 0; y < count[1]; ++y) {
      const std::uint32_t layer = (from[2] + z) & (other.cells[2] - 1);
      const std::uint32_t row = ((from[1] + y) & (other.cells[1] - 1)) + other.cells[1] * layer;
      scanner.scan_cells(a, other.first_cell + row * other.cells[0], other.cells[0], from[0], count[0]);
    }
  }
}

}  // namespace grid

inline void find_pairs(const UniformGrid&, std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs,
                       std::size_t max_pairs, UniformGrid::Memory& m) {
  pairs.clear();
  require_valid(proxies);
  PairSink sink(proxies, max_pairs, m.pairs);
  grid::sort_by_size(proxies, m.levels, m.level_of);
  grid::sort_by_cell(proxies, m);
  grid::Scanner scanner(m, sink);
  for (const GridLevel& level : m.levels) {
    if (level.kind == 0) grid::scan_level(level, m, scanner);
    const std::uint32_t begin = m.starts[level.first_cell];
    for (const GridLevel& other : m.levels) {
      if (other.size_class < level.size_class || (other.kind == level.kind && level.kind != 0)) continue;
      if (other.size_class == level.size_class && other.kind <= level.kind) continue;  // itself, or seen from there
      for (std::uint32_t a = begin; a < begin + level.count; ++a) grid::scan_other_level(a, other, m, scanner);
    }
  }
  scanner.flush();
  sink.finish(pairs);
}

}  // namespace thinwall
