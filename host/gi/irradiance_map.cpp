#include "gi/irradiance_map.h"

#include <utility>

#include "device/buffer.h"
#include "shared/density_types.h"

namespace prelight {

namespace {

std::vector<glm::vec2> markedCorners(const LightMapLayout& layout) {
  std::vector<glm::vec2> corners = layout.corners;
  for (std::size_t face = 0; face < layout.chartOf.size(); ++face)
    if (layout.chartOf[face] == LightMapLayout::noChart)
      for (std::size_t k = 0; k < 3; ++k) corners[3 * face + k] = glm::vec2(-1.0f);
  return corners;
}

std::vector<glm::vec2> wallsOf(const LightMapLayout& layout) {
  std::vector<glm::vec2> walls;
  for (const LightMapLayout::Wall& wall : layout.walls) walls.emplace_back(wall.right, wall.below);
  return walls;
}

/// Returns 1 + patch for the layout's texels, [texel].
std::vector<std::uint32_t> patchesOnGrid(const LightMapLayout& layout,
                                         std::span<const std::uint32_t> patches) {
  std::vector<std::uint32_t> grid(patches.empty() ? 0 : layout.texelCount(), PRELIGHT_WHOLE_REGION);
  for (std::size_t i = 0; i < patches.size(); ++i) grid[layout.texels[i].texel] = 1 + patches[i];
  return grid;
}

}  // namespace

IrradianceMap::IrradianceMap(DeviceContext& device, const LightMapLayout& layout,
                             std::span<const std::uint32_t> patches) {
  for (const LightMapLayout::Wall& wall : layout.walls) inside_.push_back(wall.inside ? 1.0f : 0.0f);
  PackedArrays<device::IrradianceLine> pack;
  layout_.corners = pack.add(markedCorners(layout));
  layout_.texels = pack.reserve<glm::vec4>(layout.texelCount());
  std::vector<glm::vec2> walls = wallsOf(layout);
  // Patches that are separated only along seams still need a look-up by texel.
  if (walls.empty() && !patches.empty()) walls.assign(layout.texelCount(), glm::vec2(LightMapLayout::noWall));
  std::vector<std::uint32_t> onGrid = patchesOnGrid(layout, patches);
  if (!walls.empty() && onGrid.empty()) onGrid.assign(layout.texelCount(), PRELIGHT_WHOLE_REGION);
  layout_.walled = walls.empty() ? 0u : 1u;
  layout_.walls = pack.add(std::move(walls));
  layout_.patches = pack.add(std::move(onGrid));
  layout_.width = static_cast<std::uint32_t>(layout.width);
  layout_.height = static_cast<std::uint32_t>(layout.height);
  layout_.triangleCount = static_cast<std::uint32_t>(layout.chartOf.size() / 2);
  lines_ = pack.upload(device);
}

void IrradianceMap::set(std::span<const glm::vec3> irradiance) {
  std::vector<glm::vec4> texels;
  texels.reserve(irradiance.size());
  for (std::size_t i = 0; i < irradiance.size(); ++i)
    texels.emplace_back(irradiance[i], inside_.empty() ? 0.0f : inside_[i]);
  lines_.writeArray(std::span<const glm::vec4>(texels), layout_.texels);
}

}  // namespace prelight
