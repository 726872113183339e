#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/state_file.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "prelight/scene.h"

namespace prelight {

/// What a technique's passes are planned from.
struct PlanInput {
  const Scene& source;
  const CompiledScene& scene;
  const BakeRequest& request;
  bool bounces;  ///< of the transfer that is asked for, run

  /// Something colours the light of transfer.
  bool colored() const { return bounces || request.specular; }
};

/// What a technique asks of a bake before it begins. A function that is nullptr has nothing to say.
struct Planning {
  /// Irradiance of the scene's own lights, which has bounces of its own; else transfer, or visibility.
  bool staticLight = false;

  /// Whether its passes run, and why.
  std::vector<PlannedPass> (*passes)(const PlanInput&) = nullptr;

  /// Adds what it takes beyond what all bakes take.
  void (*addMemory)(const PlanInput&, Plan&) = nullptr;

  /// Why rays must know the closest of what they hit; nullptr: they need not.
  const char* (*closestHits)(const BakeRequest&) = nullptr;

  /// The same where that depends on the scene.
  const char* (*closestHitsOfSome)(const BakeRequest&) = nullptr;

  /// "NAME alone carry", of the light that mirrors and glass throw; nullptr: it does not.
  const char* (*specularLight)(const BakeRequest&) = nullptr;

  /// What the state of an interrupted bake depends on, without lists.
  void (*addToKey)(const BakeRequest&, StateHash&) = nullptr;

  /// The same, lists.
  void (*addListsToKey)(const BakeRequest&, StateHash&) = nullptr;
};

/// Rays of the hemispheres. With a target instead of a count they are bounded by memory alone.
std::uint64_t plannedRays(const CompiledScene& scene, const BakeRequest& request);

/// How many of a scene's materials pass a test.
std::size_t countMaterials(const Scene& scene, bool (*test)(const Material&));

/// "3 channels".
std::string plannedChannels(bool colored);

/// Transfer in harmonics of an order, 0: not asked for. `how` follows the text.
PlannedPass planHarmonics(Pass name, int order, bool colored, const std::string& how);

constexpr std::uint64_t senderBytes = 8;  ///< that bounces keep of a ray

}  // namespace prelight
