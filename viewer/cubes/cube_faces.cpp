#include "viewer/cubes/cube_faces.h"

#include <algorithm>
#include <array>
#include <vector>

namespace prelight::viewer {
namespace {

/// Forward and up of the faces of a cube map, in OpenGL's order.
constexpr std::array<std::array<glm::dvec3, 2>, facesOfACube> faceAxes = {{
    {{{1, 0, 0}, {0, -1, 0}}},
    {{{-1, 0, 0}, {0, -1, 0}}},
    {{{0, 1, 0}, {0, 0, 1}}},
    {{{0, -1, 0}, {0, 0, -1}}},
    {{{0, 0, 1}, {0, -1, 0}}},
    {{{0, 0, -1}, {0, -1, 0}}},
}};

}  // namespace

Camera cubeFaceCamera(const glm::dvec3& world, std::size_t face, double near) {
  const auto& [forward, up] = faceAxes[face];
  Camera camera;
  camera.world = glm::dmat4(glm::dvec4(glm::cross(forward, up), 0.0), glm::dvec4(up, 0.0),
                            glm::dvec4(-forward, 0.0), glm::dvec4(world, 1.0));
  camera.yFov = 1.5707963267948966;
  camera.aspect = 1.0;
  camera.zNear = near;
  return camera;
}

double nearestInCube(const CompiledScene& compiled, float radius) {
  const double scene = glm::length(glm::dvec3(compiled.boundsMax - compiled.boundsMin));
  return std::clamp(0.1 * static_cast<double>(radius), 1e-5 * scene, 1e-3 * scene);
}

gl::Texture makeCubeMaps(int side, std::size_t count, bool mipmapped) {
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl::Texture texture;
  glBindTexture(GL_TEXTURE_CUBE_MAP_ARRAY, texture.name());
  const std::vector<float> black(
      4 * facesOfACube * count * static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0f);
  glTexImage3D(GL_TEXTURE_CUBE_MAP_ARRAY, 0, GL_RGBA32F, side, side,
               static_cast<GLsizei>(facesOfACube * count), 0, GL_RGBA, GL_FLOAT, black.data());
  glTexParameteri(GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_MIN_FILTER,
                  mipmapped ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  glTexParameteri(GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  if (mipmapped) glGenerateMipmap(GL_TEXTURE_CUBE_MAP_ARRAY);
  gl::check("making environment maps");
  return texture;
}

void copyToCube(const gl::Framebuffer& from, const gl::Object<gl::FramebufferTraits>& target,
                const gl::Texture& to, std::size_t face, int side) {
  from.bind();
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.name());
  glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, to.name(), 0,
                            static_cast<GLint>(face));
  glBlitFramebuffer(0, 0, from.width(), from.height(), 0, 0, side, side, GL_COLOR_BUFFER_BIT,
                    from.width() > side ? GL_LINEAR : GL_NEAREST);
}

}  // namespace prelight::viewer
