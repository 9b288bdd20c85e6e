// abut._native: what the package abut re-exports. Stubs: abut/__init__.pyi and abut/contact.pyi.
#include <pybind11/pybind11.h>

#include "abut/run.hpp"
#include "parts.hpp"

PYBIND11_MODULE(_native, m) {
  m.doc() = "Explicit dynamics with two-surface contact.";
  pybind11::module_ contact = m.def_submodule("contact", "The contact library on its own.");
  abut::python::bind_contact_options(contact);
  abut::python::bind_inspection(contact);  // before the interface, whose defaults are of its types
  abut::python::bind_contact(contact);
  abut::python::bind_replay(contact);
  abut::python::bind_diagnostics(m);
  abut::python::bind_model(m);
  abut::python::bind_run(m);
  m.def("version", &abut::version_text, "Version, commit, compiler and instruction set.");
}
