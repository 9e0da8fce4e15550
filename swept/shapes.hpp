#pragma once
/// Every shape, in the order of rank. A new shape is its headers and one line here: tests, benchmarks and experiments
/// loop over this list. What each pair is served by stands in docs/pairs.md.

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/discrete/triangle.hpp>
#include <thinwall/discrete/type_list.hpp>

namespace thinwall {

template <Scalar S>
using Shapes = TypeList<  //
    Sphere<S>,            //
    Aabb<S>,              //
    Obb<S>,               //
    Triangle<S>,          //
    Capsule<S>>;

}  // namespace thinwall
