#include <fmt/format.h>

#include <optional>

#include "basis/cube_overlap.h"
#include "basis/haar.h"
#include "basis/sh_projection.h"
#include "prelight/error.h"
#include "relight/device/harmonic_light.h"
#include "relight/device/relighting.h"
#include "techniques/haar/haar.h"
#include "techniques/haar/haar_model.h"
#include "techniques/haar/haar_relighter.h"

namespace prelight {

namespace {

/// Transfer in Haar wavelets: the light as a cube map, whose most important coefficients are multiplied.
class WaveletPart final : public RelitPart {
 public:
  WaveletPart(const HaarTransfer& transfer, std::size_t kept, DeviceContext& device)
      : faceSize_(transfer.faceSize), kept_(kept), relighter_(device, transfer) {
    if (kept_ >= cubeTexelCount(faceSize_)) kept_ = 0;
    if (kept_ > 0) model_ = haar::modelTransfer(transfer, haar::usualRank);
  }

  std::size_t receiverCount() const override { return relighter_.vertexCount(); }
  std::size_t bytesMoved() const override { return relighter_.bytesMoved(); }
  void relight(Buffer<float>& radiance) override { relighter_.relight(radiance); }

  void light(const RelighterLight& light) override {
    if (!light.coefficients.empty())
      throw UsageError("RelighterLight::coefficients", "wavelets take no SH",
                       "give the sky itself, or choose SH or CH");
    const std::vector<float> coefficients = haar::transformLight(cubeOf(light));
    const haar::SparseLight selected = selectionOf(coefficients);
    std::vector<haar::LitWavelet> lit;
    for (std::size_t i = 0; i < selected.indices.size(); ++i)
      if (selected.values[i] != glm::vec3(0.0f)) lit.push_back({selected.indices[i], selected.values[i]});
    relighter_.setLight(lit);
  }

 private:
  CubeMap cubeOf(const RelighterLight& light) {
    CubeMap cube = darkCube(faceSize_);
    if (light.sky != nullptr) {
      cube = cubeFromEnvironment(*light.sky, faceSize_);
      if (light.rotation != glm::dmat3(1.0)) cube = rotationBy(light.rotation).apply(cube);
    }
    for (const DistantLight& one : light.lights) {
      const glm::dvec3 towards = glm::normalize(light.rotation * one.towards);
      if (hasSize(one))
        addDisk(cube, towards, one.halfAngle, glm::vec3(radianceOf(one)));
      else
        addDirectional(cube, towards, glm::vec3(one.irradiance));
    }
    return cube;
  }

  /// Returns the map for a rotation, which is kept for the next light.
  const CubeResampling& rotationBy(const glm::dmat3& rotation) {
    if (!resampling_ || rotation_ != rotation) resampling_ = rotateByArea(rotation, faceSize_);
    rotation_ = rotation;
    return *resampling_;
  }

  haar::SparseLight selectionOf(const std::vector<float>& coefficients) const {
    const std::size_t all = cubeTexelCount(faceSize_);
    return model_ ? haar::selectFitted(coefficients, kept_, *model_)
                  : haar::selectLight(coefficients, std::vector<float>(all, 1.0f), all);
  }

  int faceSize_;
  std::size_t kept_;  ///< coefficients of a light; 0: all
  HaarRelighter relighter_;
  std::optional<haar::TransferModel> model_;  ///< by which coefficients are chosen and fitted
  glm::dmat3 rotation_{1.0};
  std::optional<CubeResampling> resampling_;
};

std::string haarForm(const Bake& bake) {
  if (!bake.haar) return {};
  return fmt::format("faces of {0} x {0}, {1} channel{2}, columns of the light's coefficients",
                     bake.haar->faceSize, bake.haar->channels, bake.haar->channels == 1 ? "" : "s");
}

std::unique_ptr<RelitPart> makeWaveletPart(const RelitSource& source) {
  return std::make_unique<WaveletPart>(*source.bake.haar, source.options.wavelets, source.device);
}

}  // namespace

const Relighting haarRelighting = {
    .preference = preferVertices, .form = haarForm, .make = makeWaveletPart, .atVertices = true};

}  // namespace prelight
