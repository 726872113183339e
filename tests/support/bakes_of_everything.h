#pragma once

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"

/// Small bakes that together have every technique, for tests of work that ends and goes on elsewhere.
namespace prelight::test {

/// A ground and a sphere that shines above it, both two-sided.
CompiledScene groundAndSphere();

/// Accessibility and SH transfer at vertices.
BakeRequest vertexTransferRequest(int bounces);

/// Every technique that is stored per vertex or in the air, but vector occluders.
BakeRequest vertexRequest();
BakeRequest occluderRequest();
BakeRequest errorRequest();  ///< rays until an error is met
BakeRequest radiosityRequest();
BakeRequest lightMapRequest();    ///< of texels of one size, with an encoding of incident light
BakeRequest texelErrorRequest();  ///< of texels whose sizes are chosen by an error

/// Expects the same values in both.
void expectSame(const Bake& part, const Bake& whole);

}  // namespace prelight::test
