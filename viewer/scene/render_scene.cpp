#include "viewer/scene/render_scene.h"

#include "gpu/albedo_table.h"
#include "gpu/surface_upload.h"
#include "scene/lobes.h"
#include "scene/surface/tangent_space.h"
#include "viewer/scene/tex_coords.h"

namespace prelight::viewer {
namespace {

bool sameTexture(const TextureRef& a, const TextureRef& b) {
  return a.image == b.image && a.wrapS == b.wrapS && a.wrapT == b.wrapT && a.filter == b.filter;
}

bool hasNoHoles(const Surface& surface) {
  return surface.material.alphaMode == AlphaMode::Opaque && surface.passes == 0.0f;
}

}  // namespace

void drawTriangles(const TriangleRange& range) {
  const std::size_t offset = std::size_t{range.first} * sizeof(glm::uvec3);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.count * 3), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(offset));
}

RenderScene::RenderScene(const RenderInputs& inputs) {
  Image white{"white", 1, 1, {255, 255, 255, 255}};
  white_ = gl::makeImageTexture(white, false, {});
  makeSurfaces(inputs);
  makeBatches(inputs.compiled);
  makeVertices(inputs);
  glBindVertexArray(0);
  gl::check("uploading the scene");
}

void RenderScene::makeSurfaces(const RenderInputs& inputs) {
  surfaces_ = surfacesOf(inputs);
  for (Surface& surface : surfaces_)
    for (SurfaceTexture& slot : surface.textures)
      if (slot.use.image >= 0) slot.texture = texture(inputs.scene, slot.use, slot.srgb);
}

void RenderScene::makeAlbedos(const CompiledScene& compiled) {
  const SceneAlbedos albedos = surfaceAlbedos(compiled, surfaces_);
  if (!albedos.texels.empty()) albedos_ = gl::makeBufferTexture(albedos.texels, "reflectances");
}

TextureHandle RenderScene::texture(const Scene& scene, const TextureRef& use, bool srgb) {
  for (const LoadedTexture& loaded : textures_)
    if (loaded.srgb == srgb && sameTexture(loaded.use, use)) return loaded.texture.get();
  textures_.push_back(
      {use, srgb, std::make_unique<gl::Texture>(gl::makeImageTexture(scene.images[use.image], srgb, use))});
  return textures_.back().texture.get();
}

void RenderScene::makeBatches(const CompiledScene& compiled) {
  blocks_ = TriangleBlocks(compiled);
  batches_ = batchesOf(compiled, surfaces_);
  occluders_.clear();
  for (const Batch& batch : batches_) {
    const bool whole = hasNoHoles(surfaces_[batch.surface]);
    if (!occluders_.empty() && whole && hasNoHoles(surfaces_[occluders_.back().surface]))
      occluders_.back().triangleCount += batch.triangleCount;
    else
      occluders_.push_back(batch);
  }
}

void RenderScene::fillPositions(const CompiledScene& compiled) {
  streams_.front().fill(std::span<const glm::vec3>(compiled.positions));
  blocks_ = TriangleBlocks(compiled);
  for (Batch& batch : batches_) batch.center = centerOf(compiled, batch);
}

template <typename T>
void RenderScene::fillAttribute(Attribute attribute, const std::vector<T>& values) const {
  for (const VertexStream& stream : streams_)
    if (stream.attribute() == attribute) stream.fill(std::span<const T>(values));
}

void RenderScene::fillVertices(const CompiledScene& compiled) {
  fillAttribute(Attribute::Position, compiled.positions);
  fillAttribute(Attribute::Normal, compiled.normals);
  fillAttribute(Attribute::TexCoords, texCoords(compiled));
  fillAttribute(Attribute::Color, compiled.colors);
  const auto refill = [](const gl::Buffer& buffer, const auto& values) {
    buffer.fill(GL_TEXTURE_BUFFER, std::span(values), GL_DYNAMIC_DRAW);
  };
  refill(triangles_, compiled.triangles);
  refill(triangleNormals_.buffer, geometricNormals(compiled));
  if (compiled.needsTangents()) refill(tangents_.buffer, cornerTangents(compiled));
  makeBatches(compiled);
}

void RenderScene::fillSurfaces(const RenderInputs& inputs) {
  makeSurfaces(inputs);
  makeAlbedos(inputs.compiled);
}

void RenderScene::drawOccluders(const ShownTriangles& shown,
                                const std::function<void(const Surface&)>& setSurface) const {
  glBindVertexArray(vertexArray_.name());
  glVertexAttrib4f(static_cast<GLuint>(Attribute::Color), 1.0f, 1.0f, 1.0f, 1.0f);
  for (const Batch& batch : occluders_) {
    setSurface(surfaces_[batch.surface]);
    shown.forEach(batch.triangles(), drawTriangles);
  }
  glBindVertexArray(0);
}

template <typename T>
void RenderScene::addAttribute(Attribute attribute, std::span<const T> values) {
  streams_.emplace_back(attribute, values);
  streams_.back().attach();
}

void RenderScene::makeVertices(const RenderInputs& inputs) {
  const CompiledScene& compiled = inputs.compiled;
  glBindVertexArray(vertexArray_.name());
  addAttribute(Attribute::Position, std::span(compiled.positions));
  addAttribute(Attribute::Normal, std::span(compiled.normals));
  const std::vector<glm::vec4> coords = texCoords(compiled);
  if (!coords.empty()) addAttribute(Attribute::TexCoords, std::span(coords));
  if (compiled.hasVertexColors()) addAttribute(Attribute::Color, std::span(compiled.colors));
  triangles_.fill(GL_ELEMENT_ARRAY_BUFFER, std::span(compiled.triangles), GL_STATIC_DRAW);
  triangleNormals_ = gl::makeBufferTexture(geometricNormals(compiled), "triangle normals");
  if (compiled.needsTangents()) tangents_ = gl::makeBufferTexture(cornerTangents(compiled), "tangents");
  makeAlbedos(compiled);
  triangleCorners_ = gl::textureOfBuffer(triangles_, compiled.triangles.size(), GL_RGB32UI, "triangles");
  cornerPositions_ =
      gl::textureOfBuffer(streams_.front().buffer(), compiled.positions.size(), GL_RGB32F, "positions");
}

}  // namespace prelight::viewer
