#pragma once
/// Whoever finds pairs, behind one interface: ours, and Bullet's where it was built in.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>

namespace thinwall {

/// Keeps its memory, and Bullet its tree, from call to call.
class Finder {
 public:
  virtual ~Finder() = default;
  /// What is timed: from the boxes of this step to all pairs.
  virtual void find(std::span<const Proxy> proxies) = 0;
  /// What the last call found, sorted. Not timed.
  virtual std::vector<ProxyPair> pairs() const = 0;
  /// [bytes] beside the proxies; nothing where it cannot be told.
  virtual std::optional<std::size_t> bytes() const = 0;
  /// Finds exactly the pairs whose boxes touch; or else these and more.
  virtual bool is_exact() const = 0;
};

/// All that this program has, in the order of tables.
std::vector<std::string_view> finder_names();

/// `name` is one of those.
std::unique_ptr<Finder> make_finder(std::string_view name);

/// The names of Bullet's, in the program or not.
inline constexpr std::string_view bullet_build_name = "bullet_build";  ///< its tree built anew
inline constexpr std::string_view bullet_step_name = "bullet_step";    ///< its tree moved on from the last call

/// Nothing where the program was built without Bullet.
std::unique_ptr<Finder> make_bullet_finder(bool keeps_tree);
bool has_bullet();

}  // namespace thinwall
