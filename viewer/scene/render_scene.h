#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "viewer/core/render_inputs.h"
#include "viewer/gl/buffer.h"
#include "viewer/gl/texture.h"
#include "viewer/scene/surface.h"
#include "viewer/scene/triangle_blocks.h"
#include "viewer/scene/vertex_stream.h"

namespace prelight::viewer {

/// Draws triangles of the scene whose vertex array is in use.
void drawTriangles(const TriangleRange& range);

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
  const TriangleBlocks& blocks() const { return blocks_; }
  const gl::VertexArray& vertexArray() const { return vertexArray_; }
  const gl::Texture& triangleNormals() const { return triangleNormals_.texture; }

  /// Returns the tables of makeSceneAlbedos(); empty if nothing reflects specularly.
  const gl::Texture& albedos() const { return albedos_.texture; }
  const gl::Texture& triangles() const { return triangleCorners_; }  ///< [triangle], vertices
  const gl::Texture& tangents() const { return tangents_.texture; }  ///< [triangle][corner]
  const gl::Texture& positions() const { return cornerPositions_; }  ///< [vertex]
  const gl::Texture& white() const { return white_; }

  /// Moves the vertices to their places in `compiled`.
  void fillPositions(const CompiledScene& compiled);

  /// Replaces all that vertices carry and the triangles, as another pose has them.
  void fillVertices(const CompiledScene& compiled);

  /// Replaces what materials say; textures stay.
  void fillSurfaces(const RenderInputs& inputs);

  /// Draws the triangles that a view may show with the program in use, both sides of them, as what stands in
  /// the light's way; `setSurface` is called before those of a surface that has holes and once for all that
  /// have none.
  void drawOccluders(const ShownTriangles& shown,
                     const std::function<void(const Surface&)>& setSurface) const;

 private:
  struct LoadedTexture {
    TextureRef use;
    bool srgb = false;
    std::unique_ptr<gl::Texture> texture;
  };

  void makeSurfaces(const RenderInputs& inputs);
  void makeAlbedos(const CompiledScene& compiled);
  TextureHandle texture(const Scene& scene, const TextureRef& use, bool srgb);
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
  TriangleBlocks blocks_;
  std::vector<Batch> batches_;
  std::vector<Batch> occluders_;  ///< batches, those without holes that follow each other joined
};

}  // namespace prelight::viewer
