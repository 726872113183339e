#include "gpu/transport_scene.h"

#include "gpu/surface_upload.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

void addMaterial(const CompiledMaterial& m, ShadeFeatures& f) {
  const bool specular = reflectsSpecularly(m);
  f.glass = f.glass || isGlass(m);
  f.panes = f.panes || isPane(m);
  f.layers = f.layers || hasLayers(m);
  f.film = f.film || hasFilm(m);
  f.filmGlass = f.filmGlass || (hasFilm(m) && isGlass(m));
  f.dispersion = f.dispersion || (isGlass(m) && m.dispersion > 0.0f);
  f.specularGlass = f.specularGlass || isSpecularGlass(m);
  f.anisotropic = f.anisotropic || isAnisotropic(m);
  f.measured = f.measured || hasMeasuredLobe(m);
  f.roughGlass = f.roughGlass || isRoughGlass(m);
  f.mirror = f.mirror || mayMirror(m);
  f.glossy = f.glossy || mayReflectRoughly(m);
  f.absorption =
      f.absorption || ((isGlass(m) || isTranslucent(m)) && m.solid && m.absorption != glm::vec3(0.0f));
  f.media = f.media || scattersWithin(m);
  f.bumps = f.bumps || m.normalTexture.image >= 0 || m.clearcoat.normalTexture.image >= 0;
  for (const TextureRef& texture : m.textures()) f.textures = f.textures || texture.image >= 0;
  f.translucent = f.translucent || isTranslucent(m);
  f.culled = f.culled || (!m.doubleSided && !m.solid);
  f.scatters = f.scatters || isTranslucent(m) || hasLayers(m) ||
               (!m.unlit && (m.baseColor != glm::vec3(0.0f) || specular || isGlass(m)));
}

}  // namespace

ShadeFeatures findShadeFeatures(const CompiledScene& scene, const LightTables& lights) {
  ShadeFeatures f;
  f.punctual = !lights.punctual.empty();
  f.profiles = !lights.profiles.empty();
  f.emitters = !lights.emitters.empty();
  f.emitterParts = !lights.emitterRoots.empty();
  f.sky = !lights.sky.empty();
  const std::vector<bool> used = usedMaterials(scene);
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) addMaterial(scene.materials[i], f);
  return f;
}

ShadeFeatures findPaneFeatures(const CompiledScene& scene) {
  ShadeFeatures f;
  const std::vector<bool> used = usedMaterials(scene);
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] && isPane(scene.materials[i])) addMaterial(scene.materials[i], f);
  return f;
}

BuildOptions& defineFeatures(const ShadeFeatures& f, BuildOptions& options) {
  return options.defineIf(f.punctual, "PRELIGHT_PUNCTUAL")
      .defineIf(f.profiles, "PRELIGHT_PROFILES")
      .defineIf(f.emitters, "PRELIGHT_EMITTERS")
      .defineIf(f.emitterParts, "PRELIGHT_EMITTER_PARTS")
      .defineIf(f.sky, "PRELIGHT_SKY")
      .defineIf(f.glass, "PRELIGHT_GLASS")
      .defineIf(f.panes, "PRELIGHT_PANES")
      .defineIf(f.roughGlass, "PRELIGHT_ROUGH_GLASS")
      .defineIf(f.layers, "PRELIGHT_LAYERS")
      .defineIf(f.film, "PRELIGHT_FILM")
      .defineIf(f.filmGlass, "PRELIGHT_FILM_GLASS")
      .defineIf(f.dispersion, "PRELIGHT_DISPERSION")
      .defineIf(f.specularGlass, "PRELIGHT_SPECULAR_GLASS")
      .defineIf(f.anisotropic, "PRELIGHT_ANISOTROPY")
      .defineIf(f.measured, "PRELIGHT_MEASURED")
      .defineIf(f.mirror, "PRELIGHT_MIRROR")
      .defineIf(f.glossy, "PRELIGHT_GLOSSY")
      .defineIf(f.absorption, "PRELIGHT_ABSORPTION")
      .defineIf(f.media, "PRELIGHT_MEDIA")
      .defineIf(f.textures, "PRELIGHT_TEXTURES")
      .defineIf(f.bumps, "PRELIGHT_BUMPS")
      .defineIf(f.translucent, "PRELIGHT_TRANSLUCENT");
}

TransportScene::TransportScene(const LitScene& lit, const Device& device, bool choosePunctual)
    : TransportScene(lit, std::make_unique<Tracer>(lit.scene, device), nullptr, choosePunctual) {}

TransportScene::TransportScene(const LitScene& lit, Tracer& tracer, bool choosePunctual)
    : TransportScene(lit, nullptr, &tracer, choosePunctual) {}

TransportScene::TransportScene(const LitScene& lit, std::unique_ptr<Tracer> own, Tracer* tracer,
                               bool choosePunctual)
    : ownTracer_(std::move(own)),
      tracer_(ownTracer_ ? ownTracer_.get() : tracer),
      sky_(lit.sky),
      skyRotation_(lit.skyRotation),
      choosePunctual_(choosePunctual),
      tables_(makeLightTables(lit.scene, lit.lights, lit.sky, choosePunctual)),
      features_(findShadeFeatures(lit.scene, tables_)),
      handle_(tracer_->scene()) {
  handle_.setShading(lit.scene, lit.images);
  handle_.setLights(tables_, skyRotation_);
  tracer_->sharePanes(handle_);
}

void TransportScene::follow(const CompiledScene& scene) {
  tracer_->follow(scene);
  handle_.follow(scene);
}

bool TransportScene::setLights(const CompiledScene& scene, const std::vector<Light>& lights) {
  tables_ = makeLightTables(scene, lights, sky_, choosePunctual_);
  handle_.setLights(tables_, skyRotation_);
  const std::string before = options().text();
  features_ = findShadeFeatures(scene, tables_);
  return options().text() != before;
}

void TransportScene::setSkyRotation(double angle) {
  skyRotation_ = angle;
  handle_.setSkyRotation(angle);
}

BuildOptions TransportScene::options() const {
  BuildOptions options = tracer_->surfaceOptions();
  return defineFeatures(features_, options);
}

}  // namespace prelight
