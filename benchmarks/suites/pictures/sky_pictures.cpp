#include "benchmarks/suites/pictures/sky_pictures.h"

#include <cmath>

#include "benchmarks/run/timing.h"
#include "viewer/frame/render.h"

namespace prelight::benchmarks {

namespace {

constexpr std::uint64_t firstSeed = 101, secondSeed = 102, otherSeed = 7;

}  // namespace

Environment makeLobedSky(int rows) {
  Environment sky{2 * rows, rows, {}};
  const glm::dvec3 first = glm::normalize(glm::dvec3(0.5, 0.7, 0.5)), second(-0.8, 0.6, 0.0);
  const auto lobe = [](double cosine) { return 0.25 * (1.0 + cosine) * (1.0 + cosine); };
  for (int y = 0; y < sky.height; ++y)
    for (int x = 0; x < sky.width; ++x) {
      const glm::dvec3 way = Environment::direction((x + 0.5) / sky.width, (y + 0.5) / sky.height);
      sky.radiance.emplace_back(lobe(glm::dot(way, first)) * glm::dvec3(0.6, 0.5, 0.4) +
                                lobe(glm::dot(way, second)) * glm::dvec3(0.1, 0.2, 0.3));
    }
  return sky;
}

SkyTrial::SkyTrial(const BenchmarkScene& scene, const Environment& sky, const PicturesOptions& options,
                   const Device& device, const Progress& progress)
    : scene_(scene), sky_(sky), options_(options), device_(device), progress_(progress) {
  first_ = traced(options.materialTruthSamples, firstSeed);
  second_ = traced(options.materialTruthSamples, secondSeed);
  Picture black = first_;
  for (glm::vec3& pixel : black.pixels) pixel = glm::vec3(0.0f);
  size_ = pictureRmse(first_, black);
}

Picture tracedPicture(const BenchmarkScene& scene, const Environment* sky,
                      const reference::ReferenceRequest& request, const Device& device,
                      const Progress& progress) {
  const reference::ReferenceInputs inputs{
      .scene = scene.compiled,
      .images = scene.scene.images,
      .lights = sky != nullptr ? std::vector<Light>() : scene.scene.lights,
      .camera = scene.scene.cameras.at(0),
      .sky = sky};
  reference::Film film(request.width, request.height);
  reference::ReferenceReport report;
  StopOnly quiet(progress);
  renderReference(inputs, request, device, quiet, film, report);
  return film.picture();
}

Picture SkyTrial::traced(std::uint64_t samples, std::uint64_t seed) const {
  reference::ReferenceRequest request;
  request.samples = samples;
  request.seed = seed;
  request.width = options_.materialWidth;
  request.height = options_.materialHeight;
  return tracedPicture(scene_, &sky_, request, device_, progress_);
}

MeasuredError SkyTrial::errorOf(const Picture& picture) const {
  const MeasuredError error = errorBetween(picture, first_, second_);
  return {error.rmse / size_, error.standardError / size_};
}

SkyPicture SkyTrial::trace(std::uint64_t samples) const {
  const double start = processorSeconds();
  const Picture picture = traced(samples, otherSeed);
  const double seconds = processorSeconds() - start;
  return {errorOf(picture), seconds, 0};
}

SkyPicture SkyTrial::draw(const BakeRequest& request, viewer::Shading shading) const {
  const double start = processorSeconds();
  const TimedBake baked = timedBake(scene_, request, device_, progress_);
  const viewer::RenderInputs inputs{scene_.scene, scene_.compiled, &baked.bake, &sky_, &device_};
  viewer::RenderOptions options;
  options.shading = shading;
  options.width = options_.materialWidth;
  options.height = options_.materialHeight;
  options.lights.emplace();
  Warnings notes;
  const Picture picture = renderPicture(inputs, options, notes);
  const double seconds = processorSeconds() - start;
  return {errorOf(picture), seconds, baked.report.rays};
}

}  // namespace prelight::benchmarks
