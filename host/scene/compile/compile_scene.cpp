#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "base/magnitudes.h"
#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "scene/compile/compile_parts.h"
#include "scene/compile/emission_parts.h"
#include "scene/deform.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

/// One drawing of one primitive: the unit of flattening.
struct Draw {
  const MeshNode* node = nullptr;
  const Primitive* primitive = nullptr;
  PrimitiveRange range;
  glm::dmat4 transform{1.0};
};

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  bool empty() const { return low.x > high.x; }
  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

std::string placeOf(const Draw& draw) {
  return fmt::format("node \"{}\" (/nodes/{}), primitive {}", draw.node->name, draw.range.node,
                     draw.range.primitive);
}

std::vector<Draw> listDraws(const Scene& scene, const DrawnMeshes& drawn) {
  std::vector<Draw> draws;
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  for (std::size_t n = 0; n < scene.meshNodes.size(); ++n) {
    const MeshNode& node = scene.meshNodes[n];
    const Mesh& mesh = drawn.meshOf(n);
    for (std::size_t instance = 0; instance < node.transforms.size(); ++instance) {
      const glm::dmat4 transform = drawn.transformOf(n, instance);
      for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
        const Primitive& primitive = mesh.primitives[p];
        Draw draw{&node, &primitive, {}, transform};
        draw.range.node = node.node;
        draw.range.name = node.name;
        draw.range.mesh = node.mesh;
        draw.range.primitive = static_cast<int>(p);
        draw.range.instance = static_cast<int>(instance);
        draw.range.firstVertex = static_cast<std::uint32_t>(vertices);
        // Points and lines have vertices but no surface to bake on.
        const std::size_t used = primitive.triangles.empty() ? 0 : primitive.positions.size();
        draw.range.vertexCount = static_cast<std::uint32_t>(used);
        vertices += used;
        triangles += primitive.triangles.size();
        draws.push_back(draw);
      }
    }
    if (std::max(vertices, triangles) >= std::numeric_limits<std::uint32_t>::max()) {
      throw InputError(
          fmt::format("node \"{}\" (/nodes/{})", node.name, node.node),
          fmt::format("{} vertices and {} triangles so far, expected fewer than 2^32", vertices, triangles));
    }
  }
  return draws;
}

glm::dvec3 worldPosition(const Draw& draw, std::size_t vertex) {
  return glm::dvec3(draw.transform * glm::dvec4(glm::dvec3(draw.primitive->positions[vertex]), 1.0));
}

Bounds worldBounds(const std::vector<Draw>& draws) {
  Bounds bounds;
  for (const Draw& draw : draws) {
    for (const glm::uvec3& triangle : draw.primitive->triangles) {
      for (int corner = 0; corner < 3; ++corner) bounds.add(worldPosition(draw, triangle[corner]));
    }
  }
  return bounds;
}

/// Returns true when tangents are used. glTF ignores a file's tangents where it has no normals.
bool hasTangents(const CompiledScene& scene, const Draw& draw) {
  const int material = draw.primitive->material;
  return material >= 0 && !draw.primitive->tangents.empty() && !draw.primitive->normals.empty() &&
         scene.materials[static_cast<std::size_t>(material)].needsTangents();
}

/// The compiled scene's materials of primitives.
class MaterialNumbers {
 public:
  /// `scene` must have its materials already.
  explicit MaterialNumbers(const CompiledScene& scene) {
    for (std::uint32_t m = 0; m < scene.materials.size(); ++m) {
      const int source = scene.materials[m].source;
      if (!plain_.emplace(source, m).second) bothSides_.emplace(source, m);
    }
  }

  std::uint32_t of(const Primitive& primitive) const {
    const auto copy = primitive.bothSides ? bothSides_.find(primitive.material) : bothSides_.end();
    return copy != bothSides_.end() ? copy->second : plain_.at(primitive.material);
  }

 private:
  std::map<int, std::uint32_t> plain_, bothSides_;  ///< by CompiledMaterial::source
};

class Flattener {
 public:
  /// `sets`: number of sets of texture coordinates that are needed.
  Flattener(CompiledScene& scene, int sets) : scene_(scene), numbers_(scene), sets_(sets) {}

  void add(Draw& draw) {
    addPositions(draw);
    addTriangles(draw);
    addNormals(draw);
    if (sets_ > 0) addTexCoords(draw, draw.primitive->texCoords0, scene_.texCoords);
    if (sets_ > 1) addTexCoords(draw, draw.primitive->texCoords1, scene_.texCoords1);
    if (scene_.hasVertexColors()) addColors(draw);
    if (!scene_.tangents.empty()) addTangents(draw);
    scene_.primitives.push_back(draw.range);
  }

