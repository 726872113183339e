#pragma once

#include <numbers>

#include "scene/builtin/gltf_builder.h"
#include "scene/builtin/rounded_shapes.h"
#include "scene/builtin/salon_materials.h"

namespace prelight {

/// Extents of the room and of its window's opening, m. The court lies behind the window's wall, towards -z.
namespace salon {
constexpr double left = -2.4, right = 2.4, back = -2.2, front = 3.4, roomHeight = 3.0;
constexpr double wall = 0.35;  ///< thickness
constexpr double windowLeft = -1.7, windowRight = 0.5, windowHeight = 2.5;
constexpr double courtLevel = -0.16;
constexpr double degrees = std::numbers::pi / 180.0;
}  // namespace salon

/// Builds an object from shapes that share a material.
class SalonObject {
 public:
  /// Adds a shape whose texture coordinates are in metres, with a texture of `side` metres shifted at random.
  void add(MeshShape shape, double side, const glm::dmat3& rotation, const glm::dvec3& place);
  void add(MeshShape shape, double side, const glm::dvec3& place) {
    add(std::move(shape), side, glm::dmat3(1.0), place);
  }
  /// Adds a rectangle as makeGrid does, with texture coordinates from its place in space.
  void addSurface(const glm::dvec3& corner, const glm::dvec3& edgeU, const glm::dvec3& edgeV, double cell,
                  double side);
  /// Adds a box with sharp edges, of 12 triangles, centred at the place.
  void addPlainBox(const glm::dvec3& size, const glm::dmat3& rotation, const glm::dvec3& place);
  void addBox(const RoundedBox& box, double side, const glm::dvec3& place) {
    add(makeRoundedBox(box), side, place);
  }
  const MeshShape& shape() const { return shape_; }
  MeshShape& shape() { return shape_; }

 private:
  MeshShape shape_;
  int parts_ = 0;
};

/// Adds leaves, each of two triangles, at places and with directions that a seed determines.
struct LeafCloud {
  glm::dvec3 centre{0.0};
  glm::dvec3 radius{1.0};  ///< m, of the ellipsoid
  double hollow = 0.5;     ///< share of the radius without leaves
  double size = 0.07;      ///< length of a leaf, m
  int count = 1000;
  std::uint32_t seed = 1;
};
void addLeafCloud(MeshShape& shape, const LeafCloud& cloud);
/// Adds one leaf of this length at a place, along a direction, that faces a normal's side.
void addLeaf(MeshShape& shape, const glm::dvec3& place, const glm::dvec3& along, const glm::dvec3& normal,
             double length);

void addSalonRoom(GltfBuilder& builder, const SalonMaterials& materials);
void addSalonFurniture(GltfBuilder& builder, const SalonMaterials& materials);
void addSalonTable(GltfBuilder& builder, const SalonMaterials& materials);
void addSalonCourt(GltfBuilder& builder, const SalonMaterials& materials);

}  // namespace prelight
