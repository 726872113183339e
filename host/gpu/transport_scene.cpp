#include "gpu/transport_scene.h"

namespace prelight {

TransportScene::TransportScene(const LitScene& lit, const Device& device, bool choosePunctual)
    : TransportScene(lit, std::make_unique<Tracer>(lit.scene, device), nullptr, choosePunctual) {}

TransportScene::TransportScene(const LitScene& lit, Tracer& tracer, bool choosePunctual)
    : TransportScene(lit, nullptr, &tracer, choosePunctual) {}

TransportScene::TransportScene(const LitScene& lit, std::unique_ptr<Tracer> own, Tracer* tracer,
                               bool choosePunctual)
    : ownTracer_(std::move(own)),
      tracer_(ownTracer_ ? ownTracer_.get() : tracer),
      sky_(lit.sky),
      skyRotation_(lit.skyRotation),
      choosePunctual_(choosePunctual),
      tables_(makeLightTables(lit.scene, lit.lights, lit.sky, choosePunctual)),
      features_(findShadeFeatures(lit.scene, tables_)),
      handle_(tracer_->scene()) {
  handle_.setShading(lit.scene, lit.images);
  handle_.setLights(tables_, skyRotation_);
  tracer_->sharePanes(handle_);
}

void TransportScene::follow(const CompiledScene& scene) {
  tracer_->follow(scene);
  handle_.follow(scene);
}

bool TransportScene::setLights(const CompiledScene& scene, const std::vector<Light>& lights) {
  tables_ = makeLightTables(scene, lights, sky_, choosePunctual_);
  handle_.setLights(tables_, skyRotation_);
  const std::string before = options().text();
  features_ = findShadeFeatures(scene, tables_);
  return options().text() != before;
}

void TransportScene::setSkyRotation(double angle) {
  skyRotation_ = angle;
  handle_.setSkyRotation(angle);
}

BuildOptions TransportScene::options() const {
  BuildOptions options = tracer_->surfaceOptions();
  return defineFeatures(features_, options);
}

}  // namespace prelight
