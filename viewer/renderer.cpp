#include "viewer/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "basis/sh.h"
#include "prelight/error.h"
#include "viewer/light_block.h"
#include "viewer/uniform_blocks.h"

namespace prelight::viewer {
namespace {

constexpr float skyDistance = 1e30f;  ///< m, as background.frag has it
constexpr int draftEmitterSamples = 4;
constexpr int ambientOrder = 3;
constexpr std::size_t sampleViewsAPicture = 40, facesAPicture = 2;  ///< of paced updates
constexpr int turnsInDrafts = 2;  ///< of pixels with samples of lights, as samples of a still picture do
constexpr int turnsInSurroundings =
    4;  ///< of samples of lights: environment maps show them smaller and blurred

/// Bands that the bake's transfer has at most.
int largestOrder(const Bake* bake) {
  int order = ambientOrder;
  if (bake == nullptr) return order;
  if (bake->sh) order = std::max(order, bake->sh->order);
  if (bake->compressedSh) order = std::max(order, bake->compressedSh->order);
  if (bake->chartTransfer) order = std::max(order, bake->chartTransfer->order);
  if (bake->ch) order = std::max(order, bake->ch->order);
  if (bake->glossy) order = std::max(order, bake->glossy->order);
  return order;
}

gl::Texture constantSky(float radiance) {
  const glm::vec3 texel(radiance);
  return gl::makeFloatTexture(1, 1, std::span(&texel, 1));
}

/// Clip space of a tile from that of its picture.
glm::dmat4 cropTo(const View& view, const Tile& tile, glm::dvec4& pictureFromTile) {
  const double scaleX = static_cast<double>(tile.width) / view.width;
  const double scaleY = static_cast<double>(tile.height) / view.height;
  const double centerX = (2.0 * tile.x + tile.width) / view.width - 1.0;
  const double centerY = 1.0 - (2.0 * tile.y + tile.height) / view.height;
  pictureFromTile = {scaleX, scaleY, centerX, centerY};
  glm::dmat4 crop(1.0);
  crop[0][0] = 1.0 / scaleX;
  crop[1][1] = 1.0 / scaleY;
  crop[3][0] = -centerX / scaleX;
  crop[3][1] = -centerY / scaleY;
  return crop;
}

void setCamera(const View& view, const Tile& tile, const CompiledScene& compiled, FrameBlock& frame) {
  const double aspect = static_cast<double>(view.width) / view.height;
  const CameraMatrices camera = cameraMatrices(view.camera, compiled, aspect);
  glm::dvec4 pictureFromTile(0.0);
  const glm::dmat4 crop = cropTo(view, tile, pictureFromTile);
  frame.clipFromScene = crop * camera.projection * camera.view;
  frame.eye = glm::vec4(glm::vec3(camera.position), camera.perspective ? 1.0f : 0.0f);
  frame.forward = glm::vec4(glm::vec3(camera.forward), 0.0f);
  frame.tile = pictureFromTile;
  const glm::dmat3 axes(glm::transpose(glm::dmat3(camera.view)));
  const double halfHeight = std::tan(0.5 * view.camera.yFov);
  frame.pixelRight = glm::vec4(glm::vec3(axes[0] * halfHeight * aspect), 0.0f);
  frame.pixelUp = glm::vec4(glm::vec3(axes[1] * halfHeight), 0.0f);
}

void setSky(const View& view, const SkyCoefficients& sky, int skyWidth, FrameBlock& frame) {
  frame.skyFromWorld = glm::mat4(glm::dmat4(glm::transpose(skyTurn(view.skyRotation))));
  const auto coefficients = sky.turned(view.skyRotation, ambientOrder);
  for (int l = 0; l < ambientOrder; ++l) {
    const double cosine = sh::clampedCosine(l);
    for (int i = l * l; i < (l + 1) * (l + 1); ++i)
      frame.ambient[i] = glm::vec4(cosine * coefficients[i], 0.0);
  }
  const double texel = 2.0 * std::numbers::pi / skyWidth;
  const double pixel = view.camera.perspective ? 2.0 * std::tan(0.5 * view.camera.yFov) / view.height : texel;
  frame.skyLevels = glm::vec4(std::log2(texel), std::max(0.0, std::log2(pixel / texel)), 0.0, 0.0);
}

}  // namespace

Renderer::Renderer(const RenderInputs& inputs, Lobe lobe)
    : inputs_(inputs),
      compiled_(inputs.compiled),
      lobe_(lobe),
      scene_(inputs),
      neutralMap_(constantEnvironment(glm::vec3(1.0f))),
      neutralSky_(neutralMap_, 1),
      programs_(inputs.encoding),
      neutralSkyMap_(constantSky(1.0f)),
      blackSkyMap_(constantSky(0.0f)) {
  if (inputs.bake != nullptr) checkBake(*inputs.bake, compiled_);
  if (inputs.environment != nullptr) {
    const Environment& sky = *inputs.environment;
    sky_ = SkyCoefficients(sky, largestOrder(inputs.bake));
    skyMap_ = gl::makeFloatTexture(sky.width, sky.height, sky.radiance);
    skyWidth_ = sky.width;
  }
  sampleLamps();
  for (const Surface& surface : scene_.surfaces()) surfaceFeatures_.push_back(featuresOf(surface));
  if (inputs.globalIllumination != nullptr) checkGlobalIllumination(*inputs.globalIllumination, compiled_);
  if (inputs.caustics != nullptr) makeCaustics(*inputs.caustics);
  gl::check("preparing the renderer");
}

void Renderer::makeCaustics(const Caustics& caustics) {
  caustics_ = std::make_unique<CausticPass>(caustics, compiled_);
}

GlobalIlluminationLighting& Renderer::globalIllumination() {
  if (globalIllumination_ == nullptr) {
    globalIllumination_ =
        std::make_unique<GlobalIlluminationLighting>(*inputs_.globalIllumination, compiled_, scene_);
    paceUpdates(paced_);
    surroundings_ = std::make_unique<Surroundings>(scene_, compiled_);
    if (caustics_ == nullptr && !inputs_.globalIllumination->photons.empty())
      makeCaustics({inputs_.globalIllumination->photons, inputs_.globalIllumination->caustics.filter});
  }
  return *globalIllumination_;
}

/// Drafts have fewer samples, but not fewer than there are triangles to tell apart.
void Renderer::sampleLamps() {
  emitters_ = sampleEmitters(compiled_, emitterSamples);
  const auto triangles = std::count_if(compiled_.triangleMaterials.begin(), compiled_.triangleMaterials.end(),
                                       [&](std::uint32_t material) {
                                         const glm::vec3& emission = compiled_.materials[material].emission;
                                         return std::max({emission.r, emission.g, emission.b}) > 0.0f;
                                       });
  const auto fewer = std::clamp<std::ptrdiff_t>(triangles, draftEmitterSamples, emitterSamples);
  draftEmitters_ = sampleEmitters(compiled_, static_cast<int>(fewer));
}

/// Those that shaders have to look at: not what the transfer holds where nothing else reflects it.
std::vector<ShadedLight> Renderer::shownLights(const View& view, const Illumination& light) const {
  std::vector<ShadedLight> lights = light.lights;
  if (view.shading == Shading::GlobalIllumination) return lights;
  if (view.draft && view.emitters) {
    std::erase_if(lights, [](const ShadedLight& source) { return source.isSample; });
    lights.insert(lights.end(), draftEmitters_.begin(), draftEmitters_.end());
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
  variant.interreflection = view.aoCorrection == AoCorrection::Interreflection;
  if (!specialised_) {
    variant.features = Features::all();
    return variant;
  }
  Features& features = variant.features;
  features.add(Feature::VertexColors, compiled_.hasVertexColors());
  features.add(Feature::Charts, inputs_.bake != nullptr && inputs_.bake->chartTransfer);
  features.add(Feature::Caustics, showsCaustics(view));
  const Environment* sky = inputs_.environment;
  features.add(Feature::SkyMap, sky != nullptr && (sky->width > 1 || sky->height > 1));
  for (const ShadedLight& light : lights) {
    features.add(Feature::DirectionalLights, light.kind == LightKind::Directional);
    features.add(Feature::PointLights, light.kind == LightKind::Point || light.kind == LightKind::Spot);
    features.add(Feature::SpotLights, light.kind == LightKind::Spot);
    features.add(Feature::EmitterLights, light.kind == LightKind::Emitter);
  }
  return variant;
}

void Renderer::updateIndirect(std::span<const float> values) {
  globalIllumination().updateIndirect(values);
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

void Renderer::paceUpdates(bool pace) {
  paced_ = pace;
  if (globalIllumination_ != nullptr)
    globalIllumination_->setMostSampleViews(pace ? sampleViewsAPicture : ShadowMaps::everything);
}

bool Renderer::isBehind() const {
  return globalIllumination_ != nullptr &&
         (globalIllumination_->shadows().isBehind() || surroundings_->isBehind());
}

void Renderer::sceneMoved() {
  scene_.fillPositions(compiled_);
  sampleLamps();
  if (samples_ != nullptr) samples_->setScene(compiled_);
  for (Drawn& drawn : drawn_)
    if (drawn.transfer != nullptr && drawn.transfer->verticesMoved()) drawn.isStale = true;
  if (globalIllumination_ == nullptr) return;
  globalIllumination_->sceneMoved();
  surroundings_->changed();
}

void Renderer::updateSurroundings(const View& view, const Illumination& light) {
  if (surroundings_->empty()) return;
  if (surroundedBy_ != light) surroundings_->changed();
  surroundedBy_ = light;
  const std::size_t most = paced_ ? facesAPicture : static_cast<std::size_t>(-1);
  surroundings_->update(compiled_, most, [&](const Surroundings::Face& face, const gl::Framebuffer& target) {
    View seen = view;
    seen.camera = face.camera;
    seen.width = seen.height = Surroundings::side;
    drawScene(seen, {0, 0, seen.width, seen.height}, target, light, globalIllumination_.get(), face.node);
  });
}

bool Renderer::showsCaustics(const View& view) const {
  return caustics_ != nullptr && (inputs_.caustics != nullptr || view.shading == Shading::GlobalIllumination);
}

bool Renderer::canShade(Shading shading) const {
  if (shading == Shading::GlobalIllumination) return inputs_.globalIllumination != nullptr;
  return shading == Shading::Phong || (inputs_.bake != nullptr && infoOf(shading).carriedBy(*inputs_.bake));
}

bool Renderer::usesNeutralSky(const View& view) const {
  return inputs_.environment == nullptr && view.lights.empty() && emitters_.empty();
}

const Environment* Renderer::skyOf(const View& view) const {
  return usesNeutralSky(view) ? &neutralMap_ : inputs_.environment;
}

Illumination Renderer::illuminationOf(const View& view) {
  Illumination light;
  light.skyRotation = view.skyRotation;
  light.lights = lightsOf(view);
  light.windowLights = view.windowLights;
  light.haarTerms = view.haarTerms;
  light.occluders = view.occluders;
  light.groupFactors = view.groupFactors;
  if (usesNeutralSky(view)) {
    light.sky = &neutralSky_;
    light.skyMap = &neutralMap_;
  } else {
    light.sky = inputs_.environment != nullptr ? &sky_ : &blackSky_;
    light.skyMap = inputs_.environment;
  }
  return light;
}

const DrawnTransfer* Renderer::litTransfer(const View& view, const Illumination& light) {
  if (!canShade(view.shading)) {
    const ShadingInfo& info = infoOf(view.shading);
    if (view.shading == Shading::GlobalIllumination)
      throw Error(ExitCode::RuntimeFailure, "--shading full", "its indirect light is not among the inputs",
                  "compute it with computeGlobalIllumination");
    throw Error(ExitCode::RuntimeFailure, "--shading " + std::string(info.name),
                "the bake does not carry what it needs", "bake with " + std::string(info.bakeOption));
  }
  if (view.shading == Shading::GlobalIllumination) {
    globalIllumination().light(light);
    return &globalIllumination();
  }
  Drawn& drawn = drawn_[static_cast<std::size_t>(view.shading)];
  if (!drawn.light) drawn.transfer = makeDrawnTransfer(view.shading, inputs_, lobe_);
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

std::vector<ShadedLight> Renderer::lightsOf(const View& view) {
  std::vector<ShadedLight> lights, samples;
  for (const Light& light : view.lights) lights.push_back(shadedLight(light, compiled_));
  if (view.shading == Shading::GlobalIllumination) {
    if (samples_ == nullptr) samples_ = std::make_unique<LightSamples>(compiled_);
    samples = samples_->of(view.emitters, skyOf(view), view.skyRotation);
  } else if (view.emitters) {
    samples = emitters_;
  }
  const std::size_t room = maxLights - samples.size();
  if (lights.size() > room) {
    const auto strength = [](const ShadedLight& l) { return l.intensity.r + l.intensity.g + l.intensity.b; };
    std::stable_sort(lights.begin(), lights.end(),
                     [&](const ShadedLight& a, const ShadedLight& b) { return strength(a) > strength(b); });
    lights.resize(room);
  }
  lights.insert(lights.end(), samples.begin(), samples.end());
  return lights;
}

void Renderer::uploadFrame(const View& view, const Tile& tile, const std::vector<ShadedLight>& lights,
                           int turns) const {
  FrameBlock frame{};
  const SkyCoefficients& sky = usesNeutralSky(view) ? neutralSky_ : sky_;
  setCamera(view, tile, compiled_, frame);
  setSky(view, sky, skyWidth_, frame);
  const auto single = std::count_if(lights.begin(), lights.end(), [](const auto& l) { return !l.isSample; });
  frame.counts = {static_cast<int>(lights.size()), static_cast<int>(single), turns, 0};
  frameBlock_.fill(GL_UNIFORM_BUFFER, std::span<const FrameBlock>(&frame, 1), GL_STREAM_DRAW);

  fillLightBlock(lightBlock_, lights);
  glBindBufferBase(GL_UNIFORM_BUFFER, frameBinding, frameBlock_.name());
  glBindBufferBase(GL_UNIFORM_BUFFER, lightBinding, lightBlock_.name());
}

void Renderer::bindTextures(const View& view) const {
  gl::bind(triangleNormalsUnit, GL_TEXTURE_BUFFER, scene_.triangleNormals());
  gl::bind(trianglesUnit, GL_TEXTURE_BUFFER, scene_.triangles());
  gl::bind(positionsUnit, GL_TEXTURE_BUFFER, scene_.positions());
  const gl::Texture& sky = inputs_.environment != nullptr ? skyMap_
                           : usesNeutralSky(view)         ? neutralSkyMap_
                                                          : blackSkyMap_;
  gl::bind(skyUnit, GL_TEXTURE_2D, sky);
}

/// `features`: of the program in use.
void Renderer::setSurface(const Surface& surface, Features features, const gl::Program& p) const {
  const Material& m = surface.material;
  const auto bindOrWhite = [&](Feature feature, GLuint unit, TextureHandle texture) {
    if (features.has(feature)) gl::bind(unit, GL_TEXTURE_2D, texture != nullptr ? *texture : scene_.white());
  };
  bindOrWhite(Feature::BaseColorTexture, baseColorUnit, surface.baseColor);
  bindOrWhite(Feature::MetallicRoughnessTexture, metallicRoughnessUnit, surface.metallicRoughness);
  bindOrWhite(Feature::EmissiveTexture, emissiveUnit, surface.emissive);
  bindOrWhite(Feature::NormalTexture, normalTextureUnit, surface.normal);
  p.set("normalScale", surface.normal != nullptr ? m.normalScale : 0.0f);
  // Fresnel at normal incidence; KHR_materials_ior: 0 means infinite.
  const float ratio = m.ior > 0.0f ? (m.ior - 1.0f) / (m.ior + 1.0f) : 1.0f;
  const float cutoff = m.alphaMode == AlphaMode::Mask ? m.alphaCutoff : -1.0f;
  p.set("baseColorFactor", m.baseColor);
  p.set("surfaceFactors", glm::vec4(m.metallic, m.roughness, m.transmission, cutoff));
  p.set("emissionFactor", m.emission);
  p.set("dielectricF0", glm::min(ratio * ratio * m.specularColor, glm::vec3(1.0f)));
  p.set("dielectricWeight", m.specular);
  p.set("alphaBlend", m.alphaMode == AlphaMode::Blend ? 1 : 0);
  p.set("unlit", m.unlit ? 1 : 0);
  p.set("glassIor", m.ior);
  p.set("solidGlass", m.thickness > 0.0f ? 1 : 0);
  p.set("absorption", surface.absorption);
  p.set("translucency", surface.translucency);
  p.set("showsSurroundings", surface.showsSurroundings ? 1 : 0);
  if (m.doubleSided) {
    glDisable(GL_CULL_FACE);
  } else {
    glEnable(GL_CULL_FACE);
  }
}

/// What attributes without an array are read as: a white colour, an open sky.
void Renderer::setDefaults() const {
  for (const Attribute attribute :
       {Attribute::Accessibility, Attribute::BentNormal, Attribute::Radiance, Attribute::Glow,
        Attribute::ChartCoord, Attribute::Reflected, Attribute::Highlight})
    glDisableVertexAttribArray(static_cast<GLuint>(attribute));
  glVertexAttrib4f(static_cast<GLuint>(Attribute::Color), 1.0f, 1.0f, 1.0f, 1.0f);
  glVertexAttrib1f(static_cast<GLuint>(Attribute::Accessibility), 1.0f);
  glVertexAttrib4f(static_cast<GLuint>(Attribute::BentNormal), 0.0f, 0.0f, 0.0f, 0.0f);
  glVertexAttrib3f(static_cast<GLuint>(Attribute::Radiance), 0.0f, 0.0f, 0.0f);
  glVertexAttrib3f(static_cast<GLuint>(Attribute::Glow), 1.0f, 1.0f, 1.0f);
  glVertexAttrib4f(static_cast<GLuint>(Attribute::ChartCoord), 0.0f, 0.0f, 0.0f, 0.0f);
  glVertexAttrib3f(static_cast<GLuint>(Attribute::Reflected), 0.0f, 0.0f, 0.0f);
  glVertexAttrib1f(static_cast<GLuint>(Attribute::Highlight), 1.0f);
  glVertexAttrib4f(static_cast<GLuint>(Attribute::Tangent), 0.0f, 0.0f, 0.0f, 0.0f);
}

void Renderer::drawBatches(const std::vector<const Batch*>& batches, const Look& look) {
  glBindVertexArray(scene_.vertexArray().name());
  setDefaults();
  const gl::Program* used = nullptr;
  for (const Batch* batch : batches) {
    ShaderVariant variant = look.variant;
    variant.features = variant.features | surfaceFeatures_[batch->surface];
    const gl::Program& program = programs_.of(look.shader, variant);
    if (used != &program) {
      program.use();
      program.set("causticCorner", look.causticCorner);
      if (look.transfer != nullptr) look.transfer->bind(program);
      used = &program;
    }
    setSurface(scene_.surfaces()[batch->surface], variant.features, program);
    if (look.showsSurroundings) surroundings_->set(program, *batch);
    program.set("firstTriangle", static_cast<int>(batch->firstTriangle));
    drawTriangles(*batch);
  }
  glBindVertexArray(0);
}

/// The colour of a sky that is alike everywhere; it is as far away as surroundings.glsl takes skies to be.
void Renderer::clearToSky(const View& view) const {
  const Environment* sky = skyOf(view);
  const glm::vec3 color = sky != nullptr ? sky->radiance.front() : glm::vec3(0.0f);
  glClearColor(color.r, color.g, color.b, skyDistance);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/// The sky behind what is opaque, where it is not what the picture was cleared to.
void Renderer::drawBackground(const ShaderVariant& variant) {
  glDisable(GL_CULL_FACE);
  ShaderVariant needed;
  needed.features.add(Feature::SkyMap, variant.features.has(Feature::SkyMap));
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
  const Camera& camera = view.camera;
  const double halfHeight = camera.perspective ? std::tan(0.5 * camera.yFov) : std::abs(camera.yMag);
  caustics_->draw(2.0 * halfHeight / view.height, scene_.triangleNormals());
  gl::bind(causticsUnit, GL_TEXTURE_2D, caustics_->irradiance());
  return {around, around, 0, samples};
}

void Renderer::draw(const View& view, const Tile& tile, const gl::Framebuffer& target) {
  const Illumination light = illuminationOf(view);
  const DrawnTransfer* transfer = litTransfer(view, light);
  const bool isFull = view.shading == Shading::GlobalIllumination;
  passed(isFull ? FramePass::ShadowMaps : FramePass::Transfer);
  if (isFull) {
    updateSurroundings(view, light);
    passed(FramePass::EnvironmentMaps);
  }
  drawScene(view, tile, target, light, transfer, -1);
}

void Renderer::drawScene(const View& view, const Tile& tile, const gl::Framebuffer& target,
                         const Illumination& light, const DrawnTransfer* transfer, int leftOutNode) {
  const bool isFull = view.shading == Shading::GlobalIllumination;
  const std::vector<ShadedLight> lights = shownLights(view, light);
  Look look{isFull ? "global_illumination.frag" : "surface.frag", variantOf(view, lights), transfer, isFull};
  std::vector<const Batch*> opaque;
  std::vector<const Batch*> blended;
  for (const Batch& batch : scene_.batches()) {
    if (leftOutNode >= 0 && batch.node == leftOutNode) continue;
    const Surface& surface = scene_.surfaces()[batch.surface];
    // Full shading draws what bodies of glass let through itself.
    const bool body = isFull && surface.isBody();
    (surface.isBlended() && !body ? blended : opaque).push_back(&batch);
  }
  const glm::dvec3 eye = glm::dvec3(view.camera.world[3]) - compiled_.origin;
  std::stable_sort(blended.begin(), blended.end(), [&](const Batch* a, const Batch* b) {
    return glm::distance(glm::dvec3(a->center), eye) > glm::distance(glm::dvec3(b->center), eye);
  });

  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  if (showsCaustics(view)) {
    look.causticCorner = drawCaustics(view, tile, target, opaque);
    if (leftOutNode < 0) passed(FramePass::Caustics);
  }
  const int samples = target.width() / tile.width;
  const int turns =
      leftOutNode >= 0 ? turnsInSurroundings : std::max(samples, view.draft ? turnsInDrafts : 1);
  uploadFrame(view, tile, lights, turns);
  bindTextures(view);
  if (isFull) surroundings_->bind();
  target.bind();
  clearToSky(view);
  drawBatches(opaque, look);

  glDepthMask(GL_FALSE);
  drawBackground(look.variant);
  if (leftOutNode < 0) passed(FramePass::Opaque);

  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ZERO, GL_ONE);
  look.causticCorner = glm::ivec4(0);  // those filtered lie on what is opaque
  drawBatches(blended, look);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  gl::check("drawing");
  if (leftOutNode < 0) passed(FramePass::Blended);
}

std::vector<PlannedPass> Renderer::plan(const View& view) {
  const Illumination light = illuminationOf(view);
  litTransfer(view, light);
  const std::size_t views = globalIllumination().shadows().viewCount(), nodes = surroundings_->nodeCount();
  return {{Pass::ShadowMaps, views > 0,
           views > 0 ? std::to_string(light.lights.size()) + " lights and samples of large ones see " +
                           std::to_string(views) + " views"
                     : "nothing gives light"},
          {Pass::EnvironmentMaps, nodes > 0,
           nodes > 0 ? std::to_string(nodes) + " nodes mirror what is around them or are glass"
                     : "no node is a mirror, glass, metal or nearly a mirror"}};
}

void Renderer::describe(const View& view, Warnings& notes) {
  if (usesNeutralSky(view)) {
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
  const bool inside = std::any_of(light.lights.begin(), light.lights.end(),
                                  [](const ShadedLight& source) { return !source.throughTransfer; });
  if (rules.through == Through::FarLights && inside) {
    notes.push_back("emissive surfaces and lights within the scene's bounds shine without shadows in " +
                    std::string(shadingName(view.shading)) +
                    " shading: the transfer cannot tell what is in front of them from what is behind "
                    "(--shading lights has their shadows)");
  }
  if (const DrawnTransfer* transfer = litTransfer(view, light)) transfer->describe(light, notes);
  if (view.shading == Shading::GlobalIllumination && surroundings_->nodesLeftOut() > 0)
    notes.push_back(std::to_string(surroundings_->nodesLeftOut()) +
                    " of the nodes that mirror or are glass are small and show the sky alone: the largest " +
                    std::to_string(Surroundings::mostNodes) + " have environment maps");
}

}  // namespace prelight::viewer
