#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "prelight/device.h"
#include "prelight/error.h"
#include "prelight/options.h"
#include "python/bake.h"
#include "python/pictures.h"
#include "python/scene.h"
#include "python/unlocked_work.h"
#include "viewer/frame/render.h"

namespace prelight::python {

namespace nb = nanobind;

namespace {

/// The options of a picture drawn by OpenGL.
struct DrawOptions {
  std::string shading;
  int width = 0;
  int height = 0;
  std::optional<Camera> camera;
  std::optional<std::vector<Light>> lights;
  std::optional<PythonSky> sky;
  double skyRotation = 0.0;
};

/// Throws UsageError if the bake does not hold the shading's data.
viewer::Shading shadingOf(const std::string& name, const Bake& bake) {
  const viewer::Shading shading = viewer::parseShading(name);
  if (viewer::showsAllLight(shading))
    throw UsageError("shading " + name, "it computes its light, and is not drawn from a bake",
                     "prelight.render(method=\"global_illumination\") shows all light");
  const viewer::ShadingInfo& info = viewer::infoOf(shading);
  if (!info.carriedBy(bake))
    throw UsageError("shading " + name, "the bake does not hold the data that it needs",
                     fmt::format("bake as `prelight bake --{}` does", info.bakeOption));
  return shading;
}

/// Returns the scene with a further camera, because the renderer chooses among the scene's cameras.
Scene withCamera(Scene scene, const Camera& camera) {
  scene.cameras.push_back(camera);
  return scene;
}

std::pair<Picture, Warnings> drawn(const PythonScene& scene, const Bake& bake, const DrawOptions& options,
                                   const Device* device) {
  requireRanges(
      RenderOptions{.width = options.width, .height = options.height, .skyRotation = options.skyRotation});
  viewer::RenderOptions render;
  render.shading = shadingOf(options.shading, bake);
  render.width = options.width;
  render.height = options.height;
  render.skyRotation = options.skyRotation;
  render.lights = options.lights;
  std::optional<Scene> changed;
  if (options.camera) {
    changed = withCamera(scene.loaded->scene, *options.camera);
    render.camera = static_cast<int>(changed->cameras.size()) - 1;
  }
  const viewer::RenderInputs inputs{.scene = changed ? *changed : scene.loaded->scene,
                                    .compiled = scene.compiled(),
                                    .bake = &bake,
                                    .environment = options.sky ? options.sky->environment.get() : nullptr,
                                    .device = device};
  Warnings notes;
  Picture picture = viewer::renderPicture(inputs, render, notes);
  return {std::move(picture), std::move(notes)};
}

nb::tuple drawScene(const PythonScene& scene, const PythonBake* baked, const DrawOptions& options,
                    const Device* device) {
  auto [picture, notes] = [&] {
    const UnlockedWork unlocked;
    return drawn(scene, baked != nullptr ? *baked->bake : Bake{}, options, device);
  }();
  return nb::make_tuple(pixelsOf(std::move(picture)), notes);
}

}  // namespace

}  // namespace prelight::python

NB_MODULE(_viewer, module) {
  using prelight::python::DrawOptions;
  namespace nb = nanobind;
  nb::module_::import_("prelight._native");  // defines the classes that these functions take
  prelight::python::bindInterpreterEnd();
  nb::class_<DrawOptions> options(module, "DrawOptions");
  options.def(nb::init<>())
      .def_rw("shading", &DrawOptions::shading)
      .def_rw("width", &DrawOptions::width)
      .def_rw("height", &DrawOptions::height)
      .def_rw("camera", &DrawOptions::camera, nb::arg().none())
      .def_rw("lights", &DrawOptions::lights, nb::arg().none())
      .def_rw("sky", &DrawOptions::sky, nb::arg().none())
      .def_rw("sky_rotation", &DrawOptions::skyRotation);
  module.def("draw", &prelight::python::drawScene, nb::arg(), nb::arg().none(), nb::arg(), nb::arg().none());
}
