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

/// The type and the shape that an array must have; -1 stands for any length.
struct ArrayKind {
  nb::dlpack::dtype type;
  std::vector<std::int64_t> shape;
};

/// Throws UsageError naming `where` unless the value is a C-contiguous array of this kind.
nb::ndarray<nb::ro> checkedArray(nb::handle value, const char* where, const ArrayKind& kind);

/// An array from Python that stays alive as long as this object.
template <typename T>
struct GivenArray {
  nb::ndarray<nb::ro> held = {};
  std::span<const T> values = {};
};

/// Returns all values of an array, which must have this shape.
template <typename T>
GivenArray<T> arrayOf(nb::handle value, const char* where, std::vector<std::int64_t> shape) {
  GivenArray<T> array{checkedArray(value, where, {nb::dtype<T>(), std::move(shape)})};
  array.values = {static_cast<const T*>(array.held.data()), array.held.size()};
  return array;
}

/// Returns the rows of a two-dimensional array as vectors, none for None.
template <typename Vector>
GivenArray<Vector> rowsOf(nb::handle value, const char* where) {
  if (value.is_none()) return {};
  using Scalar = typename Vector::value_type;
  GivenArray<Vector> array{checkedArray(value, where, {nb::dtype<Scalar>(), {-1, Vector::length()}})};
  array.values = {static_cast<const Vector*>(array.held.data()), array.held.shape(0)};
  return array;
}

/// Returns a one-dimensional array, empty for None.
template <typename T>
GivenArray<T> listOf(nb::handle value, const char* where) {
  return value.is_none() ? GivenArray<T>{} : arrayOf<T>(value, where, {-1});
}

}  // namespace prelight::python
