#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "base/prefetch.h"
#include "prelight/compiled_scene.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Closed-form values of an unoccluded receiver, which the fit is made relative to. Columns of a value row:
/// open fraction, then order^2 of SH transfer.
class Baseline {
 public:
  Baseline(const CompiledScene& scene, const FitMesh& mesh, int shOrder);

  /// The values of the vertices' backs, in the same memory: odd bands change their sign.
  Baseline ofBacks() const;

  std::size_t columns() const { return columns_; }

  /// Row of a unit normal.
  void evaluate(const glm::dvec3& normal, double* row) const;

  /// Value of a slot's normal.
  float value(std::size_t slot, std::size_t column) const {
    return signs_[column] * (*rows_)[slot * columns_ + column];
  }

  /// Asks for the memory of a slot's values, which are soon read.
  void prefetchRow(std::size_t slot) const { prefetch(&(*rows_)[slot * columns_], columns_); }

 private:
  int shOrder_;
  std::size_t columns_;
  std::vector<float> signs_;                  ///< [column]
  std::shared_ptr<std::vector<float>> rows_;  ///< [slot][column], of the fronts
};

}  // namespace prelight
