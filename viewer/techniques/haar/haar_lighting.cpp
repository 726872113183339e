#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "basis/cube_overlap.h"
#include "basis/haar.h"
#include "basis/haar_direction.h"
#include "device/buffer.h"
#include "prelight/bake.h"
#include "prelight/device.h"
#include "techniques/haar/haar.h"
#include "techniques/haar/haar_model.h"
#include "techniques/haar/haar_relight.h"
#include "techniques/haar/haar_relighter.h"
#include "viewer/lights/receiver_lamps.h"
#include "viewer/programs/drawn_shading.h"
#include "viewer/programs/drawn_transfer.h"
#include "viewer/techniques/through/through_lighting.h"

namespace prelight::viewer {
namespace {

/// Wavelet transfer: the light as a cube map, transformed; its coefficients by the sparse rows of every
/// vertex, once a light, on an OpenCL device or on the host; the radiance as a vertex attribute. Lamps at a
/// finite distance are evaluated for every vertex, on the host.
class HaarLighting : public DrawnTransfer {
 public:
  /// Transfer, scene and device outlive it. `device` nullptr: on the host. `result`: Radiance, or Through
  /// for that of surfaces' other sides.
  HaarLighting(const HaarTransfer& transfer, const CompiledScene& scene, const Device* device,
               Attribute result = Attribute::Radiance);
  ~HaarLighting() override;

  void light(const Illumination& light) override;
  bool verticesMoved() override { return lampsShine_; }
  void bind(const gl::Program& program) const override;
  void describe(const Illumination&, Warnings&) const override {}

  /// Coefficients of the light that is alike everywhere on the transfer's cube, [channel][i].
  std::vector<float> lightCoefficients(const Illumination& light) const;

  /// Radiance before albedo, [vertex], by the light's `terms` most important coefficients, or by all: 0.
  /// Their values are fitted under a model of the transfer, which is made when it is first needed.
  std::vector<glm::vec3> relight(const std::vector<float>& coefficients, std::size_t terms);

 private:
  haar::SparseLight kept(const std::vector<float>& coefficients, std::size_t terms);
  bool ofFronts() const { return radiance_.attribute() == Attribute::Radiance; }
  void addLamps(const std::vector<ShadedLight>& lamps, std::vector<glm::vec3>& radiance) const;

  const HaarTransfer& transfer_;
  const CompiledScene& scene_;
  const Device* device_;
  bool lampsShine_ = false;                   ///< in the last light
  std::optional<haar::TransferModel> model_;  ///< by which coefficients are chosen and fitted
  std::unique_ptr<HaarRelighter> relighter_;
  VertexStream accessibility_;
  VertexStream radiance_;
};

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

HaarLighting::HaarLighting(const HaarTransfer& transfer, const CompiledScene& scene, const Device* device,
                           Attribute result)
    : transfer_(transfer),
      scene_(scene),
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
  for (const ShadedLight& source : light.lights)
    if (source.kind == LightKind::Directional && source.intensity != glm::vec3(0.0f))
      addDirectional(cube, -glm::dvec3(source.direction), source.intensity);
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

void HaarLighting::addLamps(const std::vector<ShadedLight>& lamps, std::vector<glm::vec3>& radiance) const {
  const haar::DirectionFilter filter(transfer_.faceSize);
  const bool sharp = ofFronts() && transfer_.channels == 1;
  parallelRanges(radiance.size(), lampReceivers, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const glm::dvec3 normal = (ofFronts() ? 1.0 : -1.0) * glm::dvec3(scene_.normals[v]);
      for (const ShadedLight& lamp : lamps) {
        const SeenLamp seen = seenFrom(lamp, glm::dvec3(scene_.positions[v]), normal);
        if (!seen.shines()) continue;
        const haar::DirectionFilter::Light light = filter.towards(seen.toLamp, normal);
        const glm::dvec3 through = haar::relightVertex(transfer_, v, light.coefficients);
        radiance[v] += glm::vec3(lampThroughTransfer(seen, through, light.open, sharp));
      }
    }
  });
}

void HaarLighting::light(const Illumination& light) {
  const std::vector<ShadedLight> lamps = transferredLamps(light);
  std::vector<glm::vec3> radiance = relight(lightCoefficients(light), light.haarTerms);
  lampsShine_ = !lamps.empty();
  if (lampsShine_) addLamps(lamps, radiance);
  for (glm::vec3& r : radiance) r = glm::max(r, glm::vec3(0.0f));
  radiance_.fill(std::span<const glm::vec3>(radiance));
}

void HaarLighting::bind(const gl::Program&) const {
  if (ofFronts()) accessibility_.attach();
  radiance_.attach();
}

namespace {

std::unique_ptr<DrawnTransfer> makeHaar(const TechniqueInputs& of) {
  const Bake& bake = *of.inputs.bake;
  std::unique_ptr<DrawnTransfer> fronts =
      std::make_unique<HaarLighting>(*bake.haar, of.inputs.compiled, of.inputs.device);
  if (!bake.through || !bake.through->haar) return fronts;
  return std::make_unique<ThroughLighting>(
      std::move(fronts), std::make_unique<HaarLighting>(*bake.through->haar, of.inputs.compiled,
                                                        of.inputs.device, Attribute::Through));
}

}  // namespace

extern const DrawnShading drawnHaar = {.info = &haarShading, .make = makeHaar};

}  // namespace prelight::viewer
