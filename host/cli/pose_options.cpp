#include "cli/pose_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/pattern.h"
#include "cli/baked_contents.h"
#include "cli/values.h"
#include "occluders/scene_motion.h"
#include "scene/pose.h"
#include "transfer/animated_transfer.h"

namespace prelight::cli {

namespace {

constexpr double farthestMove = 1e6;  // m, degrees

/// What a node turns about: with a skin, where its first joint takes the origin of the mesh.
glm::dvec3 originOf(const Scene& scene, const MeshNode& node, const glm::dmat4& transform) {
  if (node.skin < 0) return glm::dvec3(transform[3]);
  const Skin& skin = scene.skins[static_cast<std::size_t>(node.skin)];
  return glm::dvec3(transform * skin.toWorld[0][3]);
}

void moveNodes(Scene& scene, const NodeMove& move) {
  bool found = false;
  for (MeshNode& node : scene.meshNodes) {
    const std::string name = node.name.empty() ? fmt::format("node {}", node.node) : node.name;
    if (!matchesPattern(name, move.pattern)) continue;
    found = true;
    for (glm::dmat4& transform : node.transforms) {
      const glm::dvec3 origin = originOf(scene, node, transform);
      const glm::dmat4 turn =
          glm::rotate(glm::dmat4(1.0), glm::radians(move.yawDegrees), glm::dvec3(0.0, 1.0, 0.0));
      transform = glm::translate(glm::dmat4(1.0), origin + move.by) * turn *
                  glm::translate(glm::dmat4(1.0), -origin) * transform;
    }
  }
  if (!found)
    throw UsageError("--move " + move.pattern, "no node with a mesh has that name",
                     "see the names with prelight info");
}

/// What skins and morph targets bend moves in no way that occluders can follow.
void requireRigid(const Scene& before, const Scene& after) {
  for (std::size_t n = 0; n < after.meshNodes.size(); ++n) {
    const MeshNode& node = after.meshNodes[n];
    const auto skin = static_cast<std::size_t>(std::max(node.skin, 0));
    const bool bent = node.skin >= 0 && before.skins[skin].toWorld != after.skins[skin].toWorld;
    if (bent || before.meshNodes[n].weights != node.weights)
      throw InputError("vector occluders",
                       fmt::format("node \"{}\" is bent, and they only move rigidly", node.name),
                       "bake the scene as it is then, with --at");
  }
}

/// A scene without what does not move.
Scene posesOf(const Scene& scene) {
  Scene poses;
  poses.meshNodes = scene.meshNodes;
  poses.skins = scene.skins;
  return poses;
}

/// `loaded` is posed, its compiled scene still as it was.
std::optional<OccluderTransfer> movedOccluders(Session& session, const LoadedScene& loaded,
                                               const Scene& before, const OccluderTransfer& rest) {
  try {
    requireRigid(before, loaded.scene);
    const auto members = membersOf(loaded.compiled, rest);
    if (!members)
      throw InputError("vector occluders", "their names are not those of the scene's parts", "bake it anew");
    const OccluderMotions motions =
        motionsBetween(loaded.scene, loaded.compiled, *members, transformsOf(before).nodes,
                       transformsOf(loaded.scene).nodes, rest.names);
    return OccluderMover(rest, loaded.compiled, *members).moved(motions);
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
  constexpr double mostSeconds = 1e6;
  addRealNumber(
      app, "--at", {0.0, mostSeconds}, [&](double seconds) { options.at = seconds; },
      "show the scene at this moment of an animation, seconds (default: as it was baked, else at rest)")
      ->type_name("SECONDS");
  app.add_option("--animation", options.animation,
                 "the animation that --at means (default: the one that was baked, else the first)")
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

/// Names what a bake has that is not posed with the scene.
std::string lostNames(const Bake& bake, const Bake& posed, std::size_t vertices) {
  const std::vector<BakedTechnique> kept = bakedTechniques(posed, vertices);
  std::string names;
  for (const BakedTechnique& technique : bakedTechniques(bake, vertices))
    if (std::none_of(kept.begin(), kept.end(), [&](const auto& k) { return k.key == technique.key; }))
      names += (names.empty() ? "" : ", ") + technique.key;
  return names;
}

}  // namespace

void poseScene(Session& session, const PoseOptions& options, LoadedScene& loaded, Bake& bake) {
  if (!options.at && !options.animation.empty())
    throw UsageError("--animation", "no moment of it is given", "add --at SECONDS");
  if (!options.at && options.moves.empty()) return;
  session.times().measure("pose", [&] {
    const Scene before = posesOf(loaded.scene);
    const std::optional<SceneMoment> moment = loaded.scene.moment;
    Bake posed;
    if (options.at) {
      const std::size_t animation = !options.animation.empty()
                                        ? findAnimation(loaded.scene, options.animation)
                                    : bake.animation ? bake.animation->animation
                                    : moment         ? moment->animation
                                                     : 0;
      setPose(loaded.scene, animation, *options.at);
      if (moment == loaded.scene.moment && options.moves.empty()) return;
      if (bake.animation && bake.animation->animation == animation && options.moves.empty())
        posed.sh = transferAt(*bake.animation, loaded.scene, loaded.compiled, *options.at);
    }
    for (const NodeMove& move : options.moves) moveNodes(loaded.scene, move);
    if (bake.occluders) posed.occluders = movedOccluders(session, loaded, before, *bake.occluders);
    if (posed.sh || posed.occluders) posed.info = bake.info;
    if (const std::string lost = lostNames(bake, posed, loaded.compiled.vertexCount()); !lost.empty())
      session.warn(fmt::format("{}: the bake is of another pose; left out of it: {}",
                               options.at ? "--at" : "--move", lost));
    bake = std::move(posed);
    Warnings said;  // by the rest pose already
    loaded.compiled = compileScene(loaded.scene, said);
  });
}

}  // namespace prelight::cli
