#include "scene/gltf/load/loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/machine_memory.h"
#include "prelight/error.h"
#include "scene/gltf/load/load_parts.h"
#include "scene/pose.h"

namespace prelight {

namespace {

/// Numbers of drawn vertices and triangles, in double precision, which any product of counts fits.
struct DrawnSize {
  double vertices = 0.0;
  double triangles = 0.0;
};

double countOf(const LoadContext& context, const JsonCursor& reference) {
  const JsonCursor accessor = context.root.at("accessors").at(reference.asUnsigned());
  return static_cast<double>(accessor.at("count").asUnsigned());
}

/// Returns the size of a primitive's triangles; points and lines are not read and count as nothing.
DrawnSize sizeOfPrimitive(const LoadContext& context, const JsonCursor& primitive) {
  constexpr std::uint64_t list = 4;
  const auto position = primitive.at("attributes").find("POSITION");
  const std::uint64_t mode = primitive.unsignedOr("mode", list);
  if (!position || mode < list) return {};
  DrawnSize size;
  size.vertices = countOf(context, *position);
  const auto indices = primitive.find("indices");
  const double corners = indices ? countOf(context, *indices) : size.vertices;
  size.triangles = mode == list ? corners / 3.0 : corners;
  return size;
}

/// Returns the number of vertices that are read in addition to those drawn: of morph targets, and sets of
/// joints.
double extraVertices(const LoadContext& context, std::uint64_t mesh) {
  double count = 0.0;
  context.root.at("meshes").at(mesh).forEachObject(
      "primitives", [&](const JsonCursor& primitive, std::size_t) {
        // About three attributes have the size of a vertex.
        primitive.forEachObject("targets", [&](const JsonCursor& target, std::size_t) {
          target.forEachMember([&](const JsonCursor& attribute, const std::string&) {
            count += countOf(context, attribute) / 3.0;
          });
        });
        primitive.at("attributes").forEachMember([&](const JsonCursor& attribute, const std::string& name) {
          if (name.starts_with("JOINTS_")) count += countOf(context, attribute);
        });
      });
  return count;
}

DrawnSize sizeOfMesh(const LoadContext& context, std::uint64_t mesh) {
  DrawnSize size;
  context.root.at("meshes").at(mesh).forEachObject(
      "primitives", [&](const JsonCursor& primitive, std::size_t) {
        const DrawnSize part = sizeOfPrimitive(context, primitive);
        size.vertices += part.vertices;
        size.triangles += part.triangles;
      });
  return size;
}

double instancesOf(const LoadContext& context, const JsonCursor& node) {
  const auto instancing = LoadContext::extension(node, "EXT_mesh_gpu_instancing");
  if (!instancing) return 1.0;
  double count = 1.0;
  for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
    if (const auto attribute = instancing->at("attributes").find(name))
      count = std::max(count, countOf(context, *attribute));
  }
  return count;
}

void checkMemory(const LoadContext& context, const DrawnSize& drawn, double instances) {
  // The compiled scene stores positions, normals, coordinates and colours per vertex; indices and materials
  // per triangle; transforms per instance.
  const double bytes = 48.0 * drawn.vertices + 20.0 * drawn.triangles + 256.0 * instances;
  const auto memory = static_cast<double>(machineMemory());
  if (bytes <= memory) return;
  constexpr double gigabyte = 1e9;
  throw Error(ExitCode::OutOfMemory, context.file,
              fmt::format("{:.0f} triangles and {:.0f} vertices take {:.1f} GB at least, there are {:.1f}",
                          drawn.triangles, drawn.vertices, bytes / gigabyte, memory / gigabyte),
              "draw fewer instances");
}

}  // namespace

