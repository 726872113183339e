#pragma once

#include <array>
#include <glm/glm.hpp>
#include <type_traits>

/// The uniform blocks of the shaders as C++ (std140: everything is of vec4s).
namespace prelight::viewer {

/// Where they are bound.
enum BlockBinding : unsigned { frameBinding = 0, lightBinding = 1, shadowBinding = 2 };

/// `Frame` of shaders/frame.glsl.
struct FrameBlock {
  glm::mat4 clipFromScene;
  glm::mat4 skyFromWorld;
  glm::vec4 eye;
  glm::vec4 forward;
  glm::vec4 pixelRight;
  glm::vec4 pixelUp;
  glm::vec4 tile;
  std::array<glm::vec4, 9> ambient;
  glm::vec4 skyLevels;
  glm::ivec4 counts;
};
static_assert(std::is_trivially_copyable_v<FrameBlock>);
static_assert(sizeof(FrameBlock) == 16 * (4 + 4 + 5 + 9 + 2));

/// One of `Lights` of shaders/lights.glsl.
struct LightBlock {
  glm::vec4 positionKind;
  glm::vec4 directionArea;
  glm::vec4 intensityRange;
  glm::vec4 cone;
};
static_assert(sizeof(LightBlock) == 64);

/// One of `ShadowLights` of shadows/shadows.glsl.
struct ShadowBlock {
  glm::vec4 axisX;  ///< w: first view
  glm::vec4 axisY;  ///< w: views
  glm::vec4 axisZ;  ///< w: nearest depth, m; of a direction: depths a metre, negative
  glm::vec4 place;  ///< w: half sides a tangent, or a metre
};
static_assert(sizeof(ShadowBlock) == 64);

}  // namespace prelight::viewer
