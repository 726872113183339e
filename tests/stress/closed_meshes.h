#pragma once

#include <functional>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "shared/ray_types.h"

namespace prelight::test {

/// Twice the number of times that the mesh winds around `point`, rounded: 0 is outside.
int windings(const CompiledScene& mesh, const glm::dvec3& point);

/// Whether every edge is traversed equally often in both directions. Vertices are identified by position.
bool isClosed(const CompiledScene& mesh);

/// A mesh without holes, and points inside it that are farther from the surface than rounding. No ray from
/// these points may escape.
struct ClosedMesh {
  std::string name;
  CompiledScene scene;
  std::vector<glm::vec3> inside;
};

/// Finds `points` points inside. Fails the running test if the mesh is not closed.
ClosedMesh closedMesh(const std::string& name, const CompiledScene& scene, std::size_t points = 256);

/// The tube of radius `tube` around a circle of radius `ring`.
CompiledScene torus(int segments, int tubeSegments, float ring, float tube);

/// Splits every triangle in three at a point that is `distance` of its height away from an edge: two ordinary
/// triangles and a sliver of about that aspect. The mesh stays closed.
CompiledScene withSlivers(const CompiledScene& mesh, float distance);

/// A prism of `sides` sides, `height` long and one quad high. Its triangles have an aspect of height * sides
/// / 6.
CompiledScene needles(int sides, float height);

/// The mesh with every point p replaced by scale * p + offset, rounded to float.
CompiledScene moved(const CompiledScene& mesh, const glm::vec3& scale, const glm::vec3& offset);

/// The objects of the built-in scenes that are closed, each compiled alone after `transform`.
std::vector<ClosedMesh> closedObjectsOfBuiltinScenes(const glm::dmat4& transform = glm::dmat4(1.0));

/// A built-in scene as loaded, with every node moved by `transform`.
Scene builtinScene(const std::string& name, const glm::dmat4& transform = glm::dmat4(1.0));

/// The `index`-th of a sequence of rays from inside, aimed at points of edges, at vertices, and a few at
/// faces. About every other thousand rays leave their points in bundles of 16, as receivers' rays do.
device::Ray aimedRay(const ClosedMesh& mesh, std::uint64_t index, std::uint64_t seed);

}  // namespace prelight::test
