// Files that cannot be opened.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

namespace abut::python {

/// Raises what Python's open() would: OSError, or the class of it that errno asks for, with the file's name.
[[noreturn]] inline void throw_os_error(const std::filesystem::path& path) {
  PyErr_SetFromErrnoWithFilenameObject(PyExc_OSError, pybind11::cast(path).ptr());
  throw pybind11::error_already_set();
}

}  // namespace abut::python
