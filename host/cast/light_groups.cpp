#include "cast/light_groups.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "prelight/error.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

/// Shadow rays to the emitters of all groups together from a receiver, which has 16 to 64 rays of its own,
/// and their bounds for one group.
constexpr std::uint32_t emitterSamples = 64, leastSamples = 4, mostSamples = 16;

/// What is dealt to a group: a punctual light, or an emissive node.
struct Source {
  std::string name;
  glm::vec3 color{0.0f};  ///< greatest intensity a channel
  std::vector<std::size_t> lights;
  std::vector<Emitter> emitters;
};

void addLights(const CompiledScene& scene, std::vector<Source>& sources) {
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    if (!shines(light.intensity)) continue;
    const std::string name = light.name.empty() ? fmt::format("light {}", i) : light.name;
    sources.push_back({name, light.intensity, {i}, {}});
  }
}

void addEmissiveNodes(const CompiledScene& scene, std::vector<Source>& sources) {
  int lastNode = -1;
  const std::vector<Emitter> emitters = emittersOf(scene);
  auto emitter = emitters.begin();
  for (const PrimitiveRange& range : scene.primitives) {
    for (; emitter != emitters.end() && emitter->triangle < range.firstTriangle + range.triangleCount;
         ++emitter) {
      if (range.node != lastNode) {
        sources.push_back({range.name.empty() ? fmt::format("node {}", range.node) : range.name, {}, {}, {}});
        lastNode = range.node;
      }
      sources.back().emitters.push_back(*emitter);
      sources.back().color = glm::max(sources.back().color, emitter->radiance);
    }
  }
}

/// Sources of every group, in the groups' order.
std::vector<Source> dealToGroups(std::vector<Source> sources, const std::vector<LightGroupRequest>& named) {
  std::vector<Source> groups;
  std::vector<bool> dealt(sources.size(), false);
  for (const LightGroupRequest& request : named) {
    Source group{request.name, {}, {}, {}};
    bool any = false;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const bool matches = std::any_of(request.patterns.begin(), request.patterns.end(),
                                       [&](const auto& p) { return matchesPattern(sources[i].name, p); });
      if (dealt[i] || !matches) continue;
      dealt[i] = any = true;
      group.color = glm::max(group.color, sources[i].color);
      group.lights.insert(group.lights.end(), sources[i].lights.begin(), sources[i].lights.end());
      group.emitters.insert(group.emitters.end(), sources[i].emitters.begin(), sources[i].emitters.end());
    }
    if (!any) {
      std::string names;
      for (const Source& source : sources) names += (names.empty() ? "" : ", ") + source.name;
      throw UsageError("LightGroupRequest::name " + request.name,
                       "the group is empty: no light has a name that it asks for",
                       "the scene's lights are: " + names);
    }
    groups.push_back(std::move(group));
  }
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (!dealt[i]) groups.push_back(std::move(sources[i]));
  return groups;
}

glm::vec3 over(const glm::vec3& intensity, const glm::vec3& color) {
  glm::vec3 factor(0.0f);
  // A lamp without blue still says where its blue would go.
  for (int c = 0; c < 3; ++c) factor[c] = color[c] > 0.0f ? intensity[c] / color[c] : 1.0f;
  return factor;
}

void addPunctual(const CompiledScene& scene, const Source& source, std::uint32_t group,
                 std::vector<const Light*>& shining, GroupedLights& out) {
  for (const std::size_t i : source.lights) {
    std::vector<device::PunctualLight>& lights = out.tables.punctual;
    out.rays.push_back({group, static_cast<std::uint32_t>(lights.size()), {}, 0, 0, 0});
    lights.push_back(deviceLight(scene.lights[i], scene));
    const glm::vec3 factor = over(scene.lights[i].intensity, source.color);
    for (int c = 0; c < 3; ++c) lights.back().intensity[c] = factor[c];
    shining.push_back(&scene.lights[i]);
  }
}

