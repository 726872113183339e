#include "viewer/near_lamp_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "basis/sh_zonal.h"
#include "transfer/near_lamps.h"

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

/// Where the lights that share a shadow are, in the mean over their surface; [shadow].
std::vector<glm::vec3> placesOf(std::span<const ShadedLight> lights) {
  std::vector<glm::vec4> sums;
  for (const ShadedLight& light : lights) {
    if (light.shadow < 0) continue;
    sums.resize(std::max(sums.size(), static_cast<std::size_t>(light.shadow) + 1), glm::vec4(0.0f));
    const float weight = light.isSample ? light.area : 1.0f;
    sums[static_cast<std::size_t>(light.shadow)] += glm::vec4(weight * light.position, weight);
  }
  std::vector<glm::vec3> places;
  for (const glm::vec4& sum : sums) places.push_back(glm::vec3(sum) / sum.w);
  return places;
}

}  // namespace

NearLampPass::NearLampPass(const NearLampTransfer& transfer, const CompiledScene& scene)
    : scene_(scene),
      order_(transfer.order),
      shells_(transfer.shells),
      nearest_(transfer.nearest),
      farthest_(transfer.farthest),
      program_("near_lamps.vert", std::vector<const char*>{"lampVisibility"}),
      texels_(gl::makeBufferTexture(std::span<const std::uint16_t>(paddedRows(transfer)), 4, GL_RGBA16F,
                                    "shells of near lamps")),
      positions_(Attribute::Position, std::span<const glm::vec3>(scene.positions)),
      normals_(Attribute::Normal, std::span<const glm::vec3>(scene.normals)),
      visibility_(Attribute::LampVisibility,
                  std::span<const glm::vec4>(std::vector<glm::vec4>(scene.vertexCount(), glm::vec4(1.0f)))) {
  glBindVertexArray(vertexArray_.name());
  positions_.attach();
  normals_.attach();
  glBindVertexArray(0);
  setUp();
}

void NearLampPass::setUp() {
  program_.use();
  program_.set("texels", 0);
  program_.set("shellShape", glm::ivec4(order_, shells_, 0, 0));
  program_.set("shellRange", glm::vec4(nearest_, static_cast<float>(shells_ / std::log(farthest_ / nearest_)),
                                       shellLag, 0.0f));
  for (int l = 0; l < order_; ++l)
    program_.set(("openBands[" + std::to_string(l) + "]").c_str(),
                 static_cast<float>(sh::clampedCosine(l) * (2 * l + 1) / (4.0 * std::numbers::pi)));
}

void NearLampPass::choose(std::span<ShadedLight> lights) {
  int chosen = 0;
  SampleGroup samples;
  for (ShadedLight& light : lights) {
    if (light.throughTransfer) continue;
    if (light.isSample)
      samples.push_back(&light);
    else if (chosen < mostLamps)
      light.shadow = chosen++;
  }
  for (const SampleGroup& group : groupsOf(samples, static_cast<std::size_t>(mostLamps - chosen))) {
    if (!isCompact(group)) continue;
    for (ShadedLight* sample : group) sample->shadow = chosen;
    ++chosen;
  }
}

void NearLampPass::share(std::span<const ShadedLight> chosen, std::span<ShadedLight> samples) {
  for (ShadedLight& sample : samples) {
    if (!sample.isSample) continue;
    float least = std::numeric_limits<float>::infinity();
    for (const ShadedLight& other : chosen) {
      const float distance = glm::distance(other.position, sample.position);
      if (!other.isSample || distance >= least) continue;
      least = distance;
      sample.shadow = other.shadow;
    }
  }
}

void NearLampPass::run(std::span<const ShadedLight> lights) {
  std::vector<glm::vec3> lamps = placesOf(lights);
  if (lamps.empty() || (!isStale_ && lamps == lamps_)) return;
  if (isStale_) {
    positions_.fill(std::span<const glm::vec3>(scene_.positions));
    normals_.fill(std::span<const glm::vec3>(scene_.normals));
  }
  lamps_ = std::move(lamps);
  isStale_ = false;
  capture_.begin();
  glBindVertexArray(vertexArray_.name());
  program_.use();
  constexpr std::array<const char*, mostLamps> names = {"lamps[0]", "lamps[1]", "lamps[2]", "lamps[3]"};
  for (std::size_t i = 0; i < lamps_.size(); ++i) program_.set(names[i], lamps_[i]);
  program_.set("lampCount", static_cast<int>(lamps_.size()));
  gl::bind(0, GL_TEXTURE_BUFFER, texels_.texture);
  gl::Capture::run(visibility_.buffer().name(), scene_.vertexCount(), verticesADraw);
  glBindVertexArray(0);
  gl::check("shadowing near lamps");
}

}  // namespace prelight::viewer
