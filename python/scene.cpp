#include "python/scene.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstring>
#include <utility>

#include "prelight/make_scene.h"
#include "prelight/refine.h"
#include "python/array_checks.h"
#include "python/option_rows.h"
#include "python/progress.h"
#include "python/result_arrays.h"
#include "python/unlocked_work.h"
#include "python/vectors.h"

namespace prelight::python {

using namespace nb::literals;

namespace {

PythonScene keep(LoadedScene&& scene) { return {std::make_shared<const LoadedScene>(std::move(scene))}; }

PythonScene loadFile(const std::filesystem::path& path, const LoadOptions& options) {
  const UnlockedWork unlocked;
  return keep(load(path, options));
}

PythonScene loadNamed(const std::string& name) {
  const UnlockedWork unlocked;
  return keep(loadBuiltin(name));
}

std::vector<std::pair<std::string, std::string>> builtinNames() {
  std::vector<std::pair<std::string, std::string>> names;
  for (const BuiltinScene& scene : builtinScenes()) names.emplace_back(scene.name, scene.description);
  return names;
}

/// A mesh from Python's arrays, checked and held until a scene is made from it.
struct PythonMesh {
  std::string name;
  GivenArray<glm::vec3> positions, normals;
  GivenArray<glm::uvec3> triangles;
  GivenArray<glm::vec2> texCoords, texCoords1;
  GivenArray<glm::vec4> colors;
  int material = -1;
  glm::dmat4 toWorld{1.0};

