/// The pairs of boxes that touch.
#include <algorithm>

#include <thinwall/discrete/broad_phase.hpp>

#include "queries.hpp"

namespace thinwall::python {

namespace {

/// A vector of numbers in either scalar; a float is exact as a double.
Vec3<double> corner(const py::array& of, py::ssize_t i) {
  const auto* const row = static_cast<const std::byte*>(of.data()) + i * of.strides(0);
  const auto at = [&](py::ssize_t k) {
    const auto* const from = row + k * of.strides(1);
    if (of.itemsize() == sizeof(double)) {
      double x;
      std::memcpy(&x, from, sizeof x);
      return x;
    }
    float x;
    std::memcpy(&x, from, sizeof x);
    return double{x};
  };
  return {at(0), at(1), at(2)};
}

template <class T> T entry(const py::array& of, py::ssize_t i) {
  T x;
  std::memcpy(&x, static_cast<const std::byte*>(of.data()) + i * of.strides(0), sizeof x);
  return x;
}

}  // namespace

py::array find_pairs(const std::string& method, const py::array& lower, const py::array& upper, const py::object& group,
                     const py::object& mask, const py::object& is_static, std::optional<std::size_t> max_pairs) {
  const py::ssize_t n = lower.shape(0);
  std::vector<Proxy> proxies(static_cast<std::size_t>(n));
  for (py::ssize_t i = 0; i < n; ++i) {
    Proxy& proxy = proxies[static_cast<std::size_t>(i)];
    proxy.low = corner(lower, i);
    proxy.high = corner(upper, i);
  }
  const auto fill = [&]<class T>(const py::object& from, TypeTag<T>, auto member) {
    if (from.is_none()) return;
    const auto array = py::reinterpret_borrow<py::array>(from);
    for (py::ssize_t i = 0; i < n; ++i) proxies[static_cast<std::size_t>(i)].*member = entry<T>(array, i);
  };
  fill(group, TypeTag<std::uint32_t>{}, &Proxy::group);
  fill(mask, TypeTag<std::uint32_t>{}, &Proxy::mask);
  fill(is_static, TypeTag<bool>{}, &Proxy::is_static);

  std::vector<ProxyPair> pairs;
  {
    const py::gil_scoped_release free;
    for_each_type(BroadPhases{}, [&]<class Tag>(Tag) {
      using Method = typename Tag::type;
      if (Method::name == method) find_pairs(Method{}, proxies, pairs, max_pairs.value_or(no_pair_limit));
    });
  }
  py::array_t<std::int64_t> out({static_cast<py::ssize_t>(pairs.size()), py::ssize_t{2}});
  std::int64_t* to = out.mutable_data();
  for (const ProxyPair& pair : pairs) {
    *to++ = pair.first;
    *to++ = pair.second;
  }
  return out;
}

std::vector<std::string> broad_phases() {
  std::vector<std::string> names;
  for_each_type(BroadPhases{}, [&]<class Tag>(Tag) { names.emplace_back(Tag::type::name); });
  return names;
}

}  // namespace thinwall::python
