#include <thinwall/experiments/world/step/neighbors.hpp>

#include <algorithm>

#include <thinwall/discrete/broad_phase/r_tree.hpp>
#include <thinwall/experiments/world/step/boxes.hpp>

// What removing from an R-tree needs; after r_tree.hpp, which silences Boost's note about a header of its own.
#include <boost/geometry/algorithms/covered_by.hpp>
#include <boost/geometry/algorithms/equals.hpp>

namespace thinwall {
namespace {

constexpr std::size_t searches_by_loop = 4;  // then a tree pays: it costs as much as a few dozen passes over the boxes

}  // namespace

struct Neighbors::Tree {
  boost::geometry::index::rtree<r_tree::Entry, boost::geometry::index::quadratic<16>> boxes;
};

Neighbors::Neighbors() = default;
Neighbors::~Neighbors() = default;

void Neighbors::begin(std::vector<Proxy>& proxies, std::span<const ProxyPair> pairs, const std::vector<bool>& has_links,
                      bool everyone) {
  proxies_ = &proxies;
  pairs_ = pairs;
  has_links_ = &has_links;
  everyone_ = everyone;
  linked_ = false;
  later_.clear();
  searches_ = 0;
  tree_.reset();
}

void Neighbors::link_pairs() {
  linked_ = true;
  start_.assign(proxies_->size() + 1, 0);
  const auto each_end = [&](const auto& use) {
    for (const ProxyPair& pair : pairs_) {
      if ((*has_links_)[pair.first]) use(pair.first, pair.second);
      if ((*has_links_)[pair.second]) use(pair.second, pair.first);
    }
  };
  each_end([&](std::uint32_t from, std::uint32_t) { ++start_[from + 1]; });
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
  links_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  each_end([&](std::uint32_t from, std::uint32_t to) { links_[next[from]++] = to; });
}

/// All that the box meets, in ascending order, to found_.
void Neighbors::search(const Proxy& box) {
  found_.clear();
  const std::vector<Proxy>& proxies = *proxies_;
  if (++searches_ <= searches_by_loop) {
    for (std::uint32_t k = 0; k < proxies.size(); ++k) {
      if (boxes_touch(box, proxies[k]) && may_meet(box, proxies[k])) found_.push_back(k);
    }
    return;
  }
  if (!tree_) {
    std::vector<r_tree::Entry> entries;
    entries.reserve(proxies.size());
    for (std::uint32_t k = 0; k < proxies.size(); ++k) {
      if (!proxies[k].skipped) entries.emplace_back(r_tree::box_of(proxies[k]), k);
    }
    tree_ = std::make_unique<Tree>();
    tree_->boxes = decltype(tree_->boxes)(entries);
  }
  auto take = [&](const r_tree::Entry& entry) {
    const Proxy& other = proxies[entry.second];
    if (boxes_touch(box, other) && may_meet(box, other)) found_.push_back(entry.second);
  };
  tree_->boxes.query(boost::geometry::index::intersects(r_tree::box_of(box)), r_tree::Each(take));
  std::sort(found_.begin(), found_.end());
}

void Neighbors::change(std::uint32_t which, const Proxy& box) {
  Proxy& old = (*proxies_)[which];
  if (everyone_ || old.skipped || holds_box(old, box)) return;
  search(box);
  if (tree_) {
    tree_->boxes.remove(r_tree::Entry(r_tree::box_of(old), which));
    tree_->boxes.insert(r_tree::Entry(r_tree::box_of(box), which));
  }
  old = box;
  for (const std::uint32_t other : found_) {
    if (other == which) continue;
    later_[which].insert(other);
    if ((*has_links_)[other]) later_[other].insert(which);
  }
}

const std::vector<std::uint32_t>& Neighbors::of(std::uint32_t which) {
  answer_.clear();
  const std::vector<Proxy>& proxies = *proxies_;
  if (everyone_) {
    for (std::uint32_t k = 0; k < proxies.size(); ++k) {
      if (k != which && may_meet(proxies[which], proxies[k])) answer_.push_back(k);
    }
    return answer_;
  }
  if (!linked_) link_pairs();
  const auto first = links_.begin() + start_[which], last = links_.begin() + start_[which + 1];
  answer_.assign(first, last);
  if (const auto later = later_.find(which); later != later_.end()) {
    answer_.insert(answer_.end(), later->second.begin(), later->second.end());
  }
  std::sort(answer_.begin(), answer_.end());
  answer_.erase(std::unique(answer_.begin(), answer_.end()), answer_.end());
  return answer_;
}

std::size_t Neighbors::bytes() const {
  std::size_t sum = (start_.capacity() + links_.capacity()) * sizeof(std::uint32_t);
  for (const auto& entry : later_) sum += sizeof(entry) + entry.second.size() * 5 * sizeof(void*);  // nodes
  return tree_ ? sum + tree_->boxes.size() * sizeof(r_tree::Entry) : sum;
}

}  // namespace thinwall
