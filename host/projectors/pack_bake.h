#pragma once

#include <vector>

#include "projectors/side_cast.h"
#include "projectors/slot_transfer.h"
#include "receivers/fit_mesh.h"
#include "scene/compiled_scene.h"
#include "transfer/bake.h"

/// From the fit's slots to the vertices of a Bake. Every value that leaves here is finite.
namespace prelight {

/// AO of the slots from the front's solution, in [0,1].
std::vector<double> accessibilityOf(const FitMesh& mesh, const SideCast& front,
                                    const std::vector<double>& fitted);

/// Ambient occlusion from that of the slots, and bent normals.
void packAo(const FitMesh& mesh, const SideCast& front, const std::vector<double>& accessibility,
            const CompiledScene& scene, Bake& bake);

/// The first `order` bands of SH transfer, at most those that it has.
HarmonicTransfer packSh(const FitMesh& mesh, const SlotTransfer& transfer, const CompiledScene& scene,
                        int order);

/// The same in cpherical harmonics: coefficients, or with `naive` the inner products that a projection onto
/// non-orthogonal functions takes for them.
HarmonicTransfer packCh(const FitMesh& mesh, const SlotTransfer& transfer, const CompiledScene& scene,
                        int order, bool naive);

/// `channels` is 1 only where neither bounces nor lights of different colours in one group tell them apart.
LightGroupTransfer packLightGroups(const FitMesh& mesh, const SlotTransfer& transfer,
                                   const CompiledScene& scene, const std::vector<LightGroup>& groups,
                                   int channels);

/// `matrices` of `transfer` are [slot][channel][i][j].
GlossyTransfer packGlossy(const FitMesh& mesh, const SlotTransfer& transfer,
                          const std::vector<float>& matrices, const CompiledScene& scene, int order);

}  // namespace prelight
