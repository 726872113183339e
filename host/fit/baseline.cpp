#include "fit/baseline.h"

#include <algorithm>

#include "base/parallel.h"
#include "basis/sh.h"

namespace prelight {

Baseline::Baseline(const CompiledScene& scene, const FitMesh& mesh, int shOrder)
    : shOrder_(shOrder),
      columns_(1 + static_cast<std::size_t>(shOrder * shOrder)),
      signs_(columns_, 1.0f),
      rows_(std::make_shared<std::vector<float>>(mesh.slotCount() * columns_)) {
  parallelRanges(mesh.slotCount(), 1024, [&](std::size_t begin, std::size_t end) {
    std::vector<double> row(columns_);
    for (std::size_t s = begin; s < end; ++s) {
      evaluate(glm::normalize(glm::dvec3(scene.normals[mesh.vertexOfSlot[s]])), row.data());
      std::transform(row.begin(), row.end(), &(*rows_)[s * columns_],
                     [](double v) { return static_cast<float>(v); });
    }
  });
}

Baseline Baseline::ofBacks() const {
  Baseline backs = *this;
  for (int band = 1; band < shOrder_; band += 2)
    for (int i = band * band; i < (band + 1) * (band + 1); ++i)
      backs.signs_[1 + static_cast<std::size_t>(i)] *= -1.0f;
  return backs;
}

void Baseline::evaluate(const glm::dvec3& normal, double* row) const {
  row[0] = 1.0;
  if (shOrder_ > 0) sh::openTransfer(normal, shOrder_, std::span(row + 1, columns_ - 1));
}

}  // namespace prelight
