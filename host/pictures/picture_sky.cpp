#include "pictures/picture_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/baked_file.h"
#include "pictures/named_sky.h"
#include "pictures/recorded_sky.h"
#include "scene/camera.h"
#include "scene/faint_glow.h"
#include "scene/inside_out.h"
#include "scene/light_sources.h"
#include "viewer/core/camera.h"

namespace prelight::pictures {
namespace {

/// Returns whether a camera stands within the scene's bounds. Such a camera shows the scene by its own light.
bool hasCameraWithin(const LoadedScene& loaded) {
  const glm::dvec3 least(loaded.compiled.boundsMin), most(loaded.compiled.boundsMax);
  return std::any_of(loaded.scene.cameras.begin(), loaded.scene.cameras.end(), [&](const Camera& camera) {
    const glm::dvec3 at(camera.world[3]);
    return glm::all(glm::lessThanEqual(least, at)) && glm::all(glm::lessThanEqual(at, most));
  });
}

/// Returns the camera that is asked for, or the one that the studio would choose.
Camera eyeOf(const LoadedScene& loaded, std::optional<int> camera) {
  return loaded.scene.cameras.empty() && !camera
             ? frameModel(loaded.compiled, viewer::defaultAspect)
             : viewer::chooseCamera(loaded.scene, loaded.compiled, camera);
}

}  // namespace

PictureSky choosePictureSky(DrawingSession& session, const std::filesystem::path& asked, bool lightsAsked,
                            bool lightBaked, const LoadedScene& loaded, std::optional<int> camera) {
  if (!asked.empty())
    return {session.measure("sky", [&] { return readNamedSky(asked); }), asked == studioName,
            asked.stem().string()};
  if (!lightsAsked)
    if (std::optional<PictureSky> baked = bakedSkyOf(session, loaded)) return *std::move(baked);
  if (loaded.sky) return {*loaded.sky, false};
  if (lightsAsked || lightBaked) return {};
  const bool shines = hasLights(loaded.compiled);
  const bool glows = shines && !hasCameraWithin(loaded) && onlyGlows(loaded.compiled, eyeOf(loaded, camera));
  if (shines && !glows) return {};
  session.note(fmt::format(
      "the scene has no light, {} and no sky: lit by the built-in studio (DrawRequest::skyName {} or a map "
      "chooses another sky, DrawRequest::lights none leaves the studio out)",
      glows ? "only a glow that leaves it dark" : "nothing emissive", neutralName));
  return {session.measure("sky", [] { return studioEnvironment(); }), true};
}

PictureSky skyOfPicture(DrawingSession& session, const PictureRequest& asked, bool lightBaked,
                        const LoadedScene& loaded) {
  if (asked.sky) return {*asked.sky, false};
  return choosePictureSky(session, asked.environment, asked.render.lights.has_value(), lightBaked, loaded,
                          asked.render.camera);
}

void frameScene(DrawingSession& session, bool studio, std::optional<int> width, int height,
                LoadedScene& loaded) {
  if (!loaded.scene.cameras.empty()) return;
  if (studio && !readRecordedChoice(*loaded.document).baked) {
    const std::vector<std::uint32_t> turned = insideOutPrimitives(loaded.scene, loaded.compiled);
    if (!turned.empty()) {
      session.warn(
          fmt::format("{}; turned for this picture", insideOutText(loaded.path, loaded.compiled, turned)));
      turnFaces(turned, loaded.scene, loaded.compiled);
    }
  }
  const double aspect = width ? static_cast<double>(*width) / height : viewer::defaultAspect;
  Camera& camera = loaded.scene.cameras.emplace_back(frameModel(loaded.compiled, aspect));
  camera.sceneNode = loaded.scene.nodes.size();
}

}  // namespace prelight::pictures
