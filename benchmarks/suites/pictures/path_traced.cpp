#include "benchmarks/suites/pictures/path_traced.h"

#include "integrators/reference.h"

namespace prelight::benchmarks {

TimedPicture pathTrace(const BenchmarkScene& scene, int size, std::uint64_t samples, std::uint64_t seed,
                       const Device& device, const Progress& progress) {
  const reference::ReferenceInputs inputs{.scene = scene.compiled,
                                          .images = scene.scene.images,
                                          .lights = scene.scene.lights,
                                          .camera = scene.scene.cameras.at(0)};
  reference::ReferenceRequest request;
  request.samples = samples;
  request.seed = seed;
  request.width = request.height = size;
  reference::Film film(size, size);
  reference::ReferenceReport report;
  StopOnly quiet(progress);
  TimedPicture result;
  result.seconds = secondsOf([&] { renderReference(inputs, request, device, quiet, film, report); });
  result.picture = film.picture();
  result.reportedError = film.passes < 2 ? 0.0 : film.relativeError();
  return result;
}

}  // namespace prelight::benchmarks
