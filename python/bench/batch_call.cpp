/// The C++ side of queries.py: swept/batch.hpp put to the columns of NumPy's arrays.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <thinwall/swept/batch.hpp>
#include <thinwall/swept/compiled.hpp>

namespace {

namespace py = pybind11;
using namespace thinwall;
using Array = py::array_t<double>;

std::span<const double> column(const Array& array, py::ssize_t k) {
  const bool vectors = array.ndim() == 2;
  if (array.strides(0) != py::ssize_t{sizeof(double)}) throw std::invalid_argument("columns with gaps");
  const double* const data = array.data() + (vectors ? k * array.strides(1) / py::ssize_t{sizeof(double)} : 0);
  return {data, static_cast<std::size_t>(array.shape(0))};
}

VectorRows<const double> vectors(const Array& array) { return {column(array, 0), column(array, 1), column(array, 2)}; }

/// Moving spheres and boxes as a caller of the C++ library would have them, and room for the answers.
class BatchCall {
 public:
  BatchCall(Array center, Array radius, Array motion, Array box_center, Array half, Array box_motion, bool with_vectors)
      : arrays_{std::move(center),     std::move(radius), std::move(motion),
                std::move(box_center), std::move(half),   std::move(box_motion)},
        balls_{vectors(arrays_[0]), column(arrays_[1], 0), vectors(arrays_[2])},
        boxes_{vectors(arrays_[3]), vectors(arrays_[4]), vectors(arrays_[5])},
        status_(balls_.radius.size()),
        numbers_(with_vectors ? 7 : 1, std::vector<double>(status_.size())) {
    out_.status = status_;
    out_.time = numbers_[0];
    if (!with_vectors) return;
    out_.normal = {numbers_[1], numbers_[2], numbers_[3]};
    out_.point = {numbers_[4], numbers_[5], numbers_[6]};
  }
  void run() { time_of_impact(balls_, boxes_, out_); }

 private:
  std::array<Array, 6> arrays_;
  RowsOf<Moving<Sphere<double>>> balls_;
  RowsOf<Moving<Aabb<double>>> boxes_;
  std::vector<ToiStatus> status_;
  std::vector<std::vector<double>> numbers_;
  ToiRows<double> out_;
};

}  // namespace

PYBIND11_MODULE(batch_call, m) {
  py::class_<BatchCall>(m, "BatchCall")
      .def(py::init<Array, Array, Array, Array, Array, Array, bool>())
      .def("run", &BatchCall::run);
}
