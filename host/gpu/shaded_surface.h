#pragma once

#include <vector>

#include "gpu/tracer.h"
#include "shared/shade_types.h"

namespace prelight {

/// What kernels/transport/interaction_funcs.cl reads of the surface, on the device: shading normals, materials and
/// their textures. This header and light_buffers.h show OpenCL types, as the tracer's does.
class ShadedSurface {
 public:
  static constexpr cl_uint argumentCount = 10;

  /// The tracer outlives it. `layerTextures`: ShadeFeatures::layerTextures.
  ShadedSurface(const CompiledScene& scene, const std::vector<Image>& images, const Tracer& tracer,
                bool layerTextures);

  /// Takes vertices to where the scene has them now.
  void follow(const CompiledScene& scene);

  /// Sets the members of a kernel's PathScene as its arguments from `index` on; returns the index after them.
  cl_uint setArguments(cl::Kernel& kernel, cl_uint index) const;

 private:
  const Tracer* tracer_;
  bool layerTextures_;
  Buffer<float> vertices_;
  Buffer<std::uint8_t> flat_;
  Buffer<glm::vec2> texCoords_;
  Buffer<device::DeviceMaterial> bases_, layers_;
  Buffer<device::ShadeMaterial> materials_;
  Buffer<glm::u16vec4> layerTexels_;
};

}  // namespace prelight
