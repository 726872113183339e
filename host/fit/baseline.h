#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Closed-form values of an unoccluded receiver, which the fit is made relative to. Columns of a value row:
/// open fraction, then order^2 of SH transfer.
class Baseline {
 public:
  /// `sign` -1 gives the values of the vertices' backs.
  Baseline(const CompiledScene& scene, const FitMesh& mesh, int shOrder, double sign);

  std::size_t columns() const { return columns_; }

  /// Row of a unit normal.
  void evaluate(const glm::dvec3& normal, double* row) const;

  /// Row of a slot's normal.
  const float* row(std::size_t slot) const { return &rows_[slot * columns_]; }

 private:
  int shOrder_;
  std::size_t columns_;
  std::vector<float> rows_;  ///< [slot][column]
};

}  // namespace prelight
