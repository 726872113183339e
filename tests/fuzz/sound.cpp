#include "fuzz/sound.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/spans.h"
#include "fuzz/target.h"
#include "techniques/registry/registry.h"

namespace prelight::fuzz {

namespace {

bool areFinite(std::span<const float> numbers) {
  return std::ranges::all_of(numbers, [](float number) { return std::isfinite(number); });
}

template <glm::length_t length, typename Number>
bool isFinite(const glm::vec<length, Number>& vector) {
  for (glm::length_t i = 0; i < length; ++i)
    if (!std::isfinite(vector[i])) return false;
  return true;
}

void requireVertices(const CompiledScene& scene) {
  const std::size_t count = scene.vertexCount();
  require(scene.normals.size() == count, "arrays of vertices match");
  for (const std::size_t size :
       {scene.texCoords.size(), scene.texCoords1.size(), scene.tangents.size(), scene.colors.size()})
    require(size == 0 || size == count, "optional arrays of vertices match");
  require(areFinite(numbersOf(scene.positions)), "positions are finite");
  require(areFinite(numbersOf(scene.normals)), "normals are finite");
  require(areFinite(numbersOf(scene.texCoords)) && areFinite(numbersOf(scene.texCoords1)),
          "texture coordinates are finite");
  require(areFinite(numbersOf(scene.tangents)) && areFinite(numbersOf(scene.colors)),
          "tangents and colours are finite");
}

void requireTriangles(const CompiledScene& scene) {
  const std::size_t count = scene.triangleCount();
  require(scene.triangleMaterials.size() == count && scene.triangleFlat.size() == count,
          "arrays of triangles match");
  require(scene.triangleTurns.empty() || scene.triangleTurns.size() == count, "turns of triangles match");
  for (const glm::uvec3& triangle : scene.triangles)
    require(glm::max(glm::max(triangle.x, triangle.y), triangle.z) < scene.vertexCount(),
            "triangles name vertices that there are");
  for (const std::uint32_t material : scene.triangleMaterials)
    require(material < scene.materials.size(), "triangles name materials that there are");
}

void requireMaterial(const CompiledMaterial& material, std::size_t images) {
  for (const TextureRef& texture : material.textures())
    require(texture.image < 0 || static_cast<std::size_t>(texture.image) < images,
            "materials name images that there are");
  for (const glm::vec3& color : {material.albedo, material.emission, material.baseColor, material.absorption,
                                 material.specularColor, material.scattering})
    require(isFinite(color), "colours of materials are finite");
  require(areFinite(std::initializer_list<float>{material.metallic, material.roughness, material.transmission,
                                                 material.ior, material.specular, material.dispersion,
                                                 material.alphaCutoff, material.alphaFactor}),
          "factors of materials are finite");
}

void requireRanges(const CompiledScene& scene) {
  for (const PrimitiveRange& range : scene.primitives) {
    require(std::uint64_t{range.firstVertex} + range.vertexCount <= scene.vertexCount(),
            "primitives have vertices that there are");
    require(std::uint64_t{range.firstTriangle} + range.triangleCount <= scene.triangleCount(),
            "primitives have triangles that there are");
  }
  for (const CompiledInstance& instance : scene.instances)
    require(instance.shape < scene.shapes.size(), "instances name shapes that there are");
}

}  // namespace

void requireSound(const Scene& scene, const CompiledScene& compiled) {
  for (const Image& image : scene.images)
    if (!image.rgba.empty()) requireSound(image);
  requireVertices(compiled);
  requireTriangles(compiled);
  requireRanges(compiled);
  for (const CompiledMaterial& material : compiled.materials) requireMaterial(material, scene.images.size());
  for (const Light& light : compiled.lights) requireSound(light);
}

void requireSound(const Image& image) {
  require(image.width > 0 && image.height > 0, "images have texels");
  require(image.rgba.size() ==
              std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
          "images have as many texels as their size says");
}

void requireSound(const Bake& bake) {
  for (const BakedArray& array : arraysOf(bake))
    for (const std::span<const float> part : array.parts)
      require(areFinite(part), "baked numbers are finite");
}

void requireSound(const Environment& sky) {
  require(sky.radiance.size() == static_cast<std::size_t>(sky.width) * static_cast<std::size_t>(sky.height),
          "skies have as many texels as their size says");
  for (const float radiance : numbersOf(sky.radiance))
    require(std::isfinite(radiance) && radiance >= 0.0f, "radiance of skies is finite and not negative");
}

void requireSound(const Light& light) {
  require(isFinite(light.intensity) && isFinite(light.position) && isFinite(light.direction),
          "lights have finite intensities, places and directions");
  require(areFinite(std::initializer_list<float>{light.range, light.radius, light.innerConeAngle,
                                                 light.outerConeAngle}),
          "lights have finite ranges, radii and angles");
}

}  // namespace prelight::fuzz
