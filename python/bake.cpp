#include "python/bake.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <tuple>
#include <utility>
#include <vector>

#include "prelight/bake_animation.h"
#include "prelight/device.h"
#include "prelight/export.h"
#include "prelight/load.h"
#include "prelight/save_compressed.h"
#include "prelight/stale_bake.h"
#include "python/module.h"
#include "python/option_rows.h"
#include "python/progress.h"
#include "python/scene.h"
#include "python/unlocked_work.h"

namespace prelight::python {

namespace nb = nanobind;

namespace {

PythonBake bakeScene(const PythonScene& scene, const BakeRequest& request,
                     const std::optional<AnimationKeys>& keys, const Device* device, nb::object progress,
                     const std::filesystem::path& checkpoint) {
  if (keys) requireRanges(*keys);  // before the first bake of many
  BakeResult result = interruptibly(std::move(progress), [&](Progress& told) {
    const BakeOptions options{device, &told, checkpoint};
    return keys ? bakeAnimated(*scene.loaded, request, *keys, options)
                : bake(*scene.loaded, request, options);
  });
  return {std::make_shared<const Bake>(std::move(result.bake)), std::move(result.report)};
}

nb::list passesOf(const Plan& plan) {
  nb::list passes;
  for (const PlannedPass& pass : plan.passes)
    passes.append(nb::make_tuple(pass.name, pass.runs, pass.reason));
  return passes;
}

/// Returns the bake in a file, read as a whole (compressed SH of vertices are unpacked), and which parts of
/// it no longer fit the scene.
std::optional<std::pair<PythonBake, std::optional<std::string>>> carried(const PythonScene& scene) {
  const UnlockedWork unlocked;
  std::optional<Bake> found = carriedBake(*scene.loaded);
  if (!found) return std::nullopt;
  std::optional<std::string> stale = staleBake(*scene.loaded, *found);
  if (!found->sh && found->compressedSh) found->sh = decompress(*found->compressedSh);
  return std::pair(PythonBake{std::make_shared<const Bake>(*std::move(found)), {}}, std::move(stale));
}

std::vector<std::string> saveBake(const std::filesystem::path& path, const PythonScene& scene,
                                  const PythonBake* made, const std::string& compression,
                                  bool compressesOccluders) {
  const UnlockedWork unlocked;
  if (made == nullptr) {
    save(path, *scene.loaded);
    return {};
  }
  FileCompression smaller = compression.empty() ? FileCompression{} : parseFileCompression(compression);
  smaller.occluders = compressesOccluders;
  return saveCompressed(path, *scene.loaded, *made->bake, smaller);
}

std::vector<std::tuple<std::string, std::string, std::uint64_t>> exportBaked(
    const std::filesystem::path& output, const PythonScene& scene, const PythonBake& made,
    const ExportOptions& options) {
  const UnlockedWork unlocked;
  std::vector<std::tuple<std::string, std::string, std::uint64_t>> files;
  for (const WrittenFile& file : exportScene(output, *scene.loaded, *made.bake, options).files)
    files.emplace_back(file.name, file.contents, file.bytes);
  return files;
}

void bindSky(nb::class_<BakeRequest>& request) {
  request.def_prop_rw(
      "sky",
      [](const BakeRequest& r) { return std::optional<PythonSky>(PythonSky{r.radiosity.environment}); },
      [](BakeRequest& r, const std::optional<PythonSky>& sky) {
        r.radiosity.environment = sky ? sky->environment : nullptr;
      },
      nb::for_setter(nb::arg().none()));
}

using Patterns = std::vector<std::string>;

/// Binds the lists of names and patterns.
void bindPatterns(nb::class_<BakeRequest>& request) {
  using Groups = std::vector<std::pair<std::string, Patterns>>;
  using Sets = std::vector<std::pair<Patterns, Patterns>>;
  request
      .def_prop_rw(
          "light_group", [](const BakeRequest&) { return Groups(); },
          [](BakeRequest& r, const Groups& groups) {
            r.lightGroups.named.clear();
            for (const auto& [name, patterns] : groups) r.lightGroups.named.push_back({name, patterns});
          })
      .def_prop_rw(
          "shadow_sets", [](const BakeRequest&) { return Sets(); },
          [](BakeRequest& r, const Sets& sets) {
            r.shadowSets.clear();
            for (const auto& [receivers, occluders] : sets) r.shadowSets.push_back({receivers, occluders});
          });
}

void bindRequest(nb::module_& module) {
  nb::class_<BakeRequest> request(module, "_BakeRequest");
  request.def(nb::init<>())
      .def_rw("seed", &BakeRequest::seed)
      .def_prop_rw(
          "encode", [](const BakeRequest& r) { return r.encodedLight.encodings; },
          [](BakeRequest& r, const std::vector<std::string>& names) { r.encodedLight.encodings = names; });
  bindRows(request);
  bindSky(request);
  bindPatterns(request);
}

void bindKeysAndExport(nb::module_& module) {
  nb::class_<AnimationKeys> keys(module, "_AnimationKeys");
  keys.def(nb::init<>()).def_rw("animation", &AnimationKeys::animation);
  bindRows(keys);
  nb::class_<ExportOptions>(module, "_ExportOptions")
      .def(nb::init<>())
      .def_rw("target", &ExportOptions::target)
      .def_rw("form", &ExportOptions::form)
      .def_rw("lights", &ExportOptions::lights)
      .def_rw("name", &ExportOptions::name)
      .def_rw("dry_run", &ExportOptions::dryRun);
  module.def("_export", &exportBaked);
}

void bindReport(nb::class_<PythonBake>& bake) {
  bake.def_prop_ro(
          "rays", [](const PythonBake& b) { return b.bake->info.rays; }, "Number of rays that were cast.")
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
      .def_prop_ro(
          "notes",
          [](const PythonBake& b) {
            std::vector<std::string> all = b.report.notes;
            all.insert(all.end(), b.report.warnings.begin(), b.report.warnings.end());
            return all;
          },
          "Remarks about what was left out or is odd, such as light that arrives nowhere.");
}

}  // namespace

void bindBaking(nb::module_& module) {
  bindRequest(module);
  nb::class_<PythonBake> made(module, "Bake", "A bake. Techniques that were not asked for are None.");
  bindBakedParts(made);
  bindReport(made);
  bindKeysAndExport(module);
  module.def("_bake", &bakeScene, nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none(), nb::arg().none(),
             nb::arg());
  module.def("_plan", [](const PythonScene& scene, const BakeRequest& request) {
    const Plan planned = plan(*scene.loaded, request);
    return nb::make_tuple(passesOf(planned), planned.hostBytes, planned.deviceBytes);
  });
  module.def("_carried_bake", &carried);
  module.def("_save", &saveBake, nb::arg(), nb::arg(), nb::arg().none(), nb::arg(), nb::arg());
}

}  // namespace prelight::python
