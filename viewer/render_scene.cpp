#include "viewer/render_scene.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>

#include "gpu/scene_albedos.h"
#include "gpu/surface_arrays.h"
#include "photon/caustic_casters.h"
#include "scene/lobes.h"
#include "scene/tangent_space.h"
#include "viewer/measured_lobes.h"
#include "viewer/tex_coords.h"

namespace prelight::viewer {
namespace {

bool sameTexture(const TextureRef& a, const TextureRef& b) {
  return a.image == b.image && a.wrapS == b.wrapS && a.wrapT == b.wrapT && a.filter == b.filter;
}

/// The first triangle of every primitive and its node, in order: blended batches and those that show their
/// surroundings end where a primitive does.
std::map<std::uint32_t, int> primitiveStarts(const CompiledScene& compiled) {
  std::map<std::uint32_t, int> starts;
  for (const PrimitiveRange& range : compiled.primitives)
    if (range.triangleCount > 0) starts[range.firstTriangle] = range.node;
  return starts;
}

constexpr float metallic = 0.5f;  ///< surfaces with more of it reflect little diffusely

bool mirrors(const CompiledMaterial& material) {
  return makesCaustics(material) || isGlass(material) || (!material.unlit && material.metallic >= metallic);
}

glm::vec3 centerOf(const CompiledScene& compiled, const Batch& batch) {
  glm::vec3 lower(std::numeric_limits<float>::max());
  glm::vec3 upper(std::numeric_limits<float>::lowest());
  for (std::uint32_t t = 0; t < batch.triangleCount; ++t) {
    const glm::uvec3 corners = compiled.triangles[batch.firstTriangle + t];
    for (int k = 0; k < 3; ++k) {
      lower = glm::min(lower, compiled.positions[corners[k]]);
      upper = glm::max(upper, compiled.positions[corners[k]]);
    }
  }
  return 0.5f * (lower + upper);
}

bool hasNoHoles(const Surface& surface) { return surface.material.alphaMode == AlphaMode::Opaque; }

std::vector<glm::vec4> geometricNormals(const CompiledScene& compiled) {
  std::vector<glm::vec4> normals;
  normals.reserve(compiled.triangles.size());
  for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t) {
    const glm::dvec3 normal = geometricNormal(compiled, t);
    const double length = glm::length(normal);
    const glm::dvec3 unit = length > 0.0 ? normal / length : glm::dvec3(0.0, 1.0, 0.0);
    const bool flat = t < compiled.triangleFlat.size() && compiled.triangleFlat[t] != 0;
    normals.emplace_back(glm::vec3(unit), flat ? 1.0f : 0.0f);
  }
  return normals;
}

}  // namespace

void drawTriangles(const Batch& batch) {
  const std::size_t offset = std::size_t{batch.firstTriangle} * sizeof(glm::uvec3);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(batch.triangleCount * 3), GL_UNSIGNED_INT,
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
  const std::vector<int> measured = measuredNumbers(inputs.compiled);
  for (std::size_t i = 0; i < inputs.compiled.materials.size(); ++i) {
    Surface surface;
    surface.material = materialAt(inputs.scene, inputs.compiled, i);
    surface.showsSurroundings = mirrors(inputs.compiled.materials[i]);
    const CompiledMaterial& compiled = inputs.compiled.materials[i];
    surface.absorption = compiled.absorption;
    surface.measured = measured[i];
    surface.translucency = glm::vec4(compiled.diffuseTransmission, compiled.meanTranslucency);
    const Material& m = surface.material;
    const Scene& scene = inputs.scene;
    surface.textures = {
        texture(scene, m.baseColorTexture, true),
        texture(scene, m.metallicRoughnessTexture, false),
        texture(scene, m.emissiveTexture, true),
        texture(scene, inputs.normalTextures ? m.normalTexture : TextureRef{}, false),
        texture(scene, m.transmissionTexture, false),
        texture(scene, m.specularTexture, false),
        texture(scene, m.specularColorTexture, true),
        texture(scene, m.clearcoat.texture, false),
        texture(scene, m.clearcoat.roughnessTexture, false),
        texture(scene, inputs.normalTextures ? m.clearcoat.normalTexture : TextureRef{}, false),
        texture(scene, m.sheen.colorTexture, true),
        texture(scene, m.sheen.roughnessTexture, false),
        texture(scene, m.anisotropy.texture, false),
        texture(scene, m.iridescence.texture, false),
        texture(scene, m.iridescence.thicknessTexture, false)};
    surfaces_.push_back(std::move(surface));
  }
}

void RenderScene::makeAlbedos(const CompiledScene& compiled) {
  const std::vector<bool> used = usedMaterials(compiled);
  bool lookedUp = false;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const CompiledMaterial& m = compiled.materials[i];
    lookedUp = lookedUp || (used[i] && (reflectsSpecularly(m) || hasLayers(m) || isRoughGlass(m)));
  }
  if (!lookedUp) return;
  const SceneAlbedos albedos = makeSceneAlbedos(compiled, used);
  albedos_ = gl::makeBufferTexture(albedos.texels, "reflectances");
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    surfaces_[i].filmTable = albedos.filmTables[i];
    surfaces_[i].glassTable = albedos.glassTables[i];
  }
}

SurfaceTexture RenderScene::texture(const Scene& scene, const TextureRef& use, bool srgb) {
  if (use.image < 0 || static_cast<std::size_t>(use.image) >= scene.images.size()) return {};
  for (const LoadedTexture& loaded : textures_) {
    if (loaded.srgb == srgb && sameTexture(loaded.use, use)) return {loaded.texture.get(), use};
  }
  textures_.push_back(
      {use, srgb, std::make_unique<gl::Texture>(gl::makeImageTexture(scene.images[use.image], srgb, use))});
  return {textures_.back().texture.get(), use};
}

void RenderScene::makeBatches(const CompiledScene& compiled) {
  batches_.clear();
  occluders_.clear();
  const std::map<std::uint32_t, int> starts = primitiveStarts(compiled);
  for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t) {
    const std::uint32_t surface = compiled.triangleMaterials[t];
    const bool goesOn =
        !batches_.empty() && batches_.back().surface == surface &&
        !((surfaces_[surface].isBlended() || surfaces_[surface].showsSurroundings) && starts.contains(t));
    if (goesOn) {
      ++batches_.back().triangleCount;
    } else {
      batches_.push_back({surface, t, 1, {}});
      const auto primitive = starts.upper_bound(t);
      if (surfaces_[surface].showsSurroundings && primitive != starts.begin())
        batches_.back().node = std::prev(primitive)->second;
    }
  }
  for (Batch& batch : batches_) {
    batch.center = centerOf(compiled, batch);
    const bool whole = hasNoHoles(surfaces_[batch.surface]);
    if (!occluders_.empty() && whole && hasNoHoles(surfaces_[occluders_.back().surface]))
      occluders_.back().triangleCount += batch.triangleCount;
    else
      occluders_.push_back(batch);
  }
}

void RenderScene::fillPositions(const CompiledScene& compiled) {
  streams_.front().fill(std::span<const glm::vec3>(compiled.positions));
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
  surfaces_.clear();
  makeSurfaces(inputs);
  makeAlbedos(inputs.compiled);
}

void RenderScene::drawOccluders(const std::function<void(const Surface&)>& setSurface) const {
  glBindVertexArray(vertexArray_.name());
  glVertexAttrib4f(static_cast<GLuint>(Attribute::Color), 1.0f, 1.0f, 1.0f, 1.0f);
  for (const Batch& batch : occluders_) {
    setSurface(surfaces_[batch.surface]);
    drawTriangles(batch);
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
