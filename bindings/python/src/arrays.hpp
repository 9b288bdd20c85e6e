// The border between numpy and abut: every array that comes in is checked here, every array that goes out is made here.
//
// In: anything numpy can turn into an array; a float64 array in C order is taken as it is, without a copy. Arrays that are written to
// must be exactly that. Out: a view keeps its owner alive and is read-only; a copy belongs to the caller.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <span>
#include <vector>

#include "abut/contact/surface.hpp"
#include "abut/types.hpp"
#include "abut/vec3.hpp"

namespace abut::python {

namespace py = pybind11;

/// An argument that is checked by the functions below; None is not one.
struct ArrayLike {
  py::object value;
};

/// #N by 3 or #N numbers of the caller; the span lives as long as this object.
struct Points {
  py::array array;
  std::span<const Vec3> span;
};
struct Reals {
  py::array array;
  std::span<const double> span;
};

inline constexpr py::ssize_t any_count = -1;

/// @param name  of the argument, for the message
/// @param count  rows that there must be
/// @throws TypeError or ValueError when the shape is another one or a value is not finite
[[nodiscard]] Points points(const ArrayLike& value, const char* name, py::ssize_t count = any_count);
[[nodiscard]] Reals reals(const ArrayLike& value, const char* name, py::ssize_t count = any_count);
/// Nothing gives an empty span.
[[nodiscard]] Reals reals(const std::optional<ArrayLike>& value, const char* name, py::ssize_t count = any_count);
/// Nodal masses: not negative.
[[nodiscard]] Reals masses(const std::optional<ArrayLike>& value, py::ssize_t count);
/// Number of dimensions of what numpy makes of it. @throws TypeError when that is no array
[[nodiscard]] py::ssize_t dimensions(const ArrayLike& value, const char* name);
/// Integers that are not negative and fit.
[[nodiscard]] std::vector<Index> indices(const ArrayLike& value, const char* name);
[[nodiscard]] std::vector<Id> ids(const ArrayLike& value, const char* name);
/// 0 and 1 or booleans.
[[nodiscard]] std::vector<std::uint8_t> flags(const ArrayLike& value, const char* name);
/// #F by 3 or 4; a triangle in four columns repeats its third node or ends in -1.
[[nodiscard]] std::vector<contact::Facet> facets(const ArrayLike& value, const char* name);

/// Arrays that are added to: float64, C order, writable.
[[nodiscard]] std::span<Vec3> writable_points(const ArrayLike& value, const char* name, py::ssize_t count);
[[nodiscard]] std::span<double> writable_reals(const ArrayLike& value, const char* name, py::ssize_t count);

/// Read-only, without a copy; `owner` keeps the memory alive.
[[nodiscard]] py::array view(std::span<const Vec3> values, py::handle owner);
[[nodiscard]] py::array view(std::span<const double> values, py::handle owner);
[[nodiscard]] py::array view(std::span<const Index> values, py::handle owner, py::ssize_t columns = 0);
[[nodiscard]] py::array view(std::span<const Id> values, py::handle owner);

[[nodiscard]] py::array copy(const Vec3& value);
[[nodiscard]] py::array copy(std::span<const Vec3> values);
[[nodiscard]] py::array copy(std::span<const Index> values);
[[nodiscard]] py::array copy(std::span<const Id> values);
[[nodiscard]] py::array copy(std::span<const std::array<Index, 4>> values);
[[nodiscard]] py::array copy(std::span<const std::array<Id, 4>> values);
/// Takes the vector over: #rows, or #rows by `columns` when that is more than 1.
[[nodiscard]] py::array take(std::vector<double> values, std::size_t columns = 1);

}  // namespace abut::python

namespace pybind11::detail {

template <>
struct type_caster<abut::python::ArrayLike> {
  PYBIND11_TYPE_CASTER(abut::python::ArrayLike, const_name("ArrayLike"));
  bool load(handle source, bool) {
    if (!source || source.is_none()) return false;
    value.value = reinterpret_borrow<object>(source);
    return true;
  }
  static handle cast(const abut::python::ArrayLike& source, return_value_policy, handle) { return source.value.inc_ref(); }
};

}  // namespace pybind11::detail
