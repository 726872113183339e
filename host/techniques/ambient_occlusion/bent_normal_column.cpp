#include "techniques/ambient_occlusion/bent_normal_column.h"

namespace prelight {

namespace {

constexpr double halfWeight = 0.05;  // mean open vector of 64 rays is known to about 0.02

glm::dvec3 interpolatedNormal(const CompiledScene& scene, const SurfaceSample& sample) {
  const auto& t = scene.triangles[sample.triangle];
  const double b1 = sample.b1, b2 = sample.b2;
  return (1.0 - b1 - b2) * glm::dvec3(scene.normals[t.x]) + b1 * glm::dvec3(scene.normals[t.y]) +
         b2 * glm::dvec3(scene.normals[t.z]);
}

}  // namespace

// Directions are fitted, not the mean vectors that they come from: otherwise what is bright at one corner of
// a triangle would turn the normal at a dark one. The less is open, the less a direction is worth; nothing
// open has none.
void BentNormalColumn::addTo(VertexFit& fit, const SeenBlock& block, std::vector<double>& rows) const {
  std::vector<SurfaceSample> samples;
  rows.clear();
  for (std::size_t i = 0; i < block.samples.size(); ++i) {
    const float* values = hemisphere_.row(block.rows, i);
    const float* n = block.receivers[i].normal;
    const double open = values[0];
    // The mean direction under the density cos/pi is 2/3 of the normal where all is open.
    const glm::dvec3 mean =
        glm::dvec3(values[1], values[2], values[3]) + open * 2.0 / 3.0 * glm::dvec3(n[0], n[1], n[2]);
    const double length = glm::length(mean);
    if (length < 1e-6) continue;
    const glm::dvec3 residual = mean / length - interpolatedNormal(scene_, block.samples[i]);
    samples.push_back(block.samples[i]);
    samples.back().weight *=
        static_cast<float>(length * length / (length * length + halfWeight * halfWeight));
    rows.insert(rows.end(), {residual.x, residual.y, residual.z});
  }
  fit.add(samples, rows);
}

std::vector<float> BentNormalColumn::solve(const SideSums& side, const Progress& progress) const {
  SolveLimits limits = noisyValues();
  limits.progress = &progress;
  return fitOn(side).solve(defaultSmoothing, limits);
}

}  // namespace prelight
