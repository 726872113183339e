#include "fit/baseline.h"

#include <algorithm>

#include "base/parallel.h"
#include "basis/sh.h"

namespace prelight {

Baseline::Baseline(const CompiledScene& scene, const FitMesh& mesh, int shOrder, double sign)
    : shOrder_(shOrder),
      columns_(1 + static_cast<std::size_t>(shOrder * shOrder)),
      rows_(mesh.slotCount() * columns_) {
  parallelRanges(mesh.slotCount(), 1024, [&](std::size_t begin, std::size_t end) {
    std::vector<double> row(columns_);
    for (std::size_t s = begin; s < end; ++s) {
      evaluate(sign * glm::normalize(glm::dvec3(scene.normals[mesh.vertexOfSlot[s]])), row.data());
      std::transform(row.begin(), row.end(), &rows_[s * columns_], [](double v) { return static_cast<float>(v); });
    }
  });
}

void Baseline::evaluate(const glm::dvec3& normal, double* row) const {
  row[0] = 1.0;
  if (shOrder_ > 0) sh::openTransfer(normal, shOrder_, std::span(row + 1, columns_ - 1));
}

}  // namespace prelight
