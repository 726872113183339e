#include "viewer/gl/texture.h"

#include <string>

#include "prelight/error.h"

namespace prelight::viewer::gl {
namespace {

GLint limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

GLint wrap(WrapMode mode) {
  switch (mode) {
    case WrapMode::ClampToEdge:
      return GL_CLAMP_TO_EDGE;
    case WrapMode::MirroredRepeat:
      return GL_MIRRORED_REPEAT;
    case WrapMode::Repeat:
      break;
  }
  return GL_REPEAT;
}

void checkSize(const std::string& name, int width, int height) {
  const int largest = limit(GL_MAX_TEXTURE_SIZE);
  if (width <= largest && height <= largest) return;
  throw Error(ExitCode::RuntimeFailure, name.empty() ? "image" : "image " + name,
              std::to_string(width) + "x" + std::to_string(height) + " texels; OpenGL here takes up to " +
                  std::to_string(largest) + " a side",
              "scale the image down");
}

void setMipmapped(GLint wrapS, GLint wrapT) {
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrapS);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrapT);
}

struct ArrayFormat {
  GLint stored;
  GLenum given;
};

Texture makeArray(int side, int layers, ArrayFormat format, const char* what) {
  const int mostSide = limit(GL_MAX_TEXTURE_SIZE), mostLayers = limit(GL_MAX_ARRAY_TEXTURE_LAYERS);
  if (side > mostSide || layers > mostLayers) {
    throw Error(ExitCode::RuntimeFailure, what,
                std::to_string(layers) + " layers of " + std::to_string(side) +
                    " texels a side; OpenGL here takes " + std::to_string(mostLayers) + " of " +
                    std::to_string(mostSide),
                "bake fewer texels");
  }
  Texture texture;
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, format.stored, side, side, layers, 0, format.given, GL_FLOAT, nullptr);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D_ARRAY, wrap, GL_CLAMP_TO_EDGE);
  check(std::string("making ") + what);
  return texture;
}

/// Sets how the array that is bound is looked up.
void setArrayFilter(GLint filter) {
  for (const GLenum name : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D_ARRAY, name, filter);
}

}  // namespace

Texture makeImageTexture(const Image& image, bool srgb, const TextureRef& use) {
  checkSize(image.name, image.width, image.height);
  Texture texture;
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, image.width, image.height, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, image.rgba.data());
  noteUpload(image.rgba.size());
  setMipmapped(wrap(use.wrapS), wrap(use.wrapT));
  if (use.filter == TextureFilter::Nearest) glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  // No anisotropic filtering: llvmpipe's breaks magnified textures along the diagonals.
  check("uploading the image " + image.name);
  return texture;
}

Texture makeFloatTexture(int width, int height, std::span<const glm::vec3> texels) {
  checkSize("environment", width, height);
  Texture texture;
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, width, height, 0, GL_RGB, GL_FLOAT, texels.data());
  noteUpload(texels.size_bytes());
  setMipmapped(GL_REPEAT, GL_CLAMP_TO_EDGE);
  check("uploading a float texture");
  return texture;
}

Texture makeFloatLevels(int width, int height, std::span<const std::vector<glm::vec3>> levels) {
  Texture texture;
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    glTexImage2D(GL_TEXTURE_2D, static_cast<GLint>(level), GL_RGB32F, width >> level, height >> level, 0,
                 GL_RGB, GL_FLOAT, levels[level].data());
    noteUpload(std::span(levels[level]).size_bytes());
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(levels.size()) - 1);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  check("uploading levels of a float texture");
  return texture;
}

Texture makeFloatArray(int side, int layers, const char* what) {
  Texture texture = makeArray(side, layers, {GL_RGB32F, GL_RGB}, what);
  setArrayFilter(GL_LINEAR);
  return texture;
}

Texture makeDepthArray(int side, int layers, const char* what) {
  Texture texture = makeArray(side, layers, {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT}, what);
  setArrayFilter(GL_NEAREST);
  return texture;
}

void fillFloatArray(const Texture& texture, const glm::ivec3& corner, const glm::ivec2& size,
                    std::span<const glm::vec3> texels) {
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, corner.x, corner.y, corner.z, size.x, size.y, 1, GL_RGB, GL_FLOAT,
                  texels.data());
  noteUpload(texels.size_bytes());
  check("filling a layer of a texture");
}

Texture textureOfBuffer(const Buffer& buffer, std::size_t count, GLenum format, const char* what) {
  const auto largest = static_cast<std::size_t>(limit(GL_MAX_TEXTURE_BUFFER_SIZE));
  if (count > largest) {
    throw Error(ExitCode::RuntimeFailure, what,
                std::to_string(count) + " texels; OpenGL here takes up to " + std::to_string(largest),
                "use a lower order or a smaller scene");
  }
  Texture texture;
  bind(0, GL_TEXTURE_BUFFER, texture);  // what other units have stays
  glTexBuffer(GL_TEXTURE_BUFFER, format, buffer.name());
  check(std::string("uploading ") + what);
  return texture;
}

BufferTexture makeBufferTexture(std::span<const std::byte> bytes, std::size_t count, GLenum format,
                                const char* what) {
  Buffer buffer(GL_TEXTURE_BUFFER, bytes);
  Texture texture = textureOfBuffer(buffer, count, format, what);
  return {std::move(buffer), std::move(texture)};
}

BufferTexture makeBufferTexture(std::span<const glm::vec4> texels, const char* what) {
  return makeBufferTexture(texels, 1, GL_RGBA32F, what);
}

void bind(GLuint unit, GLenum target, const Texture& texture) {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(target, texture.name());
}

}  // namespace prelight::viewer::gl
