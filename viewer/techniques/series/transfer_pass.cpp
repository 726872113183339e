#include "viewer/techniques/series/transfer_pass.h"

#include <array>
#include <utility>
#include <vector>

#include "viewer/core/uniform_blocks.h"
#include "viewer/lights/light_block.h"
#include "viewer/programs/shader_variant.h"

namespace prelight::viewer {
namespace {

constexpr std::size_t mostVertices = std::size_t{1} << 16;  ///< of a draw

}  // namespace

TransferPass::TransferPass(const CompiledScene& scene, Attribute result)
    : scene_(scene),
      program_("transfer.vert", std::vector<const char*>{"transferred"},
               {{"variant.glsl", textOf(variantOfAnySurface())}}),
      radiance_(result,
                std::span<const glm::vec3>(std::vector<glm::vec3>(scene.vertexCount(), glm::vec3(0.0f)))) {
  constexpr std::array<std::pair<const char*, TransferUnit>, 6> samplers = {
      {{"transfer", transferUnit},
       {"transferLight", transferLightUnit},
       {"transferRanges", rangesUnit},
       {"chBasis", chBasisUnit},
       {"clusters", clustersUnit},
       {"clusterRows", clusterRowsUnit}}};
  program_.bindBlock("Lights", lightBinding);
  program_.use();
  for (const auto& [name, unit] : samplers) program_.set(name, static_cast<int>(unit));
  program_.set("lampTables", static_cast<int>(lampTablesUnit));  // that stays bound
}

bool TransferPass::verticesMoved() {
  const bool known = positions_.has_value();
  positions_.reset();
  normals_.reset();
  return known;
}

void TransferPass::run(std::span<const ShadedLight> lamps,
                       const std::function<void(const gl::Program&)>& setUp) {
  capture_.begin();
  glBindVertexArray(vertexArray_.name());
  if (!lamps.empty() && !positions_) {
    positions_.emplace(Attribute::Position, std::span<const glm::vec3>(scene_.positions)).attach();
    normals_.emplace(Attribute::Normal, std::span<const glm::vec3>(scene_.normals)).attach();
  }
  fillLightBlock(lightBlock_, lamps);
  glBindBufferBase(GL_UNIFORM_BUFFER, lightBinding, lightBlock_.name());
  program_.use();
  program_.set("lightCount", static_cast<int>(lamps.size()));
  setUp(program_);
  gl::Capture::run(radiance_.buffer().name(), scene_.vertexCount(), mostVertices);
  glBindVertexArray(0);
  gl::check("lighting baked transfer");
}

}  // namespace prelight::viewer
