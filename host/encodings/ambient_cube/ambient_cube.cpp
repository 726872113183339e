#include "encodings/encodings.h"

#include <cassert>

#include "encodings/encoding.h"
#include "encodings/least_squares.h"

namespace prelight {
namespace {

constexpr std::size_t faces = 6;

/// Weight, relative to all normals, that pulls each face towards the mean irradiance. Faces that no normal
/// over the surface looks at have no other source of light.
constexpr double pull = 1e-3;

template <typename Real>
std::array<Real, faces> ambientCubeWeights(const glm::vec<3, Real>& n) {
  std::array<Real, faces> found{};
  for (int axis = 0; axis < 3; ++axis)
    found[static_cast<std::size_t>(2 * axis + (n[axis] < Real(0) ? 1 : 0))] = n[axis] * n[axis];
  return found;
}

void encodeAmbientCube(std::span<const float> incident, const glm::mat3& frame, std::span<float> values) {
  assert(values.size() == 3 * faces);
  const FitIrradiance wanted = fitIrradiance(incident, frame);
  const glm::dmat3 toWorld(frame);
  FitFunctions<faces> functions;
  glm::dvec3 mean(0.0);
  for (std::size_t n = 0; n < fitNormalCount; ++n) {
    functions[n] = ambientCubeWeights<double>(toWorld * fitNormals()[n].direction);
    mean += fitNormals()[n].weight * wanted[n];
  }
  GramMatrix<faces> gram = gramMatrix<faces>(functions);
  FitColours<faces> right = rightSide<faces>(functions, wanted);
  for (std::size_t i = 0; i < faces; ++i) {
    gram[i * faces + i] += pull;
    right[i] += pull * mean;
  }
  storeColours<faces>(solveColours<faces>(gram, right, 0), values);
}

glm::vec3 ambientCubeIrradiance(std::span<const float> values, const glm::mat3& /*frame*/,
                                const glm::vec3& normal) {
  assert(values.size() == 3 * faces);
  const std::array<float, faces> weight = ambientCubeWeights<float>(normal);
  glm::vec3 sum(0.0f);
  for (std::size_t i = 0; i < faces; ++i)
    sum += weight[i] * glm::vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  return glm::max(sum, glm::vec3(0.0f));
}

}  // namespace

Encoding ambientCubeEncoding() {
  return {"ambient-cube",
          "ambient cube: six colours along the world's axes",
          3 * faces,
          false,
          encodeAmbientCube,
          ambientCubeIrradiance,
          encodingShader("ambient_cube")};
}

}  // namespace prelight
