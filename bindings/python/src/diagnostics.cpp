// Diagnostics, and the exceptions that carry them.
#include <pybind11/stl.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "abut/diagnostic.hpp"
#include "diagnostic_names.hpp"
#include "parts.hpp"

namespace abut::python {
namespace py = pybind11;
namespace {

// Exception types live as long as the interpreter: their references are never given back.
PyObject* input_error = nullptr;
PyObject* run_error = nullptr;

PyObject* make_exception(py::module_& m, const char* name, PyObject* base, const char* doc) {
  const std::string full = std::string("abut.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(full.c_str(), doc, base, nullptr);
  if (type == nullptr) throw py::error_already_set();
  m.add_object(name, py::reinterpret_borrow<py::object>(type));
  return type;
}

void raise_input_error(const InputError& e) {
  py::object error = py::reinterpret_borrow<py::object>(input_error)(e.what());
  error.attr("diagnostics") = py::cast(e.diagnostics().all());
  PyErr_SetObject(input_error, error.ptr());
}

py::object columns(const Diagnostic& d) {
  if (d.place.first_column == 0) return py::none();
  return py::make_tuple(d.place.first_column, d.place.last_column);
}

/// Raises InputError with all findings, those at the places `wrong` made errors.
void refuse(std::vector<Diagnostic> findings, const std::vector<std::size_t>& wrong) {
  for (const std::size_t k : wrong) findings.at(k).severity = Severity::error;
  Diagnostics all;
  for (Diagnostic& d : findings) all.add(std::move(d));
  throw InputError(std::move(all));
}

}  // namespace

void bind_diagnostics(py::module_& m) {
  py::class_<Diagnostic>(m, "Diagnostic", "One finding about input. str() is the line that the command line prints.")
      .def_property_readonly(
          "severity", [](const Diagnostic& d) { return name_of(d.severity, severities); }, "'note', 'warning' or 'error'")
      .def_readonly("code", &Diagnostic::code, "stable name, e.g. 'deck.bad_real'")
      .def_readonly("message", &Diagnostic::message, "what is wrong and what would be right")
      .def_property_readonly(
          "file", [](const Diagnostic& d) { return d.place.file; }, "file name, empty when not known")
      .def_property_readonly(
          "line", [](const Diagnostic& d) { return d.place.line; }, "1-based, 0 when not known")
      .def_property_readonly(
          "keyword", [](const Diagnostic& d) { return d.place.keyword; }, "e.g. '/INTER/TYPE3/1'")
      .def_property_readonly(
          "field", [](const Diagnostic& d) { return d.place.field; }, "e.g. 'Gap'")
      .def_property_readonly("columns", &columns, "first and last column of the field, 1-based; None when it has none")
      .def(py::pickle(
          [](const Diagnostic& d) {
            const Place& p = d.place;
            return py::make_tuple(name_of(d.severity, severities), d.code, d.message, p.file, p.line, p.keyword, p.field, p.first_column,
                                  p.last_column);
          },
          [](const py::tuple& t) {
            if (t.size() != 9) throw py::value_error("this is not the state of a Diagnostic");
            const Place place{t[3].cast<std::string>(), t[4].cast<int>(), t[5].cast<std::string>(),
                              t[6].cast<std::string>(), t[7].cast<int>(), t[8].cast<int>()};
            return Diagnostic{named(t[0].cast<std::string>(), "severity", severities), t[1].cast<std::string>(), place,
                              t[2].cast<std::string>()};
          }))
      .def("__str__", [](const Diagnostic& d) { return to_string(d); })
      .def("__repr__",
           [](const Diagnostic& d) { return "<" + name_of(d.severity, severities) + " " + d.code + ": " + to_string(d) + ">"; });

  input_error = make_exception(m, "InputError", PyExc_ValueError,
                               "Input that cannot be used. `diagnostics` lists every finding, str() the errors among them, one a line.");
  run_error = make_exception(m, "RunError", PyExc_RuntimeError, "A run that cannot go on: not finite, an error limit, a full disk.");
  m.def("_refuse", &refuse, py::arg("findings"), py::arg("wrong"));
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const InputError& e) { raise_input_error(e); } catch (const RunError& e) {
      PyErr_SetString(run_error, e.what());
    }
  });
}

}  // namespace abut::python
