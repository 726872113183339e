#include "cli/commands/picture_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "cli/commands/picture_options.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "io/finite_results.h"
#include "viewer/follow/frames.h"

namespace prelight::cli {

namespace {

constexpr std::size_t mostDigits = 9;
constexpr double mostFrames = 1e6;

void checkSequence(const PictureOptions& options) {
  if (options.shading == viewer::Shading::Instant)
    throw UsageError("--fps --shading instant", "its light is computed for one moment",
                     "draw each moment by itself, with --at");
  if (options.causticPhotons > 0)
    throw UsageError("--fps --caustics", "its photons are sent at one moment",
                     "draw full shading, which has caustics of every moment, or each moment with --at");
}

}  // namespace

std::vector<SceneMoment> momentsOf(const PictureOptions& options, const Scene& scene, const Bake& bake,
                                   double framesASecond) {
  if (scene.animations.empty()) throw UsageError("--fps", "the scene has no animations");
  const std::size_t index = pictures::animationMeant(options.pose, scene, bake);
  const Animation& animation = scene.animations[index];
  const double start = options.pose.at.value_or(animation.startTime());
  const double frames = std::floor((animation.endTime() - start) * framesASecond + 1e-6) + 1.0;
  if (!(frames >= 1.0 && frames <= mostFrames))
    throw UsageError("--fps", fmt::format("{:g} pictures from {:g} s to {:g} s, the animation's end", frames,
                                          start, animation.endTime()));
  std::vector<SceneMoment> moments;
  for (std::size_t i = 0; i < static_cast<std::size_t>(frames); ++i)
    moments.push_back({index, start + static_cast<double>(i) / framesASecond});
  return moments;
}

FrameNames::FrameNames(const std::filesystem::path& pattern) : folder_(pattern.parent_path()) {
  const std::string name = pattern.filename().string();
  const UsageError missing("-o " + pattern.string(), "a sequence needs a place for numbers in its name",
                           "write %d or %04d there, once, as in frame.%04d.png");
  const std::size_t start = name.find('%');
  if (start == std::string::npos || name.find('%', start + 1) != std::string::npos) throw missing;
  const std::size_t end = name.find('d', start);
  if (end == std::string::npos) throw missing;
  const std::string_view digits = std::string_view(name).substr(start + 1, end - start - 1);
  if (!digits.empty()) {
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), digits_);
    if (error != std::errc{} || stop != digits.data() + digits.size() || digits.front() != '0' ||
        digits_ < 1 || digits_ > mostDigits)
      throw missing;
  }
  before_ = name.substr(0, start);
  after_ = name.substr(end + 1);
}

std::filesystem::path FrameNames::of(std::size_t frame) const {
  return folder_ / fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

void renderSequence(Session& session, const PictureOptions& options, double framesASecond,
                    const std::filesystem::path& output) {
  checkSequence(options);
  const FrameNames names(output);
  pictures::ShadedScene shaded = pictures::prepareScene(
      session, options, false, [&] { checkPictureOutputs(options, "-o", names.of(0)); });
  shaded.render.layersOfFrames = takesLayers(output);
  const std::vector<SceneMoment> moments =
      momentsOf(options, shaded.loaded.scene, shaded.bake, framesASecond);
  ExposureOption exposure = options.exposure;
  std::optional<double> chosen;
  Warnings notes;
  const auto write = [&](std::size_t frame, const Picture& picture,
                         const std::vector<PictureChannel>& layers) {
    session.progress().check();
    requireFinite(names.of(frame), picture);
    chosen = writeExposed(session, names.of(frame), {picture, layers}, exposure);
    if (chosen) exposure.factor = *chosen;  // the first picture's exposure serves all
  };
  session.times().measure("render", [&] {
    viewer::renderFrames(shaded.inputs(), shaded.render, shaded.poseSources(options.pose), moments, write,
                         notes);
  });
  for (const std::string& note : notes) session.console().note(note);
  if (shaded.run) printBakeSummary(session.console(), shaded.request, *shaded.run, session.times());
  session.console().line(
      "wrote", fmt::format("{} pictures of {}x{}, {} to {}, in {}", moments.size(), shaded.render.width,
                           shaded.render.height, names.of(0).string(), names.of(moments.size() - 1).string(),
                           shortSeconds(session.times().total())));
  nlohmann::ordered_json report = drawnReport(session, options, output, shaded, notes);
  report["frames"] = moments.size();
  addLook(report, shaded.studio, chosen);
  session.console().json(report);
}

}  // namespace prelight::cli
