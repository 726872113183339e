#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/scene.h"
#include "viewer/gl/buffer.h"

namespace prelight::viewer::gl {

using Texture = Object<TextureTraits>;

/// A mipmapped texture of an image that wraps and filters as `use` says; `srgb` decodes RGB when it is
/// sampled. Rows top to bottom lie at v = 0..1, as glTF has it. Throws Error when the image is larger than
/// OpenGL allows.
Texture makeImageTexture(const Image& image, bool srgb, const TextureRef& use);

/// A mipmapped RGB float texture, repeating in u.
Texture makeFloatTexture(int width, int height, std::span<const glm::vec3> texels);

/// An RGB float texture with the given mip levels, [level][row][column], each half as wide and high as the
/// one before; repeating in u and bilinear within a level.
Texture makeFloatLevels(int width, int height, std::span<const std::vector<glm::vec3>> levels);

/// Layers of RGB floats, bilinear within a layer, with undefined texels. Throws Error when OpenGL does not
/// allow as many or as large ones; `what` names the data.
Texture makeFloatArray(int side, int layers, const char* what);

/// Layers of 32-bit float depths, looked up without filter. Throws as makeFloatArray.
Texture makeDepthArray(int side, int layers, const char* what);

/// Sets a rectangle of a layer, from its corner (x, y, layer).
void fillFloatArray(const Texture& texture, const glm::ivec3& corner, const glm::ivec2& size,
                    std::span<const glm::vec3> texels);

/// Texels of a buffer as vec4, addressed by number. The buffer belongs to the texture.
struct BufferTexture {
  Buffer buffer;
  Texture texture;
};

/// The texture of a buffer of `count` texels, which outlives it. Throws Error when OpenGL does not allow as
/// many; `what` names the data.
Texture textureOfBuffer(const Buffer& buffer, std::size_t count, GLenum format, const char* what);

/// `count` texels of an OpenGL format. Throws Error when OpenGL does not allow as many; `what` names the
/// data.
BufferTexture makeBufferTexture(std::span<const std::byte> bytes, std::size_t count, GLenum format,
                                const char* what);

/// Elements of T as texels of `format`, `perTexel` of them each.
template <typename T>
BufferTexture makeBufferTexture(std::span<const T> values, std::size_t perTexel, GLenum format,
                                const char* what) {
  return makeBufferTexture(std::as_bytes(values), values.size() / perTexel, format, what);
}

/// RGBA32F.
BufferTexture makeBufferTexture(std::span<const glm::vec4> texels, const char* what);

/// Binds a texture to a unit.
void bind(GLuint unit, GLenum target, const Texture& texture);

}  // namespace prelight::viewer::gl
