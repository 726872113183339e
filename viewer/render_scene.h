#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "viewer/drawn_transfer.h"
#include "viewer/gl/buffer.h"
#include "viewer/gl/texture.h"
#include "viewer/render.h"

namespace prelight::viewer {

/// A texture of a material; null is one white texel.
using TextureHandle = const gl::Texture*;

/// What textures of a surface tell.
enum class TextureSlot : std::uint8_t {
  BaseColor,
  MetallicRoughness,
  Emissive,
  Normal,
  Transmission,
  Specular,
  SpecularColor,
  Coat,
  CoatRoughness,
  CoatNormal,
  SheenColor,
  SheenRoughness,
  Anisotropy,
  Film,
  FilmThickness
};

constexpr std::size_t surfaceTextures = 15;

struct SurfaceTexture {
  TextureHandle texture = nullptr;
  TextureRef use;
};

/// How the triangles of a batch look.
struct Surface {
  Material material;
  std::array<SurfaceTexture, surfaceTextures> textures;

  glm::vec3 absorption{0.0f};    ///< inside a body, 1/m
  glm::vec4 translucency{0.0f};  ///< light that comes through diffusely: colour x share, share
  std::uint32_t filmTable = 0;   ///< where that of its film begins in albedos()
  std::uint32_t glassTable = 0;  ///< the same of what its glass scatters
  int measured = -1;             ///< as measuredNumbers()
  bool showsSurroundings =
      false;  ///< mirrors, glass, narrow lobes and metals, which reflect nothing diffusely

  const SurfaceTexture& at(TextureSlot slot) const { return textures[static_cast<std::size_t>(slot)]; }
  bool has(TextureSlot slot) const { return at(slot).texture != nullptr; }

  /// Glass with an inside.
  bool isBody() const { return material.transmission > 0.0f && material.thickness > 0.0f; }

  /// Drawn over what lies behind, after everything opaque.
  bool isBlended() const { return material.alphaMode == AlphaMode::Blend || material.transmission > 0.0f; }
};

/// Consecutive triangles of one surface.
struct Batch {
  std::uint32_t surface = 0;
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangleCount = 0;
  glm::vec3 center{0.0f};  ///< of its bounds, to sort what is blended
  int node = -1;           ///< of a surface that shows its surroundings: the glTF node it belongs to
};

/// Draws a batch of the scene whose vertex array is in use.
void drawTriangles(const Batch& batch);

/// A scene as OpenGL objects of the current context; nothing in it depends on a bake, lights or camera.
/// Triangle normals are a buffer texture of RGBA32F: geometric normal, and 1 where a triangle shades flat,
/// else 0.
class RenderScene {
 public:
  explicit RenderScene(const RenderInputs& inputs);
  RenderScene(const RenderScene&) = delete;  // surfaces point into its textures
  RenderScene& operator=(const RenderScene&) = delete;

  const std::vector<Surface>& surfaces() const { return surfaces_; }
  const std::vector<Batch>& batches() const { return batches_; }
  const gl::VertexArray& vertexArray() const { return vertexArray_; }
  const gl::Texture& triangleNormals() const { return triangleNormals_.texture; }

  /// As makeSceneAlbedos() has them; empty where nothing reflects specularly.
  const gl::Texture& albedos() const { return albedos_.texture; }
  const gl::Texture& triangles() const { return triangleCorners_; }  ///< [triangle], vertices
  const gl::Texture& tangents() const { return tangents_.texture; }  ///< [triangle][corner]
  const gl::Texture& positions() const { return cornerPositions_; }  ///< [vertex]
  const gl::Texture& white() const { return white_; }

  /// Takes the vertices to other places.
  void fillPositions(const CompiledScene& compiled);

  /// The same, of vertices that carry something else too, and of triangles, as they are in other poses.
  void fillVertices(const CompiledScene& compiled);

  /// Replaces what materials say; textures stay.
  void fillSurfaces(const RenderInputs& inputs);

  /// Draws all triangles with the program in use, both sides of them, as what stands in the light's way;
  /// `setSurface` is called before those of a surface that has holes and once for all that have none.
  void drawOccluders(const std::function<void(const Surface&)>& setSurface) const;

 private:
  struct LoadedTexture {
    TextureRef use;
    bool srgb = false;
    std::unique_ptr<gl::Texture> texture;
  };

  void makeSurfaces(const RenderInputs& inputs);
  void makeAlbedos(const CompiledScene& compiled);
  SurfaceTexture texture(const Scene& scene, const TextureRef& use, bool srgb);
  void makeBatches(const CompiledScene& compiled);
  void makeVertices(const RenderInputs& inputs);
  template <typename T>
  void addAttribute(Attribute attribute, std::span<const T> values);
  template <typename T>
  void fillAttribute(Attribute attribute, const std::vector<T>& values) const;

  gl::VertexArray vertexArray_;
  std::vector<VertexStream> streams_;
  gl::Buffer triangles_;
  gl::BufferTexture triangleNormals_;
  gl::BufferTexture albedos_;
  gl::BufferTexture tangents_;   ///< of normal textures
  gl::Texture triangleCorners_;  ///< of `triangles_`
  gl::Texture cornerPositions_;  ///< of the first stream
  gl::Texture white_;
  std::vector<LoadedTexture> textures_;
  std::vector<Surface> surfaces_;
  std::vector<Batch> batches_;
  std::vector<Batch> occluders_;  ///< batches, those without holes that follow each other joined
};

}  // namespace prelight::viewer