  MeshArrays arrays() const {
    return {name,           positions.values, triangles.values,
            normals.values, texCoords.values, texCoords1.values,
            colors.values,  material,         toWorld};
  }
};

/// The optional arrays of a mesh.
struct MeshAttributes {
  nb::object normals, texCoords, texCoords1, colors;
};

void setAttributes(PythonMesh& mesh, const MeshAttributes& given) {
  mesh.normals = rowsOf<glm::vec3>(given.normals, "Mesh: normals");
  mesh.texCoords = rowsOf<glm::vec2>(given.texCoords, "Mesh: tex_coords");
  mesh.texCoords1 = rowsOf<glm::vec2>(given.texCoords1, "Mesh: tex_coords1");
  mesh.colors = rowsOf<glm::vec4>(given.colors, "Mesh: colors");
}

void bindMeshes(nb::module_& module) {
  nb::class_<PythonMesh>(module, "_Mesh")
      .def("__init__",
           [](PythonMesh* place, nb::handle positions, nb::handle triangles) {
             PythonMesh mesh;
             mesh.positions = rowsOf<glm::vec3>(positions, "Mesh: positions");
             mesh.triangles = rowsOf<glm::uvec3>(triangles, "Mesh: triangles");
             new (place) PythonMesh(std::move(mesh));
           })
      .def(
          "set_attributes",
          [](PythonMesh& mesh, nb::object normals, nb::object texCoords, nb::object texCoords1,
             nb::object colors) {
            setAttributes(
                mesh, {std::move(normals), std::move(texCoords), std::move(texCoords1), std::move(colors)});
          },
          nb::arg().none(), nb::arg().none(), nb::arg().none(), nb::arg().none())
      .def_rw("name", &PythonMesh::name)
      .def_rw("material", &PythonMesh::material)
      .def_prop_rw(
          "to_world", [](const PythonMesh& mesh) { return rowsOf(mesh.toWorld); },
          [](PythonMesh& mesh, const Rows4& rows) { mesh.toWorld = matrixOf(rows); });
}

PythonScene sceneOfArrays(const std::vector<const PythonMesh*>& meshes, std::vector<PlainMaterial> materials,
                          std::vector<Light> lights, std::vector<Camera> cameras, const std::string& name) {
  SceneArrays arrays{name, {}, std::move(materials), std::move(lights), std::move(cameras)};
  for (const PythonMesh* mesh : meshes) arrays.meshes.push_back(mesh->arrays());
  const UnlockedWork unlocked;
  return keep(makeScene(arrays));
}

/// Returns a member array of the compiled scene, with one vector per row.
template <typename Scalar, typename Vector>
View<Scalar, 2> rowsIn(const PythonScene& scene, const std::vector<Vector>& values) {
  return viewOf<Scalar, 2>(values.data(), {values.size(), static_cast<std::size_t>(Vector::length())},
                           scene.loaded);
}

void bindSceneArrays(nb::class_<PythonScene>& scene) {
  scene
      .def_prop_ro(
          "positions", [](const PythonScene& s) { return rowsIn<float>(s, s.compiled().positions); },
          "[vertex, xyz], m, relative to `origin`.", nb::rv_policy::automatic)
      .def_prop_ro(
          "normals", [](const PythonScene& s) { return rowsIn<float>(s, s.compiled().normals); },
          "[vertex, xyz], unit.", nb::rv_policy::automatic)
      .def_prop_ro(
          "tex_coords", [](const PythonScene& s) { return rowsIn<float>(s, s.compiled().texCoords); },
          "[vertex, uv], the first set, where a material has a texture.", nb::rv_policy::automatic)
      .def_prop_ro(
          "triangles", [](const PythonScene& s) { return rowsIn<std::uint32_t>(s, s.compiled().triangles); },
          "[triangle, corner], vertices.", nb::rv_policy::automatic)
      .def_prop_ro(
          "triangle_materials",
          [](const PythonScene& s) {
            return viewOf<std::uint32_t, 1>(s.compiled().triangleMaterials.data(),
                                            {s.compiled().triangleMaterials.size()}, s.loaded);
          },
          "Index into `albedos` [triangle].", nb::rv_policy::automatic)
      .def_prop_ro(
          "albedos",
          [](const PythonScene& s) {
            std::vector<glm::vec3> albedos;
            for (const CompiledMaterial& material : s.compiled().materials)
              albedos.push_back(material.albedo);
            const std::size_t count = albedos.size();
            return arrayFrom<float, 2>(std::move(albedos), {count, 3});
          },
          "[material, rgb], diffuse, without textures.", nb::rv_policy::automatic);
}

void bindSceneText(nb::class_<PythonScene>& scene) {
  scene.def_prop_ro("vertex_count", [](const PythonScene& s) { return s.compiled().vertexCount(); })
      .def_prop_ro("triangle_count", [](const PythonScene& s) { return s.compiled().triangleCount(); })
      .def_prop_ro(
          "origin", [](const PythonScene& s) { return numbersOf(s.compiled().origin); },
          "World position, m, that `positions` are relative to.")
      .def_prop_ro(
          "bounds",
          [](const PythonScene& s) {
            const CompiledScene& c = s.compiled();
            return std::make_pair(numbersOf(c.origin + glm::dvec3(c.boundsMin)),
                                  numbersOf(c.origin + glm::dvec3(c.boundsMax)));
          },
          "Least and greatest world coordinates, m.")
      .def_prop_ro(
          "primitives", [](const PythonScene& s) { return s.compiled().primitives; },
          "The vertices and triangles of each node.")
      .def_prop_ro("lights", [](const PythonScene& s) { return s.loaded->scene.lights; })
      .def_prop_ro("cameras", [](const PythonScene& s) { return s.loaded->scene.cameras; })
      .def_prop_ro(
          "sky",
          [](const PythonScene& s) -> std::optional<PythonSky> {
            if (!s.loaded->sky) return std::nullopt;
            return PythonSky{s.loaded->sky};
          },
          "The file's own sky, or None.")
      .def_prop_ro(
          "warnings", [](const PythonScene& s) { return s.loaded->warnings; }, "Warnings about the file.")
      .def_prop_ro("path", [](const PythonScene& s) { return s.loaded->path.string(); })
      .def("__repr__", [](const PythonScene& s) {
        return "<prelight.Scene \"" + s.loaded->path.string() +
               "\": " + std::to_string(s.compiled().vertexCount()) + " vertices, " +
               std::to_string(s.compiled().triangleCount()) + " triangles>";
      });
}

void bindPrimitives(nb::module_& module) {
  nb::class_<PrimitiveRange>(module, "Primitive", "A primitive's place in the arrays of a scene.")
      .def_ro("name", &PrimitiveRange::name, "Name of the node; may be empty.")
      .def_ro("node", &PrimitiveRange::node)
      .def_ro("primitive", &PrimitiveRange::primitive, "Index within the node's mesh.")
      .def_ro("instance", &PrimitiveRange::instance)
      .def_ro("first_vertex", &PrimitiveRange::firstVertex)
      .def_ro("vertex_count", &PrimitiveRange::vertexCount)
      .def_ro("first_triangle", &PrimitiveRange::firstTriangle)
      .def_ro("triangle_count", &PrimitiveRange::triangleCount)
      .def_prop_ro(
          "vertices",
          [](const PrimitiveRange& range) {
            return nb::slice(nb::int_(range.firstVertex), nb::int_(range.firstVertex + range.vertexCount),
                             nb::int_(1));
          },
          "Slice of the scene's vertices.");
}

std::pair<PythonScene, RefineReport> refined(const PythonScene& scene, const RefineRequest& request,
                                             const Device* device, nb::object progress) {
  return interruptibly(std::move(progress), [&](Progress& told) {
    RefinedScene result = refine(*scene.loaded, request, device, &told);
    return std::make_pair(keep(std::move(result.scene)), result.report);
  });
}

PythonScene unwrapped(const PythonScene& scene, int size, nb::object progress) {
  return interruptibly(std::move(progress),
                       [&](Progress& told) { return keep(unwrap(*scene.loaded, size, &told)); });
}

void bindRefinement(nb::module_& module) {
  nb::class_<RefineRequest> request(module, "_RefineRequest");
  bindRows(request);
  request.def(nb::init<>());
  nb::class_<RefineReport>(module, "RefineReport", "What refine() has done.")
      .def_ro("vertices", &RefineReport::vertices, "Vertices that were added.")
      .def_ro("triangles", &RefineReport::triangles, "Triangles that were added.")
      .def_ro("primitives", &RefineReport::primitives, "Primitives that were subdivided.")
      .def_ro("error_before", &RefineReport::errorBefore, "Estimated error before, rms over the surface.")
      .def_ro("error", &RefineReport::error, "Estimated error afterwards, rms over the surface.")
      .def_ro("least_edge", &RefineReport::leastEdge, "m; edges shorter than twice this are not cut.")
      .def_ro("limited", &RefineReport::limited, "Whether the limit of vertices ended the refinement.")
      .def_ro("rays", &RefineReport::rays, "Rays cast for the estimates.");
  module.def("_refine", &refined, nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none());
  module.def("_unwrap", &unwrapped, nb::arg(), nb::arg(), nb::arg().none());
}

void bindLoading(nb::module_& module) {
  nb::class_<LoadOptions> options(module, "_LoadOptions");
  bindRows(options);
  options.def(nb::init<>())
      .def_rw("scene", &LoadOptions::scene)
      .def_rw("variant", &LoadOptions::variant)
      .def_rw("animation", &LoadOptions::animation);
  module.def("_load", &loadFile);
  module.def("builtin", &loadNamed, "name"_a, "A built-in scene with a camera and a light.");
  module.def("builtin_scenes", &builtinNames, "Names and descriptions of the built-in scenes.");
  module.def("_make_scene", &sceneOfArrays);
}

}  // namespace

void bindScenes(nb::module_& module) {
  bindPrimitives(module);
  bindMeshes(module);
  nb::class_<PythonScene> scene(module, "Scene", "A scene, as it was read and in flat arrays.");
  bindSceneArrays(scene);
  bindSceneText(scene);
  bindLoading(module);
  bindRefinement(module);
}

}  // namespace prelight::python
