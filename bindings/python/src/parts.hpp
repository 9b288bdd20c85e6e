// What module.cpp puts together.
#pragma once

#include <pybind11/pybind11.h>

namespace abut::python {

void bind_diagnostics(pybind11::module_& m);
void bind_model(pybind11::module_& m);
void bind_run(pybind11::module_& m);
void bind_contact_options(pybind11::module_& m);
void bind_contact(pybind11::module_& m);
void bind_replay(pybind11::module_& m);
void bind_inspection(pybind11::module_& m);

}  // namespace abut::python
