#include "viewer/near_lamp_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
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
  for (ShadedLight& light : lights)
    if (!light.throughTransfer && !light.isSample && chosen < mostLamps) light.shadow = chosen++;
}

void NearLampPass::run(std::span<const ShadedLight> lights) {
  std::vector<glm::vec3> lamps;
  for (const ShadedLight& light : lights)
    if (light.shadow >= 0) lamps.push_back(light.position);
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
