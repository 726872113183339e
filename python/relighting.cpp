#include "prelight/relighter.h"

#include <fmt/format.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <string>
#include <utility>
#include <vector>

#include "prelight/error.h"
#include "python/array_checks.h"
#include "python/bake.h"
#include "python/module.h"
#include "python/result_arrays.h"
#include "python/scene.h"
#include "python/unlocked_work.h"
#include "python/vectors.h"

namespace prelight::python {

using namespace nb::literals;

namespace {

constexpr std::size_t channels = 3;

void makeRelighter(Relighter* place, const PythonBake& baked, const Device& device,
                   const std::string& technique, std::size_t wavelets, int skyLights,
                   const PythonScene* scene) {
  const RelighterOptions options{.technique = technique,
                                 .wavelets = wavelets,
                                 .skyLights = skyLights,
                                 .scene = scene == nullptr ? nullptr : scene->loaded.get()};
  const UnlockedWork unlocked;
  new (place) Relighter(*baked.bake, device, options);
}

/// Lights as arrays: directions [light, xyz], irradiance [light, rgb] and half angles [light].
std::vector<DistantLight> lightsOf(nb::handle towards, nb::handle irradiance, nb::handle halfAngles) {
  const GivenArray<glm::dvec3> directions = rowsOf<glm::dvec3>(towards, "lights"),
                               colors = rowsOf<glm::dvec3>(irradiance, "lights");
  const GivenArray<double> angles = listOf<double>(halfAngles, "lights");
  if (directions.values.size() != angles.values.size() || colors.values.size() != angles.values.size())
    throw UsageError("lights",
                     fmt::format("got {} directions, {} colours and {} half angles, expected as many of each",
                                 directions.values.size(), colors.values.size(), angles.values.size()));
  std::vector<DistantLight> lights;
  for (std::size_t i = 0; i < directions.values.size(); ++i)
    lights.push_back({directions.values[i], colors.values[i], angles.values[i]});
  return lights;
}

void lightBy(Relighter& relighter, const PythonSky* sky, const nb::tuple& lights, nb::handle coefficients,
             const Rows3& rotation, nb::handle groups) {
  GivenArray<double> further;
  if (!coefficients.is_none()) further = arrayOf<double>(coefficients, "coefficients", {3, -1});
  const GivenArray<glm::vec3> colors = rowsOf<glm::vec3>(groups, "groups");
  const RelighterLight given{.sky = sky == nullptr ? nullptr : sky->environment.get(),
                             .lights = lightsOf(lights[0], lights[1], lights[2]),
                             .coefficients = {further.values.begin(), further.values.end()},
                             .rotation = matrixOf(rotation),
                             .groups = {colors.values.begin(), colors.values.end()}};
  const UnlockedWork unlocked;
  relighter.light(given);
}

using Colors = nb::ndarray<float, nb::numpy, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

void radianceInto(Relighter& relighter, const Colors& out) {
  const std::span<glm::vec3> colors(reinterpret_cast<glm::vec3*>(out.data()), out.shape(0));
  const UnlockedWork unlocked;
  relighter.relight(colors);
}

Result<float, 2> relitRadiance(Relighter& relighter) {
  std::vector<glm::vec3> radiance(relighter.receiverCount());
  {
    const UnlockedWork unlocked;
    relighter.relight(radiance);
  }
  const std::size_t count = radiance.size();
  return arrayFrom<float, 2>(std::move(radiance), {count, channels});
}

void makeProjector(SkyProjector* place, const Device& device, const PythonSky& sky, int order) {
  const UnlockedWork unlocked;
  new (place) SkyProjector(device, sky.environment->width, sky.environment->height, order);
  place->setSky(*sky.environment);
}

void replaceSky(SkyProjector& projector, const PythonSky& sky) {
  const UnlockedWork unlocked;
  projector.setSky(*sky.environment);
}

Result<double, 2> projected(SkyProjector& projector, const Rows3& rotation) {
  std::vector<double> light;
  {
    const UnlockedWork unlocked;
    projector.setRotation(matrixOf(rotation));
    light = projector.projectSh();
  }
  const std::size_t terms = light.size() / channels;
  return arrayFrom<double, 2>(std::move(light), {channels, terms});
}

Result<float, 2> projectedWavelets(SkyProjector& projector, int faceSize, int samples,
                                   const Rows3& rotation) {
  std::vector<float> light;
  {
    const UnlockedWork unlocked;
    projector.setRotation(matrixOf(rotation));
    light = projector.projectWavelets(faceSize, samples);
  }
  const std::size_t terms = light.size() / channels;
  return arrayFrom<float, 2>(std::move(light), {channels, terms});
}

}  // namespace

void bindRelighting(nb::module_& module) {
  nb::class_<Relighter>(module, "_Relighter")
      .def("__init__", &makeRelighter, "bake"_a, "device"_a, "technique"_a, "wavelets"_a, "sky_lights"_a,
           "scene"_a.none(), nb::keep_alive<1, 3>())
      .def_prop_ro("technique", [](const Relighter& r) { return r.technique(); })
      .def_prop_ro("reason", [](const Relighter& r) { return r.reason(); })
      .def_prop_ro("count", &Relighter::receiverCount)
      .def_prop_ro("bytes_moved", &Relighter::bytesMoved)
      .def("light", &lightBy, "sky"_a.none(), "lights"_a, "coefficients"_a.none(), "rotation"_a,
           "groups"_a.none())
      .def("set_time", &Relighter::setTime)
      .def("radiance", &relitRadiance)
      .def("radiance_into", &radianceInto, "out"_a.noconvert());
  nb::class_<SkyProjector>(module, "_SkyProjector")
      .def("__init__", &makeProjector, "device"_a, "sky"_a, "order"_a, nb::keep_alive<1, 2>())
      .def("set_sky", &replaceSky)
      .def("sh", &projected)
      .def("wavelets", &projectedWavelets);
}

}  // namespace prelight::python
