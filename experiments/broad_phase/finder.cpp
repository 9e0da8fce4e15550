#include <thinwall/experiments/broad_phase/finder.hpp>

#include <thinwall/discrete/broad_phase.hpp>

namespace thinwall {

namespace {

template <class Method> class OwnFinder final : public Finder {
 public:
  void find(std::span<const Proxy> proxies) override { find_pairs(Method{}, proxies, pairs_, no_pair_limit, memory_); }
  std::vector<ProxyPair> pairs() const override { return pairs_; }
  std::optional<std::size_t> bytes() const override { return memory_.bytes() + bytes_of(pairs_); }
  bool is_exact() const override { return true; }

 private:
  typename Method::Memory memory_;
  std::vector<ProxyPair> pairs_;
};

}  // namespace

std::vector<std::string_view> finder_names() {
  std::vector<std::string_view> names;
  for_each_type(BroadPhases{}, [&]<class Method>(TypeTag<Method>) { names.push_back(Method::name); });
  if (has_bullet()) names.insert(names.end(), {bullet_build_name, bullet_step_name});
  return names;
}

std::unique_ptr<Finder> make_finder(std::string_view name) {
  if (name == bullet_build_name) return make_bullet_finder(false);
  if (name == bullet_step_name) return make_bullet_finder(true);
  std::unique_ptr<Finder> finder;
  for_each_type(BroadPhases{}, [&]<class Method>(TypeTag<Method>) {
    if (name == Method::name) finder = std::make_unique<OwnFinder<Method>>();
  });
  return finder;
}

}  // namespace thinwall
