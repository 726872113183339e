#include "pictures/pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>

#include "base/text.h"
#include "pictures/session/lost_techniques.h"
#include "scene/deform.h"
#include "scene/pose.h"

namespace prelight::pictures {

namespace {

constexpr const char* animationKey = "animation";
constexpr const char* compressedKey = "shCompressed";

void moveMatching(Scene& scene, const NodeMove& move) {
  bool found = false;
  for (MeshNode& node : scene.meshNodes) {
    const std::string name = node.name.empty() ? fmt::format("node {}", node.node) : node.name;
    if (!matchesPattern(name, move.pattern)) continue;
    found = true;
    moveNode(scene, node, move.by, glm::radians(move.yawDegrees));
  }
  if (!found)
    throw UsageError("PoseOptions::moves " + move.pattern, "no node with a mesh has that name",
                     "see the names with prelight info");
}

/// `loaded` must be as it was baked.
std::unique_ptr<const PosedOccluders> occludersOf(DrawingSession& session, const LoadedScene& loaded,
                                                  OccluderTransfer rest) {
  try {
    return std::make_unique<const PosedOccluders>(std::make_shared<const OccluderTransfer>(std::move(rest)),
                                                  loaded.scene, loaded.compiled);
  } catch (const InputError& error) {
    session.warn(fmt::format("{}; left out", error.what()));
    return nullptr;
  }
}

/// `loaded` must be posed.
std::optional<OccluderTransfer> movedOccluders(DrawingSession& session, const LoadedScene& loaded,
                                               const PosedOccluders& occluders) {
  try {
    return occluders.at(loaded.scene, loaded.compiled);
  } catch (const InputError& error) {
    session.warn(fmt::format("{}; left out", error.what()));
    return std::nullopt;
  }
}

bool haveKeys(const BakedMotion& motion, const std::optional<SceneMoment>& moment) {
  return motion.keys && moment && motion.keys->animation == moment->animation;
}

/// Returns the part of a bake that holds for the posed scene.
Bake posedBake(DrawingSession& session, const LoadedScene& loaded, const Bake& bake,
               const BakedMotion& motion, bool moved) {
  Bake posed;
  const std::optional<SceneMoment>& moment = loaded.scene.moment;
  if (haveKeys(motion, moment) && !moved) {
    posed = bakeAt(*motion.keys, loaded.scene, loaded.compiled, moment->seconds);
  } else if (motion.bent) {
    posed = motion.bent->at(loaded.compiled);
    session.note(bentBakeNote);
  }
  if (motion.occluders) posed.occluders = movedOccluders(session, loaded, *motion.occluders);
  if (posed.sh || posed.occluders) posed.info = bake.info;
  return posed;
}

}  // namespace

std::size_t animationMeant(const PoseOptions& options, const Scene& scene, const Bake& bake) {
  if (!options.animation.empty()) return findAnimation(scene, options.animation);
  if (bake.animation) return bake.animation->animation;
  return scene.moment ? scene.moment->animation : 0;
}

void moveNodes(Scene& scene, std::span<const NodeMove> moves) {
  for (const NodeMove& move : moves) moveMatching(scene, move);
}

BakedMotion poseScene(DrawingSession& session, const PoseOptions& options, LoadedScene& loaded, Bake& bake) {
  BakedMotion motion;
  if (!options.at && !options.animation.empty() && !options.plays)
    throw UsageError("PoseOptions::animation", "it needs a moment, and none is given",
                     "add PoseOptions::at SECONDS");
  if (!options.at && options.moves.empty()) return motion;
  session.measure("pose", [&] {
    const std::size_t vertices = loaded.compiled.vertexCount();
    const std::size_t animation = animationMeant(options, loaded.scene, bake);
    const bool moved = !options.moves.empty();
    if (options.at && !moved && loaded.scene.moment == SceneMoment{animation, *options.at}) return;
    const Shapes shapes = shapesOf(loaded.scene);
    std::vector<std::string> had = techniqueKeys(bake, vertices);
    if (bake.occluders) motion.occluders = occludersOf(session, loaded, std::move(*bake.occluders));
    motion.keys = std::move(bake.animation);
    if (options.at) setPose(loaded.scene, animation, *options.at);
    moveNodes(loaded.scene, options.moves);
    const bool byKeys = haveKeys(motion, loaded.scene.moment) && !moved;
    if (!byKeys && BentBake::servesFor(bake) && shapesOf(loaded.scene) != shapes)
      motion.bent = std::make_unique<const BentBake>(bake, loaded.compiled);
    Warnings said;  // these warnings were given for the rest pose
    loaded.compiled = compileScene(loaded.scene, said);
    Bake posed = posedBake(session, loaded, bake, motion, moved || !options.at);
    if (posed.sh)  // these are there as the transfer that they give
      std::erase_if(had, [](const std::string& key) { return key == animationKey || key == compressedKey; });
    if (const std::string lost = lostTechniques(had, posed, vertices); !lost.empty())
      session.warn(fmt::format("{}: the bake was made in another pose; left out: {}",
                               options.at ? "PoseOptions::at" : "PoseOptions::moves", lost));
    bake = std::move(posed);
  });
  return motion;
}

}  // namespace prelight::pictures
