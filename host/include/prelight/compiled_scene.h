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

/// A primitive's place in the flat arrays of CompiledScene. Vertices keep the file's order.
struct PrimitiveRange {
  int node = 0;       ///< glTF node
  int primitive = 0;  ///< index within the node's mesh
  int instance = 0;   ///< of EXT_mesh_gpu_instancing; 0 otherwise
  std::uint32_t firstVertex = 0;
  std::uint32_t vertexCount = 0;
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangleCount = 0;
  std::string name = {};  ///< of the node; may be empty
  int mesh = -1;          ///< into Scene::meshes
};

/// A mesh that is drawn more than once with the same triangles, in a space of its own.
struct CompiledShape {
  std::uint32_t firstTriangle = 0;  ///< of the drawing whose triangles stand for those of all
  std::uint32_t triangleCount = 0;
  std::uint32_t firstVertex = 0;
  std::uint32_t vertexCount = 0;
  std::vector<glm::vec3> positions;  ///< [vertex], relative to the centre of the mesh's bounds
};

/// One of a shape's drawings. Its triangles and vertices lie in the flat arrays too, as many and in the same
/// order as the shape's, and only positions and normals differ.
struct CompiledInstance {
  std::uint32_t shape = 0;  ///< into CompiledScene::shapes
  std::uint32_t firstTriangle = 0;
  std::uint32_t firstVertex = 0;
  glm::dmat4 toWorld{1.0};  ///< from the shape's space to the scene's
};

/// What light transport needs to know of a material. Bakes read the Lambertian albedo, the emission and
/// the coverage; what follows light reads the rest. Images of textures are of Scene::images; a factor that
/// has a texture multiplies it.
struct CompiledMaterial {
  /// Of the body; multiplies baseColorTexture and the vertex colour, and where metalness or transmission have
  /// a texture also the share that is neither (see albedoTextures).
  glm::vec3 albedo{0.0f};
  glm::vec3 diffuseTransmission{0.0f};  ///< share of the light on the other side that leaves on this one
  glm::vec3 emission{0.0f};             ///< W/(m2 sr); multiplies its texture
  float alphaCutoff = -1.0f;            ///< < 0: opaque; otherwise texels with alpha below it are holes
  float alphaFactor = 1.0f;             ///< multiplies the texture's alpha
  bool blended = false;                 ///< no cutoff: alpha is the share of the surface that is there
  bool doubleSided = false;

  glm::vec3 baseColor{0.0f};    ///< linear; multiplies its texture and vertex colour
  TextureRef baseColorTexture;  ///< sRGB; A is the coverage
  float metallic = 0.0f;
  float roughness = 1.0f;
  TextureRef surfaceTexture;       ///< linear: G roughness, B metalness
  TextureRef normalTexture;        ///< linear: normals in tangent space
  float normalScale = 1.0f;        ///< of its x and y
  TextureRef emissionTexture;      ///< sRGB
  float transmission = 0.0f;       ///< share of the dielectric that is glass
  TextureRef transmissionTexture;  ///< linear: R
  bool solid = false;              ///< glass with an inside, which refracts
  float ior = 1.5f;                ///< 0: infinite
  glm::vec3 absorption{0.0f};      ///< inside, of what is solid, 1/m
  float specular = 0.0f;           ///< strength of a dielectric's reflection; 0: pure Lambert
  TextureRef specularTexture;      ///< linear: A
  glm::vec3 specularColor{1.0f};
  TextureRef specularColorTexture;  ///< sRGB
  glm::vec3 scattering{0.0f};      ///< inside, share of what `absorption` takes that is scattered on; 0: none
  float scatterAnisotropy = 0.0f;  ///< mean cosine of one scattering
  float translucency = 0.0f;       ///< share of the body's light that leaves on the other side
  float meanTranslucency = 0.0f;   ///< the same times the mean of its texture
  TextureRef translucencyTexture;  ///< linear: A
  glm::vec3 translucentColor{1.0f};    ///< of that light
  TextureRef translucentColorTexture;  ///< sRGB
  Clearcoat clearcoat;
  Sheen sheen;
  Anisotropy anisotropy;
  Iridescence iridescence;
  float dispersion = 0.0f;                            ///< of solid glass: 20 over Abbe's number
  std::shared_ptr<const MeasuredBrdf> measured = {};  ///< as Material has it
  bool unlit = false;
  int source = -1;  ///< into Scene::materials; -1: none of them

