#include "pictures/missing_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "library/save.h"
#include "pictures/drawn_encoding.h"
#include "refine/coarse_triangles.h"
#include "scene/deform.h"
#include "scene/lobes.h"
#include "techniques/registry/registry.h"
#include "viewer/core/shading.h"

namespace prelight::pictures {
namespace {

constexpr int shadingBounces = 1;

/// Returns the shadings whose data are missing. With `everyShading` these include ao and sh, and everything
/// else that is asked for.
std::vector<viewer::Shading> missingShadings(const BakeRequest& asked, const Bake& bake,
                                             viewer::Shading shading, bool everyShading) {
  std::vector<viewer::Shading> missing;
  for (const viewer::ShadingInfo& info : viewer::shadings()) {
    const bool usual = info.traits.bakedForWindows;
    const bool wanted = info.shading == shading || (everyShading && (usual || info.askedBy(asked)));
    if (wanted && !info.carriedBy(bake)) missing.push_back(info.shading);
  }
  return missing;
}

/// Whether transfer is baked for a scene that reflects a sky, whose reflections ambient occlusion shadows.
bool reflectsSkyPastTransfer(const std::vector<viewer::Shading>& missing, const ShadedScene& shaded) {
  return shaded.environment && std::ranges::any_of(shaded.loaded.compiled.materials, reflectsSpecularly) &&
         std::ranges::any_of(missing, [](viewer::Shading shading) {
           return viewer::infoOf(shading).rules.ambient.knowsLightAlone;
         });
}

/// Asks for what tells how open the sky is, which costs little where rays are cast anyway.
void askForOpenSky(const BakeRequest& asked, const Bake& bake, BakeRequest& request) {
  for (const viewer::ShadingInfo& info : viewer::shadings())
    if (info.traits.tellsOpenSky && !info.carriedBy(bake)) info.addTo(request, asked);
}

/// Returns the request for the data of shadings: as asked if they are asked for, else with defaults.
BakeRequest requestFor(const std::vector<viewer::Shading>& missing, const BakeRequest& asked,
                       const ShadedScene& shaded) {
  BakeRequest request = asked.withoutTechniques();
  bool light = false;
  bool lightAsked = false;
  for (const viewer::Shading shading : missing) {
    const viewer::ShadingInfo& info = viewer::infoOf(shading);
    info.addTo(request, asked);
    light = light || info.traits.bounces;
    lightAsked = lightAsked || (info.traits.bounces && info.askedBy(asked));
  }
  addParts(request, asked);
  if (request.castsReceivers() && reflectsSkyPastTransfer(missing, shaded))
    askForOpenSky(asked, shaded.bake, request);
  if (!light) {
    request.bounces = 0;
  } else if (!lightAsked && request.bounces == 0) {
    request.bounces = shadingBounces;
  }
  return request;
}

/// Bakes under the picture's lights, on which radiosity and light maps depend.
BakeRun bakeUnderLights(DrawingSession& session, const PictureRequest& asked, const DeviceOptions& device,
                        ShadedScene& shaded) {
  if (!shaded.request.radiosity && !shaded.request.lightMap)
    return session.bake(shaded.loaded, shaded.request, device);
  RadiosityRequest& shape = shaded.request.radiosity;
  if (shaded.environment) shape.environment = std::make_shared<const Environment>(*shaded.environment);
  shape.skyRotation = shaded.render.skyRotation;
  if (!asked.render.lights) return session.bake(shaded.loaded, shaded.request, device);
  std::vector<Light>& lights = shaded.loaded.compiled.lights;
  const std::vector<Light> own = std::exchange(lights, *asked.render.lights);
  BakeRun run = session.bake(shaded.loaded, shaded.request, device);
  lights = own;
  return run;
}

}  // namespace

void warnOfCoarseTriangles(DrawingSession& session, const PictureRequest& asked, const ShadedScene& shaded) {
  BakeRequest drawn;
  viewer::infoOf(shaded.render.shading).addTo(drawn, asked.bake.request);
  if (asked.bake.refine || !staysAtVertices(drawn, shaded.bake)) return;
  if (const auto warning = coarseWarning(shaded.loaded.path, shaded.loaded.compiled)) session.warn(*warning);
}

void refineAsAsked(DrawingSession& session, const PictureRequest& asked, const Bake& carried,
                   LoadedScene& loaded) {
  const bool baked = !carried.info.generator.empty();
  if (asked.bake.refine && baked)
    session.warn(
        "RefineRequest::error: ignored, because the file already holds a bake of its meshes (prelight bake "
        "refines and bakes them anew)");
  if (baked) return;
  if (asked.bake.refine)
    loaded = session.refine(std::move(loaded), asked.bake.refine, session.deviceOptions(asked.bake)).scene;
  loaded = session.withCharts(std::move(loaded), asked.bake.request);
}

void bakeMissing(DrawingSession& session, const PictureRequest& asked, bool everyShading,
                 ShadedScene& shaded) {
  const viewer::Shading shading = shaded.render.shading;
  const BakeRequest& request = asked.bake.request;
  if (viewer::showsAllLight(shading)) return;
  if (viewer::infoOf(shading).carriedBy(shaded.bake)) {
    if (asked.bake.techniqueGiven() && !viewer::infoOf(shading).bakeOption.empty())
      session.warn(fmt::format(
          "{}: ignored, because the file already holds what the shading needs (prelight bake bakes it anew)",
          techniqueText(request)));
    return;
  }
  requireTriangles(shaded.loaded);
  shaded.request = requestFor(missingShadings(request, shaded.bake, shading, everyShading), request, shaded);
  if (shaded.encoding != nullptr) askForEncoding(*shaded.encoding, request, shaded.request);
  session.note(
      fmt::format("{} carries no bake for DrawRequest::shading {}: baking {} now (prelight bake keeps it)",
                  asked.scene.string(), viewer::shadingName(shading), techniqueText(shaded.request)));
  const DeviceOptions device = session.deviceOptions(asked.bake);
  shaded.run = bakeUnderLights(session, asked, device, shaded);
  for (const std::string& warning : shaded.run->report.warnings) session.warn(warning);
  // Before what the file carries joins it, which stays as it is.
  if (asked.bake.compression.any())
    session.measure("compress", [&] {
      Bake& made = shaded.run->bake;
      std::vector<std::string> notes;
      const StoredForms forms = compressBake(asked.bake.compression, shaded.loaded.compiled, made, notes);
      decodeStored(*shaded.loaded.document, shaded.loaded.compiled, forms, made);
      for (const std::string& note : notes) session.note(note);
    });
  takeBake(shaded.bake, std::move(shaded.run->bake));
}

}  // namespace prelight::pictures
