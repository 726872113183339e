#include "viewer/frame/renderer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "prelight/error.h"
#include "viewer/frame/frame_block.h"
#include "viewer/lights/light_block.h"
#include "viewer/programs/draw_order.h"

namespace prelight::viewer {
namespace {

constexpr float skyDistance = 1e30f;                                ///< m, as background.frag has it
constexpr std::size_t sampleViewsAPicture = 40, facesAPicture = 2;  ///< of paced updates
constexpr int turnsInDrafts = 2;  ///< of pixels with samples of lights, as samples of a still picture do

/// Side of the square of pixels that share samples of lights, in an environment map, which is shown smaller
/// and blurred. Virtual lights are too few and too different for it: glass shows which pixel had which.
constexpr int turnsInCube(Shading shading) { return shading == Shading::Instant ? 1 : 4; }

}  // namespace

Renderer::Renderer(const RenderInputs& inputs, Lobe lobe)
    : inputs_(inputs),
      compiled_(inputs.compiled),
      lobe_(lobe),
      scene_(inputs),
      lights_(compiled_),
      sky_(inputs, lights_.hasEmitters()),
      batches_(scene_, inputs.encoding) {
  if (inputs.bake != nullptr) checkBake(*inputs.bake, compiled_);
  if (inputs.bake != nullptr && inputs.bake->nearLamps)
    nearLamps_ = std::make_unique<NearLampPass>(*inputs.bake->nearLamps, compiled_);
  if (inputs.globalIllumination != nullptr) checkGlobalIllumination(*inputs.globalIllumination, compiled_);
  if (inputs.caustics != nullptr) makeCaustics(*inputs.caustics);
  gl::check("preparing the renderer");
}

void Renderer::makeCaustics(const Caustics& caustics) {
  caustics_ = std::make_unique<CausticPass>(caustics, compiled_);
}

void Renderer::makeSurroundings() {
  if (surroundings_ == nullptr) surroundings_ = std::make_unique<Surroundings>(scene_, compiled_);
}

InstantRadiosityLighting& Renderer::instantRadiosity() {
  if (instant_ == nullptr) {
    instant_ = std::make_unique<InstantRadiosityLighting>(*inputs_.virtualLights, compiled_, scene_);
    makeSurroundings();
  }
  return *instant_;
}

ShadowedLighting& Renderer::shadowedLighting(Shading shading) {
  if (shading == Shading::Instant) return instantRadiosity();
  return globalIllumination();
}

GlobalIlluminationLighting& Renderer::globalIllumination() {
  if (globalIllumination_ == nullptr) {
    globalIllumination_ =
        std::make_unique<GlobalIlluminationLighting>(*inputs_.globalIllumination, compiled_, scene_);
    makeSurroundings();
    if (caustics_ == nullptr && !inputs_.globalIllumination->photons.empty())
      makeCaustics({inputs_.globalIllumination->photons, inputs_.globalIllumination->caustics.filter});
  }
  return *globalIllumination_;
}

/// Passes that come before bindTextures() find them bound.
void Renderer::updateLampTables() {
  const LampTables& tables = lights_.tables();
  if (tables.texels().empty()) return;
  if (shownTables_ != tables.version())
    lampTables_ = gl::makeBufferTexture(tables.texels(), "profiles, cookies and shapes of lamps");
  shownTables_ = tables.version();
  gl::bind(lampTablesUnit, GL_TEXTURE_BUFFER, lampTables_->texture);
}

/// Returns the lights that shaders have to look at: none that the transfer holds, unless something reflects
/// it besides.
std::vector<ShadedLight> Renderer::shownLights(const View& view, const Illumination& light) const {
  std::vector<ShadedLight> lights = light.lights;
  if (showsAllLight(view.shading)) return lights;
  if (view.draft && view.emitters) {
    lights_.thinOut(lights);
    NearLampPass::share(light.lights, lights);
  }
  if (!specialised_ || lightsByCubes(view.shading, inputs_)) return lights;
  const DrawingRules rules = rulesFor(view);
  const bool allReflect = rules.reflection == Reflection::Everywhere ||
                          (rules.reflection == Reflection::Metals && batches_.anySurfaceHas(Feature::Gloss));
  std::erase_if(lights, [&](const ShadedLight& source) {
    return !allReflect && (rules.through == Through::AllLights ||
                           (rules.through == Through::FarLights && source.throughTransfer));
  });
  return lights;
}

DrawingRules Renderer::rulesFor(const View& view) const {
  DrawingRules rules = rulesOf(view.shading, inputs_);
  if (view.shading == Shading::Vo && view.occluders.allHighlights) rules.reflection = Reflection::Everywhere;
  return rules;
}

/// Returns the variant for a view; the features of surfaces are added when they are drawn.
ShaderVariant Renderer::variantOf(const View& view, std::span<const ShadedLight> lights) const {
  ShaderVariant variant;
  variant.rules = rulesFor(view);
  variant.aoCorrection = static_cast<int>(view.aoCorrection);
  variant.aoFilter = static_cast<int>(view.aoFilter);
  variant.phongLobe = view.shading == Shading::Phong && lobe_ == Lobe::Phong;
  if (!specialised_) {
    variant.features = Features::all();
    return variant;
  }
  Features& features = variant.features;
  features.add(Feature::VertexColors, compiled_.hasVertexColors());
  const Bake* bake = bakeOf(view.shading);
  features.add(Feature::Charts, bake != nullptr && bake->chartTransfer);
  features.add(Feature::Caustics, showsCaustics(view));
  features.add(Feature::SkyLight, sky_.seenBy(view).map != nullptr);
  features.add(Feature::SkyMap, sky_.isMap());
  variant.lights = fewLights(lights);
  for (const ShadedLight& light : lights) {
    features.add(Feature::DirectionalLights, light.kind == LightKind::Directional);
    features.add(Feature::PointLights, light.kind == LightKind::Point || light.kind == LightKind::Spot ||
                                           light.kind == LightKind::Profiled ||
                                           light.kind == LightKind::Cookie);
    features.add(Feature::SpotLights, light.kind == LightKind::Spot);
    features.add(Feature::ProfiledLights, light.kind == LightKind::Profiled);
    features.add(Feature::EmitterLights, light.kind == LightKind::Emitter);
    features.add(Feature::CookieLights, light.kind == LightKind::Cookie);
    features.add(Feature::AreaLights, light.kind == LightKind::Area);
    features.add(Feature::NearLamps, light.shadow >= 0);
  }
  return variant;
}

void Renderer::updateIndirect(std::span<const float> values) {
  globalIllumination().updateIndirect(values);
  surroundings_->changedSlowly();
}

void Renderer::updateVirtualLights(const VirtualLightSet& lights) {
  instantRadiosity().updateLights(lights);
  surroundings_->changedSlowly();
}

void Renderer::updateCaustics(const Caustics& caustics) {
  globalIllumination();
  surroundings_->changedSlowly();
  if (caustics_ == nullptr)
    makeCaustics(caustics);
  else
    caustics_->update(caustics, compiled_);
}

void Renderer::updateIrradiance(std::span<const glm::vec3> irradiance) {
  if (!canShade(Shading::Radiosity))
    throw Error(ExitCode::RuntimeFailure, "irradiance", "the bake has no radiosity that it could replace",
                "bake with --radiosity");
  if (irradiance.size() != compiled_.vertexCount())
    throw Error(ExitCode::RuntimeFailure, "irradiance",
                std::to_string(irradiance.size()) + " values; one for each of the scene's " +
                    std::to_string(compiled_.vertexCount()) + " vertices is needed");
  drawnOf(Shading::Radiosity).transfer->replaceIrradiance(irradiance);
}

bool Renderer::isBehind() const {
  const bool shadowsAre = (globalIllumination_ != nullptr && globalIllumination_->isBehind()) ||
                          (instant_ != nullptr && instant_->isBehind());
  return (screen_ != nullptr && screen_->isBehind()) || shadowsAre ||
         (surroundings_ != nullptr && surroundings_->isBehind()) || (cubes_ != nullptr && cubes_->isBehind());
}

void Renderer::materialsChanged() {
  scene_.fillSurfaces(inputs_);
  batches_.materialsChanged();
  for (Drawn& drawn : drawn_)
    if (drawn.transfer != nullptr && drawn.transfer->materialsChanged()) drawn.isStale = true;
}

void Renderer::sceneMoved(bool shapes) {
  if (shapes)
    scene_.fillVertices(compiled_);
  else
    scene_.fillPositions(compiled_);
  lights_.setScene(compiled_);
  for (Drawn& drawn : drawn_)
    if (drawn.transfer != nullptr && drawn.transfer->verticesMoved()) drawn.isStale = true;
  if (nearLamps_ != nullptr) nearLamps_->verticesMoved();
  if (screen_ != nullptr) screen_->sceneMoved();
  if (globalIllumination_ != nullptr) globalIllumination_->sceneMoved();
  if (instant_ != nullptr) instant_->sceneMoved();
  if (surroundings_ != nullptr) surroundings_->moved();
  if (cubes_ != nullptr) cubes_->moved(compiled_);
}

/// Returns the bake that a shading is drawn from. Near lamps and light maps belong to the bake's first pose
/// only.
const Bake* Renderer::bakeOf(Shading shading) const {
  const bool posed = inputs_.posed != nullptr && shading != Shading::Phong && !showsAllLight(shading) &&
                     infoOf(shading).carriedBy(*inputs_.posed);
  return posed ? inputs_.posed : inputs_.bake;
}

NearLampPass* Renderer::nearLampsOf(Shading shading) const {
  return bakeOf(shading) == inputs_.bake ? nearLamps_.get() : nullptr;
}

void Renderer::bakeChanged(Shading shading) {
  Drawn& drawn = drawn_[static_cast<std::size_t>(shading)];
  if (drawn.transfer == nullptr) return;
  const Bake* bake = bakeOf(shading);
  if (bake == drawn.bake && bake == inputs_.bake) return;  // that one stays what it is
  if (bake != nullptr && drawn.transfer->takeBake(*bake)) {
    drawn.bake = bake;
    drawn.isStale = true;
  } else {
    drawn = {};
  }
}

void Renderer::transferChanged(std::span<const VertexRange> ranges) {
  const auto replace = [&](Shading shading, const auto& transfer, std::size_t width) {
    Drawn& drawn = drawn_[static_cast<std::size_t>(shading)];
    if (drawn.transfer == nullptr || !transfer) return;
    const std::size_t length = width * static_cast<std::size_t>(transfer->channels);
    for (const VertexRange& range : ranges)
      if (drawn.transfer->replaceRows(range.firstVertex,
                                      std::span<const float>(transfer->coefficients)
                                          .subspan(range.firstVertex * length, range.vertexCount * length)))
        drawn.isStale = true;
  };
  const Bake& bake = *inputs_.bake;
  if (bake.sh) replace(Shading::Sh, bake.sh, static_cast<std::size_t>(bake.sh->order * bake.sh->order));
  if (bake.lightGroups) replace(Shading::Lights, bake.lightGroups, bake.lightGroups->groups.size());
  if (cubes_ != nullptr) cubes_->changedSlowly();
}

void Renderer::updateSurroundings(const View& view, const Illumination& light,
                                  const ShadowedLighting& lighting) {
  if (surroundings_->empty()) return;
  const bool coarse = lighting.shadows().areCoarse();
  if (surroundedBy_ != light || surroundedWith_ != &lighting || (surroundedCoarsely_ && !coarse))
    surroundings_->changed();
  surroundedBy_ = light;
  surroundedWith_ = &lighting;
  surroundedCoarsely_ = coarse;
  const std::size_t most = paced_ ? facesAPicture : static_cast<std::size_t>(-1);
  surroundings_->update(compiled_, most, [&](const Surroundings::Face& face, const gl::Framebuffer& target) {
    View seen = view;
    seen.camera = face.camera;
    seen.width = seen.height = Surroundings::side;
    drawScene({seen, light, &lighting, {face.node, {}}}, {0, 0, seen.width, seen.height}, target);
  });
}

void Renderer::updateObjectCubes(const View& view, const Illumination& light, const DrawnTransfer* transfer) {
  if (cubes_ == nullptr)
    cubes_ = std::make_unique<ObjectCubes>(compiled_, inputs_.cubeLit, inputs_.cubeOpenness);
  cubes_->lit(light, view.shading);
  const std::size_t most = paced_ ? facesAPicture : static_cast<std::size_t>(-1);
  cubes_->update(compiled_, most, [&](const ObjectCubes::Face& face, const gl::Framebuffer& target) {
    View seen = view;
    seen.camera = face.camera;
    seen.width = seen.height = ObjectCubes::side;
    const bool lampsApart = view.emitters || view.shading == Shading::Lights;
    drawScene({seen, light, transfer, {-1, face.leftOut}, lampsApart}, {0, 0, seen.width, seen.height},
              target);
  });
}

bool Renderer::showsCaustics(const View& view) const {
  return caustics_ != nullptr && !caustics_->empty() &&
         (inputs_.caustics != nullptr || view.shading == Shading::GlobalIllumination);
}

bool Renderer::canShade(Shading shading) const {
  if (shading == Shading::GlobalIllumination) return inputs_.globalIllumination != nullptr;
  if (shading == Shading::Instant) return inputs_.virtualLights != nullptr;
  const ShadingInfo& info = infoOf(shading);
  return info.bakeOption.empty() || (inputs_.bake != nullptr && info.carriedBy(*inputs_.bake));
}

Illumination Renderer::illuminationOf(const View& view) {
  Illumination light;
  light.skyRotation = view.skyRotation;
  if (showsSunAsLamp(view.shading)) sky_.takeSunOut();
  light.lights = lights_.of(view, sky_.seenBy(view));
  updateLampTables();
  if (nearLampsOf(view.shading) != nullptr && rulesFor(view).through == Through::FarLights)
    NearLampPass::choose(light.lights, compiled_);
  light.windowLights = view.windowLights;
  light.haarTerms = view.haarTerms;
  light.occluders = view.occluders;
  light.horizonSoftness = view.horizonSoftness;
  light.groupFactors = view.groupFactors;
  const SeenSky sky = sky_.seenBy(view);
  light.sky = sky.coefficients;
  light.skyMap = sky.map;
  return light;
}

Renderer::Drawn& Renderer::drawnOf(Shading shading) {
  Drawn& drawn = drawn_[static_cast<std::size_t>(shading)];
  if (drawn.isMade) return drawn;
  drawn.bake = bakeOf(shading);
  drawn.transfer = makeDrawnTransfer(shading, inputs_.with(drawn.bake), lobe_);
  drawn.isMade = true;
  return drawn;
}

const DrawnTransfer* Renderer::litTransfer(const View& view, const Illumination& light) {
  if (!canShade(view.shading)) {
    const ShadingInfo& info = infoOf(view.shading);
    if (view.shading == Shading::GlobalIllumination)
      throw Error(ExitCode::RuntimeFailure, "--shading full", "its indirect light is not among the inputs",
                  "compute it with computeGlobalIllumination");
    if (view.shading == Shading::Instant)
      throw Error(ExitCode::RuntimeFailure, "--shading instant",
                  "its virtual lights are not among the inputs", "make them with LiveVirtualLights");
    throw Error(ExitCode::RuntimeFailure, "--shading " + std::string(info.name()),
                "the bake does not carry what it needs", "bake with " + std::string(info.bakeOption));
  }
  if (showsAllLight(view.shading)) {
    ShadowedLighting& lighting = shadowedLighting(view.shading);
    lighting.setShadowEffort({paced_ ? sampleViewsAPicture : ShadowMaps::everything, view.draft});
    if (instant_ != nullptr) instant_->paceUpdates(paced_);
    lighting.light(light);
    return &lighting;
  }
  Drawn& drawn = drawnOf(view.shading);
  Illumination seen = light;
  if (drawn.transfer != nullptr && drawn.transfer->dependsOnEye(light)) seen.eye = eyeOf(view);
  if (drawn.isStale || drawn.light != seen) {
    if (drawn.transfer != nullptr) drawn.transfer->light(seen);
    drawn.light = seen;
    drawn.isStale = false;
  }
  return drawn.transfer.get();
}

OccluderEye Renderer::eyeOf(const View& view) const {
  const CameraMatrices camera =
      cameraMatrices(view.camera, compiled_, static_cast<double>(view.width) / view.height);
  if (camera.perspective) return {camera.position, true};
  return {-camera.forward, false};
}

FrameBlock Renderer::uploadFrame(const View& view, const Tile& tile, std::span<const ShadedLight> lights,
                                 int turns) const {
  const FrameBlock frame = frameBlockOf(view, tile, compiled_, sky_.seenBy(view), lights, turns);
  frameBlock_.fill(GL_UNIFORM_BUFFER, std::span<const FrameBlock>(&frame, 1), GL_STREAM_DRAW);
  fillLightBlock(lightBlock_, lights);
  glBindBufferBase(GL_UNIFORM_BUFFER, frameBinding, frameBlock_.name());
  glBindBufferBase(GL_UNIFORM_BUFFER, lightBinding, lightBlock_.name());
  return frame;
}

void Renderer::bindTextures(const View& view) const {
  gl::bind(triangleNormalsUnit, GL_TEXTURE_BUFFER, scene_.triangleNormals());
  gl::bind(trianglesUnit, GL_TEXTURE_BUFFER, scene_.triangles());
  gl::bind(cornerTangentsUnit, GL_TEXTURE_BUFFER, scene_.tangents());
  gl::bind(positionsUnit, GL_TEXTURE_BUFFER, scene_.positions());
  gl::bind(albedosUnit, GL_TEXTURE_BUFFER, scene_.albedos());
  if (lampTables_) gl::bind(lampTablesUnit, GL_TEXTURE_BUFFER, lampTables_->texture);
  gl::bind(skyUnit, GL_TEXTURE_2D, *sky_.seenBy(view).texture);
}

/// The colour of a sky that is alike everywhere; it is as far away as surroundings.glsl takes skies to be.
void Renderer::clearToSky(const View& view, const BatchLook& look) const {
  const Environment* sky = sky_.seenBy(view).map;
  glm::vec3 color = sky != nullptr ? sky->radiance.front() : glm::vec3(0.0f);
  if (look.variant.showsParts && look.shownLayer != static_cast<DrawnLayer>(PicturePart::Emitted))
    color = glm::vec3(look.shownLayer == accessibilityLayer ? 1.0f : 0.0f);
  glClearColor(color.r, color.g, color.b, skyDistance);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/// Filters the caustics of a tile and what lies around it, once a pixel: photons are too few for more.
glm::ivec4 Renderer::drawCaustics(const View& view, const Tile& tile, const gl::Framebuffer& target,
                                  const std::vector<const Batch*>& opaque) {
  const int samples = target.width() / tile.width;
  const int around = CausticPass::margin;
  const Tile whole{tile.x - around, tile.y - around, tile.width + 2 * around, tile.height + 2 * around};
  uploadFrame(view, whole, {}, samples);
  const gl::Framebuffer& places = caustics_->places(whole.width, whole.height);
  BatchLook look;
  look.shader = "surface_places.frag";
  batches_.drawInto(places, opaque, look);
  caustics_->draw(2.0 * halfHeightOf(view.camera) / view.height, scene_.triangleNormals());
  gl::bind(causticsUnit, GL_TEXTURE_2D, caustics_->irradiance());
  return {around, around, 0, samples};
}

/// Leaves what is found of every sample of the target bound.
void Renderer::drawScreenOcclusion(const View& view, const Tile& tile, const gl::Framebuffer& target,
                                   const std::vector<const Batch*>& opaque, const ShownLight& shown) {
  const ScreenTile part = screenTileOf(view, tile, target, compiled_);
  const FrameBlock frame = uploadFrame(view, part.whole, shown.lights, part.samples);
  bindTextures(view);
  if (screen_ == nullptr) screen_ = std::make_unique<ScreenShading>(compiled_, inputs_.device, batches_);
  screen_->draw(part, opaque, {frame, shown.look, shown.light}, reusesOcclusion_);
}

void Renderer::draw(const View& view, const Tile& tile, const gl::Framebuffer& target,
                    const LayerRequest& layers) {
  const Illumination light = illuminationOf(view);
  const DrawnTransfer* transfer = litTransfer(view, light);
  if (nearLamps_ != nullptr) nearLamps_->run(light.lights);
  const bool isFull = showsAllLight(view.shading);
  passed(isFull ? FramePass::ShadowMaps : FramePass::Transfer);
  const bool hasCubes = lightsByCubes(view.shading, inputs_);
  if (isFull) updateSurroundings(view, light, shadowedLighting(view.shading));
  if (hasCubes) updateObjectCubes(view, light, transfer);
  if (isFull || hasCubes) passed(FramePass::EnvironmentMaps);
  drawScene({view, light, transfer, {}, false, layers.drawn ? &layers : nullptr}, tile, target);
}

BatchLook Renderer::lookOf(const Drawing& drawing, std::span<const ShadedLight> lights) const {
  const bool isFull = showsAllLight(drawing.view.shading);
  BatchLook look{isFull ? "global_illumination.frag" : "surface.frag",
                 variantOf(drawing.view, lights),
                 {drawing.transfer, nearLamps_.get(), isFull ? surroundings_.get() : nullptr}};
  std::erase(look.inputs, nullptr);
  look.withoutEmission = drawing.withoutEmission;
  return look;
}

/// Returns the cube maps that light objects in a view, or nullptr.
const ObjectCubes* Renderer::cubesOf(const View& view) const {
  return lightsByCubes(view.shading, inputs_) ? cubes_.get() : nullptr;
}

/// Draws batches in their order; those of objects that cube maps light have rules of their own.
void Renderer::drawBatches(const View& view, const std::vector<const Batch*>& batches,
                           const BatchLook& look) {
  const ObjectCubes* cubes = cubesOf(view);
  if (cubes == nullptr) {
    batches_.draw(batches, look);
    return;
  }
  BatchLook objects = look;
  objects.inputs.push_back(cubes);
  objects.variant.rules = rulesOfObjects(look.variant.rules);
  for (auto first = batches.begin(); first != batches.end();) {
    const bool isObject = cubes->holds(**first);
    const auto end =
        std::find_if(first, batches.end(), [&](const Batch* b) { return cubes->holds(*b) != isObject; });
    batches_.draw({first, end}, isObject ? objects : look);
    first = end;
  }
}

void Renderer::drawScene(const Drawing& drawing, const Tile& tile, const gl::Framebuffer& target) {
  const View& view = drawing.view;
  const Illumination& light = drawing.light;
  const bool isFull = showsAllLight(view.shading), isCube = drawing.leftOut.any();
  const std::vector<ShadedLight> lights = shownLights(view, light);
  BatchLook look = lookOf(drawing, lights);
  const glm::dvec3 eye(glm::dvec3(view.camera.world[3]) - compiled_.origin);
  DrawOrder order = drawOrderOf(scene_, eye, isFull, drawing.leftOut);
  if (view.hidesProbes && inputs_.probes)
    std::erase_if(order.opaque, [&](const Batch* b) { return b->surface == inputs_.probes->surface; });
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  if (showsCaustics(view)) {
    look.causticCorner = drawCaustics(view, tile, target, order.opaque);
    if (!isCube) passed(FramePass::Caustics);
  }
  const bool findsOcclusion = look.variant.rules.ambient == Ambient::Screen;
  if (screen_ != nullptr) screen_->startPicture();
  if (findsOcclusion) {
    drawScreenOcclusion(view, tile, target, order.opaque, {look, lights, light});
    if (view.screenOcclusion.method == OcclusionMethod::Ssdo)
      look.variant.rules.ambient =
          gathers(view.screenOcclusion) ? Ambient::ScreenBounce : Ambient::ScreenLight;
    if (!isCube) passed(FramePass::ScreenOcclusion);
  }
  const int samples = target.width() / tile.width;
  const int turns = isCube ? turnsInCube(view.shading) : std::max(samples, view.draft ? turnsInDrafts : 1);
  uploadFrame(view, tile, lights, turns);
  bindTextures(view);
  if (isFull) surroundings_->bindTextures();
  if (const ObjectCubes* cubes = cubesOf(view)) cubes->bindTextures();
  target.bind();
  if (drawsDepthsFirst(view.shading, lights.size())) look.depthsFirst = true;
  drawOrdered(view, order, look, !isCube);
  if (drawing.layers == nullptr) return;
  drawing.layers->drawn(nullptr);
  look.variant.showsParts = true;
  for (const DrawnLayer& layer : drawing.layers->layers) {
    look.shownLayer = layer;
    target.bind();
    drawOrdered(view, order, look, false);
    drawing.layers->drawn(&layer);
  }
}

/// Into the target that is bound. `observed`: observePasses() tells of it.
void Renderer::drawOrdered(const View& view, const DrawOrder& order, BatchLook look, bool observed) {
  clearToSky(view, look);
  if (look.depthsFirst) batches_.drawDepths(order.opaque);
  drawBatches(view, order.opaque, look);

  glDepthMask(GL_FALSE);
  if (!look.variant.showsParts || look.shownLayer == static_cast<DrawnLayer>(PicturePart::Emitted))
    batches_.drawBackground(look.variant);
  if (observed) passed(FramePass::Opaque);

  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ZERO, GL_ONE);
  look.causticCorner = glm::ivec4(0);  // those filtered lie on what is opaque
  const Ambient ambient = look.variant.rules.ambient;
  const bool found =
      ambient == Ambient::Screen || ambient == Ambient::ScreenLight || ambient == Ambient::ScreenBounce;
  if (found) look.variant.rules.ambient = Ambient::Open;  // so does the occlusion found
  drawBatches(view, order.blended, look);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  gl::check("drawing");
  if (observed) passed(FramePass::Blended);
}

std::vector<PlannedPass> Renderer::plan(const View& view) {
  const Illumination light = illuminationOf(view);
  litTransfer(view, light);
  const std::size_t views = shadowedLighting(view.shading).shadows().viewCount(),
                    nodes = surroundings_->nodeCount();
  return {{Pass::ShadowMaps, views > 0,
           views > 0 ? std::to_string(light.lights.size()) + " lights and samples of large ones see " +
                           std::to_string(views) + " views"
                     : "nothing gives light"},
          {Pass::EnvironmentMaps, nodes > 0,
           nodes > 0 ? std::to_string(nodes) + " nodes mirror what is around them or are glass"
                     : "no node is a mirror, glass, metal or nearly a mirror"}};
}

void Renderer::describe(const View& view, Warnings& notes) {
  if (sky_.isNeutral(view)) {
    notes.emplace_back(
        "the scene has no light, nothing emissive and no sky: lit by a neutral sky of radiance 1");
  }
  const Illumination light = illuminationOf(view);
  const auto samples = std::count_if(light.lights.begin(), light.lights.end(),
                                     [](const ShadedLight& l) { return l.isSample; });
  const std::size_t room = maxLights - static_cast<std::size_t>(samples);
  if (view.lights.size() > room) {
    notes.push_back("the scene has " + std::to_string(view.lights.size()) + " lights: the strongest " +
                    std::to_string(room) + " are drawn");
  }
  const DrawingRules rules = rulesOf(view.shading, inputs_);
  const bool inside = std::any_of(light.lights.begin(), light.lights.end(), [](const ShadedLight& source) {
    return !source.throughTransfer && source.shadow < 0;
  });
  if (rules.through == Through::FarLights && inside) {
    notes.push_back("emissive surfaces and lights within the scene's bounds shine without shadows in " +
                    std::string(shadingName(view.shading)) +
                    " shading: the transfer cannot tell what is in front of them from what is behind "
                    "(--shading lights has their shadows, and bake --near-lamps gives some to " +
                    std::to_string(NearLampPass::mostLamps) + " lamps and parts of emissive surfaces here)");
  }
  if (const DrawnTransfer* transfer = litTransfer(view, light)) transfer->describe(light, notes);
  if (showsAllLight(view.shading) && surroundings_->nodesLeftOut() > 0)
    notes.push_back(std::to_string(surroundings_->nodesLeftOut()) +
                    " of the nodes that mirror or are glass are small and show the sky alone: the largest " +
                    std::to_string(Surroundings::mostNodes) + " have environment maps");
}

}  // namespace prelight::viewer