  /// Textures of base colour, metalness and transmission, as far as the albedo or the coverage depends on
  /// them.
  std::array<TextureRef, 3> albedoTextures() const;
  /// Textures that decide how much light goes straight through, where it is thin and smooth glass.
  std::array<TextureRef, 13> paneTextures() const;
  /// All textures; those that it has not are among them, without images.
  std::array<TextureRef, 17> textures() const;

  /// Whether it is drawn by tangents: it has a normal texture or is anisotropic.
  bool needsTangents() const {
    return normalTexture.image >= 0 || clearcoat.normalTexture.image >= 0 || anisotropy.strength > 0.0f;
  }
};

/// Parts of emissive triangles that show about one colour each, of scenes whose emission has textures or
/// holes. A triangle, or a part of one, is cut at the middles of its edges into four: those at its corners 0,
/// 1 and 2, and the one between them, turned around.
struct EmissionParts {
  static constexpr std::uint32_t dark = 0xffffffffu;  ///< a reference to nothing: no light leaves there
  static constexpr std::uint32_t leaf = 0x80000000u;  ///< a reference | this: the part of that number

  struct Part {
    glm::vec2 origin{0.0f};  ///< weights of the triangle's vertices 1 and 2 at the part's corner 0
    float scale = 1.0f;      ///< its edges over the triangle's; negative: it is turned around
    glm::vec3 color{0.0f};   ///< mean over it of texture and coverage, linear
  };

  std::vector<Part> parts;
  std::vector<std::array<std::uint32_t, 4>> nodes;  ///< references to the four parts of what was cut
  std::vector<std::uint32_t> roots;  ///< [triangle] references; empty: every emissive triangle emits evenly
};

/// The scene as flat world-space arrays, ready for BVH, receivers and device buffers. Triangles of zero area
/// are dropped and counted; winding is flipped where a transform mirrors, so that geometric normals point to
/// the front, which is the same to all that reads the scene. Positions are relative to `origin` (the centre
/// of the bounds), which keeps float32 precise far from zero.
struct CompiledScene {
  glm::dvec3 origin{0.0};
  std::vector<glm::vec3> positions;   ///< [vertex], world minus origin
  std::vector<glm::vec3> normals;     ///< [vertex], unit shading normals (area-weighted mean where flat)
  std::vector<glm::vec2> texCoords;   ///< [vertex], the file's first set; (0,0) where it has none
  std::vector<glm::vec2> texCoords1;  ///< [vertex], the second; empty when no material asks for it
  /// [vertex], unit, w +-1; 0 where the file has none; empty when no material needs them or no primitive with
  /// such a material has some.
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec4> colors;      ///< [vertex], linear; empty when no primitive has vertex colours
  std::vector<glm::uvec3> triangles;  ///< [triangle], vertex indices
  std::vector<std::uint32_t> triangleMaterials;  ///< [triangle], into materials
  std::vector<std::uint8_t>
      triangleFlat;  ///< [triangle], 1: shade with the geometric normal (file has no normals)
  /// [triangle], bits of FaceTurn: how it lies against the file's; empty: all lie as there.
  std::vector<std::uint8_t> triangleTurns;
  /// Scene::materials, then glTF's default material, then two-sided copies for Primitive::bothSides.
  std::vector<CompiledMaterial> materials;
  std::vector<Image> images;  ///< [as Scene::images], those of albedo and panes; the others have no texels
  std::vector<PrimitiveRange> primitives;
  std::vector<CompiledShape> shapes;
  std::vector<CompiledInstance> instances;  ///< firstTriangle ascends
  EmissionParts emissionParts;
  std::vector<Light> lights;  ///< punctual, in world space as in Scene
  glm::vec3 boundsMin{0.0f};  ///< relative to origin
  glm::vec3 boundsMax{0.0f};
  std::uint64_t droppedTriangles = 0;  ///< zero area

  std::uint32_t vertexCount() const { return static_cast<std::uint32_t>(positions.size()); }
  std::uint32_t triangleCount() const { return static_cast<std::uint32_t>(triangles.size()); }
  bool hasAlbedoTextures() const;
  bool needsTangents() const;  ///< some triangle's material does
  bool hasAlphaMask() const;
  bool hasDiffuseTransmission() const;  ///< of a triangle's material
  bool hasVertexColors() const { return !colors.empty(); }
};

/// Flattens a scene. Accepts an empty one.
CompiledScene compileScene(const Scene& scene, Warnings& warnings);

/// Unnormalised geometric normal of a triangle (twice its area long).
glm::dvec3 geometricNormal(const CompiledScene& scene, std::uint32_t triangle);

}  // namespace prelight
