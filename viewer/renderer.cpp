#include "viewer/renderer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "prelight/error.h"
#include "viewer/draw_order.h"
#include "viewer/frame_block.h"
#include "viewer/light_block.h"
#include "viewer/screen/occlusion_band.h"
#include "viewer/surface_uniforms.h"

namespace prelight::viewer {
namespace {

constexpr float skyDistance = 1e30f;                                ///< m, as background.frag has it
constexpr std::size_t sampleViewsAPicture = 40, facesAPicture = 2;  ///< of paced updates
constexpr int turnsInDrafts = 2;  ///< of pixels with samples of lights, as samples of a still picture do
constexpr int turnsInSurroundings =
    4;  ///< of samples of lights: environment maps show them smaller and blurred

}  // namespace

Renderer::Renderer(const RenderInputs& inputs, Lobe lobe)
    : inputs_(inputs),
      compiled_(inputs.compiled),
      lobe_(lobe),
      scene_(inputs),
      lights_(compiled_),
      sky_(inputs, lights_.hasEmitters()),
      programs_(inputs.encoding) {
  if (inputs.bake != nullptr) checkBake(*inputs.bake, compiled_);
  if (inputs.bake != nullptr && inputs.bake->nearLamps)
    nearLamps_ = std::make_unique<NearLampPass>(*inputs.bake->nearLamps, compiled_);
  findFeatures();
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

/// Those that shaders have to look at: not what the transfer holds where nothing else reflects it.
std::vector<ShadedLight> Renderer::shownLights(const View& view, const Illumination& light) const {
  std::vector<ShadedLight> lights = light.lights;
  if (showsAllLight(view.shading)) return lights;
  if (view.draft && view.emitters) {
    lights_.thinOut(lights);
    NearLampPass::share(light.lights, lights);
  }
  if (!specialised_) return lights;
  const DrawingRules rules = rulesFor(view);
  const bool allReflect = rules.reflection == Reflection::Everywhere ||
                          (rules.reflection == Reflection::Metals && anySurfaceHas(Feature::Gloss));
  std::erase_if(lights, [&](const ShadedLight& source) {
    return !allReflect && (rules.through == Through::AllLights ||
                           (rules.through == Through::FarLights && source.throughTransfer));
  });
  return lights;
}

bool Renderer::anySurfaceHas(Feature feature) const {
  return std::any_of(surfaceFeatures_.begin(), surfaceFeatures_.end(),
                     [&](Features features) { return features.has(feature); });
}

DrawingRules Renderer::rulesFor(const View& view) const {
  DrawingRules rules = rulesOf(view.shading, inputs_);
  if (view.shading == Shading::Vo && view.occluders.allHighlights) rules.reflection = Reflection::Everywhere;
  return rules;
}

/// Of what surfaces do not decide.
ShaderVariant Renderer::variantOf(const View& view, std::span<const ShadedLight> lights) const {
  ShaderVariant variant;
  variant.rules = rulesFor(view);
  variant.aoCorrection = static_cast<int>(view.aoCorrection);
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
  return occlusionIsBehind_ || shadowsAre || (surroundings_ != nullptr && surroundings_->isBehind());
}

void Renderer::findFeatures() {
  surfaceFeatures_.clear();
  for (const Surface& surface : scene_.surfaces()) surfaceFeatures_.push_back(featuresOf(surface));
}

void Renderer::materialsChanged() {
  scene_.fillSurfaces(inputs_);
  findFeatures();
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
  if (disks_ != nullptr) disks_->sceneMoved();
  if (fields_ != nullptr) fields_->sceneMoved();
  occlusionMoved_ = true;
  if (globalIllumination_ != nullptr) globalIllumination_->sceneMoved();
  if (instant_ != nullptr) instant_->sceneMoved();
  if (surroundings_ != nullptr) surroundings_->moved();
}

/// What a shading is drawn from; near lamps and light maps of a bake are not of its other poses.
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
    drawScene(seen, {0, 0, seen.width, seen.height}, target, light, &lighting, face.node);
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
  light.lights = lights_.of(view, sky_.seenBy(view).map);
  updateLampTables();
  if (nearLampsOf(view.shading) != nullptr && rulesFor(view).through == Through::FarLights)
    NearLampPass::choose(light.lights, compiled_);
  light.windowLights = view.windowLights;
  light.haarTerms = view.haarTerms;
  light.occluders = view.occluders;
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
    throw Error(ExitCode::RuntimeFailure, "--shading " + std::string(info.name),
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

/// So that what is hidden is not shaded: of surfaces without holes.
void Renderer::drawDepths(const std::vector<const Batch*>& batches) {
  glBindVertexArray(scene_.vertexArray().name());
  programs_.depth().use();
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  for (const Batch* batch : batches) {
    const Surface& surface = scene_.surfaces()[batch->surface];
    if (surface.material.alphaMode == AlphaMode::Mask) continue;
    cullBacksOf(surface);
    drawTriangles(*batch);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBindVertexArray(0);
}

void Renderer::drawBatches(const std::vector<const Batch*>& batches, const Look& look) {
  glBindVertexArray(scene_.vertexArray().name());
  setAttributeDefaults();
  const gl::Program* used = nullptr;
  for (const Batch* batch : batches) {
    ShaderVariant variant = look.variant;
    variant.features = variant.features | surfaceFeatures_[batch->surface];
    const gl::Program& program = programs_.of(look.shader, variant);
    if (used != &program) {
      program.use();
      program.set("causticCorner", look.causticCorner);
      program.set("layer", look.layer);
      if (look.transfer != nullptr) look.transfer->bind(program);
      if (nearLamps_ != nullptr) nearLamps_->attach();
      used = &program;
    }
    setSurface(scene_.surfaces()[batch->surface], variant.features, scene_.white(), program);
    if (look.layer > 0) glDisable(GL_CULL_FACE);
    if (look.showsSurroundings) surroundings_->set(program, *batch);
    program.set("firstTriangle", static_cast<int>(batch->firstTriangle));
    drawTriangles(*batch);
  }
  glBindVertexArray(0);
}

/// The colour of a sky that is alike everywhere; it is as far away as surroundings.glsl takes skies to be.
void Renderer::clearToSky(const View& view) const {
  const Environment* sky = sky_.seenBy(view).map;
  const glm::vec3 color = sky != nullptr ? sky->radiance.front() : glm::vec3(0.0f);
  glClearColor(color.r, color.g, color.b, skyDistance);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/// The sky behind what is opaque, where it is not what the picture was cleared to.
void Renderer::drawBackground(const ShaderVariant& variant) {
  glDisable(GL_CULL_FACE);
  ShaderVariant needed;
  for (const Feature feature : {Feature::SkyLight, Feature::SkyMap})
    needed.features.add(feature, variant.features.has(feature));
  if (!needed.features.has(Feature::SkyMap)) return;
  programs_.background(needed).use();
  glBindVertexArray(noVertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

/// Filters the caustics of a tile and what lies around it, once a pixel: photons are too few for more.
glm::ivec4 Renderer::drawCaustics(const View& view, const Tile& tile, const gl::Framebuffer& target,
                                  const std::vector<const Batch*>& opaque) {
  const int samples = target.width() / tile.width;
  const int around = CausticPass::margin;
  const Tile whole{tile.x - around, tile.y - around, tile.width + 2 * around, tile.height + 2 * around};
  uploadFrame(view, whole, {}, samples);
  const gl::Framebuffer& places = caustics_->places(whole.width, whole.height);
  places.bind();
  glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  Look look;
  look.shader = "surface_places.frag";
  drawBatches(opaque, look);
  caustics_->draw(2.0 * halfHeightOf(view.camera) / view.height, scene_.triangleNormals());
  gl::bind(causticsUnit, GL_TEXTURE_2D, caustics_->irradiance());
  return {around, around, 0, samples};
}

/// What occludes, or sends light, in a picture and around it.
void Renderer::drawLayers(const std::vector<const Batch*>& opaque, const ScreenOcclusionOptions& options,
                          const OcclusionPicture& picture) {
  Look look;
  look.shader = "screen_surface.frag";
  for (look.layer = 0; look.layer < layersOf(options); ++look.layer) {
    if (look.layer > 0)
      gl::bind(screenInputUnit, GL_TEXTURE_2D, occlusion_->layer(look.layer - 1, picture).color());
    drawInto(occlusion_->layer(look.layer, picture), opaque, look);
  }
}

void Renderer::drawInto(const gl::Framebuffer& target, const std::vector<const Batch*>& batches,
                        const Look& look) {
  target.bind();
  glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  drawBatches(batches, look);
}

/// Makes ready what of the scene occludes, seen or not, where a method looks at that.
void Renderer::prepareSceneOcclusion(const ScreenOcclusionOptions& options, const OcclusionPicture& picture,
                                     const std::vector<const Batch*>& opaque) {
  if (options.method == OcclusionMethod::Disks) {
    if (disks_ == nullptr) disks_ = std::make_unique<DiskOcclusion>(compiled_);
    disks_->prepare(options, picture.radius, OcclusionPass::disksUnit);
  }
  if (options.method != OcclusionMethod::Fields) return;
  if (fields_ == nullptr) fields_ = std::make_unique<FieldOcclusion>(compiled_, inputs_.device);
  fields_->prepare(options, picture.radius);
  Look look;
  look.shader = "screen_owner.frag";
  look.transfer = fields_.get();
  drawInto(occlusion_->layer(1, picture), opaque, look);
  fields_->attach(OcclusionPass::fieldsUnit);
}

void Renderer::bindOcclusion(const gl::Framebuffer& found, const ScreenOcclusionOptions& options) {
  constexpr std::array<Unit, OcclusionPass::mostOutputs> units = {screenInputUnit, screenLampsUnit,
                                                                  screenBounceUnit};
  for (int i = 0; i < OcclusionPass::outputsOf(options); ++i)
    gl::bind(units[static_cast<std::size_t>(i)], GL_TEXTURE_2D, found.color(i));
}

/// What is found of the picture alone, or joined with pictures before it.
const gl::Framebuffer& Renderer::foundOcclusion(const OcclusionPicture& picture,
                                                const ScreenOcclusionOptions& options,
                                                const OcclusionLight& light, const FrameBlock& frame,
                                                bool goesOn) {
  if (options.frames <= 1) return occlusion_->draw(picture, options, light, 0);
  if (!goesOn) occlusionHistory_.drop();
  const gl::Framebuffer* joined = nullptr;
  for (int i = 0; i < (goesOn ? 1 : options.frames); ++i) {
    const gl::Framebuffer& found = occlusion_->draw(picture, options, light, occlusionHistory_.turn());
    joined = &occlusionHistory_.join(found, occlusion_->layer(0, picture), picture,
                                     {frame, options.frames, goesOn && occlusionMoved_});
  }
  occlusionIsBehind_ = goesOn && occlusionHistory_.stillPictures() < options.frames;
  occlusionMoved_ = false;
  return *joined;
}

/// Leaves what is found of every sample of the target bound.
void Renderer::drawScreenOcclusion(const View& view, const Tile& tile, const gl::Framebuffer& target,
                                   const std::vector<const Batch*>& opaque, const ScreenLook& shown) {
  if (occlusion_ == nullptr) occlusion_ = std::make_unique<OcclusionPass>();
  const int samples = target.width() / tile.width;
  const double radius = occlusionRadius(view.screenOcclusion, compiled_);
  const ScreenOcclusionOptions options = view.draft ? draftOf(view.screenOcclusion) : view.screenOcclusion;
  const int around =
      looksAround(options) ? occlusionMargin(view, samples, radius, compiled_) : OcclusionPass::filterReach;
  const Tile whole{tile.x - around, tile.y - around, tile.width + 2 * around, tile.height + 2 * around};
  const glm::ivec2 origin(tile.x * samples, (view.height - tile.y - tile.height) * samples);
  const OcclusionPicture picture{target.width(), target.height(), around * samples, origin, radius};
  const FrameBlock frame = uploadFrame(view, whole, shown.lights, samples);
  bindTextures(view);
  drawLayers(opaque, options, picture);
  prepareSceneOcclusion(options, picture, opaque);
  OcclusionLight light;
  if (options.method == OcclusionMethod::Ssdo) {
    for (const Feature feature : {Feature::SkyLight, Feature::SkyMap})
      light.sky.add(feature, shown.look.variant.features.has(feature));
    light.lamps = std::min(frame.counts.y, OcclusionPass::mostLamps);
    if (occlusionLight_ != shown.light) occlusionHistory_.drop();
    occlusionLight_ = shown.light;
  }
  if (gathers(options)) {
    bindOcclusion(occlusion_->drawSenders(picture, options, light), options);
    Look senders = shown.look;
    senders.variant.rules.ambient = Ambient::Sender;
    senders.causticCorner = glm::ivec4(0);
    drawInto(occlusion_->sent(picture), opaque, senders);
  }
  const bool isWhole = tile.width == view.width && tile.height == view.height;
  bindOcclusion(foundOcclusion(picture, options, light, frame, reusesOcclusion_ && isWhole), options);
}

void Renderer::draw(const View& view, const Tile& tile, const gl::Framebuffer& target) {
  const Illumination light = illuminationOf(view);
  const DrawnTransfer* transfer = litTransfer(view, light);
  if (nearLamps_ != nullptr) nearLamps_->run(light.lights);
  const bool isFull = showsAllLight(view.shading);
  passed(isFull ? FramePass::ShadowMaps : FramePass::Transfer);
  if (isFull) {
    updateSurroundings(view, light, shadowedLighting(view.shading));
    passed(FramePass::EnvironmentMaps);
  }
  drawScene(view, tile, target, light, transfer, -1);
}

void Renderer::drawScene(const View& view, const Tile& tile, const gl::Framebuffer& target,
                         const Illumination& light, const DrawnTransfer* transfer, int leftOutNode) {
  const bool isFull = showsAllLight(view.shading);
  const std::vector<ShadedLight> lights = shownLights(view, light);
  Look look{isFull ? "global_illumination.frag" : "surface.frag", variantOf(view, lights), transfer, isFull};
  const glm::dvec3 eye(glm::dvec3(view.camera.world[3]) - compiled_.origin);
  DrawOrder order = drawOrderOf(scene_, eye, isFull, leftOutNode);
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
    if (leftOutNode < 0) passed(FramePass::Caustics);
  }
  const bool findsOcclusion = look.variant.rules.ambient == Ambient::Screen;
  occlusionIsBehind_ = false;
  if (findsOcclusion) {
    drawScreenOcclusion(view, tile, target, order.opaque, {look, lights, light});
    if (view.screenOcclusion.method == OcclusionMethod::Ssdo)
      look.variant.rules.ambient =
          gathers(view.screenOcclusion) ? Ambient::ScreenBounce : Ambient::ScreenLight;
    if (leftOutNode < 0) passed(FramePass::ScreenOcclusion);
  }
  const int samples = target.width() / tile.width;
  const int turns =
      leftOutNode >= 0 ? turnsInSurroundings : std::max(samples, view.draft ? turnsInDrafts : 1);
  uploadFrame(view, tile, lights, turns);
  bindTextures(view);
  if (isFull) surroundings_->bind();
  target.bind();
  clearToSky(view);
  if (drawsDepthsFirst(view.shading, lights.size())) drawDepths(order.opaque);
  drawBatches(order.opaque, look);

  glDepthMask(GL_FALSE);
  drawBackground(look.variant);
  if (leftOutNode < 0) passed(FramePass::Opaque);

  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ZERO, GL_ONE);
  look.causticCorner = glm::ivec4(0);                              // those filtered lie on what is opaque
  if (findsOcclusion) look.variant.rules.ambient = Ambient::Open;  // so does the occlusion found
  drawBatches(order.blended, look);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  gl::check("drawing");
  if (leftOutNode < 0) passed(FramePass::Blended);
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
