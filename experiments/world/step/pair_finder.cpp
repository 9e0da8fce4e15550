#include <thinwall/experiments/world/step/pair_finder.hpp>

#include <stdexcept>
#include <string>

#include <thinwall/discrete/broad_phase.hpp>

namespace thinwall {
namespace {

template <class BroadPhase> struct Named final : PairFinder::Method {
  BroadPhase options;
  typename BroadPhase::Memory memory;
  void find(std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs, std::size_t max_pairs) override {
    find_pairs(options, proxies, pairs, max_pairs, memory);
  }
};

}  // namespace

const std::vector<std::string_view>& PairFinder::names() {
  static const std::vector<std::string_view> all = [] {
    std::vector<std::string_view> names;
    for_each_type(BroadPhases{}, [&]<class T>(TypeTag<T>) { names.push_back(T::name); });
    return names;
  }();
  return all;
}

PairFinder::PairFinder(std::string_view name) {
  for_each_type(BroadPhases{}, [&]<class T>(TypeTag<T>) {
    if (T::name == name) method_ = std::make_unique<Named<T>>();
  });
  if (!method_) throw std::invalid_argument("there is no broad phase '" + std::string(name) + "'");
}
PairFinder::~PairFinder() = default;
PairFinder::PairFinder(PairFinder&&) noexcept = default;
PairFinder& PairFinder::operator=(PairFinder&&) noexcept = default;

void PairFinder::find(std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs, std::size_t max_pairs) {
  method_->find(proxies, pairs, max_pairs);
}

}  // namespace thinwall
