#pragma once
/// One of the broad phases, chosen by name, with its working memory.

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>

namespace thinwall {

class PairFinder {
 public:
  static const std::vector<std::string_view>& names();  ///< of BroadPhases, in its order

  explicit PairFinder(std::string_view name);  ///< one of names()
  ~PairFinder();
  PairFinder(PairFinder&&) noexcept;
  PairFinder& operator=(PairFinder&&) noexcept;

  void find(std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs, std::size_t max_pairs);

  struct Method {
    Method() = default;
    Method(const Method&) = delete;
    Method& operator=(const Method&) = delete;
    virtual ~Method() = default;
    virtual void find(std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs, std::size_t max_pairs) = 0;
  };

 private:
  std::unique_ptr<Method> method_;
};

}  // namespace thinwall
