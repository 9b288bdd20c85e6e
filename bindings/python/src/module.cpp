// abut._native: what the package abut re-exports. Stubs: abut/__init__.pyi and abut/contact.pyi.
#include <pybind11/pybind11.h>

#include <cstddef>

#include "abut/run.hpp"
#include "parts.hpp"

namespace {

void* refuse_raw(std::size_t) { throw pybind11::type_error("this object was made by __new__ alone: it has no value"); }

/// An object that __new__ alone made would be used as memory that nobody wrote.
void refuse_raw_objects(const pybind11::module_& m) {
  for (const auto& [name, value] : m.attr("__dict__").cast<pybind11::dict>()) {
    if (PyType_Check(value.ptr()) == 0) continue;
    auto* info = pybind11::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr()));
    if (info != nullptr) info->operator_new = &refuse_raw;
  }
}

}  // namespace

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
  refuse_raw_objects(contact);
  refuse_raw_objects(m);
}
