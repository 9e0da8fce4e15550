#include "lab.hpp"

#include <exception>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <pybind11/stl.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/lab/settings.hpp>

namespace thinwall {

namespace {

namespace py = pybind11;

using Word = std::optional<std::string>;

Wish wish_of(const std::map<std::string, Word>& words) {
  const auto word = [&](const char* name) {
    const auto found = words.find(name);
    return found == words.end() ? Word() : found->second;
  };
  return read_wish({word("speed"), word("radius"), word("thickness"), word("angle"), word("step"), word("fps"),
                    word("miss"), word("late"), word("length"), word("spin")});
}

/// Every number as JSON, and all of it in words.
std::pair<std::string, std::string> advice(const std::map<std::string, Word>& words) {
  const Advice made = advise(wish_of(words));
  return {advice_json(made).dump(), advice_text(made)};
}

std::string advice_toml(const std::map<std::string, Word>& words) {
  const Wish wish = wish_of(words);
  return check_config(wish, candidates(wish));
}

void bind_advice(py::module_& module) {
  module.def("advice", advice, py::arg("words"), py::call_guard<py::gil_scoped_release>());
  module.def("advice_toml", advice_toml, py::arg("words"), py::call_guard<py::gil_scoped_release>());
}

/// What the user must mend is a ValueError; the rest is as pybind11 has it.
void translate(std::exception_ptr failure) {
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const UsageError& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  }
}

}  // namespace

}  // namespace thinwall

PYBIND11_MODULE(_lab, module) {
  pybind11::register_local_exception_translator(thinwall::translate);
  thinwall::bind_advice(module);
  thinwall::bind_run(module);
  thinwall::bind_theory(module);
  thinwall::bind_world(module);
}
