#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "prelight/light_profile.h"
#include "prelight/light_shape.h"
#include "prelight/measured_brdf.h"
#include "prelight/picture.h"

namespace prelight {

enum class WrapMode : std::uint8_t { Repeat, ClampToEdge, MirroredRepeat };

enum class TextureFilter : std::uint8_t { Linear, Nearest };

/// A material's use of an image; no image if `image` < 0.
struct TextureRef {
  int image = -1;             ///< into Scene::images
  int texCoord = 0;           ///< TEXCOORD_0 or TEXCOORD_1
  glm::mat3 transform{1.0f};  ///< KHR_texture_transform, applied to (u, v, 1)
  WrapMode wrapS = WrapMode::Repeat;
  WrapMode wrapT = WrapMode::Repeat;
  TextureFilter filter = TextureFilter::Linear;  ///< filter of magnification
};

/// KHR_materials_clearcoat: a layer of varnish over a material.
struct Clearcoat {
  float factor = 0.0f;  ///< share of the surface that is coated
  TextureRef texture;   ///< linear: R multiplies `factor`
  float roughness = 0.0f;
  TextureRef roughnessTexture;  ///< linear: G multiplies `roughness`
  TextureRef normalTexture;     ///< linear: normals in tangent space; without image: smooth
  float normalScale = 1.0f;     ///< scale of the normal's x and y
};

/// KHR_materials_anisotropy: microfacets that spread reflections more in one direction than in the other.
struct Anisotropy {
  float strength = 0.0f;
  /// Direction in which the surface is rougher: radians from the tangent to the bitangent.
  float rotation = 0.0f;
  TextureRef texture;  ///< linear: RG is the direction in tangent space, B multiplies the strength
};

/// KHR_materials_iridescence: a thin film between a material and what lies over it.
struct Iridescence {
  float factor = 0.0f;  ///< share of the surface that has a film
  TextureRef texture;   ///< linear: R multiplies `factor`
  float ior = 1.3f;
  float thicknessMinimum = 100.0f;  ///< nm, where the texture is 0
  float thicknessMaximum = 400.0f;  ///< nm, where the texture is 1 or missing
  TextureRef thicknessTexture;      ///< linear: G
};

/// KHR_materials_sheen: light scattered by fibres on a material, strongest at grazing angles.
struct Sheen {
  glm::vec3 color{0.0f};
  TextureRef colorTexture;  ///< sRGB
  float roughness = 0.0f;
  TextureRef roughnessTexture;  ///< linear: A multiplies `roughness`
};

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

/// Metallic-roughness material with the extensions that change light transport. Defaults are those of glTF.
struct Material {
  std::string name;
  glm::vec4 baseColor{1.0f};    ///< linear RGB, alpha
  TextureRef baseColorTexture;  ///< sRGB RGB, linear alpha
  float metallic = 1.0f;
  float roughness = 1.0f;
  TextureRef metallicRoughnessTexture;  ///< linear: G roughness, B metallic
  glm::vec3 emission{0.0f};             ///< emissiveFactor x emissiveStrength, W/(m2 sr)
  TextureRef emissiveTexture;           ///< sRGB
  TextureRef normalTexture;             ///< linear: normals in tangent space
  float normalScale = 1.0f;             ///< scale of the normal's x and y
  AlphaMode alphaMode = AlphaMode::Opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;
  bool unlit = false;
  float transmission = 0.0f;       ///< KHR_materials_transmission, [0,1]
  TextureRef transmissionTexture;  ///< linear: R multiplies it
  float thickness = 0.0f;          ///< KHR_materials_volume, > 0 means solid
  glm::vec3 attenuationColor{1.0f};
  float attenuationDistance = std::numeric_limits<float>::infinity();  ///< world-space metres
  float ior = 1.5f;                                                    ///< 0 means infinite
  float specular = 1.0f;                                               ///< KHR_materials_specular
  TextureRef specularTexture;                                          ///< linear: A multiplies it
  glm::vec3 specularColor{1.0f};
  TextureRef specularColorTexture;  ///< sRGB
  glm::vec3 multiscatterColor{
      0.0f};  ///< KHR_materials_volume_scatter, [0,1]: share of light that a thick body returns
  float scatterAnisotropy = 0.0f;  ///< [-1,1]: mean cosine of one scattering
  /// KHR_materials_diffuse_transmission, [0,1]: share of light that passes through.
  float diffuseTransmission = 0.0f;
  TextureRef diffuseTransmissionTexture;  ///< alpha, multiplies the share
  glm::vec3 diffuseTransmissionColor{1.0f};
  TextureRef diffuseTransmissionColorTexture;  ///< sRGB
  Clearcoat clearcoat;
  Sheen sheen;
  Anisotropy anisotropy;
  Iridescence iridescence;
  float dispersion = 0.0f;  ///< KHR_materials_dispersion: 20 over Abbe's number
  /// Measured reflection that replaces the other members, which approximate it where tables are not looked up
  /// (setMeasured() of host/scene/measured_brdf.h).
  std::shared_ptr<const MeasuredBrdf> measured = {};

