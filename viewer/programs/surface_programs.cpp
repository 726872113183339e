#include "viewer/programs/surface_programs.h"

#include <array>

#include "base/text.h"
#include "encodings/encoding.h"
#include "viewer/core/uniform_blocks.h"
#include "viewer/gl/shader_sources.h"
#include "viewer/programs/texture_units.h"

namespace prelight::viewer {
namespace {

struct Sampler {
  Unit unit = baseColorUnit;
  const char* name = "";
};

constexpr std::array<Sampler, unitCount> samplers = {{
    {baseColorUnit, "baseColorTexture"},
    {metallicRoughnessUnit, "metallicRoughnessTexture"},
    {emissiveUnit, "emissiveTexture"},
    {triangleNormalsUnit, "triangleNormals"},
    {skyUnit, "skyMap"},
    {trianglesUnit, "triangleCorners"},
    {positionsUnit, "cornerPositions"},
    {arrivingUnit, "arriving"},
    {lobesUnit, "lobes"},
    {lightMapsUnit, "lightMaps"},
    {lightMapCornersUnit, "lightMapCorners"},
    {causticsUnit, "caustics"},
    {shadowMapsUnit, "shadowMaps"},
    {shadowViewsUnit, "shadowViews"},
    {surroundingsUnit, "surroundings"},
    {insidesUnit, "insides"},
    {reflectionsUnit, "reflections"},
    {normalTextureUnit, "normalTexture"},
    {encodedVerticesUnit, "encodedVertices"},
    {transmissionUnit, "transmissionTexture"},
    {specularUnit, "specularTexture"},
    {specularColorUnit, "specularColorTexture"},
    {cornerTangentsUnit, "cornerTangents"},
    {albedosUnit, "albedos"},
    {coatUnit, "coatTexture"},
    {coatRoughnessUnit, "coatRoughnessTexture"},
    {coatNormalUnit, "coatNormalTexture"},
    {sheenColorUnit, "sheenColorTexture"},
    {sheenRoughnessUnit, "sheenRoughnessTexture"},
    {anisotropyUnit, "anisotropyTexture"},
    {filmUnit, "filmTexture"},
    {filmThicknessUnit, "filmThicknessTexture"},
    {lampTablesUnit, "lampTables"},
    {screenInputUnit, "screenInput"},
    {screenLampsUnit, "screenLamps"},
    {screenBounceUnit, "screenBounce"},
    {virtualLightsUnit, "virtualLights"},
    {virtualMapsUnit, "virtualMaps"},
    {virtualViewsUnit, "virtualViews"},
    {horizonsUnit, "horizonBands"},
    {objectLightUnit, "objectLight"},
    {measuredLobesUnit, "measuredLobes"},
    {skyLobesUnit, "skyLobes"},
    {lightMapWallsUnit, "lightMapWalls"},
}};
static_assert(followsOrder(samplers, &Sampler::unit));

void prepare(const gl::Program& program) {
  program.bindBlock("Frame", frameBinding);
  program.bindBlock("Lights", lightBinding);
  program.bindBlock("ShadowLights", shadowBinding);
  program.use();
  for (const Sampler& sampler : samplers) program.set(sampler.name, static_cast<int>(sampler.unit));
}

}  // namespace

const gl::Program& SurfacePrograms::of(const std::string& vertexFile, const std::string& fragmentFile,
                                       const ShaderVariant& variant) {
  const auto found = programs_.find({fragmentFile, variant});
  if (found != programs_.end()) return found->second;
  std::map<std::string, std::string> texts = {
      {"variant.glsl", textOf(variant)},
      {"ambient.glsl", shaderSources().at(std::string(variant.rules.ambient.file))}};
  if (variant.features.has(Feature::LocalReflections))
    texts["around.glsl"] = shaderSources().at("local_reflections.glsl");
  if (variant.features.has(Feature::ShadowMaps))
    texts["lamp_maps.glsl"] = shaderSources().at("mapped_lamps.glsl");
  if (encoding_ != nullptr) texts["encoding.glsl"] = std::string(encoding_->shader);
  gl::Program program(vertexFile, fragmentFile, texts);
  prepare(program);
  return programs_.emplace(std::pair(fragmentFile, variant), std::move(program)).first->second;
}

}  // namespace prelight::viewer
