#pragma once

#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight::test {

/// A CompiledScene from raw arrays with one white Lambertian material; vertex normals are area-weighted
/// means. Positions are kept: origin stays 0.
CompiledScene sceneOf(std::vector<glm::vec3> positions, std::vector<glm::uvec3> triangles,
                      float albedo = 1.0f);

/// Appends a mesh to a scene of sceneOf as a further primitive.
void append(CompiledScene& scene, const CompiledScene& other);

/// Triangles with random places and shapes within the unit cube.
CompiledScene randomSoup(std::size_t triangles, float size, std::uint32_t seed);

/// A closed sphere of `segments` x 2 `segments` quads around `centre`, facing outwards.
CompiledScene sphere(int segments, float radius, const glm::vec3& centre);

/// A square in the plane y = `height`, `cells` x `cells` quads over [-half, half]^2, facing +Y.
CompiledScene ground(int cells, float half, float height = 0.0f);

/// The axis-aligned box [lower, upper] with `cells` x `cells` quads and separate vertices per face. With
/// `inward`, faces look inside.
CompiledScene box(int cells, const glm::vec3& lower, const glm::vec3& upper, bool inward);

/// The images of a scene that has none.
const std::vector<Image>& noImages();

/// A direction that is uniformly distributed on the sphere.
glm::vec3 randomDirection(std::mt19937& random);

}  // namespace prelight::test
