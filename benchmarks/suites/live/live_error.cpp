#include "benchmarks/suites/live/live_error.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"

namespace prelight::benchmarks {

int nodeOf(const BenchmarkScene& scene, const std::string& name) {
  for (const MeshNode& node : scene.scene.meshNodes)
    if (node.name == name) return node.node;
  for (const Light& light : scene.scene.lights)
    if (light.name == name) return scene.scene.nodes.at(light.sceneNode).node;
  return -1;
}

double relativeError(std::span<const glm::vec3> got, std::span<const glm::vec3> truth) {
  double squares = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    squares += std::pow(luminance(glm::dvec3(got[i]) - glm::dvec3(truth[i])), 2.0);
    sum += luminance(glm::dvec3(truth[i]));
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, truth.size()));
  return sum > 0.0 ? std::sqrt(squares / count) / (sum / count) : 0.0;
}

}  // namespace prelight::benchmarks