  /// Returns the Lambertian albedo without textures: baseColor (1 - metallic)(1 - transmission)(1 - diffuse
  /// transmission).
  glm::vec3 diffuseAlbedo() const {
    return glm::vec3(baseColor) * (1.0f - metallic) * (1.0f - transmission) * (1.0f - diffuseTransmission);
  }
  bool isEmissive() const { return emission.x > 0.0f || emission.y > 0.0f || emission.z > 0.0f; }
};

/// Differences that a morph target of weight 1 adds to the vertices of a primitive. Attributes that it does
/// not change are empty.
struct MorphTarget {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec3> tangents;  ///< changes of the direction; the sign stays
  std::vector<glm::vec2> texCoords0;
  std::vector<glm::vec2> texCoords1;
  std::vector<glm::vec4> colors;
};

/// Changes of a triangle's orientation relative to the file (docs/conventions.md, "Sides"): a set of bits.
enum FaceTurn : std::uint8_t {
  CornersExchanged = 1,  ///< corners 1 and 2 are exchanged, which reverses the winding
  NormalsNegated = 2     ///< the normals of the vertices are negated
};

/// One glTF primitive in object space. Vertices keep the file's order, so that baked values can be written
/// back per vertex. Strips and fans are already converted to triangles. Primitives of points or lines have no
/// triangles.
struct Primitive {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;   ///< unit; empty when the file has none (flat shading, as glTF demands)
  std::vector<glm::vec4> tangents;  ///< xyz unit, w +-1 (bitangent = w n x t); empty when the file has none
  std::vector<glm::vec2> texCoords0;
  std::vector<glm::vec2> texCoords1;
  std::vector<glm::vec4> colors;         ///< linear RGBA of COLOR_0; empty means white
  std::vector<glm::uvec3> triangles;     ///< vertex indices, every one in range
  int material = -1;                     ///< index into Scene::materials; -1 means glTF's default material
  std::vector<std::uint8_t> turns = {};  ///< [triangle], FaceTurn bits; empty: all are as in the file
  bool bothSides = false;  ///< drawn and lit on both sides, although its material may be one-sided
  std::vector<MorphTarget> targets = {};
  std::size_t influences = 0;              ///< most joints per vertex; 0: no skin
  std::vector<std::uint32_t> joints = {};  ///< [vertex][influence], into Skin::joints
  std::vector<float> jointWeights = {};    ///< [vertex][influence], >= 0, sum 1
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<float> weights = {};  ///< [morph target], default for nodes without weights
};

/// Joints that deform the vertices of meshes.
struct Skin {
  std::string name;
  std::vector<std::size_t> joints;       ///< into Scene::nodes
  std::vector<glm::dmat4> inverseBind;   ///< [joint], from the mesh to the joint's space in the bind pose
  std::vector<glm::dmat4> toWorld = {};  ///< [joint], from the mesh to world space in the current pose
};

/// A node of the hierarchy with its transform to the parent: a matrix, or translation, rotation and scale.
struct SceneNode {
  int node = 0;     ///< index in the glTF file
  int parent = -1;  ///< into Scene::nodes, before this node; -1 for a root
  bool hasMatrix = false;
  glm::dmat4 matrix{1.0};
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit; w first
  glm::dvec3 scale{1.0};
};

/// A node that draws a mesh, once for each transform (more than one with EXT_mesh_gpu_instancing, whose base
/// mesh is not drawn).
struct MeshNode {
  int node = 0;  ///< index in the glTF file
  std::string name;
  int mesh = 0;
  /// Object to world, for column vectors. A skin leads to world space by itself, whatever its node's
  /// transform; with one, these are the identity or the transforms of the instances.
  std::vector<glm::dmat4> transforms;
  std::size_t sceneNode = 0;  ///< into Scene::nodes
  /// Object to node, one per entry of transforms; empty: not instanced.
  std::vector<glm::dmat4> instances = {};
  int skin = -1;                        ///< into Scene::skins; -1: none
  std::vector<float> restWeights = {};  ///< [morph target of the mesh], at rest
  std::vector<float> weights = {};      ///< [morph target of the mesh], in the current pose
};

enum class LightType : std::uint8_t { Directional, Point, Spot, Area };

/// A light in world space: KHR_lights_punctual, EXT_lights_ies, or an area light, which no file holds.
struct Light {
  LightType type = LightType::Point;
  std::string name;
  /// Colour x intensity: W/sr (point, spot), W/m2 (directional) or W/(m2 sr) (area).
  glm::vec3 intensity{1.0f};
  glm::dvec3 position{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};  ///< unit, direction of travel of the light
  float range = 0.0f;                    ///< metres; 0 means infinite
  float innerConeAngle = 0.0f;           ///< radians, spot only
  float outerConeAngle = 0.785398163f;
  /// Size of what has no shape, which makes shadows soft: radius in metres of a point or spot light's ball,
  /// half the angle in radians that a directional light's disk is seen at, at most pi/2. 0: none.
  float radius = 0.0f;
  std::size_t sceneNode = 0;  ///< index into Scene::nodes, for lights of the file
  /// Point lights only: multiplies the intensity, which then has no unit.
  std::shared_ptr<const LightProfile> profile = {};
  /// Unit X axis of a lamp with a profile, shape or cookie, perpendicular to the direction.
  glm::dvec3 side{1.0, 0.0, 0.0};
  /// Spot lights only: a linear picture that multiplies the light over the square around the outer cone.
  /// `side` is its left, seen from the lamp.
  std::shared_ptr<const Picture> cookie = {};
  /// Area lights only: the emitting shape, which faces the direction.
  std::shared_ptr<const LightShape> shape = {};

