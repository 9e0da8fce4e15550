/// Asks the C++ library row by row, for tests of the Python package:
///
///   row_by_row QUERY SCALAR KIND_A KIND_B ROWS [METHOD] <rows of A, then rows of B, as their numbers lie in memory  >answers, without gaps
///
/// It shares no code with python/src: another reader of rows, and the front doors with A and B in the order that is given.

#include <cstdio>
#include <cstdlib>
#include <string>
#include <type_traits>
#include <vector>

#include <thinwall/capsule/capsule_manifold.hpp>
#include <thinwall/discrete/boxes/box_manifold.hpp>
#include <thinwall/swept/certified.hpp>
#include <thinwall/swept/compiled.hpp>
#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>
#include <thinwall/swept/turning.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

namespace thinwall {

namespace {

struct Task {
  std::string query, kind_a, kind_b, method;
  std::size_t rows = 0;
};

template <class T> void put(const T& value) { std::fwrite(&value, sizeof value, 1, stdout); }
template <Scalar S> void put(const Vec3<S>& v) { std::fwrite(v.data(), sizeof(S), 3, stdout); }

template <Scalar S> Vec3<S> vector(const S* x) { return {x[0], x[1], x[2]}; }

template <class A> struct Known;
template <Scalar S> struct Known<Sphere<S>> {
  static constexpr const char* name = "Sphere";
  static constexpr int size = 4;
  static Sphere<S> of(const S* x) { return {vector(x), x[3]}; }
};
template <Scalar S> struct Known<Aabb<S>> {
  static constexpr const char* name = "Aabb";
  static constexpr int size = 6;
  static Aabb<S> of(const S* x) { return {vector(x), vector(x + 3)}; }
};
template <Scalar S> struct Known<Obb<S>> {
  static constexpr const char* name = "Obb";
  static constexpr int size = 15;
  static Obb<S> of(const S* x) {
    Mat3<S> axes;
    axes << x[6], x[7], x[8], x[9], x[10], x[11], x[12], x[13], x[14];  // row by row, as NumPy's
    return {vector(x), vector(x + 3), axes};
  }
};
template <Scalar S> struct Known<Triangle<S>> {
  static constexpr const char* name = "Triangle";
  static constexpr int size = 9;
  static Triangle<S> of(const S* x) { return {vector(x), vector(x + 3), vector(x + 6)}; }
};
template <Scalar S> struct Known<Capsule<S>> {
  static constexpr const char* name = "Capsule";
  static constexpr int size = 7;
  static Capsule<S> of(const S* x) { return {vector(x), vector(x + 3), x[6]}; }
};
template <Scalar S> struct Known<Ray<S>> {
  static constexpr const char* name = "Ray";
  static constexpr int size = 7;
  static Ray<S> of(const S* x) { return {vector(x), vector(x + 3), x[6]}; }
};

/// A shape and the numbers of its motion, which not every query reads.
template <class A> struct Body {
  using S = typename A::Scalar;
  A shape;
  Vec3<S> displacement, rotation;
};
template <Scalar S> struct Body<Ray<S>> {
  Ray<S> shape;
};

/// Reads ROWS bodies: the shape's numbers, 3 of its displacement, 3 of its rotation; of a ray its own alone.
template <class A, class S> std::vector<Body<A>> read_bodies(std::size_t rows) {
  constexpr bool moves = !std::is_same_v<A, Ray<S>>;
  constexpr std::size_t size = Known<A>::size + (moves ? 6 : 0);
  std::vector<Body<A>> bodies;
  S x[size];
  for (std::size_t i = 0; i < rows; ++i) {
    if (std::fread(x, sizeof(S), size, stdin) != size) std::exit(3);
    if constexpr (moves) {
      bodies.push_back({Known<A>::of(x), vector(x + size - 6), vector(x + size - 3)});
    } else {
      bodies.push_back({Known<A>::of(x)});
    }
  }
  return bodies;
}

/// Calls ask(a, b) for every row, if the task is of these two kinds.
template <class A, class B, class S, class Ask> bool each_row(const Task& task, const Ask& ask) {
  if (task.kind_a != Known<A>::name || task.kind_b != Known<B>::name) return false;
  const auto a = read_bodies<A, S>(task.rows);
  const auto b = read_bodies<B, S>(task.rows);
  for (std::size_t i = 0; i < task.rows; ++i) ask(a[i], b[i]);
  return true;
}

template <Scalar S> void put(const Toi<S>& toi) {
  put(toi.status);
  put(toi.evaluations);
  put(toi.time);
  put(toi.normal);
  put(toi.point);
}

/// The same for whichever two shapes the task's kinds are; false unless `serves.operator()<A, B>()` is std::true_type.
template <class S, class Serves, class Ask>
bool each_row_of_pairs(const Task& task, const Serves& serves, const Ask& ask) {
  bool asked = false;
  for_each_type(Shapes<S>{}, [&]<class A>(TypeTag<A>) {
    for_each_type(Shapes<S>{}, [&]<class B>(TypeTag<B>) {
      if constexpr (decltype(serves.template operator()<A, B>())::value) asked = asked || each_row<A, B, S>(task, ask);
    });
  });
  return asked;
}

// ---- At one instant.

template <Scalar S> void put_contact(const Contact<S>& c) {
  put(c.local_a);
  put(c.local_b);
  put(c.normal);
  put(c.penetration);
}

template <class A, class B> void ask_at_rest(const std::string& query, const A& a, const B& b) {
  using S = typename A::Scalar;
  if (query == "overlaps") put(overlaps(a, b));
  if (query == "contact") {
    const auto answer = contact(a, b);
    put(answer.has_value());
    put_contact(answer.value_or(Contact<S>{}));
  }
  if (query == "separation") {
    const Separation<S> answer = separation(a, b);
    put(answer.distance);
    put(answer.normal);
    put(answer.point_a);
    put(answer.point_b);
  }
  if (query == "manifold") {
    const Manifold<S> answer = manifold(a, b);
    put(answer.count);
    for (const Contact<S>& c : answer.contacts) put_contact(c);
  }
}

template <class S> bool cast_rays(const Task& task) {
  bool asked = false;
  for_each_type(Shapes<S>{}, [&]<class A>(TypeTag<A>) {
    asked = asked || each_row<Ray<S>, A, S>(task, [](const auto& ray, const auto& body) {
              const auto hit = raycast(ray.shape, body.shape);
              put(hit.has_value());
              put(hit.value_or(RayHit<S>{}).t);
              put(hit.value_or(RayHit<S>{}).normal);
              put(hit.value_or(RayHit<S>{}).point);
            });
  });
  return asked;
}

// ---- In time.

template <class A> Moving<A> straight(const Body<A>& body) { return {body.shape, body.displacement}; }

/// Every method, of a few pairs: the pair changes what a row is, the method what is asked of it.
template <class A, class B> bool by_method(const Task& task) {
  using S = typename A::Scalar;
  bool asked = false;
  if (task.query == "turning") {
    return each_row<A, B, S>(task, [&](const auto& a, const auto& b) {
      if constexpr (stays_along_the_axes<B>) {
        put(time_of_impact(Turning<A>{a.shape, a.displacement, a.rotation}, Moving<B>{b.shape, b.displacement}));
      } else {
        put(time_of_impact(Turning<A>{a.shape, a.displacement, a.rotation},
                           Turning<B>{b.shape, b.displacement, b.rotation}));
      }
    });
  }
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      if (Method::name != task.method) return;
      asked = each_row<A, B, S>(
          task, [](const auto& a, const auto& b) { put(time_of_impact(Method{}, straight(a), straight(b))); });
    }
  });
  return asked;
}

