#include "cli/pose_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>

#include "base/pattern.h"
#include "cli/baked_contents.h"
#include "cli/parameters.h"
#include "cli/values.h"
#include "scene/move_node.h"
#include "scene/pose.h"
#include "transfer/animated_transfer.h"

namespace prelight::cli {

namespace {

constexpr double farthestMove = 1e6;  // m, degrees

void moveMatching(Scene& scene, const NodeMove& move) {
  bool found = false;
  for (MeshNode& node : scene.meshNodes) {
    const std::string name = node.name.empty() ? fmt::format("node {}", node.node) : node.name;
    if (!matchesPattern(name, move.pattern)) continue;
    found = true;
    moveNode(scene, node, move.by, glm::radians(move.yawDegrees));
  }
  if (!found)
    throw UsageError("--move " + move.pattern, "no node with a mesh has that name",
                     "see the names with prelight info");
}

/// `loaded` is as it was baked.
std::unique_ptr<const PosedOccluders> occludersOf(Session& session, const LoadedScene& loaded,
                                                  OccluderTransfer rest) {
  try {
    return std::make_unique<const PosedOccluders>(std::make_shared<const OccluderTransfer>(std::move(rest)),
                                                  loaded.scene, loaded.compiled);
  } catch (const InputError& error) {
    session.warn(fmt::format("{}; left out", error.what()));
    return nullptr;
  }
}

/// `loaded` is posed, its compiled scene still as it was.
std::optional<OccluderTransfer> movedOccluders(Session& session, const LoadedScene& loaded,
                                               const PosedOccluders& occluders) {
  try {
    return occluders.at(loaded.scene, loaded.compiled);
  } catch (const InputError& error) {
    session.warn(fmt::format("{}; left out", error.what()));
    return std::nullopt;
  }
}

}  // namespace

NodeMove parseNodeMove(const std::string& text) {
  const auto fail = [&](const char* what) {
    return UsageError("--move " + text, what,
                      "expected NODE:x,y,z or NODE:x,y,z:yaw, for example Ball:0.5,0,0:30");
  };
  std::size_t end = text.rfind(':');
  if (end == std::string::npos || end == 0) throw fail("no node or no way is given");
  auto numbers = numbersIn(std::string_view(text).substr(end + 1), farthestMove);
  NodeMove move;
  if (numbers && numbers->size() == 1) {
    move.yawDegrees = numbers->front();
    const std::size_t before = text.rfind(':', end - 1);
    if (before == std::string::npos || before == 0) throw fail("three coordinates are needed");
    numbers = numbersIn(std::string_view(text).substr(before + 1, end - before - 1), farthestMove);
    end = before;
  }
  if (!numbers || numbers->size() != 3) throw fail("its coordinates are not three numbers");
  move.pattern = text.substr(0, end);
  move.by = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  return move;
}

void addPoseOptions(CLI::App& app, PoseOptions& options) {
  addParameter<LoadOptions>(app, "at", [&options](double seconds) { options.at = seconds; })
      ->description(
          "show the scene at this moment of an animation, seconds (default: as it was baked, else at rest)")
      ->type_name("SECONDS");
  app.add_option("--animation", options.animation,
                 "the animation that moments are of (default: the one that was baked, else the first)")
      ->type_name("NAME|INDEX");
  app.add_option_function<std::vector<std::string>>(
         "--move",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) options.moves.push_back(parseNodeMove(text));
         },
         "move a node, with its vector occluders: NODE:x,y,z[:yaw], metres and degrees; repeat it for more")
      ->type_name("MOVE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

namespace {

/// Names what a bake had that is not posed with the scene. The keys of an animation are there as the transfer
/// that they give.
std::string lostNames(const std::vector<BakedTechnique>& had, const Bake& posed, std::size_t vertices) {
  constexpr std::string_view keys = "animation";
  const std::vector<BakedTechnique> kept = bakedTechniques(posed, vertices);
  std::string names;
  for (const BakedTechnique& technique : had)
    if (!(technique.key == keys && posed.sh) &&
        std::none_of(kept.begin(), kept.end(), [&](const auto& k) { return k.key == technique.key; }))
      names += (names.empty() ? "" : ", ") + technique.key;
  return names;
}

/// What of a bake holds where its scene has been posed.
Bake posedBake(Session& session, const LoadedScene& loaded, const Bake& bake, const BakedMotion& motion,
               bool moved) {
  Bake posed;
  const std::optional<SceneMoment>& moment = loaded.scene.moment;
  if (motion.keys && moment && motion.keys->animation == moment->animation && !moved)
    posed.sh = transferAt(*motion.keys, loaded.scene, loaded.compiled, moment->seconds);
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

BakedMotion poseScene(Session& session, const PoseOptions& options, LoadedScene& loaded, Bake& bake) {
  BakedMotion motion;
  if (!options.at && !options.animation.empty() && !options.plays)
    throw UsageError("--animation", "no moment of it is given", "add --at SECONDS");
  if (!options.at && options.moves.empty()) return motion;
  session.times().measure("pose", [&] {
    const std::size_t vertices = loaded.compiled.vertexCount();
    const std::size_t animation = animationMeant(options, loaded.scene, bake);
    const bool moved = !options.moves.empty();
    if (options.at && !moved && loaded.scene.moment == SceneMoment{animation, *options.at}) return;
    const std::vector<BakedTechnique> had = bakedTechniques(bake, vertices);
    if (bake.occluders) motion.occluders = occludersOf(session, loaded, std::move(*bake.occluders));
    motion.keys = std::move(bake.animation);
    if (options.at) setPose(loaded.scene, animation, *options.at);
    moveNodes(loaded.scene, options.moves);
    Bake posed = posedBake(session, loaded, bake, motion, moved || !options.at);
    if (const std::string lost = lostNames(had, posed, vertices); !lost.empty())
      session.warn(fmt::format("{}: the bake is of another pose; left out of it: {}",
                               options.at ? "--at" : "--move", lost));
    bake = std::move(posed);
    Warnings said;  // by the rest pose already
    loaded.compiled = compileScene(loaded.scene, said);
  });
  return motion;
}

}  // namespace prelight::cli
