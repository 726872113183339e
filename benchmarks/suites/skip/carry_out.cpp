#include "benchmarks/suites/skip/carry_out.h"

#include <fmt/format.h>

#include <cstring>

#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
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

/// Returns the rows of vertices that belong to a triangle; the light of others is never visible.
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

namespace {

constexpr std::array<Presence, 3> presences = {Presence::Absent, Presence::Unneeded, Presence::Needed};

/// Returns "1234 / 1234 / 5678", in thousands or units.
std::string triple(const MeasuredRow& measured, std::uint64_t Outcome::*count, double unit) {
  std::string text;
  for (const Outcome& outcome : measured.outcomes)
    text += fmt::format("{}{:.{}f}", text.empty() ? "" : " / ", static_cast<double>(outcome.*count) / unit,
                        unit > 1.0 && static_cast<double>(outcome.*count) < 10.0 * unit ? 1 : 0);
  return text;
}

}  // namespace

MeasuredRow measureRow(const Row& row, const Effort& effort, int rounds, const Device& device,
                       const Progress& progress) {
  MeasuredRow measured{row, {}, 1.0};
  std::array<std::vector<double>, 3> seconds;
  std::array<Setting, 3> settings;
  for (const Presence presence : presences) {
    const auto i = static_cast<std::size_t>(presence);
    settings[i] = row.make(presence, effort);
    measured.outcomes[i] = carryOut(settings[i], device, progress);
  }
  for (int round = 0; round < rounds; ++round)
    for (std::size_t turn = 0; turn < settings.size(); ++turn) {
      const std::size_t i = (static_cast<std::size_t>(round) + turn) % settings.size();
      progress.check();
      seconds[i].push_back(carryOut(settings[i], device, progress).cpuSeconds);
    }
  if (rounds == 0) return measured;
  std::vector<double> costs;
  for (std::size_t round = 0; round < seconds[0].size(); ++round)
    costs.push_back(seconds[0][round] > 0.0 ? seconds[1][round] / seconds[0][round] : 1.0);
  measured.cost = median(costs);
  for (std::size_t i = 0; i < settings.size(); ++i) measured.outcomes[i].cpuSeconds = median(seconds[i]);
  return measured;
}

std::string tableOf(const std::vector<MeasuredRow>& rows) {
  std::string text =
      "| feature | present, not needed | rays, thousands | launches | device, MB | processor time, ms | cost "
      "of its presence | values |\n|---|---|---|---|---|---|---|---|\n";
  for (const MeasuredRow& measured : rows) {
    std::string times;
    for (const Outcome& outcome : measured.outcomes)
      times += fmt::format("{}{:.0f}", times.empty() ? "" : " / ", 1000.0 * outcome.cpuSeconds);
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {:.2f} | {} |\n", measured.row.name,
                    measured.row.unneeded, triple(measured, &Outcome::rays, 1e3),
                    triple(measured, &Outcome::launches, 1.0), triple(measured, &Outcome::deviceBytes, 1e6),
                    times, measured.cost, measured.unchanged() ? "the same bits" : "differ");
  }
  return text;
}

}  // namespace prelight::benchmarks::skip
