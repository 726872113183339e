#include "python/array_checks.h"

#include <fmt/format.h>

#include <string>

#include "prelight/error.h"

namespace prelight::python {

namespace {

std::string nameOf(const nb::dlpack::dtype& type) {
  const char* kind = "other";
  switch (static_cast<nb::dlpack::dtype_code>(type.code)) {
    case nb::dlpack::dtype_code::Int:
      kind = "int";
      break;
    case nb::dlpack::dtype_code::UInt:
      kind = "uint";
      break;
    case nb::dlpack::dtype_code::Float:
      kind = "float";
      break;
    case nb::dlpack::dtype_code::Complex:
      kind = "complex";
      break;
    case nb::dlpack::dtype_code::Bool:
      return "bool";
    default:
      break;
  }
  return fmt::format("{}{}", kind, type.bits);
}

std::string nameOf(const std::vector<std::int64_t>& shape) {
  std::string text;
  for (const std::int64_t length : shape)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", length < 0 ? "n" : std::to_string(length));
  return fmt::format("({}{})", text, shape.size() == 1 ? "," : "");
}

std::vector<std::int64_t> shapeOf(const nb::ndarray<nb::ro>& array) {
  std::vector<std::int64_t> shape(array.ndim());
  for (std::size_t i = 0; i < shape.size(); ++i) shape[i] = static_cast<std::int64_t>(array.shape(i));
  return shape;
}

bool fits(const std::vector<std::int64_t>& shape, const std::vector<std::int64_t>& wanted) {
  if (shape.size() != wanted.size()) return false;
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (wanted[i] >= 0 && shape[i] != wanted[i]) return false;
  return true;
}

bool isContiguous(const nb::ndarray<nb::ro>& array) {
  std::int64_t stride = 1;
  for (std::size_t i = array.ndim(); i-- > 0;) {
    if (array.shape(i) != 1 && array.size() > 0 && array.stride(i) != stride) return false;
    stride *= static_cast<std::int64_t>(array.shape(i));
  }
  return true;
}

}  // namespace

nb::ndarray<nb::ro> checkedArray(nb::handle value, const char* where, const ArrayKind& kind) {
  const std::string expected =
      fmt::format("a NumPy array of {} with shape {}", nameOf(kind.type), nameOf(kind.shape));
  const std::string fix = fmt::format("numpy.ascontiguousarray(x, dtype=numpy.{})", nameOf(kind.type));
  nb::ndarray<nb::ro> array;
  if (!nb::try_cast(value, array))
    throw UsageError(where, fmt::format("got {}, expected {}", nb::inst_name(value).c_str(), expected), fix);
  if (array.device_type() != nb::device::cpu::value)
    throw UsageError(where, "got an array that is not in the processor's memory, expected " + expected);
  const std::vector<std::int64_t> shape = shapeOf(array);
  const bool rightType = array.dtype() == kind.type, rightShape = fits(shape, kind.shape);
  if (rightType && rightShape && isContiguous(array)) return array;
  throw UsageError(where,
                   fmt::format("got {} with shape {}{}, expected {}", nameOf(array.dtype()), nameOf(shape),
                               isContiguous(array) ? "" : ", not C-contiguous", expected),
                   rightShape ? fix : "");
}

}  // namespace prelight::python
