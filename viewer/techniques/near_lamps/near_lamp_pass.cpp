#include "viewer/techniques/near_lamps/near_lamp_pass.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/colour.h"
#include "techniques/near_lamps/lamp_shells.h"

namespace prelight::viewer {
namespace {

constexpr std::size_t verticesADraw = std::size_t{1} << 15;

/// Rows of order^2 halves, padded to whole texels.
std::vector<std::uint16_t> paddedRows(const NearLampTransfer& transfer) {
  const std::size_t length = transfer.columns(), padded = (length + 3) / 4 * 4;
  const std::size_t rows = transfer.halves.size() / length;
  std::vector<std::uint16_t> texels(rows * padded, 0);
  for (std::size_t row = 0; row < rows; ++row)
    std::copy_n(transfer.halves.begin() + static_cast<std::ptrdiff_t>(row * length), length,
                texels.begin() + static_cast<std::ptrdiff_t>(row * padded));
  return texels;
}

gl::BufferTexture texelsOf(const NearLampTransfer& transfer) {
  return gl::makeBufferTexture(std::span<const std::uint16_t>(paddedRows(transfer)), 4, GL_RGBA16F,
                               "shells of near lamps");
}

/// Samples of emissive surfaces that are neighbours.
using SampleGroup = std::vector<ShadedLight*>;

/// Squared extent of the box around a group over the surface that it stands for, above which one place does
/// not stand for all.
constexpr float mostSpread = 16.0f;

glm::vec3 extentOf(const SampleGroup& group) {
  glm::vec3 lower = group.front()->position, upper = lower;
  for (const ShadedLight* sample : group) {
    lower = glm::min(lower, sample->position);
    upper = glm::max(upper, sample->position);
  }
  return upper - lower;
}

bool isCompact(const SampleGroup& group) {
  float area = 0.0f;
  for (const ShadedLight* sample : group) area += sample->area;
  const glm::vec3 extent = extentOf(group);
  return glm::dot(extent, extent) <= mostSpread * area;
}

/// Cuts the widest group across its longest side, half of its samples here and half there, until there are as
/// many as may be.
std::vector<SampleGroup> groupsOf(SampleGroup samples, std::size_t most) {
  std::vector<SampleGroup> groups;
  if (!samples.empty() && most > 0) groups.push_back(std::move(samples));
  while (!groups.empty() && groups.size() < most) {
    const auto widest =
        std::max_element(groups.begin(), groups.end(), [](const SampleGroup& a, const SampleGroup& b) {
          return glm::length(extentOf(a)) < glm::length(extentOf(b));
        });
    const glm::vec3 extent = extentOf(*widest);
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    if (extent[axis] <= 0.0f) break;
    const auto middle = widest->begin() + static_cast<std::ptrdiff_t>(widest->size() / 2);
    std::nth_element(widest->begin(), middle, widest->end(), [&](const ShadedLight* a, const ShadedLight* b) {
      return a->position[axis] < b->position[axis];
    });
    SampleGroup beyond(middle, widest->end());
    widest->erase(middle, widest->end());
    groups.push_back(std::move(beyond));
  }
  return groups;
}

/// Vertices at which lamps are compared.
constexpr std::size_t probes = 256;

/// Mean of what a lamp sends to some of a scene's vertices, without shadows.
double meanIrradiance(const ShadedLight& light, const CompiledScene& scene) {
  const std::size_t step = std::max<std::size_t>(scene.vertexCount() / probes, 1);
  double sum = 0.0;
  for (std::size_t v = 0; v < scene.vertexCount(); v += step) {
    const IncidentLight incident = incidentFrom(light, glm::dvec3(scene.positions[v]));
    sum += luminance(incident.irradiance) *
           std::max(glm::dot(glm::dvec3(scene.normals[v]), incident.toLight), 0.0);
  }
  return sum;
}

/// The lamps that matter most, in their order.
std::vector<ShadedLight*> mostImportant(std::vector<ShadedLight*> lamps, std::size_t most,
                                        const CompiledScene& scene) {
  if (lamps.size() <= most) return lamps;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < lamps.size(); ++i) order.emplace_back(-meanIrradiance(*lamps[i], scene), i);
  std::sort(order.begin(), order.end());
  std::vector<ShadedLight*> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(lamps[order[i].second]);
  return chosen;
}

}  // namespace

