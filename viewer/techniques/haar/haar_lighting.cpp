#include "viewer/techniques/haar/haar_lighting.h"

#include <algorithm>

#include "basis/cube_overlap.h"
#include "basis/haar.h"
#include "device/buffer.h"
#include "techniques/haar/haar_relight.h"
#include "techniques/haar/haar_relighter.h"

namespace prelight::viewer {
namespace {

std::vector<glm::vec3> asFloat(const std::vector<glm::dvec3>& values) {
  return {values.begin(), values.end()};
}

/// Mean of the channels, [vertex]: the radiance under a sky of radiance 1, of which a face's average is S and
/// all other coefficients are 0.
std::vector<float> haarAccessibility(const HaarTransfer& transfer) {
  haar::SparseLight even;
  const auto faceTexels = static_cast<std::uint32_t>(transfer.faceSize * transfer.faceSize);
  for (std::uint32_t face = 0; face < cubeFaces; ++face) {
    even.indices.push_back(face * faceTexels);
    even.values.emplace_back(static_cast<float>(transfer.faceSize));
  }
  std::vector<float> result;
  for (const glm::dvec3& exit : haar::relight(transfer, even))
    result.push_back(static_cast<float>(std::clamp((exit.x + exit.y + exit.z) / 3.0, 0.0, 1.0)));
  return result;
}

}  // namespace

HaarLighting::HaarLighting(const HaarTransfer& transfer, const Device* device, Attribute result)
    : transfer_(transfer),
      device_(device),
      accessibility_(Attribute::Accessibility, std::span<const float>(haarAccessibility(transfer))),
      radiance_(result, std::span<const glm::vec3>()) {}

HaarLighting::~HaarLighting() = default;

std::vector<float> HaarLighting::lightCoefficients(const Illumination& light) const {
  CubeMap cube = darkCube(transfer_.faceSize);
  if (light.skyMap != nullptr) {
    const bool still = light.skyRotation == 0.0;
    cube = cubeFromEnvironment(still ? *light.skyMap : turnedSky(*light.skyMap, light.skyRotation),
                               transfer_.faceSize);
  }
  for (const ShadedLight& source : light.lights) {
    if (!source.throughTransfer) continue;
    const ShadedLight far = seenFromCentre(source);
    if (far.intensity != glm::vec3(0.0f)) addDirectional(cube, -glm::dvec3(far.direction), far.intensity);
  }
  return haar::transformLight(cube);
}

haar::SparseLight HaarLighting::kept(const std::vector<float>& coefficients, std::size_t terms) {
  const std::size_t all = cubeTexelCount(transfer_.faceSize);
  if (terms == 0 || terms >= all) return haar::selectLight(coefficients, std::vector<float>(all, 1.0f), all);
  // The model is of the transfer alone and serves every light; a fit is far cheaper than the light's cube
  // map.
  if (!model_) model_ = haar::modelTransfer(transfer_, haar::usualRank);
  return haar::selectFitted(coefficients, terms, *model_);
}

std::vector<glm::vec3> HaarLighting::relight(const std::vector<float>& coefficients, std::size_t terms) {
  const haar::SparseLight light = kept(coefficients, terms);
  if (device_ == nullptr) return asFloat(haar::relight(transfer_, light));

  if (relighter_ == nullptr) relighter_ = std::make_unique<HaarRelighter>(device_->context(), transfer_);
  std::vector<haar::LitWavelet> lit;
  for (std::size_t i = 0; i < light.indices.size(); ++i) lit.push_back({light.indices[i], light.values[i]});
  relighter_->setLight(lit);
  Buffer<float> radiance(device_->context(), 3 * relighter_->vertexCount());
  relighter_->relight(radiance);
  const std::vector<float> numbers = radiance.read();
  std::vector<glm::vec3> result(relighter_->vertexCount());
  for (std::size_t v = 0; v < result.size(); ++v)
    result[v] = {numbers[3 * v], numbers[3 * v + 1], numbers[3 * v + 2]};
  return result;
}

void HaarLighting::light(const Illumination& light) {
  std::vector<glm::vec3> radiance = relight(lightCoefficients(light), light.haarTerms);
  for (glm::vec3& r : radiance) r = glm::max(r, glm::vec3(0.0f));
  radiance_.fill(std::span<const glm::vec3>(radiance));
}

void HaarLighting::bind(const gl::Program&) const {
  if (radiance_.attribute() == Attribute::Radiance) accessibility_.attach();
  radiance_.attach();
}

void HaarLighting::describe(const Illumination& light, Warnings& notes) const {
  noteFarLights(light, "wavelet transfer", notes);
}

}  // namespace prelight::viewer
