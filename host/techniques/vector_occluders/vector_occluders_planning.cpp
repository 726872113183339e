#include "techniques/vector_occluders/vector_occluders_planning.h"

#include <fmt/format.h>

#include <cmath>

#include "occluders/occluder_vectors.h"

namespace prelight {

namespace {

constexpr std::uint64_t seenBytes = 72;  // what a vertex keeps of an occluder until its record is made
constexpr std::uint64_t wayBytes = 56;   // the same of what is mirrored or comes through it

PlannedPass planOccluders(const BakeRequest& request) {
  if (!request.occluders) return {Pass::VectorOccluders, false, "not asked for"};
  return {Pass::VectorOccluders, true,
          "position, occlusion, diffuse normal and diffuse colour, from the rays of the same cast"};
}

/// Vectors that only some scenes need.
PlannedPass planVectors(const BakeRequest& request, Pass name, bool needed, const std::string& reason,
                        const std::string& lack) {
  if (!request.occluders) return {name, false, "vector occluders are not asked for"};
  return {name, needed, needed ? reason : lack};
}

std::vector<PlannedPass> vectorOccludersPasses(const PlanInput& input) {
  const BakeRequest& request = input.request;
  const double reach = freeReach(input.scene);
  const std::string free =
      std::isinf(reach) ? "nothing is in the way, because light comes from outside"
                        : fmt::format("nothing is in the way for {:.3g} m, because lights lie inside", reach);
  return {planOccluders(request),
          planVectors(request, Pass::CausticVectors, hasGlass(input.scene),
                      "rays that meet glass are refracted until " + free,
                      "no material lets light through by refraction"),
          planVectors(request, Pass::SpecularVectors, hasShine(input.scene),
                      "rays are mirrored by shiny surfaces, and count where " + free,
                      "no material mirrors light or is glossy")};
}

/// While they are aggregated: objects that a vertex sees, or parts of them (measured, 3 to 8 and 30 to 60).
void addVectorOccludersMemory(const PlanInput& input, Plan& plan) {
  if (!input.request.occluders) return;
  const std::uint64_t seen = input.request.occluders.kind == OccluderKind::Auto ? 48 : 8;
  const bool ways = hasGlass(input.scene) || hasShine(input.scene);
  plan.hostBytes += std::uint64_t{input.scene.vertexCount()} * seen * (seenBytes + (ways ? wayBytes : 0));
}

const char* closestHits(const BakeRequest& request) {
  return request.occluders ? "closest hits, because occluders are told apart by what was hit" : nullptr;
}

const char* specularLight(const BakeRequest& request) {
  return request.occluders ? "only vector occluders carry" : nullptr;
}

void addVectorOccludersToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.occluders.wanted).value(request.occluders.kind);
  hash.value(request.occluders.records).value(request.occluders.leastFormFactor);
}

}  // namespace

Planning vectorOccludersPlanning() {
  return {.passes = vectorOccludersPasses,
          .addMemory = addVectorOccludersMemory,
          .closestHits = closestHits,
          .specularLight = specularLight,
          .addToKey = addVectorOccludersToKey};
}

}  // namespace prelight
