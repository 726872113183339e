#pragma once

#include <functional>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "shared/ray_types.h"

namespace prelight::test {

/// Twice the number of times that the mesh winds around `point`, rounded: 0 outside, else inside.
int windings(const CompiledScene& mesh, const glm::dvec3& point);

/// Whether every edge is met by as many triangles one way as the other, vertices being told apart by place.
bool isClosed(const CompiledScene& mesh);

/// A mesh without holes and points inside of it, off the surface by more than rounding, from which no ray may
/// escape.
struct ClosedMesh {
  std::string name;
  CompiledScene scene;
  std::vector<glm::vec3> inside;
};

/// Finds `points` points inside; fails the running test when the mesh is not closed.
ClosedMesh closedMesh(const std::string& name, const CompiledScene& scene, std::size_t points = 256);

/// The tube of radius `tube` around a circle of radius `ring`.
CompiledScene torus(int segments, int tubeSegments, float ring, float tube);

/// Splits every triangle in three at a point that lies `distance` of its height off an edge: two ordinary
/// triangles and a sliver of about that aspect, and the mesh as closed as before.
CompiledScene withSlivers(const CompiledScene& mesh, float distance);

/// A prism of `sides` sides, `height` long and one quad high: triangles of aspect height * sides / 6.
CompiledScene needles(int sides, float height);

/// Every point p becomes scale * p + offset, rounded to float.
CompiledScene moved(const CompiledScene& mesh, const glm::vec3& scale, const glm::vec3& offset);

/// The objects of the built-in scenes that are closed, each compiled alone after `transform`.
std::vector<ClosedMesh> closedObjectsOfBuiltinScenes(const glm::dmat4& transform = glm::dmat4(1.0));

/// A built-in scene as loaded, every node moved by `transform`.
Scene builtinScene(const std::string& name, const glm::dmat4& transform = glm::dmat4(1.0));

/// The `index`-th of a sequence of rays from inside, aimed at points of edges, at vertices, and a few at
/// faces. Every other thousand or so leaves its points in bundles of 16, as receivers' rays do.
device::Ray aimedRay(const ClosedMesh& mesh, std::uint64_t index, std::uint64_t seed);

}  // namespace prelight::test
