#include "arrays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace abut::python {
namespace {

using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;
using IntegerArray = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

[[noreturn]] void bad_shape(const char* name, const py::array& array, const std::string& expected) {
  throw py::value_error(std::string(name) + " has shape " + shape_text(array) + ", expected " + expected);
}

std::string rows_text(py::ssize_t count) { return count == any_count ? "N" : std::to_string(count); }

void check_shape(const py::array& array, const char* name, py::ssize_t count, bool by_three) {
  const bool good = by_three ? array.ndim() == 2 && array.shape(1) == 3 : array.ndim() == 1;
  if (!good || (count != any_count && array.shape(0) != count)) {
    bad_shape(name, array, by_three ? "(" + rows_text(count) + ", 3)" : "(" + rows_text(count) + ",)");
  }
}

py::array as_array(const ArrayLike& value, const char* name) {
  auto array = py::array::ensure(value.value);
  if (!array) {
    PyErr_Clear();
    throw py::type_error(std::string(name) + " cannot be made an array: its rows have different lengths, or it holds no numbers");
  }
  return array;
}

py::array as_doubles(const ArrayLike& value, const char* name) {
  const py::array any = as_array(value, name);
  const char kind = any.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u' && any.size() > 0) {
    throw py::type_error(std::string(name) + " does not hold real numbers but " + py::cast<std::string>(py::str(any.dtype())));
  }
  return DoubleArray(any);
}

void check_finite(const py::array& array, const char* name) {
  const auto* data = static_cast<const double*>(array.data());
  const auto columns = array.ndim() == 2 ? static_cast<std::size_t>(array.shape(1)) : 1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(array.size()); ++i) {
    if (!std::isfinite(data[i])) throw py::value_error(std::string(name) + ": row " + std::to_string(i / columns) + " is not finite");
  }
}

py::array as_integers(const ArrayLike& value, const char* name) {
  const py::array any = as_array(value, name);
  const char kind = any.dtype().kind();
  if (kind != 'i' && kind != 'u' && any.size() > 0) {
    throw py::type_error(std::string(name) + " does not hold integers but " + py::cast<std::string>(py::str(any.dtype())));
  }
  if (kind == 'u' && any.itemsize() == sizeof(std::uint64_t)) {
    const py::array_t<std::uint64_t, py::array::c_style | py::array::forcecast> large(any);
    const auto* first = large.data();
    const auto* largest = std::max_element(first, first + large.size());
    if (large.size() > 0 && *largest > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
      throw py::value_error(std::string(name) + ": " + std::to_string(*largest) + " is too large for an id or an index");
    }
  }
  return IntegerArray(any);
}

Index to_index(std::int64_t value, const char* name) {
  if (value < 0 || value > std::numeric_limits<Index>::max()) {
    throw py::value_error(std::string(name) + ": " + std::to_string(value) + " is not a node index");
  }
  return static_cast<Index>(value);
}

double* writable(const ArrayLike& value, const char* name, py::ssize_t count, bool by_three) {
  if (!py::isinstance<py::array_t<double>>(value.value))
    throw py::type_error(std::string(name) + " is added to: it must be a float64 array");
  const auto array = py::reinterpret_borrow<py::array>(value.value);
  check_shape(array, name, count, by_three);
  if ((array.flags() & py::array::c_style) == 0) throw py::type_error(std::string(name) + " is added to: it must be in C order");
  if (!array.writeable()) throw py::type_error(std::string(name) + " is added to, but it is read-only");
  return static_cast<double*>(const_cast<void*>(array.data()));
}

