#include "cli/commands/global_illumination_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/commands/denoiser_report.h"
#include "cli/commands/planned_picture.h"
#include "cli/options/options.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "io/finite_results.h"
#include "io/plan_json.h"
#include "pictures/session/darkness.h"
#include "pictures/traced_picture.h"
#include "viewer/core/camera.h"

namespace prelight::cli {
namespace {

using namespace pictures;

/// Returns the name of the value that an option has.
template <typename Options>
const char* chosenName(const Options& options, std::string_view name) {
  const Option<Options>& row = optionNamed<Options>(name);
  return row.choices[static_cast<std::size_t>(row.get(options).value_or(0.0))].name;
}

nlohmann::ordered_json photonJson(const PhotonReport& photons) {
  return {{"emitted", photons.emitted}, {"stored", photons.stored}, {"rays", photons.rays}};
}

nlohmann::ordered_json pictureReport(const PictureOptions& options,
                                     const GlobalIlluminationPictureRequest& request,
                                     const GlobalIlluminationPictureReport& made,
                                     const std::filesystem::path& output, const DeviceInfo& device,
                                     Session& session) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const auto& [name, seconds] : made.stageSeconds) stages[name] = seconds;
  return reportOf("render", {{"scene", options.scene.string()},
                             {"output", output.string()},
                             {"shading", "full"},
                             {"width", request.width},
                             {"height", request.height},
                             {"spp", request.samples},
                             {"seed", request.seed},
                             {"texels", made.texels},
                             {"gather", chosenName(request, "gather")},
                             {"gatheredAt", made.gatheredAt},
                             {"photonsBy", chosenName(request, "photons-by")},
                             {"photons", photonJson(made.photons)},
                             {"causticPhotons", photonJson(made.causticPhotons)},
                             {"rays", made.rays},
                             {"seconds", session.times().total()},
                             {"stages", cli::toJson(session.times())},
                             {"fullStages", stages},
                             {"device", cli::toJson(device)},
                             {"plan", toJson(made.plan)},
                             {"warnings", session.warnings()}});
}

void printSummary(const GlobalIlluminationPictureRequest& request,
                  const GlobalIlluminationPictureReport& made, const std::filesystem::path& output,
                  Session& session) {
  const Console& console = session.console();
  console.line("photons", fmt::format("{} from lights, {} towards mirrors and glass",
                                      shortCount(double(made.photons.emitted)),
                                      shortCount(double(made.causticPhotons.emitted))));
  console.line("traced",
               fmt::format("{} rays, {} texels, {} samples per pixel", shortCount(double(made.rays)),
                           shortCount(double(made.texels)), request.samples));
  for (const PlannedPass& pass : made.plan)
    if (!pass.runs) console.line("skipped", fmt::format("{}: {}", pass.name, pass.reason));
  if (console.detailsWanted())
    for (const auto& [name, seconds] : made.stageSeconds)
      console.line("", fmt::format("{:<12}{:8.3f} s", name, seconds));
  console.line("wrote", fmt::format("{}: {}x{}, full shading, in {}", output.string(), request.width,
                                    request.height, shortSeconds(session.times().total())));
}

/// Returns the request for a part of the picture: a share of its pixels, of its map's texels and of its
/// photons.
GlobalIlluminationPictureRequest shareOf(const GlobalIlluminationPictureRequest& whole,
                                         std::uint32_t triangles, double share) {
  GlobalIlluminationPictureRequest part = whole;
  const auto scaled = [](double value) { return std::max(1.0, std::round(value)); };
  part.width = static_cast<int>(scaled(whole.width * std::sqrt(share)));
  part.height = static_cast<int>(scaled(whole.height * std::sqrt(share)));
  part.texels = static_cast<std::uint32_t>(scaled(whole.mapTexels(triangles) * share));
  part.causticPhotons =
      static_cast<std::uint64_t>(scaled(static_cast<double>(whole.photonsOfCaustics()) * share));
  part.indirect.photons = static_cast<std::uint64_t>(
      scaled(static_cast<double>(whole.photonsOfIndirectLight(triangles)) * share));
  return part;
}

struct PictureSample {
  WorkSample sample = {};
  Picture picture = {};
  GlobalIlluminationPictureReport report = {};
};

PictureSample drawSample(Session& session, const LoadedScene& loaded, const TracedPlan& plan, double share,
                         const Device& device) {
  PictureSample drawn{.sample = {.size = share}};
  const GlobalIlluminationPictureRequest request =
      shareOf(plan.request, loaded.compiled.triangleCount(), share);
  drawn.sample.work = measureWork([&] {
    drawn.picture = renderGlobalIllumination(loaded.scene, plan.lit, plan.camera, request, device,
                                             session.progress(), drawn.report);
  });
  session.progress().clear();
  return drawn;
}

/// Returns the share of the second sample: as much of a picture as takes about two seconds, between a
/// sixteenth and a quarter.
double shareOfLarge(const WorkSample& first) {
  constexpr double seconds = 2.0;
  return std::clamp(first.size * seconds / std::max(first.work.seconds, 1e-3), 1.0 / 16.0, 1.0 / 4.0);
}

