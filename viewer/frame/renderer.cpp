#include "viewer/frame/renderer.h"

#include <algorithm>
#include <string>

#include "prelight/error.h"
#include "viewer/frame/frame_block.h"
#include "viewer/lights/light_block.h"
#include "viewer/programs/sliced_drawing.h"

namespace prelight::viewer {
namespace {

constexpr float skyDistance = 1e30f;  ///< m, as background.frag has it
constexpr int turnsInDrafts = 2;      ///< of pixels with samples of lights, as samples of a still picture do

void nobody(const DrawnPass&) {}

bool showsAccessibility(const BatchLook& look) {
  return look.variant.showsParts && look.factors[accessibilityLayer] > 0.0f;
}

}  // namespace

Renderer::Renderer(const RenderInputs& inputs, Lobe lobe)
    : inputs_(inputs),
      compiled_(inputs.compiled),
      lobe_(lobe),
      scene_(inputs),
      lights_(compiled_),
      sky_(inputs, lights_.hasEmitters()),
      batches_(scene_, inputs.encoding),
      debug_(inputs_, scene_, batches_),
      passes_(passRows().size()) {
  checkInputs(inputs);
  gl::check("preparing the renderer");
}

/// Returns the passes of a shading's pictures, and makes those that no picture has had before.
Renderer::Passes Renderer::passesOf(Shading shading) {
  Passes passes;
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    const PassRow& row = *passRows()[i];
    if (!row.isIn(shading, inputs_)) continue;
    if (passes_[i] == nullptr) passes_[i] = row.make({inputs_, scene_, batches_, lobe_});
    passes.push_back(passes_[i].get());
  }
  return passes;
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
/// it besides, as layers do a sky's lamps with the sky.
std::vector<ShadedLight> Renderer::shownLights(const Drawing& drawing) const {
  const View& view = drawing.picture.view;
  const std::vector<ShadedLight>& all = drawing.picture.light.lights;
  std::vector<ShadedLight> lights = all;
  if (showsAllLight(view.shading)) return lights;
  if ((view.draft || drawing.isFace) && view.emitters) {
    lights_.thinOut(lights);
    for (const TechniquePass* pass : drawing.passes) pass->shadowSamples(all, lights);
  }
  const bool ownRules = std::ranges::any_of(drawing.passes, &TechniquePass::hasOwnRules);
  if (!specialised_ || ownRules) return lights;
  const DrawingRules rules = plainVariant(view).rules;
  const bool hasLayers = batches_.anySurfaceHas(Feature::Layer);
  Features known;
  for (const TechniquePass* pass : drawing.passes) pass->addFeatures(known);
  const bool allReflect =
      ((known.has(Feature::LocalReflections) || known.has(Feature::ShadowMaps)) && hasLayers) ||
      rules.reflection == Reflection::Everywhere || batches_.anySurfaceHas(Feature::Gloss) ||
      (rules.reflection == Reflection::Transfer && hasLayers);
  std::erase_if(lights, [&](const ShadedLight& source) {
    if (allReflect || (source.ofSky && hasLayers)) return false;
    return comesThrough(rules.through, source);
  });
  return lights;
}

/// Returns a view's variant without features.
ShaderVariant Renderer::plainVariant(const View& view) const {
  ShaderVariant variant;
  variant.rules = rulesOf(view.shading, inputs_);
  variant.aoCorrection = static_cast<int>(view.aoCorrection);
  variant.aoFilter = static_cast<int>(view.aoFilter);
  if (const auto vary = drawnShadingOf(view.shading).vary) vary(view, lobe_, variant);
  return variant;
}

/// Returns the variant for a view; the features of surfaces are added when they are drawn.
ShaderVariant Renderer::variantOf(const Drawing& drawing, std::span<const ShadedLight> lights) const {
  const View& view = drawing.picture.view;
  ShaderVariant variant = plainVariant(view);
  if (!specialised_) {
    variant.features = Features::all();
    for (const Feature ofPasses : {Feature::LocalReflections, Feature::ShadowMaps})
      variant.features.remove(ofPasses);
    for (const TechniquePass* pass : drawing.passes) pass->addFeatures(variant.features);
    return variant;
  }
  Features& features = variant.features;
  features.add(Feature::VertexColors, compiled_.hasVertexColors());
  const Bake* bake = bakeOf(view.shading, inputs_);
  features.add(Feature::Charts, bake != nullptr && bake->chartTransfer);
  features.add(Feature::SkyLight, sky_.seenBy(view).map != nullptr);
  features.add(Feature::SkyMap, sky_.isMap());
  for (const TechniquePass* pass : drawing.passes) pass->addFeatures(features);
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

void Renderer::update(Shading shading, const FoundLight& light) {
  debug_.changed();
  if (DrawnTransfer* transfer = drawnOf(shading).transfer.get()) transfer->takeLight(light);
  for (TechniquePass* pass : passesOf(shading)) pass->takeLight(light);
}

bool Renderer::isBehind() const {
  if (!shown_) return false;
  const auto& transfer = drawn_[static_cast<std::size_t>(*shown_)].transfer;
  if (transfer != nullptr && transfer->isBehind()) return true;
  for (std::size_t i = 0; i < passes_.size(); ++i)
    if (passes_[i] != nullptr && passRows()[i]->isIn(*shown_, inputs_) && passes_[i]->isBehind()) return true;
  return false;
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
  debug_.changed();
  for (Drawn& drawn : drawn_)
    if (drawn.transfer != nullptr && drawn.transfer->verticesMoved()) drawn.isStale = true;
  for (const auto& pass : passes_)
    if (pass != nullptr) pass->sceneMoved();
}

void Renderer::bakeChanged(Shading shading) {
  Drawn& drawn = drawn_[static_cast<std::size_t>(shading)];
  if (drawn.transfer == nullptr) return;
  const Bake* bake = bakeOf(shading, inputs_);
  if (bake == drawn.bake && bake == inputs_.bake) return;  // that one stays what it is
  for (const auto& pass : passes_)
    if (pass != nullptr && bake != nullptr) pass->takeBake(*bake);
  if (bake != nullptr && drawn.transfer->takeBake(*bake)) {
    drawn.bake = bake;
    drawn.isStale = true;
  } else {
    drawn = {};
  }
}

void Renderer::transferChanged(std::span<const VertexRange> ranges) {
  for (const ShadingInfo& info : shadings()) {
    Drawn& drawn = drawn_[static_cast<std::size_t>(info.shading)];
    if (drawn.transfer == nullptr || info.changingRows == nullptr) continue;
    const auto [numbers, width] = info.changingRows(*inputs_.bake);
    if (width == 0) continue;
    for (const VertexRange& range : ranges)
      if (drawn.transfer->replaceRows(range.firstVertex,
                                      numbers.subspan(range.firstVertex * width, range.vertexCount * width)))
        drawn.isStale = true;
  }
  for (const auto& pass : passes_)
    if (pass != nullptr) pass->takeLight({});
}

Illumination Renderer::illuminationOf(const View& view) {
  Illumination light;
  light.skyRotation = view.skyRotation;
  if (infoOf(view.shading).traits.skyLampsApart) sky_.takeLampsOut();
  const bool lobesTell = rulesOf(view.shading, inputs_).ambient.knowsLightAlone;
  if (lobesTell || batches_.anySurfaceHas(Feature::Gloss) || batches_.anySurfaceHas(Feature::Layer))
    sky_.makeLobes();
  light.lights = lights_.of(view, sky_.seenBy(view));
  updateLampTables();
  for (TechniquePass* pass : passesOf(view.shading)) pass->shadow(view, light.lights);
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
  requireOffered(inputs_, shading);
  Drawn& drawn = drawn_[static_cast<std::size_t>(shading)];
  if (drawn.isMade) return drawn;
  drawn.bake = bakeOf(shading, inputs_);
  const RenderInputs chosen = inputs_.with(drawn.bake);
  drawn.transfer = makeTransfer(shading, {chosen, scene_, batches_, lobe_});
  drawn.isMade = true;
  return drawn;
}

const DrawnTransfer* Renderer::litTransfer(const View& view, const Illumination& light,
                                           const FramePassObserver& passed) {
  Drawn& drawn = drawnOf(view.shading);
  if (drawn.transfer == nullptr) return nullptr;
  Illumination seen = light;
  if (drawn.transfer->dependsOnEye(light)) seen.eye = eyeOf(view);
  if (drawn.isStale || drawn.light != seen) {
    drawn.transfer->light(seen);
    drawn.light = seen;
    drawn.isStale = false;
  }
  drawn.transfer->prepare({view, light, drawn.transfer.get(), pace_, passed});
  return drawn.transfer.get();
}

OccluderEye Renderer::eyeOf(const View& view) const {
  const CameraMatrices camera =
      cameraMatrices(view.camera, compiled_, static_cast<double>(view.width) / view.height);
  if (camera.perspective) return {camera.position, true};
  return {-camera.forward, false};
}

FrameBlock Renderer::useFrame(const View& view, const Tile& tile, std::span<const ShadedLight> lights,
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
  if (sky_.lobes() != nullptr) gl::bind(skyLobesUnit, GL_TEXTURE_2D, *sky_.lobes());
}

/// The colour of a sky that is alike everywhere; it is as far away as surroundings.glsl takes skies to be.
void Renderer::clearToSky(const View& view, const BatchLook& look) const {
  const Environment* sky = sky_.seenBy(view).map;
  glm::vec3 color = sky != nullptr ? sky->radiance.front() : glm::vec3(0.0f);
  if (look.variant.showsParts)
    color = showsAccessibility(look) ? glm::vec3(1.0f) : factorOf(look.factors, PicturePart::Emitted) * color;
  glClearColor(color.r, color.g, color.b, skyDistance);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Renderer::draw(const View& view, const Tile& tile, const gl::Framebuffer& target,
                    const LayerRequest& layers) {
  drawView({view, tile, target, pace_, layers.drawn ? &layers : nullptr}).finish();
}

SlicedWork Renderer::drawSliced(View view, const gl::Framebuffer& target, double seconds,
                                std::function<void(const SampleRect&)> drawn) {
  PicturePace pace = pace_;
  pace.slice = seconds;
  SlicedWork work = drawView({view, {0, 0, view.width, view.height}, target, pace, nullptr, drawn});
  while (work.goOn()) co_await endOfSlice;
}

SlicedWork Renderer::drawView(TileRequest request) {
  const View& view = request.view;
  requireOffered(inputs_, view.shading);
  const FramePassObserver passed = observer_ ? observer_ : nobody;
  const Illumination light = illuminationOf(view);
  const DrawnTransfer* transfer = litTransfer(view, light, passed);
  if (!showsAllLight(view.shading)) passed({FramePass::Transfer});
  shown_ = view.shading;
  const Passes passes = passesOf(view.shading);
  const PictureState picture{view, light, transfer, request.pace, passed};
  for (TechniquePass* pass : passes) pass->prepare(picture, *this);
  while (request.pace.slice < PictureSlices::unbounded && isBehind()) {
    gl::Framebuffer::finish();
    co_await endOfSlice;
    if (DrawnTransfer* behind = drawnOf(view.shading).transfer.get()) behind->prepare(picture);
    for (TechniquePass* pass : passes) pass->prepare(picture, *this);
  }
  SlicedWork drawing =
      drawScene({.picture = picture, .passes = passes, .layers = request.layers, .drawn = request.drawn},
                request.tile, request.target);
  while (drawing.goOn()) co_await endOfSlice;
}

void Renderer::drawFace(const PictureState& picture, const SceneFace& face, const gl::Framebuffer& target) {
  View seen = picture.view;
  seen.camera = face.camera;
  seen.width = seen.height = face.side;
  seen.layers = wholePicture;
  seen.debug = {};
  PicturePace pace = picture.pace;
  pace.slice = PictureSlices::unbounded;
  const PictureState shown{seen, picture.light, picture.transfer, pace, nobody};
  const Passes passes = passesOf(seen.shading);
  drawScene({.picture = shown,
             .passes = passes,
             .isFace = true,
             .leftOut = face.leftOut,
             .withoutEmission = face.withoutEmission},
            {0, 0, face.side, face.side}, target)
      .finish();
}

TileLook Renderer::lookOf(const Drawing& drawing, std::span<const ShadedLight> lights) const {
  BatchLook look;
  look.shader = drawnShadingOf(drawing.picture.view.shading).shader;
  look.variant = variantOf(drawing, lights);
  look.factors = drawing.picture.view.layers;
  look.variant.showsParts = look.factors != wholePicture;
  if (drawing.picture.transfer != nullptr) look.inputs.push_back(drawing.picture.transfer);
  look.inputs.insert(look.inputs.end(), drawing.passes.begin(), drawing.passes.end());
  if (drawing.withoutEmission) {
    look.variant.features.remove(Feature::Emission);
    look.ofSurfaces.remove(Feature::Emission);
  }
  return {look, look};
}

DrawOrder Renderer::orderOf(const Drawing& drawing) const {
  const View& view = drawing.picture.view;
  const glm::dvec3 eye(glm::dvec3(view.camera.world[3]) - compiled_.origin);
  DrawOrder order = drawOrderOf(scene_, eye, showsAllLight(view.shading), drawing.leftOut);
  if (view.hidesProbes && inputs_.probes)
    std::erase_if(order.opaque, [&](const Batch* b) { return b->surface == inputs_.probes->surface; });
  return order;
}

/// Draws batches in their order; those that a pass lights have its rules.
void Renderer::drawBatches(const Passes& passes, const std::vector<const Batch*>& batches,
                           const BatchLook& look) {
  const auto ownerOf = [&](const Batch* batch) {
    const auto owner = std::ranges::find_if(passes, [&](const TechniquePass* p) { return p->isOwn(*batch); });
    return owner == passes.end() ? nullptr : *owner;
  };
  for (auto first = batches.begin(); first != batches.end();) {
    const TechniquePass* owner = ownerOf(*first);
    const auto end = std::find_if(first, batches.end(), [&](const Batch* b) { return ownerOf(b) != owner; });
    BatchLook own = look;
    if (owner != nullptr) own.variant.rules = owner->ownRules(look.variant.rules);
    batches_.draw({first, end}, own);
    first = end;
  }
}

SlicedWork Renderer::drawScene(Drawing drawing, Tile tile, const gl::Framebuffer& target) {
  const View& view = drawing.picture.view;
  const std::vector<ShadedLight> lights = shownLights(drawing);
  const DrawOrder order = orderOf(drawing);
  TileLook look = lookOf(drawing, lights);
  glDisable(GL_SCISSOR_TEST);
  for (TechniquePass* pass : drawing.passes) {
    useSurfaceState();
    SlicedWork ofPass = pass->drawTile({drawing.picture, tile, target, order.opaque, lights}, *this, look);
    while (ofPass.goOn()) co_await endOfSlice;
  }
  const int samples = target.width() / tile.width;
  const DrawnTransfer* transfer = drawing.picture.transfer;
  const int turns = !drawing.isFace       ? std::max(samples, view.draft ? turnsInDrafts : 1)
                    : transfer != nullptr ? transfer->turnsInFaces()
                                          : DrawnTransfer::usualTurnsInFaces;
  look.opaque.depthsFirst = drawsDepthsFirst(view.shading, lights.size());
  look.opaque.sharesPrograms = look.blended.sharesPrograms = showsAllLight(view.shading);
  const ShownTriangles shown(scene_.blocks(), tileFromScene(view, tile, compiled_));
  look.opaque.shown = look.blended.shown = &shown;
  const double slice = drawing.picture.pace.slice;
  SlicedWork surfaces = drawInSlices(target.width(), target.height(), slice, [&](const SampleRect& rect) {
    useSurfaceState();
    useFrame(view, tile, lights, turns);
    bindTextures(view);
    for (const TechniquePass* pass : drawing.passes) pass->bindTextures();
    target.bind();
    if (!debug_.replacesSurfaces(view)) drawOrdered(drawing, order, look, drawing.picture.passed);
    if (drawing.drawn) drawing.drawn(rect);
  });
  while (surfaces.goOn()) co_await endOfSlice;
  debug_.draw({view, tile, target, order, *this});
  if (drawing.drawn && view.debug.shown != DebugView::None)
    drawing.drawn({0, 0, target.width(), target.height()});
  if (drawing.layers != nullptr) drawLayers(drawing, order, std::move(look), target);
}

/// Tells of the picture, which the target holds, and of its layers.
void Renderer::drawLayers(const Drawing& drawing, const DrawOrder& order, TileLook look,
                          const gl::Framebuffer& target) {
  drawing.layers->drawn(nullptr);
  look.opaque.variant.showsParts = look.blended.variant.showsParts = true;
  for (const DrawnLayer& layer : drawing.layers->layers) {
    look.opaque.factors = look.blended.factors = alone(layer, drawing.picture.view.layers);
    target.bind();
    drawOrdered(drawing, order, look, nobody);
    drawing.layers->drawn(&layer);
  }
}

/// Draws into the target that is bound.
void Renderer::drawOrdered(const Drawing& drawing, const DrawOrder& order, const TileLook& look,
                           const FramePassObserver& passed) {
  const BatchLook& opaque = look.opaque;
  clearToSky(drawing.picture.view, opaque);
  if (opaque.depthsFirst) batches_.drawDepths(order.opaque, *opaque.shown);
  drawBatches(drawing.passes, order.opaque, opaque);

  glDepthMask(GL_FALSE);
  const float emitted = opaque.variant.showsParts ? factorOf(opaque.factors, PicturePart::Emitted) : 1.0f;
  if (!showsAccessibility(opaque) && emitted > 0.0f) batches_.drawBackground(opaque.variant, emitted);
  passed({FramePass::Opaque});

  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ZERO, GL_ONE);
  drawBatches(drawing.passes, order.blended, look.blended);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  gl::check("drawing");
  passed({FramePass::Blended});
}

std::vector<PlannedPass> Renderer::plan(const View& view) {
  const Illumination light = illuminationOf(view);
  std::vector<PlannedPass> plan;
  if (const DrawnTransfer* transfer = litTransfer(view, light, nobody)) transfer->addPlan(light, plan);
  for (const TechniquePass* pass : passesOf(view.shading)) pass->addPlan(plan);
  return plan;
}

void Renderer::describe(const View& view, Warnings& notes) {
  requireOffered(inputs_, view.shading);
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
  debug_.describe(view, notes);
  for (const PassRow* row : passRows())
    if (row->describeLack != nullptr) row->describeLack(view.shading, light, notes);
  if (const DrawnTransfer* transfer = litTransfer(view, light, nobody)) transfer->describe(light, notes);
  for (const TechniquePass* pass : passesOf(view.shading)) pass->describe(notes);
}

}  // namespace prelight::viewer