void checkSceneSize(const LoadContext& context, const std::vector<SceneNode>& nodes) {
  constexpr double anyFile = double(1 << 22);
  constexpr double perByte = 256.0;
  constexpr double bytesOfNode = 64.0;
  const double most = anyFile + perByte * (static_cast<double>(context.document.bin.size()) +
                                           bytesOfNode * static_cast<double>(nodes.size()));
  std::map<std::uint64_t, DrawnSize> meshes;
  DrawnSize drawn;
  double instances = 0.0;
  for (const SceneNode& place : nodes) {
    const JsonCursor node = context.root.at("nodes").at(static_cast<std::size_t>(place.node));
    const auto mesh = node.find("mesh");
    if (!mesh) continue;
    const auto [known, fresh] = meshes.try_emplace(mesh->asUnsigned());
    if (fresh) {
      known->second = sizeOfMesh(context, known->first);
      drawn.vertices += extraVertices(context, known->first);
    }
    const double count = instancesOf(context, node);
    instances += count;
    drawn.vertices += count * known->second.vertices;
    drawn.triangles += count * known->second.triangles;
    if (const double largest = std::max({drawn.vertices, drawn.triangles, instances}); largest > most)
      throw InputError(node.where(),
                       fmt::format("with its {:.0f} instances the scene draws {:.0f} triangles of {:.0f} "
                                   "vertices, expected at most {:.0f} of either for so small a file",
                                   count, drawn.triangles, drawn.vertices, most),
                       "draw fewer instances");
  }
  checkMemory(context, drawn, instances);
}

namespace {

/// Converts numbers such as 1.0 to integers, as indices may be written that way and tinygltf rejects it.
void makeIntegers(nlohmann::ordered_json& tree) {
  if (tree.is_structured()) {
    for (auto& part : tree) makeIntegers(part);
  } else if (tree.is_number_float() && !std::signbit(tree.get<double>())) {
    if (const auto integer = unsignedValue(tree)) tree = *integer;
  }
}

/// Replaces all accessors by stubs that tinygltf accepts: it only tests whether they exist.
void standInForAccessors(nlohmann::ordered_json& tree) {
  if (!tree.contains("accessors")) return;
  nlohmann::ordered_json stub = {
      {"bufferView", 0}, {"componentType", 5121}, {"count", 1}, {"type", "SCALAR"}};
  for (auto& accessor : tree["accessors"]) accessor = stub;
  tree["bufferViews"] = nlohmann::ordered_json::array({{{"buffer", 0}, {"byteLength", 1}}});
}

/// Has tinygltf parse a tree without the parts that it would open, copy or judge by itself: their bytes are
/// already embedded in the document, other parts are read from the JSON tree, and unused parts may be broken.
tinygltf::Model parseModel(const GltfDocument& document, const std::string& file) {
  nlohmann::ordered_json tree = document.json;
  for (const char* part :
       {"buffers", "images", "animations", "skins", "cameras", "bufferViews", "extensions", "extras"})
    tree.erase(part);
  standInForAccessors(tree);
  makeIntegers(tree);
  const std::string text = tree.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  tinygltf::TinyGLTF parser;
  tinygltf::Model model;
  std::string error;
  std::string ignoredWarning;
  bool parsed = false;
  try {
    parsed = parser.LoadASCIIFromString(&model, &error, &ignoredWarning, text.c_str(),
                                        static_cast<unsigned int>(text.size()), "");
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!parsed) throw InputError(file, "tinygltf cannot read it: " + error);
  return model;
}

/// Sets the names of the file's scenes and variants, and of the chosen ones.
void nameChoices(const LoadContext& context, const std::string& variant, Scene& scene) {
  const tinygltf::Model& model = context.model;
  for (const tinygltf::Scene& one : model.scenes) scene.scenes.push_back(one.name);
  const std::size_t chosen = model.defaultScene >= 0 ? static_cast<std::size_t>(model.defaultScene) : 0;
  if (chosen < model.scenes.size()) {
    scene.chosen = static_cast<int>(chosen);
    scene.name = model.scenes[chosen].name;
  }
  scene.variants = loadVariants(context);
  scene.variant = variant;
}

/// Returns the index of the scene's variant; -1 without one.
int indexOfVariant(const Scene& scene) {
  if (scene.variant.empty()) return -1;
  const auto found = std::find(scene.variants.begin(), scene.variants.end(), scene.variant);
  if (found != scene.variants.end()) return static_cast<int>(found - scene.variants.begin());
  std::string list;
  for (const std::string& name : scene.variants)
    list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", name);
  throw UsageError(fmt::format("LoadOptions::variant \"{}\"", scene.variant), "there is none with that name",
                   list.empty() ? "the file has no variants of its materials" : "the file has " + list);
}

}  // namespace

