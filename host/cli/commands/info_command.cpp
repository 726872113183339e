#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "bake/make_plan.h"
#include "bvh/bvh_report.h"
#include "cli/commands.h"
#include "cli/commands/baked_contents.h"
#include "cli/options/bake_options.h"
#include "cli/options/scene_options.h"
#include "cli/report.h"
#include "cli/session.h"
#include "io/baked_file.h"
#include "io/plan_json.h"
#include "pictures/session/stale_bake.h"
#include "refine/coarse_triangles.h"
#include "scene/inside_out.h"
#include "scene/instancing.h"
#include "scene/pose.h"
#include "scene/unit_guess.h"
#include "techniques/registry/keyed_bake.h"
#include "techniques/technique.h"

namespace prelight::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InfoCommand {
  std::filesystem::path scene;
  LoadOptions load;
  BakeSettings bake;
};

const char* lightTypeName(const Light& light) {
  if (light.profile != nullptr) return "profile";
  switch (light.type) {
    case LightType::Directional:
      return "directional";
    case LightType::Spot:
      return "spot";
    case LightType::Area:
      return "area";
    case LightType::Point:
      break;
  }
  return "point";
}

/// Returns the intensity of a light, or the largest one of its profile.
glm::vec3 peakOf(const Light& light) {
  if (light.profile == nullptr) return light.intensity;
  const std::vector<double>& values = light.profile->values;
  return light.intensity * static_cast<float>(*std::max_element(values.begin(), values.end()));
}

/// Counts the morph targets of all meshes that are drawn.
std::size_t countMorphTargets(const Scene& scene) {
  std::size_t count = 0;
  for (const Mesh& mesh : scene.meshes) count += mesh.weights.size();
  return count;
}

std::optional<UnitGuess> unitOf(const LoadedScene& loaded) {
  return guessUnit(loaded.compiled, !loaded.scene.skins.empty() || countMorphTargets(loaded.scene) > 0);
}

std::string remedyOf(const UnitGuess& guess) {
  std::string text;
  for (const UnitRemedy& remedy : guess.remedies)
    text += fmt::format("{}--scale {:g} {}", text.empty() ? "" : ", ", remedy.scale, remedy.where);
  return text;
}

void printSize(const Console& console, const LoadedScene& loaded) {
  if (loaded.compiled.vertexCount() == 0) return;
  const glm::dvec3 size(loaded.compiled.boundsMax - loaded.compiled.boundsMin);
  console.line("size", fmt::format("{:.4g} x {:.4g} x {:.4g} m", size.x, size.y, size.z));
  const std::optional<UnitGuess> guess = unitOf(loaded);
  if (!guess) return;
  console.line("unit", guess->unit.empty()
                           ? fmt::format("{}; if it is not: {}", guess->reason, remedyOf(*guess))
                           : fmt::format("probably {}: {}; --scale {:g} converts the scene to metres",
                                         guess->unit, guess->reason, guess->scale.value_or(1.0)));
}

