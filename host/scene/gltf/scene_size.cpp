#include "scene/gltf/scene_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/machine_memory.h"
#include "prelight/error.h"

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

}  // namespace prelight
