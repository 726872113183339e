#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight::python {

namespace nb = nanobind;

/// What an array is to be: its type and its shape, -1 where any length will do.
struct ArrayKind {
  nb::dlpack::dtype type;
  std::vector<std::int64_t> shape;
};

/// Throws UsageError naming `where` unless the value is a C-contiguous array of that kind.
nb::ndarray<nb::ro> checkedArray(nb::handle value, const char* where, const ArrayKind& kind);

/// An array that Python gave, as long as this lives.
template <typename T>
struct GivenArray {
  nb::ndarray<nb::ro> held = {};
  std::span<const T> values = {};
};

/// All values of an array of that shape.
template <typename T>
GivenArray<T> arrayOf(nb::handle value, const char* where, std::vector<std::int64_t> shape) {
  GivenArray<T> array{checkedArray(value, where, {nb::dtype<T>(), std::move(shape)})};
  array.values = {static_cast<const T*>(array.held.data()), array.held.size()};
  return array;
}

/// Rows of a two-dimensional array as vectors; None: none.
template <typename Vector>
GivenArray<Vector> rowsOf(nb::handle value, const char* where) {
  if (value.is_none()) return {};
  using Scalar = typename Vector::value_type;
  GivenArray<Vector> array{checkedArray(value, where, {nb::dtype<Scalar>(), {-1, Vector::length()}})};
  array.values = {static_cast<const Vector*>(array.held.data()), array.held.shape(0)};
  return array;
}

/// A one-dimensional array; None: none.
template <typename T>
GivenArray<T> listOf(nb::handle value, const char* where) {
  return value.is_none() ? GivenArray<T>{} : arrayOf<T>(value, where, {-1});
}

}  // namespace prelight::python
