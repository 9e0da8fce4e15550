#pragma once
/// What the files of this folder serve: a question each, of every pair. Each returns false for a pair that it does not serve.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <thinwall/discrete/manifold.hpp>
#include <thinwall/swept/certified/certified_toi.hpp>

#include "rows.hpp"

namespace thinwall::python {

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
std::vector<std::string> broad_phases();

py::array find_pairs(const std::string& method, const py::array& lower, const py::array& upper, const py::object& group,
                     const py::object& mask, const py::object& is_static, std::optional<std::size_t> max_pairs);

}  // namespace thinwall::python
