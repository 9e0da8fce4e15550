/// thinwall._queries: what python/thinwall/queries.py calls. Arrays come checked from there; what could crash is checked here again.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <thinwall/discrete/broad_phase.hpp>

#include "queries.hpp"

namespace thinwall::python {

namespace {

py::dtype scalar_type(bool is_float) { return is_float ? py::dtype::of<float>() : py::dtype::of<double>(); }

/// How NumPy reads a struct as it lies.
class StructType {
 public:
  template <class T> explicit StructType(const T&) : size_(sizeof(T)) {}
  /// A member of `row`, which is n of `type`.
  template <class T, class M>
  StructType& add(const char* name, const T& row, const M& member, const py::object& type, py::ssize_t n = 1) {
    names_.append(name);
    formats_.append(n == 1 ? type : py::object(py::make_tuple(type, n)));
    offsets_.append(reinterpret_cast<const char*>(&member) - reinterpret_cast<const char*>(&row));
    return *this;
  }
  py::dtype dtype() const { return {names_, formats_, offsets_, static_cast<py::ssize_t>(size_)}; }

 private:
  std::size_t size_;
  py::list names_, formats_, offsets_;
};

/// The fields of a contact in `row`.
template <class T, class S>
py::dtype with_contact(StructType type, const T& row, const Contact<S>& c, const py::dtype& s) {
  return type.add("local_a", row, c.local_a, s, 3)
      .add("local_b", row, c.local_b, s, 3)
      .add("normal", row, c.normal, s, 3)
      .add("penetration", row, c.penetration, s)
      .dtype();
}

template <class S> py::dtype row_type(const std::string& query) {
  const py::dtype s = py::dtype::of<S>(), i = py::dtype::of<std::int32_t>();
  static_assert(sizeof(ToiStatus) == sizeof(std::int32_t) && sizeof(DecidedBy) == sizeof(std::int32_t));
  if (query == "overlaps" || query == "valid") return py::dtype::of<bool>();
  if (query == "contact") {
    const ContactRow<S> r;
    return with_contact(StructType(r).add("status", r, r.status, i), r, r.contact, s);
  }
  if (query == "separation") {
    const SeparationRow<S> r;
    const Separation<S>& x = r.separation;
    return StructType(r)
        .add("status", r, r.status, i)
        .add("distance", r, x.distance, s)
        .add("normal", r, x.normal, s, 3)
        .add("point_a", r, x.point_a, s, 3)
        .add("point_b", r, x.point_b, s, 3)
        .dtype();
  }
  if (query == "manifold") {
    const ManifoldRow<S> r;
    const Contact<S>& first = r.manifold.contacts[0];
    return StructType(r)
        .add("status", r, r.status, i)
        .add("count", r, r.manifold.count, i)
        .add("contacts", r, r.manifold.contacts, with_contact(StructType(first), first, first, s), 4)
        .dtype();
  }
  if (query == "raycast") {
    const RayRow<S> r;
    return StructType(r)
        .add("status", r, r.status, i)
        .add("t", r, r.hit.t, s)
        .add("normal", r, r.hit.normal, s, 3)
        .add("point", r, r.hit.point, s, 3)
        .dtype();
  }
  if (query == "certified_time_of_impact") {
    const CertifiedToi r;
    return StructType(r)
        .add("status", r, r.verdict, i)
        .add("lower", r, r.lower, s)
        .add("upper", r, r.upper, s)
        .add("decided_by", r, r.decided_by, i)
        .dtype();
  }
  if (query == "time") {
    const TimeRow<S> r;
    return StructType(r)
        .add("status", r, r.status, i)
        .add("evaluations", r, r.evaluations, i)
        .add("time", r, r.time, s)
        .dtype();
  }
  const Toi<S> r;
  return StructType(r)
      .add("status", r, r.status, i)
      .add("evaluations", r, r.evaluations, i)
      .add("time", r, r.time, s)
      .add("normal", r, r.normal, s, 3)
      .add("point", r, r.point, s, 3)
      .dtype();
}

/// [1] axes of a field's array besides that of the rows, and numbers a row.
int axes_of(char field) { return field == 's' ? 0 : field == 'v' ? 1 : 2; }

/// The arrays of one side, in the order of its layout and then of its motion.
Side side_of(const std::string& kind, const std::vector<py::array>& arrays, bool is_float) {
  Side side;
  std::string fields;
  for (const Layout& layout : layouts) {
    if (layout.name == kind) break;
    ++side.kind;
  }
  if (side.kind == static_cast<int>(layouts.size())) throw std::invalid_argument("no shape '" + kind + "'");
  fields = layouts[static_cast<std::size_t>(side.kind)].fields;
  if (arrays.size() < fields.size() || arrays.size() > fields.size() + 2)
    throw std::invalid_argument(kind + " has other arrays");
  side.motion = static_cast<Motion>(arrays.size() - fields.size());
  fields.append(arrays.size() - fields.size(), 'v');
  side.asked_as = side.kind;

  const py::dtype wanted = scalar_type(is_float);
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const py::array& array = arrays[f];
    const int axes = axes_of(fields[f]);
    const bool has_rows = array.ndim() == axes + 1;
    bool fits = array.dtype().equal(wanted) && (has_rows || array.ndim() == axes);
    for (int k = 0; fits && k < axes; ++k) fits = array.shape(array.ndim() - 1 - k) == 3;
    if (!fits) throw std::invalid_argument(kind + ": an array of another shape or dtype");
    const bool repeats = !has_rows || array.shape(0) == 1;
    if (!repeats) {
      const auto rows = static_cast<std::size_t>(array.shape(0));
      if (!side.is_one && rows != side.rows) throw std::invalid_argument(kind + ": arrays of other lengths");
      side.is_one = false;
      side.rows = rows;
    }
    const auto* const data = static_cast<const std::byte*>(array.data());
    const auto add = [&](py::ssize_t offset) {
      side.first[side.count] = data + offset;
      side.step[side.count++] = repeats ? 0 : array.strides(0);
    };
    const auto stride = [&](int axis) { return array.strides(array.ndim() - axes + axis); };
    if (axes == 0) add(0);
    for (int k = 0; axes == 1 && k < 3; ++k) add(k * stride(0));
    for (int column = 0; axes == 2 && column < 3; ++column) {
      for (int row = 0; row < 3; ++row) add(row * stride(0) + column * stride(1));
    }
  }
  return side;
}

std::size_t rows_of(const Side& a, const Side& b) {
  if (a.is_one) return b.rows;
  if (b.is_one || a.rows == b.rows) return a.rows;
  throw std::invalid_argument("A and B have other lengths");
}

bool ask_in_order(const std::string& query, const Question& q, const std::string& method, const Options& options) {
  if (query == "overlaps") return ask_overlaps(q);
  if (query == "contact") return ask_contact(q);
  if (query == "separation") return ask_separation(q);
  if (query == "manifold") return ask_manifold(q);
  if (query == "raycast") return ask_raycast(q);
  if (query == "valid") return ask_valid(q);
  const bool turning = q.a.motion == Motion::turning || q.b.motion == Motion::turning;
  if (query == "certified_time_of_impact") return ask_certified(q);
  if (turning) return ask_turning(method, q, options);
  return method == "closed_form" ? ask_closed_form(q, options) : ask_method(method, q, options);
}

using Arrays = std::vector<py::array>;

/// Asks `query` of every row into `out`, an array of row_type() that holds as many. False for a pair that it does not serve.
bool ask(const std::string& query, const std::string& kind_a, const Arrays& arrays_a, const std::string& kind_b,
         const Arrays& arrays_b, py::array& out, int threads, const std::string& method, const Options& options) {
  const bool is_float = arrays_a.at(0).itemsize() == sizeof(float);
  Side a = side_of(kind_a, arrays_a, is_float), b = side_of(kind_b, arrays_b, is_float);
  const std::size_t rows = rows_of(a, b);
  const py::dtype wanted = is_float ? row_type<float>(query) : row_type<double>(query);
  const bool holds = out.writeable() && static_cast<std::size_t>(out.size()) == rows && out.dtype().equal(wanted) &&
                     (out.flags() & py::array::c_style) != 0;
  if (!holds) throw std::invalid_argument("out does not hold the answers");
  const bool in_time = query == "time_of_impact" || query == "time" || query == "certified_time_of_impact";
  if (in_time && (a.motion == Motion::none || b.motion == Motion::none)) throw std::invalid_argument("shapes at rest");
  if (query == "certified_time_of_impact" && is_float) throw std::invalid_argument("float32");
  if (a.motion == Motion::turning || b.motion == Motion::turning) {
    for (Side* const side : {&a, &b}) {
      if (side->kind == Aabb<double>::rank) side->asked_as = Obb<double>::rank;
    }
  }
  const bool swapped = in_time && a.asked_as < b.asked_as;
  const Question q{swapped ? b : a, swapped ? a : b, rows,    out.mutable_data(),
                   threads,         is_float,        swapped, query != "time"};
  const py::gil_scoped_release free;
  return ask_in_order(query, q, method, options);
}

// ---- The pairs of boxes that touch.

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

}  // namespace

}  // namespace thinwall::python

PYBIND11_MODULE(_queries, m) {
  namespace py = pybind11;
  using namespace thinwall::python;
  py::class_<Options>(m, "Options")
      .def(py::init<>())
      .def_readwrite("tolerance", &Options::tolerance)
      .def_readwrite("margin", &Options::margin)
      .def_readwrite("min_separation", &Options::min_separation)
      .def_readwrite("n", &Options::n)
      .def_readwrite("max_evaluations", &Options::max_evaluations);
  m.def("row_type", [](const std::string& query, bool is_float) {
    return is_float ? row_type<float>(query) : row_type<double>(query);
  });
  m.def("ask", &ask);
  m.def("methods", &methods);
  m.def("turning_methods", &turning_methods);
  m.def("broad_phases", [] { return type_names(thinwall::BroadPhases{}); });
  m.def("find_pairs", &find_pairs);
}