Json contentsJson(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  const CompiledScene& compiled = loaded.compiled;
  Json lights = Json::array();
  for (const Light& light : scene.lights)
    lights.push_back({{"name", light.name},
                      {"type", lightTypeName(light)},
                      {"intensity", {peakOf(light).x, peakOf(light).y, peakOf(light).z}}});
  Json cameras = Json::array();
  for (const Camera& camera : scene.cameras)
    cameras.push_back({{"name", camera.name}, {"type", camera.perspective ? "perspective" : "orthographic"}});
  Json animations = Json::array();
  for (const Animation& animation : scene.animations)
    animations.push_back({{"name", animation.name},
                          {"start", animation.startTime()},
                          {"end", animation.endTime()},
                          {"channels", animation.channels.size() + animation.properties.size()}});
  Json skins = Json::array();
  for (const Skin& skin : scene.skins) skins.push_back({{"name", skin.name}, {"joints", skin.joints.size()}});
  Json json = {{"meshes", scene.meshes.size()},
               {"meshNodes", scene.meshNodes.size()},
               {"primitives", compiled.primitives.size()},
               {"meshesDrawnAgain", compiled.shapes.size()},
               {"instances", compiled.instances.size()},
               {"vertices", compiled.vertexCount()},
               {"triangles", compiled.triangleCount()},
               {"droppedTriangles", compiled.droppedTriangles},
               {"materials", scene.materials.size()},
               {"emissiveMaterials", countMaterials(scene, [](const Material& m) { return m.isEmissive(); })},
               {"transmissiveMaterials",
                countMaterials(scene, [](const Material& m) { return m.transmission > 0.0f; })},
               {"images", scene.images.size()},
               {"lights", lights},
               {"skins", skins},
               {"morphTargets", countMorphTargets(scene)},
               {"animations", animations},
               {"scenes", scene.scenes},
               {"scene", scene.chosen < 0 ? Json(nullptr) : Json(scene.chosen)},
               {"variants", scene.variants},
               {"variant", scene.variant.empty() ? Json(nullptr) : Json(scene.variant)},
               {"cameras", cameras},
               {"sky", loaded.sky != nullptr},
               {"sides",
                {{"woundBack", scene.sides.woundBack},
                 {"woundBackTriangles", scene.sides.woundBackTriangles},
                 {"woundBackMeshes", scene.sides.woundBackMeshes},
                 {"seenFromBehind", scene.sides.seenFromBehind},
                 {"seenFromBehindNodes", scene.sides.seenFromBehindNodes},
                 {"shutInLamps", scene.sides.shutInLamps}}}};
  if (compiled.vertexCount() > 0) {
    const glm::dvec3 low = compiled.origin + glm::dvec3(compiled.boundsMin);
    const glm::dvec3 high = compiled.origin + glm::dvec3(compiled.boundsMax);
    json["bounds"] = {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
    const std::optional<UnitGuess> guess = unitOf(loaded);
    json["unit"] = guess ? Json{{"guess", guess->unit.empty() ? Json(nullptr) : Json(guess->unit)},
                                {"scale", guess->scale ? Json(*guess->scale) : Json(nullptr)},
                                {"reason", guess->reason}}
                         : Json(nullptr);
  }
  return json;
}

/// Reads a file's bake. One that does not fit its scene is worth only a warning, since the file is still a
/// scene.
std::optional<Bake> readBakeOrWarn(Session& session, const LoadedScene& loaded) {
  try {
    std::optional<Bake> bake = readBake(*loaded.document, loaded.compiled);
    if (bake) pictures::warnOfStaleBake(session, loaded, *bake);
    return bake;
  } catch (const InputError& error) {
    session.warn(fmt::format("the bake in this file cannot be used: {}", error.what()));
    return std::nullopt;
  }
}

void printContents(const Console& console, const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  console.line("scene", fmt::format("{}: {}", loaded.path.string(), sceneText(loaded)));
  console.line("materials",
               fmt::format("{}, {} emissive, {} transmissive, {} images", scene.materials.size(),
                           countMaterials(scene, [](const Material& m) { return m.isEmissive(); }),
                           countMaterials(scene, [](const Material& m) { return m.transmission > 0.0f; }),
                           scene.images.size()));
  if (loaded.compiled.droppedTriangles > 0)
    console.line("dropped", fmt::format("{} triangles of zero area", loaded.compiled.droppedTriangles));
  if (!loaded.compiled.shapes.empty())
    console.line("instances", fmt::format("{} of {} meshes that are drawn more than once",
                                          loaded.compiled.instances.size(), loaded.compiled.shapes.size()));
  for (const Light& light : scene.lights) {
    const glm::vec3 peak = peakOf(light);
    console.line("light", fmt::format("{} '{}', {:g} {:g} {:g} {}", lightTypeName(light), light.name, peak.x,
                                      peak.y, peak.z,
                                      light.profile != nullptr               ? "W/sr at most"
                                      : light.type == LightType::Directional ? "W/m2"
                                                                             : "W/sr"));
  }
  if (loaded.sky)
    console.line("sky", fmt::format("the file's own, {} x {} texels", loaded.sky->width, loaded.sky->height));
  for (const Camera& camera : scene.cameras)
    console.line("camera",
                 fmt::format("{} '{}'", camera.perspective ? "perspective" : "orthographic", camera.name));
}

/// Prints what was found about the sides of surfaces and what was done about it, unless nothing was found.
void printSides(const Console& console, const SurfaceSides& sides) {
  if (sides.woundBackTriangles > 0)
    console.line("sides",
                 fmt::format("{} triangles, {:.3g} % of the surface, are wound against their normals "
                             "and are turned",
                             sides.woundBackTriangles, 100.0 * sides.woundBack));
  if (sides.seenFromBehind > 0.0)
    console.line("sides",
                 fmt::format("{:.3g} % of the surface is seen from behind and is taken as double-sided",
                             100.0 * sides.seenFromBehind));
  for (const std::string& lamp : sides.shutInLamps) console.line("sides", lamp);
}

void printBaked(const Console& console, const std::optional<Bake>& bake, std::size_t vertices,
                const QuantizedBytes& quantized) {
  if (!bake) {
    console.line("baked", "nothing");
    return;
  }
  console.line("baked", bakedOriginText(bake->info));
  if (bake->info.sky) console.line("under", fmt::format("the sky \"{}\"", bake->info.sky->name));
  const std::vector<BakedTechnique> techniques = bakedTechniques(*bake, vertices, quantized);
  for (const BakedTechnique& technique : techniques) console.line("holds", technique.text);
  if (techniques.empty()) console.line("holds", "nothing that this version can read");
}

/// Prints what the file leaves to choose: scenes, variants, cameras and animations.
void printChoices(const Console& console, const Scene& scene) {
  for (std::size_t i = 0; scene.scenes.size() > 1 && i < scene.scenes.size(); ++i)
    console.line("scene", fmt::format("{} '{}'{}", i, scene.scenes[i],
                                      static_cast<int>(i) == scene.chosen ? ", this one" : ""));
  for (const std::string& variant : scene.variants)
    console.line("variant", fmt::format("'{}'{}", variant, variant == scene.variant ? ", this one" : ""));
}

void printDeformations(const Console& console, const Scene& scene) {
  for (const Skin& skin : scene.skins)
    console.line("skin", fmt::format("'{}', {} joints", skin.name, skin.joints.size()));
  for (const Mesh& mesh : scene.meshes)
    if (!mesh.weights.empty())
      console.line("morphs", fmt::format("{} targets of mesh '{}'", mesh.weights.size(), mesh.name));
}

void printAnimations(const Console& console, const Scene& scene) {
  for (const Animation& animation : scene.animations)
    console.line("animation",
                 fmt::format("'{}', {:g} s to {:g} s, {} channels{}", animation.name, animation.startTime(),
                             animation.endTime(), animation.channels.size() + animation.properties.size(),
                             movesMeshes(scene, animation) ? "" : ", moves no mesh"));
}

/// Prints how transfer follows animations that bend meshes, unless keys do.
void printBends(const Console& console, const LoadedScene& loaded, const Bake& bake,
                const BakeRequest& request) {
  const bool bends = std::ranges::any_of(loaded.scene.animations, [&](const Animation& animation) {
    return bendsMeshes(loaded.scene, animation);
  });
  const std::size_t bytes = bytesOfKey(bake, request, loaded.compiled.vertexCount());
  if (bends && !bake.animation && bytes > 0)
    console.line("bends", fmt::format("transfer follows skins and morphs, without further bytes; moved "
                                      "shadows need keys (bake --animation), {} each",
                                      shortBytes(static_cast<double>(bytes))));
}

Json treeJson(const BvhReport& tree) {
  return {{"cost", tree.sahCost},
          {"depth", tree.depth},
          {"nodes", tree.nodes},
          {"leaves", tree.leaves},
          {"leafFill", tree.meanLeafFill},
          {"duplicates", tree.duplicates},
          {"bytesPerTriangle", tree.bytesPerTriangle},
          {"seconds", tree.seconds}};
}

std::string treeText(const BvhReport& tree) {
  return fmt::format(
      "{} nodes, {} leaves {:.0f} % full, {} levels; a ray's expected cost {:.1f}; {:.1f} bytes per "
      "triangle, {:.1f} % of the triangles stored twice; {:.3f} s",
      tree.nodes, tree.leaves, 100.0 * tree.meanLeafFill, tree.depth, tree.sahCost, tree.bytesPerTriangle,
      100.0 * tree.duplicates, tree.seconds);
}

Json twoLevelJson(const TwoLevelReport& tree) {
  return {{"instances", tree.instances},
          {"nodes", tree.nodes},
          {"leaves", tree.leaves},
          {"bytes", tree.bytes},
          {"seconds", tree.seconds}};
}

std::string twoLevelText(const TwoLevelReport& tree) {
  return fmt::format("two levels, {} instances; {} nodes, {} leaves; {:.2f} MB; {:.3f} s", tree.instances,
                     tree.nodes, tree.leaves, static_cast<double>(tree.bytes) / 1e6, tree.seconds);
}

/// The tree through which a bake would trace rays, as a line and as JSON.
struct TreeReport {
  std::string text;
  Json json;
};

TreeReport reportTree(Session& session, const CompiledScene& scene) {
  return session.times().measure("tree", [&]() -> TreeReport {
    const Instancing instancing = chooseInstancing(scene);
    if (instancing.used) {
      const TwoLevelReport tree = reportTwoLevel(scene, instancing.instances);
      return {twoLevelText(tree), twoLevelJson(tree)};
    }
    const BvhReport tree = reportOf(buildBvh(scene), scene.triangleCount());
    return {treeText(tree), treeJson(tree)};
  });
}

void runInfo(const InfoCommand& command, Context& context) {
  Session session(context);
  checkMoment(command.load);
  const LoadedScene loaded = session.load(command.scene, command.load, true);
  BakeRequest request = command.bake.request;
  if (!command.bake.techniqueGiven()) useDefaultTechniques(request);
  const std::optional<Bake> bake = readBakeOrWarn(session, loaded);
  const Plan plan =
      session.times().measure("plan", [&] { return makePlan(loaded.scene, loaded.compiled, request); });

  const Console& console = session.console();
  std::optional<TreeReport> tree;
  if (loaded.compiled.triangleCount() > 0 && (console.detailsWanted() || console.jsonWanted()))
    tree = reportTree(session, loaded.compiled);
  printContents(console, loaded);
  printSize(console, loaded);
  printSides(console, loaded.scene.sides);
  if (const auto turned = insideOutPrimitives(loaded.scene, loaded.compiled); !turned.empty())
    session.warn(insideOutText(loaded.path, loaded.compiled, turned));
  const Bake nothing;
  if (staysAtVertices(request, bake ? *bake : nothing))
    if (const auto warning = coarseWarning(loaded.path, loaded.compiled)) session.warn(*warning);
  printChoices(console, loaded.scene);
  printDeformations(console, loaded.scene);
  printAnimations(console, loaded.scene);
  if (tree) console.line("tree", tree->text);
  const QuantizedBytes quantized = bake ? quantizedBytes(*loaded.document) : QuantizedBytes();
  printBaked(console, bake, loaded.compiled.vertexCount(), quantized);
  printBends(console, loaded, bake ? *bake : nothing, request);
  console.line("plan", fmt::format("of bake {}", techniqueText(request)));
  printPlan(console, plan);
  console.json(reportOf(
      "info", {{"scene", command.scene.string()},
               {"contents", contentsJson(loaded)},
               {"tree", tree ? tree->json : Json(nullptr)},
               {"baked", bake ? bakedJson(*bake, loaded.compiled.vertexCount(), quantized) : Json(nullptr)},
               {"options", toJson(request)},
               {"plan", toJson(plan)},
               {"warnings", session.warnings()}}));
}

}  // namespace

void addInfoCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<InfoCommand>();
  CLI::App* app = program.add_subcommand("info", "Show what a file holds and what a bake of it would do");
  app->add_option("SCENE", command->scene, "glTF file, baked or not (.gltf or .glb)")
      ->required()
      ->type_name("");
  addSceneOptions(*app, command->load);
  addMomentOptions(*app, command->load);
  addTechniqueOptions(*app, command->bake);
  addEffortOptions(*app, command->bake);
  app->footer(
      "Without a technique the plan is that of bake --ao --sh 3 --bounces 1.\n\n"
      "Examples:\n"
      "  prelight info level.glb\n"
      "  prelight info level.glb --ao --sh 6 --json");
  app->callback([command, &context] { runInfo(*command, context); });
}

}  // namespace prelight::cli
