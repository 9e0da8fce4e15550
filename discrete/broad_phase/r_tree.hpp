#pragma once
/// A tree of nested boxes, built anew for each step. Needs Boost.Geometry; nothing else in discrete/ does.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#ifndef BOOST_ALLOW_DEPRECATED_HEADERS  // Boost's R-tree includes one of its own, and would say so in every build
#define BOOST_ALLOW_DEPRECATED_HEADERS
#define THINWALL_ALLOWED_DEPRECATED_HEADERS
#endif
#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#ifdef THINWALL_ALLOWED_DEPRECATED_HEADERS
#undef BOOST_ALLOW_DEPRECATED_HEADERS
#undef THINWALL_ALLOWED_DEPRECATED_HEADERS
#endif

#include <thinwall/discrete/broad_phase/proxy.hpp>

namespace thinwall {

/// Boost.Geometry's R-tree, packed from all boxes at once, asked once for each moving body. Its boxes are rounded to
/// floats; what it finds is checked with the boxes given. Time n log n, whatever the sizes, as long as floats tell the boxes apart: not
/// beyond 1e36, nor below 1e-36.
/// Source: Leutenegger, Lopez and Edgington, STR: a simple and efficient algorithm for R-tree packing, 1997, and
/// Garcia, Lopez and Leutenegger 1998, as Boost.Geometry says.
struct RTree {
  static constexpr std::string_view name = "r_tree";
  struct Memory;
};

namespace r_tree {

using Point = boost::geometry::model::point<float, 3, boost::geometry::cs::cartesian>;
using Box = boost::geometry::model::box<Point>;
using Entry = std::pair<Box, std::uint32_t>;
/// The standard allocator, and a count of what it gave out.
template <class T> struct Counting {
  using value_type = T;
  std::size_t* bytes;  ///< [bytes] given out so far; what comes back is not taken off

  explicit Counting(std::size_t& count) : bytes(&count) {}
  template <class U> Counting(const Counting<U>& other) : bytes(other.bytes) {}  // as allocators convert
  T* allocate(std::size_t count) {
    *bytes += count * sizeof(T);
    return std::allocator<T>().allocate(count);
  }
  void deallocate(T* place, std::size_t count) { std::allocator<T>().deallocate(place, count); }
  friend bool operator==(const Counting&, const Counting&) { return true; }
};

using Tree =
    boost::geometry::index::rtree<Entry, boost::geometry::index::rstar<8>, boost::geometry::index::indexable<Entry>,
                                  boost::geometry::index::equal_to<Entry>, Counting<Entry>>;

inline constexpr double largest =
    0x1p120;  ///< [length] beyond, coordinates are one: sums and differences must be floats

/// Each coordinate's nearest float, within `largest`. That never falls as a number grows, so boxes that touch still do.
inline Point point_of(const Vec3<double>& x) {
  const auto rounded = [](double c) { return static_cast<float>(std::clamp(c, -largest, largest)); };
  return {rounded(x[0]), rounded(x[1]), rounded(x[2])};
}
inline Box box_of(const Proxy& p) { return {point_of(p.low), point_of(p.high)}; }

/// An output iterator that hands each entry to a function.
template <class F> class Each {
 public:
  explicit Each(F& take) : take_(&take) {}
  Each& operator*() { return *this; }
  Each& operator++() { return *this; }
  Each operator++(int) { return *this; }
  Each& operator=(const Entry& entry) {
    (*take_)(entry);
    return *this;
  }

 private:
  F* take_;
};

}  // namespace r_tree

struct RTree::Memory {
  PairMemory pairs;
  std::vector<r_tree::Entry> entries;
  std::size_t tree_bytes = 0;
  std::size_t bytes() const { return pairs.bytes() + bytes_of(entries) + tree_bytes; }
};

inline void find_pairs(const RTree&, std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs,
                       std::size_t max_pairs, RTree::Memory& m) {
  pairs.clear();
  require_valid(proxies);
  PairSink sink(proxies, max_pairs, m.pairs);
  m.entries.clear();
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    if (!proxies[i].skipped) m.entries.emplace_back(r_tree::box_of(proxies[i]), static_cast<std::uint32_t>(i));
  }
  m.tree_bytes = 0;
  const r_tree::Tree tree(m.entries, {}, {}, {}, r_tree::Counting<r_tree::Entry>(m.tree_bytes));
  for (const r_tree::Entry& mine : tree) {  // in the tree's order: the next query walks where the last one did
    const Proxy& body = proxies[mine.second];
    if (body.is_static) continue;
    auto take = [&](const r_tree::Entry& other) {
      const Proxy& partner = proxies[other.second];
      if (!partner.is_static && other.second <= mine.second) return;  // found from the other side, or itself
      if (boxes_touch(body, partner)) sink.add(mine.second, other.second);
    };
    tree.query(boost::geometry::index::intersects(mine.first), r_tree::Each(take));
  }
  sink.finish(pairs);
}

}  // namespace thinwall
