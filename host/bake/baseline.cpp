#include "bake/baseline.h"

#include "base/parallel.h"
#include "basis/sh.h"

namespace prelight {

Baseline::Baseline(const CompiledScene& scene, const FitMesh& mesh, int shOrder, double sign)
    : shOrder_(shOrder),
      columns_(4 + static_cast<std::size_t>(shOrder * shOrder)),
      rows_(mesh.slotCount() * columns_) {
  parallelRanges(mesh.slotCount(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s)
      evaluate(sign * glm::normalize(glm::dvec3(scene.normals[mesh.vertexOfSlot[s]])), &rows_[s * columns_]);
  });
}

void Baseline::evaluate(const glm::dvec3& normal, double* row) const {
  row[0] = 1.0;
  // Mean of the direction under the density cos/pi: 2/3 of the normal.
  for (int axis = 0; axis < 3; ++axis) row[1 + axis] = 2.0 / 3.0 * normal[axis];
  if (shOrder_ > 0) sh::openTransfer(normal, shOrder_, std::span(row + 4, columns_ - 4));
}

}  // namespace prelight
