#include "techniques/light_map/light_map_sources.h"

#include <algorithm>

#include "base/clocks.h"
#include "base/kept_work.h"
#include "cast/schedule.h"

namespace prelight {

namespace {

constexpr std::size_t leastPlaces = 64, mostPlaces = 4096;  // between two looks at whether to stop

}  // namespace

LightMapSources::LightMapSources(const Scene& source, const CompiledScene& scene,
                                 const LightMapLayout& layout, const BakeRequest& request, const Plan& plan,
                                 int coefficients, const Device& device, Tracer& tracer, Progress& progress)
    : coefficients_(coefficients) {
  if (plan.runs(Pass::IndirectLightOfTheMap) || plan.runs(Pass::CausticsOfTheMap))
    light_.emplace(source, scene, layout, request, plan, device, tracer, progress);
  if (plan.runs(Pass::DirectLightOfTheMap))
    addDirect(scene, request, tracer);
  else if (light_ || plan.runs(Pass::SkyLightOfTheMap))  // else every texel is black, hidden or not
    parts_.push_back(&inside_.emplace(scene, tracer, request.seed));
  const RadiosityRequest& lights = request.radiosity;
  if (plan.runs(Pass::SkyLightOfTheMap))
    parts_.push_back(&sky_.emplace(scene, tracer, *lights.environment, lights.skyRotation, raysEach(request),
                                   request.seed));
  if (light_) light_->addTo(parts_);
}

void LightMapSources::addDirect(const CompiledScene& scene, const BakeRequest& request, Tracer& tracer) {
  const GroupedLights lights = groupLights(scene, {{"all", {"*"}}});
  if (lights.emitters.empty())
    parts_.push_back(&inside_.emplace(scene, tracer, request.seed));
  else
    parts_.push_back(
        &emitters_.emplace(scene, tracer, lights, raysEach(request), request.seed, coefficients_));
  if (!lights.tables.punctual.empty())
    parts_.push_back(&points_.emplace(scene, tracer, lights, coefficients_));
}

std::vector<float> LightMapSources::irradiance(std::span<const LightMapTexel> places,
                                               std::vector<std::uint8_t>& hidden, const Progress& progress) {
  const std::size_t length = 3 * static_cast<std::size_t>(coefficients_);
  std::vector<float> values(length * places.size(), 0.0f);
  std::uint64_t done = 0, cast = 0, atOnce = leastPlaces;  // parts inside are kept by blocks of this size
  WorkPart part(progress, "places", [&](auto& state) {
    state.value(done);
    state.value(cast);
    state.value(atOnce);
    state.require(atOnce >= leastPlaces && atOnce <= mostPlaces);
    state.growing(values, length * done);
    state.growing(hidden, done);
    state.requireFinite(values);
    state.check([&] { return std::all_of(hidden.begin(), hidden.end(), [](auto is) { return is <= 1; }); });
  });
  const std::uint64_t before = rays();
  earlierRays_ += cast;
  Pace pace(leastPlaces, mostPlaces);
  pace.next(mostPlaces);
  while (done < places.size()) {
    progress.check();
    const std::size_t count = std::min<std::size_t>(atOnce, places.size() - done);
    for (LightMapPart* each : parts_)
      each->add(places.subspan(done, count), coefficients_,
                std::span(values).subspan(length * done, length * count),
                std::span(hidden).subspan(done, count));
    done += count;
    cast = rays() - before;
    atOnce = pace.next(mostPlaces);
    part.advance();
  }
  part.finish();
  std::vector<float> irradiance;
  irradiance.reserve(3 * places.size());
  for (std::size_t i = 0; i < 3 * places.size(); ++i)
    irradiance.push_back(values[i * static_cast<std::size_t>(coefficients_)]);
  return irradiance;
}

std::uint64_t LightMapSources::rays() const {
  std::uint64_t sum = earlierRays_;
  for (const LightMapPart* part : parts_) sum += part->rays();
  return sum;
}

}  // namespace prelight
