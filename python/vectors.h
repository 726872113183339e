#pragma once

#include <array>
#include <glm/glm.hpp>

namespace prelight::python {

/// Vectors are sequences of numbers in Python.
using Numbers2 = std::array<double, 2>;
using Numbers3 = std::array<double, 3>;
using Numbers4 = std::array<double, 4>;
using Rows3 = std::array<Numbers3, 3>;
using Rows4 = std::array<Numbers4, 4>;

inline glm::dvec3 vectorOf(const Numbers3& v) { return {v[0], v[1], v[2]}; }
inline Numbers3 numbersOf(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Returns a matrix from rows, as mathematics writes it; glm stores columns.
inline glm::dmat3 matrixOf(const Rows3& rows) {
  glm::dmat3 matrix;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) matrix[c][r] = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  return matrix;
}

inline glm::dmat4 matrixOf(const Rows4& rows) {
  glm::dmat4 matrix;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) matrix[c][r] = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  return matrix;
}

inline Rows4 rowsOf(const glm::dmat4& matrix) {
  Rows4 rows;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = matrix[c][r];
  return rows;
}

}  // namespace prelight::python
