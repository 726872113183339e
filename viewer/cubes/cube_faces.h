#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/texture.h"

/// Cube maps that are drawn face by face, in OpenGL's order of faces.
namespace prelight::viewer {

/// Faces that a picture draws anew where it spreads such work over several pictures.
constexpr std::size_t facesAPicture = 2;

constexpr std::size_t facesOfACube = 6;

/// Returns the camera of a face for a cube at a place of the world.
Camera cubeFaceCamera(const glm::dvec3& world, std::size_t face, double near);

/// The nearest that a cube map around something of a radius shows: what lies close behind a surface would
/// show through it if depth began at nothing, and small things in large scenes are to see what lies near
/// them.
double nearestInCube(const CompiledScene& compiled, float radius);

/// A layer for each cube, RGBA32F, black.
gl::Texture makeCubeMaps(int side, std::size_t count, bool mipmapped);

/// Fills a face of `side` texels of the array, [cube][face], from a picture of twice the side, whose samples
/// are averaged, or of half of it, whose samples are repeated.
void copyToCube(const gl::Framebuffer& from, const gl::Object<gl::FramebufferTraits>& target,
                const gl::Texture& to, std::size_t face, int side);

}  // namespace prelight::viewer