template <class T>
py::array read_only(const T* data, std::vector<py::ssize_t> shape, py::handle owner) {
  py::array array(py::dtype::of<T>(), std::move(shape), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::ssize_t size_of(std::size_t n) { return static_cast<py::ssize_t>(n); }

}  // namespace

Points points(const ArrayLike& value, const char* name, py::ssize_t count) {
  py::array array = as_doubles(value, name);
  check_shape(array, name, count, true);
  check_finite(array, name);
  const auto* data = static_cast<const Vec3*>(array.data());
  const auto rows = static_cast<std::size_t>(array.shape(0));
  return {std::move(array), {data, rows}};
}

Reals reals(const ArrayLike& value, const char* name, py::ssize_t count) {
  py::array array = as_doubles(value, name);
  check_shape(array, name, count, false);
  check_finite(array, name);
  const auto* data = static_cast<const double*>(array.data());
  const auto rows = static_cast<std::size_t>(array.shape(0));
  return {std::move(array), {data, rows}};
}

Reals reals(const std::optional<ArrayLike>& value, const char* name, py::ssize_t count) {
  return value ? reals(*value, name, count) : Reals{};
}

Reals masses(const std::optional<ArrayLike>& value, py::ssize_t count) {
  Reals mass = reals(value, "mass", count);
  const auto negative = std::find_if(mass.span.begin(), mass.span.end(), [](double m) { return m < 0.0; });
  if (negative != mass.span.end()) { throw py::value_error("mass: row " + std::to_string(negative - mass.span.begin()) + " is negative"); }
  return mass;
}

py::ssize_t dimensions(const ArrayLike& value, const char* name) { return as_array(value, name).ndim(); }

std::vector<Id> ids(const ArrayLike& value, const char* name) {
  const py::array array = as_integers(value, name);
  check_shape(array, name, any_count, false);
  const auto* data = static_cast<const std::int64_t*>(array.data());
  return {data, data + array.size()};
}

std::vector<Index> indices(const ArrayLike& value, const char* name) {
  std::vector<Index> out;
  for (const Id v : ids(value, name)) out.push_back(to_index(v, name));
  return out;
}

std::vector<std::uint8_t> flags(const ArrayLike& value, const char* name) {
  const py::array any = as_array(value, name);
  const char kind = any.dtype().kind();
  if (kind != 'b' && kind != 'i' && kind != 'u') throw py::type_error(std::string(name) + " does not hold flags");
  const IntegerArray array(any);
  check_shape(array, name, any_count, false);
  std::vector<std::uint8_t> out;
  for (py::ssize_t i = 0; i < array.size(); ++i) out.push_back(array.data()[i] != 0 ? 1 : 0);
  return out;
}

std::vector<contact::Facet> facets(const ArrayLike& value, const char* name) {
  const py::array array = as_integers(value, name);
  if (array.ndim() != 2 || (array.shape(1) != 3 && array.shape(1) != 4)) bad_shape(name, array, "(F, 3) or (F, 4)");
  const auto* data = static_cast<const std::int64_t*>(array.data());
  const auto columns = static_cast<std::size_t>(array.shape(1));
  std::vector<contact::Facet> out;
  for (std::size_t f = 0; f < static_cast<std::size_t>(array.shape(0)); ++f) {
    const std::int64_t* node = data + f * columns;
    const Index third = to_index(node[2], name);
    const bool triangle = columns == 3 || node[3] == -1;
    out.push_back({{to_index(node[0], name), to_index(node[1], name), third, triangle ? third : to_index(node[3], name)}});
  }
  return out;
}

std::span<Vec3> writable_points(const ArrayLike& value, const char* name, py::ssize_t count) {
  return {reinterpret_cast<Vec3*>(writable(value, name, count, true)), static_cast<std::size_t>(count)};
}

std::span<double> writable_reals(const ArrayLike& value, const char* name, py::ssize_t count) {
  return {writable(value, name, count, false), static_cast<std::size_t>(count)};
}

py::array view(std::span<const Vec3> values, py::handle owner) {
  return read_only(values.empty() ? nullptr : &values.front().x, {size_of(values.size()), 3}, owner);
}

py::array view(std::span<const double> values, py::handle owner) { return read_only(values.data(), {size_of(values.size())}, owner); }

py::array view(std::span<const Index> values, py::handle owner, py::ssize_t columns) {
  if (columns == 0) return read_only(values.data(), {size_of(values.size())}, owner);
  return read_only(values.data(), {size_of(values.size()) / columns, columns}, owner);
}

py::array view(std::span<const Id> values, py::handle owner) { return read_only(values.data(), {size_of(values.size())}, owner); }

py::array copy(const Vec3& value) { return copy(std::span<const Vec3>(&value, 1)).squeeze(); }

py::array copy(std::span<const Vec3> values) {
  return {py::dtype::of<double>(), {size_of(values.size()), py::ssize_t{3}}, values.empty() ? nullptr : &values.front().x};
}

py::array copy(std::span<const Index> values) { return {py::dtype::of<Index>(), {size_of(values.size())}, values.data()}; }

py::array copy(std::span<const Id> values) { return {py::dtype::of<Id>(), {size_of(values.size())}, values.data()}; }

py::array copy(std::span<const std::array<Index, 4>> values) {
  return {py::dtype::of<Index>(), {size_of(values.size()), py::ssize_t{4}}, values.empty() ? nullptr : values.front().data()};
}

py::array copy(std::span<const std::array<Id, 4>> values) {
  return {py::dtype::of<Id>(), {size_of(values.size()), py::ssize_t{4}}, values.empty() ? nullptr : values.front().data()};
}

py::array take(std::vector<double> values, std::size_t columns) {
  auto owned = std::make_unique<std::vector<double>>(std::move(values));
  std::vector<double>& held = *owned;
  const py::capsule keeper(owned.release(), [](void* p) { delete static_cast<std::vector<double>*>(p); });
  std::vector<py::ssize_t> shape{size_of(columns == 0 ? 0 : held.size() / columns)};
  if (columns > 1) shape.push_back(size_of(columns));
  return {py::dtype::of<double>(), std::move(shape), held.data(), keeper};
}

}  // namespace abut::python
