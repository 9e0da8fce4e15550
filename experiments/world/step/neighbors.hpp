#pragma once
/// Whom a body may meet in what is left of a step, kept up to date while bodies change course.
///
/// Every body has a box that holds the rest of its path, and two bodies are linked if their boxes meet. The broad phase gives
/// the first links. A body whose new path stays in its box keeps box and links; another gets a new box, and is linked to all
/// whose boxes it meets. So two bodies that are not linked have disjoint boxes and cannot meet. However often bodies turn, each
/// has one box, and at most one link to each other.

#include <memory>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>

namespace thinwall {

class Neighbors {
 public:
  Neighbors();
  ~Neighbors();

  /// Begins a step: the boxes and the links, both of which must live until its end. `has_links` [by body] is false for bodies
  /// that never change course, and are not asked about. `everyone`: link all, whatever their boxes.
  void begin(std::vector<Proxy>& proxies, std::span<const ProxyPair> pairs, const std::vector<bool>& has_links,
             bool everyone);

  /// The body goes on in this box.
  void change(std::uint32_t which, const Proxy& box);

  /// All that may be met, in ascending order.
  const std::vector<std::uint32_t>& of(std::uint32_t which);

  std::size_t bytes() const;

 private:
  void link_pairs();
  void search(const Proxy& box);

  struct Tree;
  std::vector<Proxy>* proxies_ = nullptr;
  std::span<const ProxyPair> pairs_;
  const std::vector<bool>* has_links_ = nullptr;
  bool everyone_ = false, linked_ = false;
  std::vector<std::uint32_t> start_, links_;                          // of the pairs, body by body
  std::unordered_map<std::uint32_t, std::set<std::uint32_t>> later_;  // links made since
  std::size_t searches_ = 0;
  std::unique_ptr<Tree> tree_;  // of all boxes, once enough of them have been searched
  std::vector<std::uint32_t> found_, answer_;
};

}  // namespace thinwall