 private:
  void addPositions(const Draw& draw) {
    for (std::size_t i = 0; i < draw.range.vertexCount; ++i) {
      const glm::dvec3 world = worldPosition(draw, i);
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(world[axis]) <= largestInput) continue;
        throw InputError(
            placeOf(draw),
            fmt::format("vertex {} is at ({:g}, {:g}, {:g}) m, expected coordinates within {:g} m", i,
                        world.x, world.y, world.z, largestInput),
            "check the transforms of the node and its ancestors");
      }
      scene_.positions.emplace_back(world - scene_.origin);
    }
  }

  void addTriangles(Draw& draw) {
    draw.range.firstTriangle = scene_.triangleCount();
    const bool flip = mirrors(draw.transform);
    const std::uint32_t material = numbers_.of(*draw.primitive);
    const std::vector<std::uint8_t>& turns = draw.primitive->turns;
    if (!turns.empty()) scene_.triangleTurns.resize(scene_.triangleCount(), 0);
    for (std::size_t t = 0; t < draw.primitive->triangles.size(); ++t) {
      glm::uvec3 triangle = draw.primitive->triangles[t];
      if (flip) std::swap(triangle.y, triangle.z);
      triangle += glm::uvec3(draw.range.firstVertex);
      scene_.triangles.push_back(triangle);
      // Below float's normal range the device would see zero as well.
      if (!(glm::length(geometricNormal(scene_, scene_.triangleCount() - 1)) >
            std::numeric_limits<float>::min())) {
        scene_.triangles.pop_back();
        ++scene_.droppedTriangles;
        continue;
      }
      scene_.triangleMaterials.push_back(material);
      scene_.triangleFlat.push_back(draw.primitive->normals.empty() ? 1 : 0);
      if (!turns.empty()) scene_.triangleTurns.push_back(turns[t]);
    }
    if (!scene_.triangleTurns.empty()) scene_.triangleTurns.resize(scene_.triangleCount(), 0);
    draw.range.triangleCount = scene_.triangleCount() - draw.range.firstTriangle;
  }

  void addNormals(const Draw& draw) {
    const bool flat = draw.primitive->normals.empty();
    const glm::dmat3 matrix = normalMatrix(draw.transform);
    std::vector<glm::dvec3> normals(draw.range.vertexCount, glm::dvec3(0.0));
    bool complete = !flat;
    for (std::size_t i = 0; !flat && i < normals.size(); ++i) {
      normals[i] = unitOrZero(matrix * glm::dvec3(draw.primitive->normals[i]));
      complete = complete && normals[i] != glm::dvec3(0.0);
    }
    if (!complete) fillFromFaces(draw, normals);
    for (const glm::dvec3& normal : normals) scene_.normals.emplace_back(normal);
  }

  /// Sets normals that are still zero to the area-weighted mean of the adjacent faces, or to +Y where there
  /// are none.
  void fillFromFaces(const Draw& draw, std::vector<glm::dvec3>& normals) const {
    std::vector<glm::dvec3> sums(normals.size(), glm::dvec3(0.0));
    for (std::uint32_t t = 0; t < draw.range.triangleCount; ++t) {
      const std::uint32_t triangle = draw.range.firstTriangle + t;
      const glm::dvec3 normal = geometricNormal(scene_, triangle);
      for (int corner = 0; corner < 3; ++corner) {
        sums[scene_.triangles[triangle][corner] - draw.range.firstVertex] += normal;
      }
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (normals[i] == glm::dvec3(0.0)) normals[i] = unitOrZero(sums[i]);
      if (normals[i] == glm::dvec3(0.0)) normals[i] = {0.0, 1.0, 0.0};
    }
  }

  static void addTexCoords(const Draw& draw, const std::vector<glm::vec2>& source,
                           std::vector<glm::vec2>& coords) {
    for (std::size_t i = 0; i < draw.range.vertexCount; ++i) {
      const glm::vec2 uv = source.empty() ? glm::vec2(0.0f) : source[i];
      coords.push_back(std::isfinite(uv.x) && std::isfinite(uv.y) ? uv : glm::vec2(0.0f));
    }
  }

  void addColors(const Draw& draw) {
    const std::vector<glm::vec4>& source = draw.primitive->colors;
    for (std::size_t i = 0; i < draw.range.vertexCount; ++i) {
      scene_.colors[draw.range.firstVertex + i] = source.empty() ? glm::vec4(1.0f) : source[i];
    }
  }

  /// A mirroring transform reverses the bitangent, which the cross product would not do.
  void addTangents(const Draw& draw) {
    if (!hasTangents(scene_, draw)) return;
    const glm::dmat3 matrix(draw.transform);
    const float mirror = mirrors(draw.transform) ? -1.0f : 1.0f;
    for (std::size_t i = 0; i < draw.range.vertexCount; ++i) {
      const glm::vec4& tangent = draw.primitive->tangents[i];
      const glm::dvec3 world = unitOrZero(matrix * glm::dvec3(tangent));
      if (world != glm::dvec3(0.0))
        scene_.tangents[draw.range.firstVertex + i] = {glm::vec3(world), mirror * tangent.w};
    }
  }

  CompiledScene& scene_;
  MaterialNumbers numbers_;
  int sets_;
};