  bool operator==(const Light&) const = default;
};

struct Camera {
  std::string name;
  glm::dmat4 world{1.0};  ///< camera to world; looks along its -Z, +Y up
  bool perspective = true;
  double yFov = 0.785398163;  ///< radians
  double aspect = 0.0;        ///< width / height; 0: that of the picture
  double zNear = 0.01;
  double zFar = 0.0;  ///< 0 means infinite
  double xMag = 1.0;  ///< orthographic half width and half height
  double yMag = 1.0;
  std::size_t sceneNode = 0;  ///< index into Scene::nodes, or their count if no node carries the camera

  bool operator==(const Camera&) const = default;
};

enum class AnimatedPath : std::uint8_t { Translation, Rotation, Scale, Weights };

enum class Interpolation : std::uint8_t { Linear, Step, CubicSpline };

/// Values over time, as a glTF animation sampler gives them.
struct AnimationSampler {
  Interpolation interpolation = Interpolation::Linear;
  std::vector<float> times;  ///< [key], seconds, >= 0, strictly ascending, never empty
  /// [key], or [key][in-tangent, value, out-tangent] with cubic splines. Translations and scales are x, y, z;
  /// rotations are x, y, z, w; properties use as many as they have. Finite.
  std::vector<glm::vec4> values;
  /// Instead of values for morph weights: the same order, with one weight per target, [...][target].
  std::vector<float> weights = {};
  std::size_t targets = 0;  ///< number of morph targets in `weights`
};

struct AnimationChannel {
  std::size_t node = 0;  ///< into Scene::nodes
  AnimatedPath path = AnimatedPath::Translation;
  std::size_t sampler = 0;  ///< into Animation::samplers
};

/// Properties besides nodes that KHR_animation_pointer may change.
enum class AnimatedProperty : std::uint8_t {
  BaseColor,
  Metallic,
  Roughness,
  Emission,
  AlphaCutoff,
  NormalScale,
  Transmission,
  Thickness,
  AttenuationColor,
  AttenuationDistance,
  Ior,
  Specular,
  SpecularColor,
  DiffuseTransmission,
  DiffuseTransmissionColor,
  Clearcoat,
  ClearcoatRoughness,
  SheenColor,
  SheenRoughness,
  LightIntensity,
  LightRange,
  InnerConeAngle,
  OuterConeAngle,
  YFov,
  XMag,
  YMag,
};

struct PropertyChannel {
  AnimatedProperty property = AnimatedProperty::BaseColor;
  std::size_t object = 0;   ///< into Scene::materials, lights or cameras
  std::size_t sampler = 0;  ///< into Animation::samplers
  glm::vec4 rest{0.0f};     ///< value without animation
  glm::vec4 factor{1.0f};   ///< factor of the sampled values
  int factorSampler = -1;   ///< index into Animation::samplers, replaces `factor`; -1: none
};

/// The part of a glTF animation that moves nodes of the scene or changes properties.
struct Animation {
  std::string name;
  std::vector<AnimationSampler> samplers;
  std::vector<AnimationChannel> channels;
  std::vector<PropertyChannel> properties = {};

