#pragma once
/// NumPy's memory as rows of shapes, the one loop that asks a question of every row, and what the files of this folder serve: a question
/// each, of every pair.

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>

#include <thinwall/discrete/manifold.hpp>
#include <thinwall/swept/batch/run.hpp>
#include <thinwall/swept/certified/certified_toi.hpp>
#include <thinwall/swept/members.hpp>
#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/toi.hpp>
#include <thinwall/swept/turning.hpp>

namespace thinwall::python {

namespace py = pybind11;

/// What the arrays of a side are, in the order in which Python passes them: s a number, v a vector, m the columns of a matrix.
struct Layout {
  std::string_view name, fields;
};
inline constexpr std::array layouts{Layout{"Sphere", "vs"},    Layout{"Aabb", "vv"},     Layout{"Obb", "vvm"},
                                    Layout{"Triangle", "vvv"}, Layout{"Capsule", "vvs"}, Layout{"Ray", "vvs"}};

enum class Motion { none, moving, turning };

/// One side of a question: where each number of its first row lies, and how many bytes on that of the next does; 0 repeats it.
struct Side {
  int kind = 0;      ///< its place in `layouts`; a shape's is its rank
  int asked_as = 0;  ///< the rank of the shape that is asked about: an Aabb's beside what turns is an Obb's
  Motion motion = Motion::none;
  std::size_t count = 0;  ///< numbers a row
  bool is_one = true;     ///< one row, against all of the other side
  std::size_t rows = 1;
  std::array<const std::byte*, 21> first{};
  std::array<std::ptrdiff_t, 21> step{};
};

/// A number of a row. Arrays of any strides are read where they lie, aligned or not.
template <class S> S number(const Side& side, std::size_t k, std::size_t i) {
  S x;
  std::memcpy(&x, side.first[k] + side.step[k] * static_cast<std::ptrdiff_t>(i), sizeof x);
  return x;
}

/// Takes the numbers of row i one after the other.
template <class S> class RowReader {
 public:
  RowReader(const Side& side, std::size_t i) : side_(side), i_(i) {}
  S next() { return number<S>(side_, k_++, i_); }
  Vec3<S> vector() {
    const S x = next(), y = next(), z = next();
    return {x, y, z};
  }
  template <class Item> Item item() {
    return item_of<Item>([this] { return next(); });
  }

 private:
  const Side& side_;
  std::size_t i_, k_ = 0;
};

/// Row i as what Item is.
template <class Item, class S> Item row_of(const Side& side, std::size_t i) {
  return RowReader<S>(side, i).template item<Item>();
}

/// Row i of what turns, or moves and could turn; a box along the axes becomes one that could.
template <class A, class S> Turning<A> turning_row(const Side& side, std::size_t i) {
  RowReader<S> from(side, i);
  Turning<A> item;
  if constexpr (std::is_same_v<A, Obb<S>>) {
    item.shape = side.kind == Aabb<S>::rank ? to_obb(from.template item<Aabb<S>>()) : from.template item<A>();
  } else {
    item.shape = from.template item<A>();
  }
  item.displacement = from.vector();
  item.rotation = side.motion == Motion::turning ? from.vector() : Vec3<S>(Vec3<S>::Zero());
  return item;
}

/// A question to all rows, and where the answers go: an array of what the question calls a Row.
struct Question {
  const Side& a;
  const Side& b;
  std::size_t rows;
  void* out;
  int threads;
  bool is_float;
  bool swapped = false;  ///< A and B were passed the other way round, and the answer is to be flipped
  bool vectors = true;   ///< false: the rows of a time of impact are TimeRows
};

/// A Toi without its vectors.
template <Scalar S> struct TimeRow {
  ToiStatus status = ToiStatus::invalid;
  int evaluations = 0;
  S time = 1;
};

/// Writes row i of the answers.
template <class Row> void put(const Question& q, std::size_t i, const Row& row) { static_cast<Row*>(q.out)[i] = row; }
/// With the vectors only where there is room for them.
template <Scalar S> void put(const Question& q, std::size_t i, const Toi<S>& toi) {
  if (q.vectors) {
    static_cast<Toi<S>*>(q.out)[i] = toi;
  } else {
    static_cast<TimeRow<S>*>(q.out)[i] = {toi.status, toi.evaluations, toi.time};
  }
}

inline constexpr std::size_t block_of_rows = 512;

/// `answer(i)` of every row.
template <class Answer> void answer_rows(const Question& q, const Answer& answer) {
  batch::for_each_block(q.rows, block_of_rows, {q.threads}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) put(q, i, answer(i));
  });
}

/// Calls ask.template operator()<A, B>() for the shapes of the two sides; false where `ask` serves no such pair.
/// `Serves<A, B>::value` says which.
template <class S, template <class, class> class Serves, class Ask>
bool for_the_shapes(const Question& q, const Ask& ask) {
  bool asked = false;
  for_each_type(Shapes<S>{}, [&]<class TagA>(TagA) {
    using A = typename TagA::type;
    if (A::rank != q.a.asked_as) return;
    for_each_type(Shapes<S>{}, [&]<class TagB>(TagB) {
      using B = typename TagB::type;
      if constexpr (Serves<A, B>::value) {
        if (B::rank != q.b.asked_as) return;
        ask.template operator()<A, B>();
        asked = true;
      }
    });
  });
  return asked;
}

// ---- The rows of the answers, which NumPy reads as they lie. That of a time of impact is a Toi or a TimeRow, of a certified one
// a CertifiedToi.

template <Scalar S> struct ContactRow {
  ToiStatus status = ToiStatus::invalid;  ///< apart, overlapping or invalid
  Contact<S> contact;                     ///< zeros unless overlapping
};
template <Scalar S> struct SeparationRow {
  ToiStatus status = ToiStatus::invalid;  ///< apart, overlapping or invalid
  Separation<S> separation;
};
template <Scalar S> struct ManifoldRow {
  ToiStatus status = ToiStatus::invalid;  ///< apart, overlapping or invalid
  Manifold<S> manifold;
};
template <Scalar S> struct RayRow {
  ToiStatus status = ToiStatus::invalid;  ///< apart, hit, overlapping (a start inside) or invalid
  RayHit<S> hit;
};

/// The options of all methods. What is not set is the method's own default.
struct Options {
  std::optional<double> tolerance, margin, min_separation;
  std::optional<int> n, max_evaluations;
};

/// A method's options, by name.
using MethodOptions = std::vector<std::pair<std::string, std::vector<std::string>>>;

// ---- The questions. Each returns false for a pair that it does not serve.

bool ask_overlaps(const Question& q);
bool ask_contact(const Question& q);
bool ask_separation(const Question& q);
bool ask_manifold(const Question& q);
bool ask_valid(const Question& q);  ///< of side A alone
bool ask_raycast(const Question& q);
bool ask_closed_form(const Question& q, const Options& options);
bool ask_method(const std::string& method, const Question& q, const Options& options);
bool ask_turning(const std::string& method, const Question& q, const Options& options);
bool ask_certified(const Question& q);

MethodOptions methods();
MethodOptions turning_methods();

}  // namespace thinwall::python