/// Returns true for each material of the compiled scene that a triangle has.
std::vector<bool> drawnMaterials(const std::vector<Draw>& draws, const CompiledScene& scene) {
  const MaterialNumbers numbers(scene);
  std::vector<bool> drawn(scene.materials.size(), false);
  for (const Draw& draw : draws)
    if (!draw.primitive->triangles.empty()) drawn[numbers.of(*draw.primitive)] = true;
  return drawn;
}

int texCoordSets(const CompiledScene& scene, const std::vector<bool>& drawn) {
  int sets = 0;
  for (std::size_t m = 0; m < drawn.size(); ++m)
    if (drawn[m]) {
      if (scene.materials[m].needsTangents()) sets = std::max(sets, 1);
      for (const TextureRef& texture : scene.materials[m].textures())
        if (texture.image >= 0) sets = std::max(sets, texture.texCoord + 1);
    }
  return sets;
}

void copyImages(const Scene& scene, std::span<const TextureRef> textures, CompiledScene& compiled) {
  for (const TextureRef& texture : textures) {
    if (texture.image < 0) continue;
    compiled.images.resize(scene.images.size());
    const auto image = static_cast<std::size_t>(texture.image);
    if (compiled.images[image].rgba.empty()) compiled.images[image] = scene.images[image];
  }
}

/// Copies the images that rays look up.
void copyImages(const Scene& scene, const std::vector<bool>& drawn, CompiledScene& compiled) {
  for (std::size_t m = 0; m < drawn.size(); ++m) {
    if (!drawn[m]) continue;
    const CompiledMaterial& material = compiled.materials[m];
    copyImages(scene, material.albedoTextures(), compiled);
    if (isPane(material)) copyImages(scene, material.paneTextures(), compiled);
  }
}

/// Returns true when vertex colours change a picture, at any weights of the morph targets.
bool isColored(const Scene& source, const Draw& draw) {
  const Primitive& primitive = source.meshes[static_cast<std::size_t>(draw.range.mesh)]
                                   .primitives[static_cast<std::size_t>(draw.range.primitive)];
  const auto has = [](const auto& part) { return !part.colors.empty(); };
  return std::any_of(primitive.colors.begin(), primitive.colors.end(),
                     [](const glm::vec4& color) { return color != glm::vec4(1.0f); }) ||
         (has(primitive) && std::any_of(primitive.targets.begin(), primitive.targets.end(), has));
}

void reserveArrays(const Scene& source, const std::vector<Draw>& draws, int sets, CompiledScene& scene) {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  bool colored = false;
  bool tangential = false;
  for (const Draw& draw : draws) {
    vertices += draw.range.vertexCount;
    triangles += draw.primitive->triangles.size();
    colored = colored || (draw.range.vertexCount > 0 && isColored(source, draw));
    tangential = tangential || hasTangents(scene, draw);
  }
  scene.positions.reserve(vertices);
  scene.normals.reserve(vertices);
  if (sets > 0) scene.texCoords.reserve(vertices);
  if (sets > 1) scene.texCoords1.reserve(vertices);
  if (colored) scene.colors.resize(vertices, glm::vec4(1.0f));
  if (tangential) scene.tangents.resize(vertices, glm::vec4(0.0f));
  scene.triangles.reserve(triangles);
  scene.triangleMaterials.reserve(triangles);
  scene.triangleFlat.reserve(triangles);
}

}  // namespace

std::array<TextureRef, 3> CompiledMaterial::albedoTextures() const {
  const bool diffuse = albedo != glm::vec3(0.0f);
  return {diffuse || alphaCutoff >= 0.0f ? baseColorTexture : TextureRef{},
          diffuse && metallic > 0.0f ? surfaceTexture : TextureRef{},
          diffuse && transmission > 0.0f ? transmissionTexture : TextureRef{}};
}

std::array<TextureRef, 13> CompiledMaterial::paneTextures() const {
  return {baseColorTexture,
          surfaceTexture,
          normalTexture,
          transmissionTexture,
          specularTexture,
          specularColorTexture,
          clearcoat.texture,
          clearcoat.roughnessTexture,
          clearcoat.normalTexture,
          sheen.colorTexture,
          sheen.roughnessTexture,
          iridescence.texture,
          iridescence.thicknessTexture};
}