void addEmissive(const CompiledScene& scene, const Source& source, std::uint32_t group, std::uint32_t samples,
                 GroupedLights& out) {
  if (source.emitters.empty()) return;
  std::vector<double> powers;
  for (const Emitter& emitter : source.emitters) {
    const glm::vec3& e = emitter.radiance;
    powers.push_back(2.0 * emitter.area * (double(e.x) + e.y + e.z));
    const glm::vec3 factor = over(e, source.color);
    out.emitterOfTriangle[emitter.triangle] = static_cast<std::uint32_t>(out.emitters.size());
    out.emitters.push_back({group, {factor.x, factor.y, factor.z}});
  }
  const device::EmitterRange range = addEmitters(scene, source.emitters, powers, out.tables);
  out.samplesOfGroup[group] = samples;
  for (std::uint32_t s = 0; s < samples; ++s)
    out.rays.push_back({group, PRELIGHT_NO_EMITTER, range, s, samples, 0});
}

}  // namespace

GroupedLights groupLights(const CompiledScene& scene, const std::vector<LightGroupRequest>& named) {
  std::vector<Source> sources;
  addLights(scene, sources);
  addEmissiveNodes(scene, sources);
  if (sources.empty())
    throw InputError("light groups", "the scene has no light and nothing emissive",
                     "leave BakeRequest::lightGroups out, or add lights to the scene");
  GroupedLights out;
  const std::vector<Source> groups = dealToGroups(std::move(sources), named);
  out.emitterOfTriangle.assign(scene.triangleCount(), PRELIGHT_NO_EMITTER);
  out.samplesOfGroup.assign(groups.size(), 0);
  const auto withEmitters = static_cast<std::uint32_t>(
      std::count_if(groups.begin(), groups.end(), [](const Source& g) { return !g.emitters.empty(); }));
  const std::uint32_t samples =
      std::clamp(emitterSamples / std::max(1u, withEmitters), leastSamples, mostSamples);
  std::vector<const Light*> shining;
  for (const Source& group : groups) {
    const auto index = static_cast<std::uint32_t>(out.groups.size());
    out.groups.push_back({group.name, group.color});
    addPunctual(scene, group, index, shining, out);
    addEmissive(scene, group, index, samples, out);
  }
  referToEmitters(scene, out.tables);
  addProfiles(shining, out.tables);
  return out;
}

GroupedLights punctualLightsOf(GroupedLights lights) {
  std::erase_if(lights.rays, [](const device::LightRay& ray) { return ray.light == PRELIGHT_NO_EMITTER; });
  std::fill(lights.emitterOfTriangle.begin(), lights.emitterOfTriangle.end(), PRELIGHT_NO_EMITTER);
  std::fill(lights.samplesOfGroup.begin(), lights.samplesOfGroup.end(), 0u);
  lights.emitters.clear();
  lights.tables.emitters.clear();
  lights.tables.emitterDensities.clear();
  return lights;
}

GroupedLights emittersOf(GroupedLights lights, std::uint32_t samples) {
  std::vector<device::LightRay> rays;
  for (device::LightRay ray : lights.rays) {
    if (ray.light != PRELIGHT_NO_EMITTER || ray.sample != 0) continue;
    ray.sampleCount = samples;
    for (ray.sample = 0; ray.sample < samples; ++ray.sample) rays.push_back(ray);
    lights.samplesOfGroup[ray.group] = samples;
  }
  lights.rays = std::move(rays);
  lights.tables.punctual.clear();
  lights.tables.profiles.clear();
  return lights;
}

LightCounts countLights(const CompiledScene& scene, const std::vector<LightGroupRequest>& named) {
  std::vector<Source> sources;
  addLights(scene, sources);
  addEmissiveNodes(scene, sources);
  LightCounts counts{named.size(), 0};
  for (const Source& source : sources) {
    counts.rays += source.lights.size() + (source.emitters.empty() ? 0 : leastSamples);
    const bool dealt = std::any_of(named.begin(), named.end(), [&](const LightGroupRequest& request) {
      return std::any_of(request.patterns.begin(), request.patterns.end(),
                         [&](const std::string& pattern) { return matchesPattern(source.name, pattern); });
    });
    if (!dealt) ++counts.groups;
  }
  return counts;
}

}  // namespace prelight