/// Estimates a picture from two samples, since all of its work grows with the pixels, texels and photons.
PlannedPicture estimatePicture(Session& session, const LoadedScene& loaded, const TracedPlan& plan,
                               const Device& device) {
  constexpr double least = 1.0 / 64.0;
  const Work before = workSoFar(session.times().total());
  const PictureSample first = drawSample(session, loaded, plan, least, device);  // loads kernels
  const PictureSample again = drawSample(session, loaded, plan, least, device);
  const double share = shareOfLarge(again.sample);
  const PictureSample small = drawSample(session, loaded, plan, share / 4.0, device);
  const PictureSample large = drawSample(session, loaded, plan, share, device);
  PlannedPicture planned{.width = plan.request.width, .height = plan.request.height};
  planned.how = fmt::format("full shading, {} samples per pixel", plan.request.samples);
  planned.plan = large.report.plan;
  planned.device = device.info();
  planned.estimate = extrapolate(small.sample, large.sample, 1.0, planned.device);
  addOnce(before, first.sample.work, again.sample.work, *planned.estimate);
  planned.time = fmt::format("from a picture of {:.0f} % of its pixels", 100.0 * share);
  std::vector<PictureChannel> layers;
  addLayers(large.report.parts, layers);
  planned.bytes = static_cast<std::uint64_t>(
      static_cast<double>(encodedBytes("sample.exr", large.picture, layers)) / share);
  return planned;
}

/// The request with the parts that the output holds.
PictureOptions withLayersOf(const std::filesystem::path& output, PictureOptions options) {
  options.full.parts = takesLayers(output) || options.render.layers != viewer::wholePicture;
  return options;
}

}  // namespace

void planGlobalIlluminationPicture(Session& session, const PictureOptions& options,
                                   const std::filesystem::path& output) {
  LoadedScene loaded = loadForPicture(session, options);
  checkOutputFile("-o", output, {".exr", ".png"});
  PictureSetUp setUp = setUpPicture(session, options, loaded);
  const TracedPlan plan = planTracedPicture(session, withLayersOf(output, options), loaded, setUp);
  const DeviceOptions deviceOptions = session.deviceOptions(options.bake);
  const Device device = session.times().measure("device", [&] { return Device::open(deviceOptions); });
  PlannedPicture planned = estimatePicture(session, loaded, plan, device);
  planned.output = output;
  printPlannedPicture(session.console(), planned);
  nlohmann::ordered_json report =
      reportOf("render", {{"scene", options.scene.string()}, {"shading", "full"}});
  addPlannedPicture(planned, report);
  report["warnings"] = session.warnings();
  session.console().json(report);
}

void renderGlobalIlluminationPicture(Session& session, const PictureOptions& asked,
                                     const std::filesystem::path& output) {
  const PictureOptions options = withLayersOf(output, asked);
  PictureDenoising denoising(options.bake.request.lightMap.denoise);
  const auto opening = openAside(session, options);
  LoadedScene loaded = loadForPicture(session, options);
  checkOutputFile("-o", output, {".exr", ".png"});
  PictureSetUp setUp = setUpPicture(session, options, loaded);
  TracedPicture made = tracePicture(session, options, loaded, setUp, denoising, opening);
  const LayeredPicture& picture = made.layered;
  requireFinite(output, picture.picture);
  const std::optional<double> exposure = writeExposed(session, output, picture, options.exposure);
  warnOfDarkness(session, picture.picture, loaded, made.camera,
                 {made.lights, setUp.sky.map ? &*setUp.sky.map : nullptr, !options.render.lights});
  printDenoiser(session.console(), denoising);
  printSummary(made.request, made.report, output, session);
  nlohmann::ordered_json report =
      pictureReport(options, made.request, made.report, output, opening.get()->info(), session);
  addDenoiser(report, denoising);
  addLook(report, setUp.sky.studio, exposure);
  session.console().json(report);
}

void renderGlobalIlluminationSequence(Session& session, const PictureOptions& options, double framesASecond,
                                      const std::filesystem::path& output) {
  const FrameNames names(output);
  PictureDenoising denoising(options.bake.request.lightMap.denoise);
  const auto opening = openAside(session, options);
  LoadedScene first = session.load(options.scene, options.load);
  const std::vector<SceneMoment> moments =
      momentsOf(options, first.scene, carriedBake(session, first), framesASecond);
  checkOutputFile("-o", names.of(0), {".exr", ".png"});
  PictureOptions now = withLayersOf(output, options);
  now.pose.at = moments.front().seconds;
  poseForPicture(session, now.pose, first);
  PictureSetUp setUp = setUpPicture(session, options, first);
  std::optional<double> exposure;
  TracedPicture made;
  for (std::size_t frame = 0; frame < moments.size(); ++frame) {
    now.pose.at = moments[frame].seconds;
    LoadedScene loaded = first;
    poseForPicture(session, now.pose, loaded);
    made = tracePicture(session, now, loaded, setUp, denoising, opening);
    const LayeredPicture& picture = made.layered;
    requireFinite(names.of(frame), picture.picture);
    exposure = writeExposed(session, names.of(frame), picture, now.exposure);
    if (exposure) now.exposure.factor = *exposure;  // the first picture's exposure serves all
  }
  printDenoiser(session.console(), denoising);
  printSummary(made.request, made.report, names.of(moments.size() - 1), session);
  nlohmann::ordered_json report =
      pictureReport(options, made.request, made.report, output, opening.get()->info(), session);
  addDenoiser(report, denoising);
  report["frames"] = moments.size();
  addLook(report, setUp.sky.studio, exposure);
  session.console().json(report);
}

}  // namespace prelight::cli
