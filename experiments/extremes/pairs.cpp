#include <thinwall/experiments/extremes/pairs.hpp>

#include <cmath>

#include <thinwall/experiments/extremes/ask.hpp>

namespace thinwall {

namespace {

template <class A, class B> std::array<AskExtreme, precision_count> closed_form_alone() {
  return {&ask_extreme<A, B, float, ClosedFormAlone<float>>, &ask_extreme<A, B, double, ClosedFormAlone<double>>,
          nullptr, nullptr};
}

}  // namespace

const std::array<Precision, precision_count>& all_precisions() {
  static const std::array<Precision, precision_count> list{{
      {"float", "float", 0x1p-24},
      {"double", "double", 0x1p-53},
      {"long_double", "long double", std::ldexp(1.0, -std::numeric_limits<long double>::digits)},
      {"50_digits", "50 digits", std::ldexp(1.0, -std::numeric_limits<Digits50>::digits), true},
  }};
  return list;
}

std::span<const ExtremePair> extreme_pairs() {
  using Ball = Sphere<double>;
  using Upright = Aabb<double>;
  using Turned = Obb<double>;
  using Rod = Capsule<double>;
  using Flat = Triangle<double>;
  static const std::array in_float = ask_in_float(), in_double = ask_in_double(), in_long = ask_in_long_double(),
                          in_wide = ask_at_50_digits();
  const auto every = [](std::size_t i) {
    return std::array<AskExtreme, precision_count>{in_float[i], in_double[i], in_long[i], in_wide[i]};
  };
  static const std::array list = {
      ExtremePair{"sphere_sphere", true, true, false, every(0)},
      ExtremePair{"sphere_aabb", true, true, true, every(1)},
      ExtremePair{"sphere_capsule", true, true, false, every(2)},
      ExtremePair{"obb_obb", false, true, true, every(3)},
      ExtremePair{"aabb_aabb", false, false, true, closed_form_alone<Upright, Upright>()},
      ExtremePair{"sphere_obb", true, false, true, closed_form_alone<Ball, Turned>()},
      ExtremePair{"aabb_obb", false, false, true, closed_form_alone<Upright, Turned>()},
      ExtremePair{"sphere_triangle", true, false, false, closed_form_alone<Ball, Flat>()},
      ExtremePair{"capsule_capsule", true, false, false, closed_form_alone<Rod, Rod>()},
      ExtremePair{"capsule_aabb", true, false, true, closed_form_alone<Rod, Upright>()},
      ExtremePair{"capsule_obb", true, false, true, closed_form_alone<Rod, Turned>()},
      ExtremePair{"capsule_triangle", true, false, false, closed_form_alone<Rod, Flat>()},
  };
  return list;
}

std::vector<std::string_view> extreme_method_names() {
  std::vector<std::string_view> names;
  for_each_type(EveryMethod<double>::List{}, [&]<class Method>(TypeTag<Method>) { names.push_back(Method::name); });
  return names;
}

}  // namespace thinwall
