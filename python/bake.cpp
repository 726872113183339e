#include "python/bake.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <utility>

#include "prelight/device.h"
#include "prelight/load.h"
#include "python/module.h"
#include "python/progress.h"
#include "python/scene.h"

namespace prelight::python {

namespace nb = nanobind;

namespace {

PythonBake bakeScene(const PythonScene& scene, const BakeRequest& request, const Device* device,
                     nb::object progress, const std::filesystem::path& checkpoint) {
  BakeResult result = interruptibly(std::move(progress), [&](Progress& told) {
    return bake(*scene.loaded, request, {device, &told, checkpoint});
  });
  return {std::make_shared<const Bake>(std::move(result.bake)), std::move(result.report)};
}

nb::list passesOf(const Plan& plan) {
  nb::list passes;
  for (const PlannedPass& pass : plan.passes)
    passes.append(nb::make_tuple(std::string(nameOf(pass.pass)), pass.runs, pass.reason));
  return passes;
}

/// What a file carries is read whole: vertices' SH that were compressed are unpacked.
std::optional<PythonBake> carried(const PythonScene& scene) {
  const nb::gil_scoped_release released;
  std::optional<Bake> found = carriedBake(*scene.loaded);
  if (!found) return std::nullopt;
  if (!found->sh && found->compressedSh) found->sh = decompress(*found->compressedSh);
  return PythonBake{std::make_shared<const Bake>(*std::move(found)), {}};
}

void saveBake(const std::filesystem::path& path, const PythonScene& scene, const PythonBake* made) {
  const nb::gil_scoped_release released;
  save(path, *scene.loaded, made != nullptr ? *made->bake : Bake{});
}

/// A field of a part of the request.
template <typename Part, typename Value>
auto partOf(Part BakeRequest::*part, Value Part::*field) {
  return std::make_pair([part, field](const BakeRequest& r) { return (r.*part).*field; },
                        [part, field](BakeRequest& r, const Value& value) { (r.*part).*field = value; });
}

template <typename Part, typename Value>
void bindPart(nb::class_<BakeRequest>& request, const char* name, Part BakeRequest::*part,
              Value Part::*field) {
  const auto [get, set] = partOf(part, field);
  request.def_prop_rw(name, get, set, nb::for_setter(nb::arg().none()));
}

void bindParts(nb::class_<BakeRequest>& request) {
  bindPart(request, "sh", &BakeRequest::sh, &ShRequest::order);
  bindPart(request, "ch", &BakeRequest::ch, &ChRequest::order);
  bindPart(request, "haar", &BakeRequest::haar, &HaarRequest::size);
  bindPart(request, "haar_error", &BakeRequest::haar, &HaarRequest::error);
  bindPart(request, "glossy", &BakeRequest::glossy, &GlossyRequest::order);
  bindPart(request, "horizons", &BakeRequest::horizons, &HorizonsRequest::sectors);
  bindPart(request, "light_groups", &BakeRequest::lightGroups, &LightGroupsRequest::wanted);
  bindPart(request, "radiosity", &BakeRequest::radiosity, &RadiosityRequest::wanted);
  bindPart(request, "patch_size", &BakeRequest::radiosity, &RadiosityRequest::patchSize);
  bindPart(request, "sky_rotation", &BakeRequest::radiosity, &RadiosityRequest::skyRotation);
  bindPart(request, "light_map", &BakeRequest::lightMap, &LightMapRequest::wanted);
  bindPart(request, "texel_size", &BakeRequest::lightMap, &LightMapRequest::texelSize);
  bindPart(request, "denoise", &BakeRequest::lightMap, &LightMapRequest::denoise);
  bindPart(request, "caustics", &BakeRequest::lightMap, &LightMapRequest::caustics);
  bindPart(request, "photons", &BakeRequest::lightMap, &LightMapRequest::photons);
  bindPart(request, "rays", &BakeRequest::effort, &Effort::rays);
  bindPart(request, "error", &BakeRequest::effort, &Effort::error);
  bindPart(request, "seconds", &BakeRequest::effort, &Effort::seconds);
  bindPart(request, "nearest", &BakeRequest::limits, &OcclusionLimits::nearest);
  bindPart(request, "farthest", &BakeRequest::limits, &OcclusionLimits::farthest);
  request.def_prop_rw(
      "sky",
      [](const BakeRequest& r) { return std::optional<PythonSky>(PythonSky{r.radiosity.environment}); },
      [](BakeRequest& r, const std::optional<PythonSky>& sky) {
        r.radiosity.environment = sky ? sky->environment : nullptr;
      },
      nb::for_setter(nb::arg().none()));
}

void bindRequest(nb::module_& module) {
  nb::class_<BakeRequest> request(module, "_BakeRequest");
  request.def(nb::init<>())
      .def_rw("ao", &BakeRequest::ao)
      .def_rw("cones", &BakeRequest::cones)
      .def_rw("bounces", &BakeRequest::bounces)
      .def_rw("specular", &BakeRequest::specular)
      .def_rw("subsurface", &BakeRequest::subsurface)
      .def_rw("seed", &BakeRequest::seed)
      .def_rw("max_memory", &BakeRequest::maxMemory, nb::arg().none());
  bindParts(request);
}

void bindReport(nb::class_<PythonBake>& bake) {
  bake.def_prop_ro(
          "rays", [](const PythonBake& b) { return b.bake->info.rays; }, "Cast in all.")
      .def_prop_ro(
          "error", [](const PythonBake& b) { return b.bake->info.error; },
          "Estimated standard error of ambient occlusion, RMS over the surface.")
      .def_prop_ro("seconds", [](const PythonBake& b) { return b.bake->info.seconds; })
      .def_prop_ro("device", [](const PythonBake& b) { return b.bake->info.device; })
      .def_prop_ro("bounces", [](const PythonBake& b) { return b.bake->info.bounces; })
      .def_prop_ro(
          "passes", [](const PythonBake& b) { return passesOf(b.bake->info.plan); },
          "(name, whether it ran, why) of every pass.")
      .def_prop_ro("stage_seconds", [](const PythonBake& b) { return b.report.stageSeconds; })
      .def_prop_ro("notes", [](const PythonBake& b) { return b.report.notes; });
}

}  // namespace

void bindBaking(nb::module_& module) {
  bindRequest(module);
  nb::class_<PythonBake> made(module, "Bake", "What was baked; a technique that was not asked for is None.");
  bindBakedParts(made);
  bindReport(made);
  module.def("_bake", &bakeScene, nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none(), nb::arg());
  module.def("_plan", [](const PythonScene& scene, const BakeRequest& request) {
    const Plan planned = plan(*scene.loaded, request);
    return nb::make_tuple(passesOf(planned), planned.hostBytes, planned.deviceBytes);
  });
  module.def("carried_bake", &carried, nb::arg("scene"),
             "What a scene's file carries of an earlier bake, or None.");
  module.def("save", &saveBake, nb::arg("path"), nb::arg("scene"), nb::arg("bake").none() = nb::none(),
             "Writes a scene's file as .glb with a bake in place of an earlier one.");
}

}  // namespace prelight::python
