#include <fmt/format.h>

#include <utility>

#include "basis/median_cut.h"
#include "basis/sh_projection.h"
#include "prelight/error.h"
#include "prelight/load.h"
#include "relight/device/relighting.h"
#include "techniques/vector_occluders/occluder_relighter.h"
#include "techniques/vector_occluders/vector_occluders.h"

namespace prelight {

namespace {

const CompiledScene& sceneOf(const RelighterOptions& options) {
  if (options.scene == nullptr)
    throw UsageError("RelighterOptions::scene", "vector occluders need positions and normals, got no scene",
                     "give the scene of the bake");
  return options.scene->compiled;
}

/// Vector occluders: distant lights, and skies as directional lights, through the records of every vertex.
class OccluderPart final : public RelitPart {
 public:
  OccluderPart(const OccluderTransfer& transfer, DeviceContext& device, const RelighterOptions& options)
      : skyLights_(options.skyLights),
        relighter_(device, transfer, receiversOf(sceneOf(options))),
        lit_(device, relighter_.vertexCount()) {
    if (skyLights_ < 1 || skyLights_ > mostSkyLights)
      throw UsageError("RelighterOptions::skyLights",
                       fmt::format("got {}, expected 1 to {}", skyLights_, mostSkyLights));
  }

  std::size_t receiverCount() const override { return relighter_.vertexCount(); }

  std::size_t bytesMoved() const override {
    return relighter_.recordCount() * sizeof(glm::vec4) + lit_.bytes() + 3 * receiverCount() * sizeof(float);
  }

  void light(const RelighterLight& light) override {
    if (!light.coefficients.empty())
      throw UsageError("RelighterLight::coefficients", "vector occluders take no SH",
                       "give the sky itself, or choose SH or CH");
    std::vector<device::OccluderLight> lights;
    if (light.sky != nullptr) {
      sh::checkEnvironment(*light.sky);
      for (const SkyLight& part : medianCut(*light.sky, skyLights_))
        lights.push_back(occluderFarLight(light.rotation * part.direction, part.irradiance));
    }
    for (const DistantLight& one : light.lights)
      lights.push_back(occluderFarLight(glm::normalize(light.rotation * one.towards), one.irradiance));
    lights_ = std::move(lights);
  }

  void relight(Buffer<float>& radiance) override {
    if (lights_.empty()) {
      radiance.fill(0.0f);
      return;
    }
    relighter_.relight(lights_, OccluderShading{}, {}, lit_);
    relighter_.takeDiffuse(lit_, radiance);
  }

 private:
  static OccluderReceivers receiversOf(const CompiledScene& scene) {
    return {scene.positions, scene.normals, scene.origin};
  }

  int skyLights_;
  OccluderRelighter relighter_;
  std::vector<device::OccluderLight> lights_;
  Buffer<device::LitVertex> lit_;
};

std::string occludersForm(const Bake& bake) {
  return bake.occluders ? fmt::format("{} records, shaded per light", bake.occluders->recordCount())
                        : std::string();
}

std::unique_ptr<RelitPart> makeOccluderPart(const RelitSource& source) {
  return std::make_unique<OccluderPart>(*source.bake.occluders, source.device, source.options);
}

}  // namespace

const Relighting vectorOccludersRelighting = {
    .preference = preferSurfaces, .form = occludersForm, .make = makeOccluderPart};

}  // namespace prelight
