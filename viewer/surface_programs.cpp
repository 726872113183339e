#include "viewer/surface_programs.h"

#include <array>

#include "encodings/encoding.h"
#include "viewer/drawn_transfer.h"
#include "viewer/uniform_blocks.h"

namespace prelight::viewer {
namespace {

void prepare(const gl::Program& program) {
  program.bindBlock("Frame", frameBinding);
  program.bindBlock("Lights", lightBinding);
  program.bindBlock("ShadowLights", shadowBinding);
  program.use();
  constexpr std::array<std::pair<const char*, Unit>, 42> samplers = {
      {{"baseColorTexture", baseColorUnit},
       {"metallicRoughnessTexture", metallicRoughnessUnit},
       {"emissiveTexture", emissiveUnit},
       {"triangleNormals", triangleNormalsUnit},
       {"skyMap", skyUnit},
       {"triangleCorners", trianglesUnit},
       {"cornerPositions", positionsUnit},
       {"arriving", arrivingUnit},
       {"lobes", lobesUnit},
       {"lightMaps", lightMapsUnit},
       {"lightMapCorners", lightMapCornersUnit},
       {"caustics", causticsUnit},
       {"shadowMaps", shadowMapsUnit},
       {"shadowViews", shadowViewsUnit},
       {"surroundings", surroundingsUnit},
       {"insides", insidesUnit},
       {"normalTexture", normalTextureUnit},
       {"encodedVertices", encodedVerticesUnit},
       {"transmissionTexture", transmissionUnit},
       {"specularTexture", specularUnit},
       {"specularColorTexture", specularColorUnit},
       {"cornerTangents", cornerTangentsUnit},
       {"albedos", albedosUnit},
       {"coatTexture", coatUnit},
       {"coatRoughnessTexture", coatRoughnessUnit},
       {"coatNormalTexture", coatNormalUnit},
       {"sheenColorTexture", sheenColorUnit},
       {"sheenRoughnessTexture", sheenRoughnessUnit},
       {"anisotropyTexture", anisotropyUnit},
       {"filmTexture", filmUnit},
       {"filmThicknessTexture", filmThicknessUnit},
       {"lampTables", lampTablesUnit},
       {"screenInput", screenInputUnit},
       {"screenLamps", screenLampsUnit},
       {"screenBounce", screenBounceUnit},
       {"virtualLights", virtualLightsUnit},
       {"virtualMaps", virtualMapsUnit},
       {"virtualViews", virtualViewsUnit},
       {"horizonBands", horizonsUnit},
       {"objectLight", objectLightUnit},
       {"measuredLobes", measuredLobesUnit},
       {"lightMapWalls", lightMapWallsUnit}}};
  for (const auto& [name, unit] : samplers) program.set(name, static_cast<int>(unit));
}

}  // namespace

const gl::Program& SurfacePrograms::of(const std::string& vertexFile, const std::string& fragmentFile,
                                       const ShaderVariant& variant) {
  const auto found = programs_.find({fragmentFile, variant});
  if (found != programs_.end()) return found->second;
  std::map<std::string, std::string> texts = {{"variant.glsl", textOf(variant)}};
  const Ambient ambient = variant.rules.ambient;
  if (encoding_ != nullptr && (ambient == Ambient::EncodedMap || ambient == Ambient::EncodedVertices))
    texts["encoding.glsl"] = std::string(encoding_->shader);
  gl::Program program(vertexFile, fragmentFile, texts);
  prepare(program);
  return programs_.emplace(std::pair(fragmentFile, variant), std::move(program)).first->second;
}

}  // namespace prelight::viewer
