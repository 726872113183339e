#include "benchmarks/suites/skip/carry_out.h"

#include <cstring>

#include "benchmarks/run/measure.h"
#include "benchmarks/run/processor_time.h"
#include "device/context.h"
#include "integrators/global_illumination_renderer.h"

namespace prelight::benchmarks::skip {

namespace {

template <class T>
void append(const std::vector<T>& from, std::vector<float>& to) {
  static_assert(sizeof(T) % sizeof(float) == 0);
  const std::size_t before = to.size(), count = from.size() * sizeof(T) / sizeof(float);
  to.resize(before + count);
  if (count > 0) std::memcpy(to.data() + before, from.data(), count * sizeof(float));
}

/// The rows of the vertices that a triangle has, whose light alone is ever seen.
template <class T>
std::vector<T> usedRows(const CompiledScene& scene, const std::vector<T>& rows) {
  std::vector<bool> used(scene.vertexCount(), false);
  for (const glm::uvec3& triangle : scene.triangles)
    for (int corner = 0; corner < 3; ++corner) used[triangle[corner]] = true;
  const std::size_t length = rows.size() / used.size();
  std::vector<T> kept;
  for (std::size_t vertex = 0; vertex < used.size(); ++vertex)
    for (std::size_t i = 0; used[vertex] && i < length; ++i) kept.push_back(rows[vertex * length + i]);
  return kept;
}

std::vector<float> valuesOf(const CompiledScene& scene, const Bake& bake) {
  std::vector<float> values;
  append(usedRows(scene, bake.ao), values);
  append(usedRows(scene, bake.bentNormals), values);
  if (bake.sh) append(usedRows(scene, bake.sh->coefficients), values);
  if (bake.ch) append(usedRows(scene, bake.ch->coefficients), values);
  if (bake.haar) append(bake.haar->values, values);
  if (bake.glossy) append(usedRows(scene, bake.glossy->matrices), values);
  if (bake.volume) append(bake.volume->coefficients, values);
  if (bake.lightGroups) append(bake.lightGroups->coefficients, values);
  if (bake.occluders) append(bake.occluders->vectors, values);
  if (bake.lightMap) append(bake.lightMap->values, values);
  if (bake.irradiance) append(*bake.irradiance, values);
  return values;
}

void bakeInto(const Setting& setting, const CompiledScene& compiled, const Device& device,
              const Progress& progress, Outcome& outcome) {
  const TimedBake result =
      timedBake({setting.scene.name, setting.scene, compiled}, setting.bake, device, progress);
  outcome.rays = result.report.rays;
  outcome.values = valuesOf(compiled, result.bake);
}

Picture drawGathered(const Setting& setting, const CompiledScene& compiled, const Device& device,
                     Progress& progress, std::uint64_t& rays) {
  GlobalIlluminationPictureRequest request;
  request.width = request.height = setting.picture->side;
  request.samples = setting.picture->samples;
  GlobalIlluminationPictureReport report;
  const LitScene lit{compiled, setting.scene.images, setting.scene.lights, setting.sky.get()};
  Picture picture = renderGlobalIllumination(setting.scene, lit, setting.scene.cameras.front(), request,
                                             device, progress, report);
  rays = report.rays;
  return picture;
}

Picture drawTraced(const Setting& setting, const CompiledScene& compiled, const Device& device,
                   Progress& progress, std::uint64_t& rays) {
  reference::ReferenceRequest request;
  request.width = request.height = setting.picture->side;
  request.samples = setting.picture->samples;
  reference::Film film(request.width, request.height);
  reference::ReferenceReport report;
  const reference::ReferenceInputs inputs{compiled, setting.scene.images, setting.scene.lights,
                                          setting.scene.cameras.front(), setting.sky.get()};
  reference::renderReference(inputs, request, device, progress, film, report);
  rays = report.rays;
  return film.picture();
}

}  // namespace

Outcome carryOut(const Setting& setting, const Device& device, const Progress& progress) {
  Warnings warnings;
  const CompiledScene compiled = compileScene(setting.scene, warnings);
  StopOnly quiet(progress);
  Outcome outcome;
  const DeviceUse before = device.context().use();
  const double start = processorSeconds();
  if (!setting.picture)
    bakeInto(setting, compiled, device, progress, outcome);
  else
    append((setting.picture->method == PictureMethod::PathTracing ? drawTraced : drawGathered)(
               setting, compiled, device, quiet, outcome.rays)
               .pixels,
           outcome.values);
  outcome.cpuSeconds = processorSeconds() - start;
  const DeviceUse after = device.context().use();
  outcome.launches = after.launches - before.launches;
  outcome.workItems = after.workItems - before.workItems;
  outcome.deviceBytes = after.bytes - before.bytes;
  return outcome;
}

bool sameValues(const Outcome& a, const Outcome& b) {
  return a.values.size() == b.values.size() &&
         std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)) == 0;
}

}  // namespace prelight::benchmarks::skip
