#pragma once
/// The extension `thinwall._lab`: experiments, advice, theory and worlds for python/thinwall/, which has their documentation and
/// turns what the user wrote into what is asked for here.

#include <pybind11/pybind11.h>

namespace thinwall {

void bind_run(pybind11::module_& module);
void bind_world(pybind11::module_& module);

}  // namespace thinwall
