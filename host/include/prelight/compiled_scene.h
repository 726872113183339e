#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "prelight/error.h"
#include "prelight/scene.h"

namespace prelight {

/// A primitive's ranges in the flat arrays of CompiledScene. Vertices keep the file's order.
struct PrimitiveRange {
  int node = 0;       ///< glTF node
  int primitive = 0;  ///< index within the node's mesh
  int instance = 0;   ///< index in EXT_mesh_gpu_instancing, else 0
  std::uint32_t firstVertex = 0;
  std::uint32_t vertexCount = 0;
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangleCount = 0;
  std::string name = {};  ///< name of the node; may be empty
  int mesh = -1;          ///< into Scene::meshes
};

/// A mesh that several nodes or instances draw with the same triangles, in a space of its own.
struct CompiledShape {
  std::uint32_t firstTriangle = 0;  ///< first triangle of the instance whose triangles the others share
  std::uint32_t triangleCount = 0;
  std::uint32_t firstVertex = 0;
  std::uint32_t vertexCount = 0;
  std::vector<glm::vec3> positions;  ///< [vertex], relative to the centre of the mesh's bounds
};

/// One instance of a shape. Its triangles and vertices also lie in the flat arrays, in the shape's number and
/// order; only positions and normals differ.
struct CompiledInstance {
  std::uint32_t shape = 0;  ///< into CompiledScene::shapes
  std::uint32_t firstTriangle = 0;
  std::uint32_t firstVertex = 0;
  glm::dmat4 toWorld{1.0};  ///< from the shape's space to the world
};

/// The part of a material that light transport needs. Bakes read the Lambertian albedo, the emission and the
/// coverage; path and photon tracing read the rest. Texture references index Scene::images. A factor that has
/// a texture multiplies it.
struct CompiledMaterial {
  /// Albedo of the diffuse body. It multiplies baseColorTexture and the vertex colour and, where metalness or
  /// transmission have a texture, also the share that is neither (see albedoTextures).
  glm::vec3 albedo{0.0f};
  glm::vec3 diffuseTransmission{0.0f};  ///< share of the light on the other side that leaves on this side
  glm::vec3 emission{0.0f};             ///< W/(m2 sr); multiplies its texture
  float alphaCutoff = -1.0f;            ///< below 0: opaque; otherwise texels with a smaller alpha are holes
  float alphaFactor = 1.0f;             ///< multiplies the texture's alpha
  bool blended = false;  ///< if there is no cutoff: alpha is the fraction of the surface that is present
  bool doubleSided = false;

  glm::vec3 baseColor{0.0f};    ///< linear; multiplies its texture and the vertex colour
  TextureRef baseColorTexture;  ///< sRGB; A is the coverage
  float metallic = 0.0f;
  float roughness = 1.0f;
  TextureRef surfaceTexture;       ///< linear: G roughness, B metalness
  TextureRef normalTexture;        ///< linear: normals in tangent space
  float normalScale = 1.0f;        ///< scale of the normal's x and y
  TextureRef emissionTexture;      ///< sRGB
  float transmission = 0.0f;       ///< share of the dielectric that is glass
  TextureRef transmissionTexture;  ///< linear: R
  bool solid = false;              ///< glass with an inside, which refracts
  float ior = 1.5f;                ///< 0: infinite
  glm::vec3 absorption{0.0f};      ///< 1/m, inside a solid
  float specular = 0.0f;           ///< strength of a dielectric's reflection; 0: pure Lambert
  TextureRef specularTexture;      ///< linear: A
  glm::vec3 specularColor{1.0f};
  TextureRef specularColorTexture;  ///< sRGB
  /// Inside a solid: share of the absorbed light that is scattered instead; 0: none.
  glm::vec3 scattering{0.0f};
  float scatterAnisotropy = 0.0f;      ///< mean cosine of one scattering
  float translucency = 0.0f;           ///< share of the diffuse light that leaves on the other side
  float meanTranslucency = 0.0f;       ///< translucency times the mean of its texture
  TextureRef translucencyTexture;      ///< linear: A
  glm::vec3 translucentColor{1.0f};    ///< colour of the light on the other side
  TextureRef translucentColorTexture;  ///< sRGB
  Clearcoat clearcoat;
  Sheen sheen;
  Anisotropy anisotropy;
  Iridescence iridescence;
  float dispersion = 0.0f;                            ///< solid glass: 20 over Abbe's number
  std::shared_ptr<const MeasuredBrdf> measured = {};  ///< as in Material
  bool unlit = false;
  int source = -1;  ///< index into Scene::materials; -1: none

