#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/bake.h"
#include "viewer/quad_scene.h"

/// Transfer of open surfaces in every basis, and a scene to light with it.
namespace prelight::test {

/// Open transfer of normals that differ from vertex to vertex and channel to channel, so that every
/// coefficient and every vertex counts and almost nothing falls below zero.
HarmonicTransfer tiltedTransfer(std::size_t vertices, int order, int channels);

/// Lossless wavelet transfer of open surfaces.
HaarTransfer openWavelets(const std::vector<glm::vec3>& normals, int faceSize, int channels);

/// Exact matrices of open surfaces: products of the cosine and the basis.
GlossyTransfer openMatrices(const std::vector<glm::vec3>& normals, int order, int channels);

/// A quad that fills the picture, with a sky of many colours, a directional light and, if requested, a light
/// at a finite distance.
QuadScene litQuad(bool nearLight);

}  // namespace prelight::test
