#include <thinwall/experiments/broad_phase/model.hpp>

#ifdef THINWALL_HAS_BULLET

#include <algorithm>
#include <cmath>
#include <limits>

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

namespace thinwall {

namespace {

btScalar down(double x) {
  const auto y = static_cast<btScalar>(x);
  return static_cast<double>(y) > x ? std::nextafter(y, -std::numeric_limits<btScalar>::infinity()) : y;
}
btScalar up(double x) { return -down(-x); }
btVector3 low_of(const Proxy& p) { return {down(p.low[0]), down(p.low[1]), down(p.low[2])}; }
btVector3 high_of(const Proxy& p) { return {up(p.high[0]), up(p.high[1]), up(p.high[2])}; }

/// Bullet's dynamic tree with its own cache of pairs, which is where its users read them. It looks for pairs once all boxes
/// have moved: its default, to look after each box, takes about twice as long on these worlds.
class BulletFinder final : public Finder {
 public:
  explicit BulletFinder(bool keeps_tree) : keeps_tree_(keeps_tree) {}

  void find(std::span<const Proxy> proxies) override {
    if (keeps_tree_ && bodies_.size() == proxies.size()) {
      move(proxies);
    } else {
      build(proxies);
    }
    tree_->calculateOverlappingPairs(nullptr);
  }

  std::vector<ProxyPair> pairs() const override {
    std::vector<ProxyPair> pairs;
    const btBroadphasePairArray& found = tree_->getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < found.size(); ++i) {
      const std::uint32_t a = index_of(found[i].m_pProxy0), b = index_of(found[i].m_pProxy1);
      pairs.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  std::optional<std::size_t> bytes() const override { return std::nullopt; }
  bool is_exact() const override { return false; }  // its boxes are floats, with a margin once they have moved
  bool moves_on() const override { return keeps_tree_; }

 private:
  static std::uint32_t index_of(const btBroadphaseProxy* proxy) {
    return *static_cast<const std::uint32_t*>(proxy->m_clientObject);
  }

  void build(std::span<const Proxy> proxies) {
    bodies_.clear();
    tree_ = std::make_unique<btDbvtBroadphase>();
    tree_->m_deferedcollide = true;
    names_.resize(proxies.size());
    for (std::size_t i = 0; i < proxies.size(); ++i) {
      names_[i] = static_cast<std::uint32_t>(i);
      bodies_.push_back(tree_->createProxy(low_of(proxies[i]), high_of(proxies[i]), 0, &names_[i],
                                           btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter, nullptr));
    }
  }

  void move(std::span<const Proxy> proxies) {
    for (std::size_t i = 0; i < proxies.size(); ++i) {
      tree_->setAabb(bodies_[i], low_of(proxies[i]), high_of(proxies[i]), nullptr);
    }
  }

  bool keeps_tree_;
  std::unique_ptr<btDbvtBroadphase> tree_;
  std::vector<btBroadphaseProxy*> bodies_;
  std::vector<std::uint32_t> names_;
};

}  // namespace

bool has_bullet() { return true; }
std::unique_ptr<Finder> make_bullet_finder(bool keeps_tree) { return std::make_unique<BulletFinder>(keeps_tree); }

}  // namespace thinwall

#else

namespace thinwall {

bool has_bullet() { return false; }
std::unique_ptr<Finder> make_bullet_finder(bool) { return nullptr; }

}  // namespace thinwall

#endif