std::array<TextureRef, 17> CompiledMaterial::textures() const {
  return {baseColorTexture,
          surfaceTexture,
          normalTexture,
          emissionTexture,
          transmissionTexture,
          specularTexture,
          specularColorTexture,
          translucencyTexture,
          translucentColorTexture,
          clearcoat.texture,
          clearcoat.roughnessTexture,
          clearcoat.normalTexture,
          sheen.colorTexture,
          sheen.roughnessTexture,
          anisotropy.texture,
          iridescence.texture,
          iridescence.thicknessTexture};
}

bool CompiledScene::hasAlbedoTextures() const {
  return anyTriangle(*this, [](const CompiledMaterial& material) {
    const auto textures = material.albedoTextures();
    return std::any_of(textures.begin(), textures.end(), [](const TextureRef& t) { return t.image >= 0; });
  });
}

bool CompiledScene::needsTangents() const {
  return std::any_of(triangleMaterials.begin(), triangleMaterials.end(),
                     [&](std::uint32_t material) { return materials[material].needsTangents(); });
}

bool CompiledScene::hasAlphaMask() const {
  return std::any_of(triangleMaterials.begin(), triangleMaterials.end(),
                     [&](std::uint32_t material) { return materials[material].alphaCutoff >= 0.0f; });
}

bool CompiledScene::hasDiffuseTransmission() const {
  return std::any_of(triangleMaterials.begin(), triangleMaterials.end(), [&](std::uint32_t material) {
    const glm::vec3 t = materials[material].diffuseTransmission;
    return t.x > 0.0f || t.y > 0.0f || t.z > 0.0f;
  });
}

glm::dvec3 geometricNormal(const CompiledScene& scene, std::uint32_t triangle) {
  const glm::uvec3& t = scene.triangles[triangle];
  const glm::dvec3 a(scene.positions[t.x]);
  return glm::cross(glm::dvec3(scene.positions[t.y]) - a, glm::dvec3(scene.positions[t.z]) - a);
}

namespace {

/// Returns the parts of a compiled scene that no pose changes; the rest is empty.
CompiledScene withoutGeometry(CompiledScene& scene) {
  CompiledScene kept;
  kept.materials = std::move(scene.materials);
  kept.images = std::move(scene.images);
  return kept;
}

/// Adds the meshes to a compiled scene that has materials and no geometry yet. Returns [material] whether it
/// is drawn. `origin` none: the centre of the bounds.
std::vector<bool> addGeometry(const Scene& scene, CompiledScene& compiled,
                              const std::optional<glm::dvec3>& origin = std::nullopt) {
  const DrawnMeshes meshes(scene);
  std::vector<Draw> draws = listDraws(scene, meshes);
  std::vector<bool> drawn = drawnMaterials(draws, compiled);
  const int sets = texCoordSets(compiled, drawn);
  const Bounds bounds = worldBounds(draws);
  if (!bounds.empty()) compiled.origin = bounds.low + 0.5 * (bounds.high - bounds.low);
  if (origin) compiled.origin = *origin;
  reserveArrays(scene, draws, sets, compiled);
  Flattener flattener(compiled, sets);
  for (Draw& draw : draws) flattener.add(draw);
  findShapes(scene, meshes, compiled);
  if (!bounds.empty()) {
    compiled.boundsMin = glm::vec3(bounds.low - compiled.origin);
    compiled.boundsMax = glm::vec3(bounds.high - compiled.origin);
  }
  return drawn;
}

}  // namespace

void flattenAnew(const Scene& scene, CompiledScene& compiled, const std::optional<glm::dvec3>& origin) {
  CompiledScene flat = withoutGeometry(compiled);
  flat.lights = scene.lights;
  addGeometry(scene, flat, origin);
  flat.emissionParts = followEmission(std::move(compiled.emissionParts), compiled, flat);
  compiled = std::move(flat);
}

CompiledScene compileScene(const Scene& scene, Warnings& warnings) {
  CompiledScene compiled;
  compiled.lights = scene.lights;
  compiled.materials = compileMaterials(scene);
  const std::vector<bool> drawn = addGeometry(scene, compiled);
  copyImages(scene, drawn, compiled);
  compiled.emissionParts = findEmissionParts(compiled, scene.images);
  if (compiled.droppedTriangles > 0) {
    warnings.push_back(fmt::format("scene: {} triangles of no area are left out", compiled.droppedTriangles));
  }
  return compiled;
}

}  // namespace prelight