bool certified(const Task& task) {
  return each_row_of_pairs<double>(
      task, []<class A, class B>() { return std::bool_constant<certifies<A, B>>{}; },
      [](const auto& a, const auto& b) {
        const CertifiedToi toi = certified_time_of_impact(straight(a), straight(b));
        put(toi.verdict);
        put(toi.lower);
        put(toi.upper);
        put(toi.decided_by);
      });
}

template <class S> bool ask(const Task& task) {
  if (task.query == "time_of_impact") {
    return each_row_of_pairs<S>(
        task, []<class A, class B>() { return std::bool_constant<serves<ClosedForm<S>, A, B>>{}; },
        [](const auto& a, const auto& b) { put(time_of_impact(straight(a), straight(b))); });
  }
  if (task.query == "method" || task.query == "turning") {
    return by_method<Sphere<S>, Aabb<S>>(task) || by_method<Obb<S>, Sphere<S>>(task) ||
           by_method<Sphere<S>, Capsule<S>>(task) || by_method<Capsule<S>, Capsule<S>>(task);
  }
  if (task.query == "raycast") return cast_rays<S>(task);
  return each_row_of_pairs<S>(
      task, []<class A, class B>() { return std::bool_constant<ServedPair<A, B>>{}; },
      [&](const auto& a, const auto& b) { ask_at_rest(task.query, a.shape, b.shape); });
}

}  // namespace

}  // namespace thinwall

int main(int argc, char** argv) {
  using namespace thinwall;
  if (argc != 7) return 2;
  const Task task{argv[1], argv[3], argv[4], argv[6], std::strtoul(argv[5], nullptr, 10)};
  const bool is_float = std::string(argv[2]) == "float32";
  const bool asked = task.query == "certified" ? certified(task) : is_float ? ask<float>(task) : ask<double>(task);
  return asked ? 0 : 2;  // no such pair
}