LoadContext::LoadContext(const GltfDocument& source, Warnings& out)
    : document(source),
      warnings(out),
      file(source.path.string()),
      root(file, source.json),
      model(parseModel(source, file)) {}

std::optional<JsonCursor> LoadContext::extension(const JsonCursor& object, std::string_view name) {
  const auto extensions = object.find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

float finiteFloat(const JsonCursor& number) {
  const auto value = static_cast<float>(number.asNumber());
  if (!std::isfinite(value)) number.fail(fmt::format("{} does not fit a 32-bit float", number.asNumber()));
  return value;
}

const Material& Scene::materialOf(const Primitive& primitive) const {
  static const Material defaultMaterial;
  return primitive.material < 0 ? defaultMaterial : materials[static_cast<std::size_t>(primitive.material)];
}

Scene loadScene(const GltfDocument& document, Warnings& warnings, const std::string& variant) {
  const LoadContext context(document, warnings);
  const tinygltf::Model& model = context.model;
  Scene scene;
  scene.materials = loadMaterials(context);
  scene.images = loadImages(context, scene.materials);
  scene.meshes.resize(model.meshes.size());
  std::vector<bool> loaded(model.meshes.size(), false);

  scene.nodes = loadNodes(context);
  checkSceneSize(context, scene.nodes);
  const std::vector<glm::dmat4> world = restTransforms(context, scene.nodes);
  nameChoices(context, variant, scene);
  const int variantIndex = indexOfVariant(scene);
  SkinLoader skins(context, scene.nodes);
  ProfileLoader profiles(context);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int index = scene.nodes[i].node;
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(index)];
    if (node.mesh >= 0) {
      const auto mesh = static_cast<std::size_t>(node.mesh);
      if (!loaded[mesh]) scene.meshes[mesh] = loadMesh(context, mesh, variantIndex);
      loaded[mesh] = true;
      MeshNode& drawn = scene.meshNodes.emplace_back(
          MeshNode{index, node.name, node.mesh, {}, i, loadInstances(context, index)});
      const JsonCursor json = context.root.at("nodes").at(static_cast<std::size_t>(index));
      drawn.weights = drawn.restWeights = loadWeights(json, scene.meshes[mesh]);
      drawn.skin = skins.skinOf(json, mesh, scene.meshes[mesh], scene.skins);
      if (drawn.skin >= 0 && !drawn.instances.empty())
        context.warn(
            fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing", index),
            "glTF does not say where instances of a skinned mesh stand; they are moved from where its "
            "joints have it");
    }
    if (node.camera >= 0) {
      scene.cameras.push_back(loadCamera(context, index, world[i]));
      scene.cameras.back().sceneNode = i;
    }
    for (auto light : {loadLight(context, index, world[i]), profiles.lightOf(index, world[i])}) {
      if (!light) continue;
      light->sceneNode = i;
      scene.lights.push_back(*std::move(light));
    }
  }
  warnOfPointsAndLines(context, loaded);
  placeMeshes(scene, world, context.file + ": ");
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (!loaded[i]) {
      scene.meshes[i].name = model.meshes[i].name;
      scene.meshes[i].primitives.resize(model.meshes[i].primitives.size());
    }
  }
  scene.animations = loadAnimations(context, scene);
  return scene;
}

}  // namespace prelight
