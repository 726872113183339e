#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace prelight::python {

namespace nb = nanobind;

/// NumPy arrays over the library's memory: nothing is copied, and the owner of the memory lives as long as
/// the arrays.
template <typename T, std::size_t Dimensions>
using View = nb::ndarray<nb::numpy, const T, nb::ndim<Dimensions>>;

template <typename T, std::size_t Dimensions>
using Result = nb::ndarray<nb::numpy, T, nb::ndim<Dimensions>>;

/// Returns a capsule that keeps `owner` alive as long as an array needs it.
inline nb::capsule keeping(std::shared_ptr<const void> owner) {
  return nb::capsule(new std::shared_ptr<const void>(std::move(owner)),
                     [](void* held) noexcept { delete static_cast<std::shared_ptr<const void>*>(held); });
}

template <typename T, std::size_t Dimensions>
View<T, Dimensions> viewOf(const void* data, const std::array<std::size_t, Dimensions>& shape,
                           std::shared_ptr<const void> owner) {
  return View<T, Dimensions>(static_cast<const T*>(data), Dimensions, shape.data(),
                             keeping(std::move(owner)));
}

/// Returns an array of one member of larger elements, which take `elementSize` bytes each; the last
/// Dimensions - 1 lengths lie within an element.
template <typename T, std::size_t Dimensions>
View<T, Dimensions> memberOf(const T* first, std::size_t elementSize,
                             const std::array<std::size_t, Dimensions>& shape,
                             std::shared_ptr<const void> owner) {
  std::array<std::int64_t, Dimensions> strides;
  strides[0] = static_cast<std::int64_t>(elementSize / sizeof(T));
  if constexpr (Dimensions > 1) strides[1] = 1;
  return View<T, Dimensions>(first, Dimensions, shape.data(), keeping(std::move(owner)), strides.data());
}

/// Returns an array that owns the elements of a vector. `T` is the scalar type of which elements consist.
template <typename T, std::size_t Dimensions, typename Element>
Result<T, Dimensions> arrayFrom(std::vector<Element> values,
                                const std::array<std::size_t, Dimensions>& shape) {
  auto* kept = new std::vector<Element>(std::move(values));
  const nb::capsule owner(kept, [](void* held) noexcept { delete static_cast<std::vector<Element>*>(held); });
  return Result<T, Dimensions>(reinterpret_cast<T*>(kept->data()), Dimensions, shape.data(), owner);
}

}  // namespace prelight::python
