#pragma once
/// The numbers of a shape, of one that moves or turns, or of a ray, one after the other: as batches, NumPy's arrays and files have them.

#include <string>
#include <type_traits>

#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// Calls visit(name, member) with every vector, matrix and number of `thing`, in one order; or with the arrays of a RowsOf, whose members
/// have the same names. The names given are those of the columns of docs/data/README.md.
template <class Thing, class Visit> void for_each_member(Thing& thing, const Visit& visit) {
  if constexpr (requires { thing.shape; }) for_each_member(thing.shape, visit);
  if constexpr (requires { thing.center; }) visit("center", thing.center);
  if constexpr (requires { thing.half_extents; }) visit("half", thing.half_extents);
  if constexpr (requires { thing.axes; }) visit("axis", thing.axes);
  if constexpr (requires { thing.a; }) visit("p", thing.a);
  if constexpr (requires { thing.b; }) visit("q", thing.b);
  if constexpr (requires { thing.c; }) visit("r", thing.c);
  if constexpr (requires { thing.radius; }) visit("radius", thing.radius);
  if constexpr (requires { thing.origin; }) visit("origin", thing.origin);
  if constexpr (requires { thing.direction; }) visit("direction", thing.direction);
  if constexpr (requires { thing.max_t; }) visit("max_t", thing.max_t);
  if constexpr (requires { thing.displacement; }) visit("displacement", thing.displacement);
  if constexpr (requires { thing.rotation; }) visit("rotation", thing.rotation);
}

/// Calls visit(number) with each number of `thing`, of axes one after the other.
template <class Thing, class Visit> void for_each_number(Thing& thing, const Visit& visit) {
  for_each_member(thing, [&](const char*, auto& member) {
    if constexpr (requires { member.cols(); }) {
      for (int k = 0; k < member.size(); ++k) visit(member(k % 3, k / 3));
    } else {
      visit(member);
    }
  });
}

/// The item whose numbers next() gives in that order. A vector is assigned as a whole: written number by number, it costs whoever reads it
/// by vector instructions.
template <class Item, class Next> Item item_of(const Next& next) {
  Item item;
  for_each_member(item, [&](const char*, auto& member) {
    if constexpr (requires { member.cols(); }) {
      for (int k = 0; k < member.cols(); ++k) {
        const auto x = next(), y = next(), z = next();
        member.col(k) = Vec3<std::remove_const_t<decltype(x)>>(x, y, z);
      }
    } else {
      member = next();
    }
  });
  return item;
}

/// Calls visit(name, number): `center_x`, `axis1_x`, `radius`.
template <class Thing, class Visit> void for_each_named_number(Thing& thing, const Visit& visit) {
  for_each_member(thing, [&](const std::string& name, auto& member) {
    if constexpr (requires { member.cols(); }) {
      for (int k = 0; k < member.size(); ++k) {
        const std::string column = member.cols() > 1 ? std::to_string(k / 3 + 1) : "";
        visit(name + column + "_" + "xyz"[k % 3], member(k % 3, k / 3));
      }
    } else {
      visit(name, member);
    }
  });
}

}  // namespace thinwall
