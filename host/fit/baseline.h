#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "base/spans.h"
#include "prelight/compiled_scene.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Closed-form transfer of unoccluded receivers. The fit only solves for the difference from this baseline. A
/// row of values has the columns: open fraction, then order^2 SH coefficients of transfer.
class Baseline {
 public:
  Baseline(const CompiledScene& scene, const FitMesh& mesh, int shOrder);

  /// Returns the values at the backs of the vertices. They share the memory, as only the signs of odd bands
  /// differ.
  Baseline ofBacks() const;

  std::size_t columns() const { return columns_; }

  /// Writes the row of a unit normal.
  void evaluate(const glm::dvec3& normal, double* row) const;

  /// Returns the value for a slot's normal.
  float value(std::size_t slot, std::size_t column) const {
    return signs_[column] * (*rows_)[slot * columns_ + column];
  }

  /// Prefetches a slot's values.
  void prefetchRow(std::size_t slot) const { prefetch(&(*rows_)[slot * columns_], columns_); }

 private:
  int shOrder_;
  std::size_t columns_;
  std::vector<float> signs_;                  ///< [column]
  std::shared_ptr<std::vector<float>> rows_;  ///< [slot][column], for the fronts
};

}  // namespace prelight
