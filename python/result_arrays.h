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

/// NumPy arrays over memory of the library: nothing is copied, and what has the memory lives as long as they.
template <typename T, std::size_t Dimensions>
using View = nb::ndarray<nb::numpy, const T, nb::ndim<Dimensions>>;

template <typename T, std::size_t Dimensions>
using Result = nb::ndarray<nb::numpy, T, nb::ndim<Dimensions>>;

/// Keeps `owner` as long as an array needs it.
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

/// A member of larger elements, `elementSize` bytes each; Dimensions - 1 lengths within an element follow.
template <typename T, std::size_t Dimensions>
View<T, Dimensions> memberOf(const T* first, std::size_t elementSize,
                             const std::array<std::size_t, Dimensions>& shape,
                             std::shared_ptr<const void> owner) {
  std::array<std::int64_t, Dimensions> strides;
  strides[0] = static_cast<std::int64_t>(elementSize / sizeof(T));
  if constexpr (Dimensions > 1) strides[1] = 1;
  return View<T, Dimensions>(first, Dimensions, shape.data(), keeping(std::move(owner)), strides.data());
}

/// An array that has a vector's elements for itself. `T` is the scalar that elements are made of.
template <typename T, std::size_t Dimensions, typename Element>
Result<T, Dimensions> arrayFrom(std::vector<Element> values,
                                const std::array<std::size_t, Dimensions>& shape) {
  auto* kept = new std::vector<Element>(std::move(values));
  const nb::capsule owner(kept, [](void* held) noexcept { delete static_cast<std::vector<Element>*>(held); });
  return Result<T, Dimensions>(reinterpret_cast<T*>(kept->data()), Dimensions, shape.data(), owner);
}

}  // namespace prelight::python
