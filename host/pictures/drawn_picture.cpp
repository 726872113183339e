#include "pictures/drawn_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pictures/session/darkness.h"
#include "viewer/core/camera.h"

namespace prelight::pictures {

int samplesPerAxis(std::uint32_t samples) {
  return std::clamp(static_cast<int>(std::lround(std::sqrt(samples))), 1, 8);
}

DrawnPicture drawPicture(DrawingSession& session, ShadedScene shaded, bool layers) {
  session.progress().check();
  DrawnPicture drawn{std::move(shaded), {}, {}, {}};
  drawn.plan = drawn.shaded.plan();
  std::vector<PlannedPass> passes;
  session.measure("render", [&] {
    drawn.layered.picture = viewer::renderPicture(drawn.shaded.inputs(), drawn.shaded.render, drawn.notes,
                                                  &passes, layers ? &drawn.layered.layers : nullptr);
  });
  drawn.plan.insert(drawn.plan.end(), passes.begin(), passes.end());
  if (drawn.shaded.objects) drawn.plan.push_back(drawn.shaded.objects->plan());
  session.progress().check();
  return drawn;
}

void warnOfPicture(DrawingSession& session, const PictureRequest& asked, const DrawnPicture& drawn) {
  const ShadedScene& shaded = drawn.shaded;
  const std::optional<std::vector<Light>>& lights = asked.render.lights;
  if (!shaded.run || shaded.run->report.warnings.empty())
    warnOfDarkness(session, drawn.layered.picture, shaded.loaded,
                   viewer::chooseCamera(shaded.loaded.scene, shaded.loaded.compiled, shaded.render.camera),
                   {lights ? *lights : shaded.loaded.scene.lights,
                    shaded.environment ? &*shaded.environment : nullptr, shaded.shadowsLamps() && !lights});
  if (asked.bake.request.lightMap.denoise && !(shaded.run && shaded.request.lightMap))
    session.warn(
        "DrawRequest::denoise: ignored, because it applies only to light maps that are baked and to full "
        "shading that is traced");
}

}  // namespace prelight::pictures
