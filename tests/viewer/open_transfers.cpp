#include "viewer/open_transfers.h"

#include <cmath>

#include "basis/haar.h"
#include "basis/sh.h"
#include "basis/sh_products.h"
#include "techniques/haar/haar_relight.h"

namespace prelight::test {

HarmonicTransfer tiltedTransfer(std::size_t vertices, int order, int channels) {
  HarmonicTransfer transfer{order, channels, channels == 3 ? 1 : 0, {}};
  std::vector<double> values(sh::coefficientCount(order));
  for (std::size_t v = 0; v < vertices; ++v) {
    for (int c = 0; c < channels; ++c) {
      const double turn = 0.9 * static_cast<double>(v) + 0.5 * c;
      sh::openTransfer(glm::normalize(glm::dvec3(0.4 * std::cos(turn), 0.4 * std::sin(turn), 1.0)), order,
                       values);
      for (const double value : values)
        transfer.coefficients.push_back(static_cast<float>((0.9 - 0.2 * c) * value));
    }
  }
  return transfer;
}

HaarTransfer openWavelets(const std::vector<glm::vec3>& normals, int faceSize, int channels) {
  HaarTransfer transfer{faceSize, channels, 0, {0}, {}, {}};
  const CubeTexels texels(faceSize);
  std::vector<float> row(texels.count());
  for (const glm::vec3& normal : normals) {
    for (int c = 0; c < channels; ++c) {
      texels.open(glm::dvec3(normal), row);
      haar::forward(row, faceSize);
      haar::appendRow(transfer, haar::keepError(row, 0.0));
    }
  }
  return transfer;
}

GlossyTransfer openMatrices(const std::vector<glm::vec3>& normals, int order, int channels) {
  GlossyTransfer transfer{order, channels, 0, {}};
  const int cosineOrder = 2 * order - 1;
  std::vector<double> cosine(sh::coefficientCount(cosineOrder));
  for (const glm::vec3& normal : normals) {
    sh::openTransfer(glm::dvec3(normal), cosineOrder, cosine);
    const std::vector<double> matrix = sh::productMatrix(cosine, cosineOrder, order);
    for (int c = 0; c < channels; ++c)
      for (const double value : matrix) transfer.matrices.push_back(static_cast<float>(value));
  }
  return transfer;
}

QuadScene litQuad(bool nearLight) {
  QuadScene quad;
  quad.add(lambertian({0.9f, 0.7f, 0.5f}));
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.setSky(halvedSky());
  quad.scene.lights = {makeLight(LightType::Directional, {1, 2, 3}, {}, {0.2, -0.5, -1})};
  if (nearLight) quad.scene.lights.push_back(makeLight(LightType::Point, {3, 2, 1}, {0.5, 0.5, 1.0}));
  quad.compile();
  return quad;
}

}  // namespace prelight::test
