#include "gather/light_map_sources.h"

#include "bake/schedule.h"

namespace prelight {

LightMapSources::LightMapSources(const CompiledScene& scene, const std::vector<Image>& images,
                                 const LightMapLayout& layout, const BakeRequest& request, const Plan& plan,
                                 int coefficients, const Device& device, Tracer& tracer, Progress& progress) {
  if (plan.runs("indirect light of the map") || plan.runs("caustics of the map"))
    light_.emplace(scene, images, layout, request, plan, device, tracer, progress);
  if (plan.runs("direct light of the map"))
    parts_.push_back(&direct_.emplace(scene, tracer, raysEach(request), request.seed, coefficients));
  else
    parts_.push_back(&inside_.emplace(scene, tracer, request.seed));
  const RadiosityRequest& lights = request.radiosityShape;
  if (lights.environment)
    parts_.push_back(&sky_.emplace(scene, tracer, *lights.environment, lights.skyRotation, raysEach(request),
                                   request.seed));
  if (light_) light_->addTo(parts_);
}

}  // namespace prelight