  /// Returns the textures of base colour, metalness and transmission, as far as the albedo or the coverage
  /// depends on them.
  std::array<TextureRef, 3> albedoTextures() const;
  /// Returns the textures that decide how much light passes straight through thin, smooth glass.
  std::array<TextureRef, 13> paneTextures() const;
  /// Returns all textures. Missing ones are included and have no image.
  std::array<TextureRef, 17> textures() const;

  /// Returns whether shading needs tangents: for a normal texture or anisotropy.
  bool needsTangents() const {
    return normalTexture.image >= 0 || clearcoat.normalTexture.image >= 0 || anisotropy.strength > 0.0f;
  }
};

/// Subdivision of emissive triangles into parts of about one colour, for scenes whose emission has textures
/// or holes. A triangle or part is cut at the middles of its edges into four: those at its corners 0, 1 and
/// 2, and the middle one, which is turned around.
struct EmissionParts {
  /// Reference that stands for no part: no light leaves there.
  static constexpr std::uint32_t dark = 0xffffffffu;
  /// Flag of a reference whose other bits are the index of a part.
  static constexpr std::uint32_t leaf = 0x80000000u;

  struct Part {
    glm::vec2 origin{0.0f};  ///< weights of the triangle's vertices 1 and 2 at the part's corner 0
    float scale = 1.0f;      ///< edge length over the triangle's; negative: turned around
    glm::vec3 color{0.0f};   ///< linear mean of texture and coverage over the part
  };

  std::vector<Part> parts;
  /// References to the four parts of each subdivided triangle or part.
  std::vector<std::array<std::uint32_t, 4>> nodes;
  std::vector<std::uint32_t> roots;  ///< [triangle], references; empty: every emissive triangle emits evenly
};

/// The scene as flat world-space arrays, ready for BVH, receivers and device buffers. Triangles of zero area
/// are dropped and counted. Winding is flipped where a transform mirrors, so that geometric normals always
/// point to the front. Positions are relative to `origin`, the centre of the bounds, which keeps float32
/// precise far from zero.
struct CompiledScene {
  glm::dvec3 origin{0.0};
  std::vector<glm::vec3> positions;   ///< [vertex], world minus origin
  std::vector<glm::vec3> normals;     ///< [vertex], unit shading normals (area-weighted mean where flat)
  std::vector<glm::vec2> texCoords;   ///< [vertex], the file's first set; (0,0) where there is none
  std::vector<glm::vec2> texCoords1;  ///< [vertex], the second set; empty when no material uses it
  /// [vertex], unit, w is 1 or -1; 0 where the file has none. Empty when no material needs tangents or no
  /// primitive with such a material has any.
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec4> colors;      ///< [vertex], linear; empty when no primitive has vertex colours
  std::vector<glm::uvec3> triangles;  ///< [triangle], vertex indices
  std::vector<std::uint32_t> triangleMaterials;  ///< [triangle], into materials
  /// [triangle], 1: shade with the geometric normal, as the file has no normals.
  std::vector<std::uint8_t> triangleFlat;
  /// [triangle], FaceTurn bits relative to the file; empty: all triangles are as in the file.
  std::vector<std::uint8_t> triangleTurns;
  /// Scene::materials, then glTF's default material, then two-sided copies for Primitive::bothSides.
  std::vector<CompiledMaterial> materials;
  std::vector<Image> images;  ///< [as Scene::images]; only those of albedo and panes have texels
  std::vector<PrimitiveRange> primitives;
  std::vector<CompiledShape> shapes;
  std::vector<CompiledInstance> instances;  ///< firstTriangle ascends
  EmissionParts emissionParts;
  std::vector<Light> lights;  ///< punctual lights in world space, as in Scene
  glm::vec3 boundsMin{0.0f};  ///< relative to origin
  glm::vec3 boundsMax{0.0f};
  std::uint64_t droppedTriangles = 0;  ///< dropped because their area is zero

  std::uint32_t vertexCount() const { return static_cast<std::uint32_t>(positions.size()); }
  std::uint32_t triangleCount() const { return static_cast<std::uint32_t>(triangles.size()); }
  bool hasAlbedoTextures() const;
  bool needsTangents() const;  ///< whether the material of any triangle does
  bool hasAlphaMask() const;
  bool hasDiffuseTransmission() const;  ///< whether the material of any triangle has it
  bool hasVertexColors() const { return !colors.empty(); }
};

/// Flattens a scene, which may be empty. Adds warnings about usable oddities.
CompiledScene compileScene(const Scene& scene, Warnings& warnings);

/// Returns the geometric normal of a triangle, whose length is twice the triangle's area.
glm::dvec3 geometricNormal(const CompiledScene& scene, std::uint32_t triangle);

}  // namespace prelight
