#include "lab.hpp"

#include <exception>

#include <thinwall/experiments/lab/settings.hpp>

namespace {

/// What the user must mend is a ValueError; the rest is as pybind11 has it.
void translate(std::exception_ptr failure) {
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const thinwall::UsageError& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  }
}

}  // namespace

PYBIND11_MODULE(_lab, module) {
  pybind11::register_local_exception_translator(translate);
  thinwall::bind_advice(module);
  thinwall::bind_run(module);
  thinwall::bind_theory(module);
  thinwall::bind_world(module);
}
