#include "gpu/shaded_surface.h"

#include "gpu/surface_upload.h"

namespace prelight {

using namespace device;

ShadedSurface::ShadedSurface(const CompiledScene& scene, const std::vector<Image>& images,
                             const Tracer& tracer, bool layerTextures)
    : tracer_(&tracer), layerTextures_(layerTextures) {
  DeviceContext& device = tracer.context();
  const Layers layers = makeLayers(scene, images);
  vertices_ = Buffer<float>(device, std::span<const float>(interleaveVertices(scene)));
  flat_ = Buffer<std::uint8_t>(device, std::span<const std::uint8_t>(scene.triangleFlat));
  bases_ = Buffer<DeviceMaterial>(device, std::span<const DeviceMaterial>(makeBaseMaterials(scene)));
  materials_ = Buffer<ShadeMaterial>(device, std::span<const ShadeMaterial>(makeShadeMaterials(scene)));
  layers_ = Buffer<DeviceMaterial>(device, std::span<const DeviceMaterial>(layers.materials));
  layerTexels_ = Buffer<glm::u16vec4>(device, std::span<const glm::u16vec4>(layers.texels));
  if (layerTextures) texCoords_ = Buffer<glm::vec2>(device, std::span<const glm::vec2>(scene.texCoords));
}

void ShadedSurface::follow(const CompiledScene& scene) {
  vertices_.write(std::span<const float>(interleaveVertices(scene)));
}

cl_uint ShadedSurface::setArguments(cl::Kernel& kernel, cl_uint index) const {
  tracer_->setSurfaceArguments(kernel, index);
  kernel.setArg(index + 1, bases_.get());
  if (layerTextures_) kernel.setArg(index + 2, texCoords_.get());
  kernel.setArg(index + 5, vertices_.get());
  kernel.setArg(index + 6, flat_.get());
  kernel.setArg(index + 7, materials_.get());
  kernel.setArg(index + 8, layers_.get());
  kernel.setArg(index + 9, layerTexels_.get());
  return index + argumentCount;
}

}  // namespace prelight
