#include "prelight/render.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include <utility>

#include "prelight/device.h"
#include "python/module.h"
#include "python/option_rows.h"
#include "python/pictures.h"
#include "python/progress.h"
#include "python/result_arrays.h"
#include "python/scene.h"

namespace prelight::python {

using namespace nb::literals;

namespace {

/// The options of a picture for Python.
struct PythonRenderOptions {
  RenderOptions options;
  std::optional<PythonSky> sky;  ///< kept as long as the options

  RenderOptions with(const Device* device, Progress* progress) const {
    RenderOptions all = options;
    all.sky = sky ? sky->environment.get() : nullptr;
    all.device = device;
    all.progress = progress;
    return all;
  }
};

Result<float, 3> renderScene(const PythonScene& scene, const PythonRenderOptions& options,
                             const Device* device, nb::object progress) {
  return pixelsOf(interruptibly(std::move(progress), [&](Progress& told) {
    return render(*scene.loaded, options.with(device, &told));
  }));
}

/// A reference picture whose arrays belong to Python.
struct PythonReference {
  std::shared_ptr<const ReferencePicture> made;
};

PythonReference referenceOf(const PythonScene& scene, const PythonRenderOptions& options,
                            const ReferenceGoal& goal, const Device* device, nb::object progress) {
  return {interruptibly(std::move(progress), [&](Progress& told) {
    return std::make_shared<const ReferencePicture>(
        drawReference(*scene.loaded, options.with(device, &told), goal));
  })};
}

View<float, 3> pictureIn(const PythonReference& reference) {
  const Picture& picture = reference.made->picture;
  return viewOf<float, 3>(
      picture.pixels.data(),
      {static_cast<std::size_t>(picture.height), static_cast<std::size_t>(picture.width), 3}, reference.made);
}

View<float, 2> varianceIn(const PythonReference& reference) {
  const std::vector<float>& variance = reference.made->variance;
  const auto width = static_cast<std::size_t>(reference.made->picture.width);
  return viewOf<float, 2>(variance.data(), {variance.size() / width, width}, reference.made);
}

void bindOptions(nb::module_& module) {
  using Options = PythonRenderOptions;
  nb::class_<Options> options(module, "_RenderOptions");
  bindRows<RenderOptions>(options, [](Options& o) -> RenderOptions& { return o.options; });
  options.def(nb::init<>())
      .def_prop_rw(
          "seed", [](const Options& o) { return o.options.seed; },
          [](Options& o, std::uint64_t seed) { o.options.seed = seed; })
      .def_prop_rw(
          "camera", [](const Options& o) { return o.options.camera; },
          [](Options& o, std::optional<Camera> camera) { o.options.camera = std::move(camera); },
          nb::for_setter(nb::arg().none()))
      .def_prop_rw(
          "lights", [](const Options& o) { return o.options.lights; },
          [](Options& o, std::optional<std::vector<Light>> lights) { o.options.lights = std::move(lights); },
          nb::for_setter(nb::arg().none()))
      .def_prop_rw(
          "sky", [](const Options& o) { return o.sky; },
          [](Options& o, std::optional<PythonSky> sky) { o.sky = std::move(sky); },
          nb::for_setter(nb::arg().none()));
  nb::class_<ReferenceGoal> goal(module, "_ReferenceGoal");
  goal.def(nb::init<>());
  bindRows(goal);
}

}  // namespace

void bindRendering(nb::module_& module) {
  bindOptions(module);
  module.def("_render", &renderScene, nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none());
  module.def("_reference", &referenceOf, nb::arg(), nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none());
  nb::class_<PythonReference>(module, "Reference", "A picture with statistics of its noise.")
      .def_prop_ro("picture", &pictureIn, "[row, column, rgb], linear radiance, W/(m2 sr).",
                   nb::rv_policy::automatic)
      .def_prop_ro("variance", &varianceIn,
                   "Variance of the mean luminance [row, column]; empty after a single pass.",
                   nb::rv_policy::automatic)
      .def_prop_ro(
          "error", [](const PythonReference& r) { return r.made->error; },
          "RMS standard error of a pixel's luminance over the picture's mean.")
      .def_prop_ro(
          "samples", [](const PythonReference& r) { return r.made->samples; }, "A pixel.")
      .def_prop_ro("rays", [](const PythonReference& r) { return r.made->rays; })
      .def_prop_ro(
          "seconds", [](const PythonReference& r) { return r.made->seconds; }, "Of tracing.");
}

}  // namespace prelight::python
