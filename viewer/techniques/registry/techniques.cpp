#include "viewer/techniques/registry/techniques.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <vector>

#include "prelight/error.h"
#include "techniques/registry/registry.h"
#include "viewer/programs/drawn_transfer.h"
#include "viewer/techniques/encoded_light/encoded_lighting.h"

namespace prelight::viewer {

/// Rows in the folders of techniques.
extern const DrawnShading drawnAo, drawnCh, drawnCones, drawnFull, drawnGlossy, drawnHaar, drawnHorizons,
    drawnInstant, drawnLightMap, drawnLights, drawnPhong, drawnRadiosity, drawnScreen, drawnSh, drawnVo;
extern const PassRow causticRow, localReflectionsRow, nearLampRow, objectCubesRow, openSkyRow, screenRow,
    shadowMapRow, surroundingsRow;

namespace {

/// Numbers of a bake that shaders read as they are, whatever the light.
class VertexNumbers final : public DrawnTransfer {
 public:
  explicit VertexNumbers(const std::vector<glm::vec3>& numbers)
      : numbers_(Attribute::Radiance, std::span<const glm::vec3>(numbers)) {}

  void light(const Illumination&) override {}
  void bind(const gl::Program&) const override { numbers_.attach(); }
  void describe(const Illumination&, Warnings&) const override {}

 private:
  VertexStream numbers_;  ///< [vertex]
};

bool isAmong(std::span<const DrawnShading> rows, const ShadingInfo& info) {
  return std::ranges::find(rows, &info, &DrawnShading::info) != rows.end();
}

/// Returns all shadings, those that show most first: a file's best shading is the first that its bake
/// carries. Shadings of techniques without a row in OpenGL come behind those that have one.
std::vector<DrawnShading> allShadings() {
  std::vector<DrawnShading> rows = {drawnSh,       drawnCh,       drawnGlossy,    drawnHaar,
                                    drawnLights,   drawnLightMap, drawnRadiosity, drawnVo,
                                    drawnHorizons, drawnCones,    drawnAo};
  for (const Technique& technique : techniques())
    if (technique.shading != nullptr && !isAmong(rows, *technique.shading))
      rows.push_back({.info = technique.shading});
  for (const DrawnShading& unbaked : {drawnPhong, drawnScreen, drawnFull, drawnInstant})
    rows.push_back(unbaked);
  assert(rows.size() == shadingCount);
  return rows;
}

const std::vector<DrawnShading>& drawnShadings() {
  static const std::vector<DrawnShading> rows = allShadings();
  return rows;
}

/// Lights are chosen first. Screen shading looks at surfaces as they are drawn with all the rest.
constexpr std::array<const PassRow*, 8> passes = {
    &shadowMapRow,        &nearLampRow,    &openSkyRow, &surroundingsRow,
    &localReflectionsRow, &objectCubesRow, &causticRow, &screenRow};

}  // namespace

std::span<const Shading> shadingsByPreference() {
  static const std::vector<Shading> shadings = [] {
    std::vector<Shading> result;
    for (const DrawnShading& drawn : drawnShadings()) result.push_back(drawn.info->shading);
    return result;
  }();
  return shadings;
}

std::span<const ShadingInfo> shadings() {
  static const std::vector<ShadingInfo> infos = [] {
    std::vector<ShadingInfo> result;
    for (const DrawnShading& drawn : drawnShadings()) result.push_back(*drawn.info);
    std::ranges::sort(result, {}, &ShadingInfo::shading);
    return result;
  }();
  return infos;
}

const DrawnShading& drawnShadingOf(Shading shading) {
  return *std::ranges::find(drawnShadings(), shading,
                            [](const DrawnShading& drawn) { return drawn.info->shading; });
}

bool offers(const RenderInputs& inputs, Shading shading) {
  const DrawnShading& drawn = drawnShadingOf(shading);
  if (drawn.offered != nullptr) return drawn.offered(inputs);
  return drawn.info->bakeOption.empty() || (inputs.bake != nullptr && drawn.info->carriedBy(*inputs.bake));
}

void requireOffered(const RenderInputs& inputs, Shading shading) {
  if (offers(inputs, shading)) return;
  const DrawnShading& drawn = drawnShadingOf(shading);
  const std::string what = "--shading " + std::string(drawn.info->name());
  if (drawn.offered != nullptr) throw Error(ExitCode::RuntimeFailure, what, drawn.missing, drawn.cure);
  throw Error(ExitCode::RuntimeFailure, what, "the bake does not carry what it needs",
              "bake with --" + std::string(drawn.info->bakeOption));
}

void checkInputs(const RenderInputs& inputs) {
  if (inputs.bake != nullptr) checkBake(*inputs.bake, inputs.compiled);
  for (const DrawnShading& drawn : drawnShadings())
    if (drawn.check != nullptr) drawn.check(inputs);
}

std::unique_ptr<DrawnTransfer> makeTransfer(Shading shading, const TechniqueInputs& of) {
  if (auto encoded = makeEncoded(shading, of)) return encoded;
  const DrawnShading& drawn = drawnShadingOf(shading);
  if (drawn.make != nullptr) return drawn.make(of);
  if (drawn.info->vertexNumbers == nullptr) return nullptr;
  return std::make_unique<VertexNumbers>(drawn.info->vertexNumbers(*of.inputs.bake, of.inputs.compiled));
}

std::span<const PassRow* const> passRows() { return passes; }

}  // namespace prelight::viewer
