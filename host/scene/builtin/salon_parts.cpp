#include "scene/builtin/salon_parts.h"

#include <cmath>
#include <numbers>

#include "scene/builtin/surface_maps.h"

namespace prelight {

void SalonObject::add(MeshShape part, double side, const glm::dmat3& rotation, const glm::dvec3& where) {
  fitTexCoords(part, side, {hashed(parts_, 0, 11), hashed(parts_, 1, 11)});
  ++parts_;
  place(part, rotation, where);
  shape_.add(part);
}

void SalonObject::addSurface(const glm::dvec3& corner, const glm::dvec3& edgeU, const glm::dvec3& edgeV,
                             double cell, double side) {
  const auto cells = [&](const glm::dvec3& edge) {
    return std::max(1, static_cast<int>(std::lround(glm::length(edge) / cell)));
  };
  MeshShape grid = makeGrid(corner, edgeU, edgeV, cells(edgeU), cells(edgeV));
  const glm::dvec3 u = glm::normalize(edgeU) / side, v = glm::normalize(edgeV) / side;
  for (std::size_t i = 0; i < grid.positions.size(); ++i) {
    const glm::dvec3 p(grid.positions[i]);
    grid.texCoords[i] = glm::vec2(glm::dot(p, u), -glm::dot(p, v));
  }
  shape_.add(grid);
}

void SalonObject::addPlainBox(const glm::dvec3& size, const glm::dmat3& rotation, const glm::dvec3& where) {
  MeshShape box = makeBox(size, 1, true);
  place(box, rotation, where - rotation * glm::dvec3(0.0, 0.5 * size.y, 0.0));
  shape_.add(box);
}

void addLeaf(MeshShape& shape, const glm::dvec3& where, const glm::dvec3& along, const glm::dvec3& normal,
             double length) {
  const glm::dvec3 side = glm::normalize(glm::cross(normal, along));
  const glm::dvec3 front = glm::cross(along, side);
  const auto first = static_cast<std::uint32_t>(shape.positions.size());
  const double width = 0.24 * length;
  const glm::dvec3 rib = where + 0.5 * length * along - 0.05 * length * front;
  for (const glm::dvec3& p :
       {where, rib + width * side, where + length * along - 0.12 * length * front, rib - width * side}) {
    shape.positions.emplace_back(p);
    shape.normals.emplace_back(front);
    shape.texCoords.emplace_back(0.0f, 0.0f);
  }
  shape.triangles.emplace_back(first, first + 2, first + 1);
  shape.triangles.emplace_back(first, first + 3, first + 2);
}

void addLeafCloud(MeshShape& shape, const LeafCloud& cloud) {
  for (int i = 0; i < cloud.count; ++i) {
    const auto random = [&](int k) { return static_cast<double>(hashed(i, k, cloud.seed)); };
    const double z = 2.0 * random(0) - 1.0, turn = 2.0 * std::numbers::pi * random(1);
    const glm::dvec3 out(std::sqrt(1.0 - z * z) * std::cos(turn), z, std::sqrt(1.0 - z * z) * std::sin(turn));
    const double depth = cloud.hollow + (1.0 - cloud.hollow) * std::sqrt(random(2));
    // Lumps break the ellipsoid's outline.
    const double lumps = 1.0 + 0.16 * std::sin(4.0 * out.x + cloud.seed) * std::sin(5.0 * out.y + 2.0) +
                         0.12 * std::sin(7.0 * out.z + 3.0 * out.x);
    const glm::dvec3 jitter(random(3) - 0.5, random(4) - 0.5, random(5) - 0.5);
    const glm::dvec3 normal = glm::normalize(out + glm::dvec3(0.0, 0.5, 0.0) + 1.6 * jitter);
    const glm::dvec3 aside(random(6) - 0.5, random(7) - 0.65, random(8) - 0.5);
    const glm::dvec3 along = glm::normalize(aside - normal * glm::dot(aside, normal));
    addLeaf(shape, cloud.centre + cloud.radius * out * (depth * lumps), along, normal,
            cloud.size * (0.7 + 0.6 * random(9)));
  }
}

}  // namespace prelight