NearLampPass::NearLampPass(const NearLampTransfer& transfer, const CompiledScene& scene)
    : scene_(scene),
      order_(transfer.order),
      shells_(transfer.shells),
      nearest_(transfer.nearest),
      farthest_(transfer.farthest),
      program_("near_lamps.vert", std::vector<const char*>{"lampVisibility"}),
      texels_(texelsOf(transfer)),
      positions_(Attribute::Position, std::span<const glm::vec3>(scene.positions)),
      normals_(Attribute::Normal, std::span<const glm::vec3>(scene.normals)) {
  glBindVertexArray(vertexArray_.name());
  positions_.attach();
  normals_.attach();
  glBindVertexArray(0);
  setUp();
}

/// The shape of shells is that of all keys.
void NearLampPass::takeBake(const Bake& bake) {
  if (!bake.nearLamps) return;
  texels_ = texelsOf(*bake.nearLamps);
  isStale_ = true;
}

void NearLampPass::setUp() {
  program_.use();
  program_.set("texels", 0);
  program_.set("shellShape", glm::ivec4(order_, shells_, 0, 0));
  program_.set("shellRange", glm::vec4(nearest_, static_cast<float>(shells_ / std::log(farthest_ / nearest_)),
                                       shellLag, 0.0f));
}

/// Places of the lights of each shadow; samples of emissive surfaces that share one have their mean place.
NearLampPass::Shadows NearLampPass::placesOf(std::span<const ShadedLight> lights) {
  Shadows shadows;
  std::vector<glm::vec4> sums;
  for (const ShadedLight& light : lights) {
    if (light.shadow < 0) continue;
    const auto shadow = static_cast<std::size_t>(light.shadow);
    shadows.resize(std::max(shadows.size(), shadow + 1));
    sums.resize(shadows.size(), glm::vec4(0.0f));
    if (light.isSample)
      sums[shadow] += glm::vec4(light.area * light.position, light.area);
    else if (light.kind != LightKind::Area)
      shadows[shadow] = {{glm::vec4(light.position, 0.0f), glm::vec3(0.0f)}};
    else
      for (const ShadedLight& part : samplesOf(light, placesOfAnArea))
        shadows[shadow].push_back({glm::vec4(part.position, part.twoSided ? 2.0f : 1.0f), part.direction});
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (sums[i].w > 0.0f) shadows[i] = {{glm::vec4(glm::vec3(sums[i]) / sums[i].w, 0.0f), glm::vec3(0.0f)}};
  return shadows;
}

void NearLampPass::choose(std::span<ShadedLight> lights, const CompiledScene& scene) {
  std::vector<ShadedLight*> lamps;
  SampleGroup samples;
  for (ShadedLight& light : lights)
    if (!light.throughTransfer && light.firstMap < 0) (light.isSample ? samples : lamps).push_back(&light);
  int chosen = 0;
  for (ShadedLight* lamp : mostImportant(lamps, mostLamps, scene)) lamp->shadow = chosen++;
  const int left = std::min(lampsAStream, mostLamps - chosen);
  for (const SampleGroup& group : groupsOf(samples, static_cast<std::size_t>(left))) {
    if (!isCompact(group)) continue;
    for (ShadedLight* sample : group) sample->shadow = chosen;
    ++chosen;
  }
}

void NearLampPass::share(std::span<const ShadedLight> chosen, std::span<ShadedLight> samples) {
  for (ShadedLight& sample : samples) {
    if (!sample.isSample) continue;
    const ShadedLight* nearest =
        nearestSample(chosen, sample.position, [](const ShadedLight&) { return true; });
    if (nearest != nullptr) sample.shadow = nearest->shadow;
  }
}

void NearLampPass::setPlaces(std::span<const std::vector<Place>> shadows) {
  glm::ivec4 ends(0);
  std::vector<glm::vec4> positions;
  std::vector<glm::vec3> normals;
  for (std::size_t i = 0; i < shadows.size(); ++i) {
    for (const Place& place : shadows[i]) {
      positions.push_back(place.position);
      normals.push_back(place.normal);
    }
    ends[static_cast<glm::length_t>(i)] = static_cast<int>(positions.size());
  }
  program_.set("places", std::span<const glm::vec4>(positions));
  program_.set("placeNormals", std::span<const glm::vec3>(normals));
  program_.set("placesEnd", ends);
  program_.set("lampCount", static_cast<int>(shadows.size()));
}

void NearLampPass::shadow(const View&, std::vector<ShadedLight>& lights) {
  choose(lights, scene_);
  run(lights);
}

void NearLampPass::run(std::span<const ShadedLight> lights) {
  Shadows shadows = placesOf(lights);
  if (shadows.empty() || (!isStale_ && shadows == shadows_)) return;
  if (isStale_) {
    positions_.fill(std::span<const glm::vec3>(scene_.positions));
    normals_.fill(std::span<const glm::vec3>(scene_.normals));
  }
  shadows_ = std::move(shadows);
  isStale_ = false;
  capture_.begin();
  glBindVertexArray(vertexArray_.name());
  program_.use();
  gl::bind(0, GL_TEXTURE_BUFFER, texels_.texture);
  for (std::size_t first = 0; first < shadows_.size(); first += lampsAStream) {
    const std::size_t stream = first / lampsAStream;
    if (visibility_.size() <= stream)
      visibility_.emplace_back(
          static_cast<Attribute>(static_cast<GLuint>(Attribute::LampVisibility) + stream),
          std::span<const glm::vec4>(std::vector<glm::vec4>(scene_.vertexCount(), glm::vec4(1.0f))));
    setPlaces(
        std::span(shadows_).subspan(first, std::min<std::size_t>(lampsAStream, shadows_.size() - first)));
    gl::Capture::run(visibility_[stream].buffer().name(), scene_.vertexCount(), verticesADraw);
  }
  glBindVertexArray(0);
  gl::check("shadowing near lamps");
}

void NearLampPass::bind(const gl::Program&) const {
  for (const VertexStream& four : visibility_) four.attach();
}

namespace {

bool letsFarLightsThrough(Shading shading) { return infoOf(shading).rules.through == Through::FarLights; }

void describeLackOfBounces(Shading shading, const Illumination& light, Warnings& notes) {
  if (!letsFarLightsThrough(shading)) return;
  const auto isLacking = [](bool mapped) {
    return [mapped](const ShadedLight& source) {
      return !source.throughTransfer && source.shadow < 0 && (source.firstMap >= 0) == mapped;
    };
  };
  const std::string name(shadingName(shading));
  if (std::ranges::any_of(light.lights, isLacking(false)))
    notes.push_back(
        "emissive surfaces and lights within the scene's bounds shine without shadows in " + name +
        " shading: the transfer cannot tell what is in front of them from what is behind (--direct auto "
        "gives them shadow maps, and bake --near-lamps some to " +
        std::to_string(NearLampPass::mostLamps) + " lamps and parts of emissive surfaces here)");
  else if (std::ranges::any_of(light.lights, isLacking(true)))
    notes.push_back(
        "surfaces do not send on the light of emissive surfaces and lights within the scene's bounds in " +
        name + " shading (a file baked with --lightmap or --light-groups has it, and --shading full)");
}

}  // namespace

extern const PassRow nearLampRow = {
    .isIn =
        [](Shading shading, const RenderInputs& inputs) {
          const Bake* bake = bakeOf(shading, inputs);
          return letsFarLightsThrough(shading) && bake != nullptr && bake->nearLamps;
        },
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<TechniquePass> {
      const RenderInputs& inputs = of.inputs;
      const bool posed = inputs.posed != nullptr && inputs.posed->nearLamps;
      return std::make_unique<NearLampPass>(posed ? *inputs.posed->nearLamps : *inputs.bake->nearLamps,
                                            inputs.compiled);
    },
    .describeLack = describeLackOfBounces,
};

}  // namespace prelight::viewer
