#include "shade/transport_scene.h"

namespace prelight {

TransportScene::TransportScene(const LitScene& lit, const Device& device, bool choosePunctual)
    : tracer_(lit.scene, device),
      tables_(makeLightTables(lit.scene, lit.lights, lit.sky, choosePunctual)),
      layout_(lightLayout(tables_, lit.skyRotation)),
      features_(findShadeFeatures(lit.scene, tables_)),
      surface_(lit.scene, lit.images, tracer_, features_.layerTextures),
      lights_(tracer_.context(), tables_) {}

cl_uint TransportScene::setArguments(cl::Kernel& kernel, cl_uint index) const {
  return lights_.setArguments(kernel, surface_.setArguments(kernel, index));
}

BuildOptions TransportScene::options() const {
  BuildOptions options = tracer_.surfaceOptions();
  return defineFeatures(features_, options);
}

}  // namespace prelight