  /// Return the seconds of the first and the last key of all channels, 0 without channels.
  double startTime() const;
  double endTime() const;
};

/// Returns the value of a sampler at a time, clamped to the first and last key. Rotations are unit
/// quaternions; linear ones take the shorter way (glTF 2.0, appendix C), and a quaternion of length 0 counts
/// as no rotation.
glm::dvec4 sampleAt(const AnimationSampler& sampler, AnimatedPath path, double seconds);

/// Returns the morph weights of a sampler at a time, [morph target].
std::vector<float> weightsAt(const AnimationSampler& sampler, double seconds);

/// A moment of one of the animations in Scene::animations.
struct SceneMoment {
  std::size_t animation = 0;
  double seconds = 0.0;

  bool operator==(const SceneMoment&) const = default;
};

/// Findings about the sides of surfaces, which were corrected when the scene was read (docs/conventions.md,
/// "Sides"). Shares are relative to the area of all surfaces.
struct SurfaceSides {
  double woundBack = 0.0;              ///< share of triangles whose winding contradicted their normals
  std::size_t woundBackTriangles = 0;  ///< their number in meshes, however many instances these have
  double seenFromBehind = 0.0;         ///< share that shows cameras and lamps only its back
  std::vector<std::string> woundBackMeshes = {};      ///< names of the meshes
  std::vector<std::string> seenFromBehindNodes = {};  ///< names of the nodes
  std::vector<std::string> shutInLamps = {};  ///< one sentence per lamp whose light reaches no other surface
};

/// Content of a glTF file, resolved but not yet flattened: meshes in object space, everything else in world
/// space.
struct Scene {
  std::string name;
  std::vector<Mesh> meshes;
  std::vector<SceneNode> nodes;     ///< nodes of the scene, depth first, parents before children
  std::vector<MeshNode> meshNodes;  ///< in depth-first order of the scene's nodes
  std::vector<Skin> skins = {};     ///< skins of the mesh nodes
  std::vector<Material> materials;
  std::vector<Image> images;
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  std::vector<Animation> animations;       ///< all animations of the file, in its order
  std::optional<SceneMoment> moment = {};  ///< moment that the scene is posed at; none: at rest
  std::vector<std::string> scenes = {};    ///< names of all scenes of the file
  int chosen = -1;                         ///< index of this scene among `scenes`
  std::vector<std::string> variants = {};  ///< names of the file's material variants
  std::string variant = {};                ///< the variant that is applied; empty: the file's own materials
  SurfaceSides sides = {};

  /// Returns the material of a primitive, which is glTF's default material when it names none.
  const Material& materialOf(const Primitive& primitive) const;
};

}  // namespace prelight
