#include "prelight/trace.h"

#include <utility>
#include <vector>

#include "prelight/device.h"
#include "prelight/error.h"
#include "python/array_checks.h"
#include "python/module.h"
#include "python/result_arrays.h"
#include "python/scene.h"

namespace prelight::python {

using namespace nb::literals;

namespace {

/// Hits whose members are arrays that look into them.
struct PythonHits {
  std::shared_ptr<const std::vector<ArrayHit>> hits;
};

template <typename T>
View<T, 1> memberIn(const PythonHits& found, const T ArrayHit::*member) {
  const std::vector<ArrayHit>& hits = *found.hits;
  const T* first = hits.empty() ? nullptr : &(hits.front().*member);
  return memberOf<T, 1>(first, sizeof(ArrayHit), {hits.size()}, found.hits);
}

View<float, 2> weightsIn(const PythonHits& found) {
  const std::vector<ArrayHit>& hits = *found.hits;
  const float* first = hits.empty() ? nullptr : &hits.front().weights.x;
  return memberOf<float, 2>(first, sizeof(ArrayHit), {hits.size(), 2}, found.hits);
}

/// Rays of Python's arrays.
struct GivenRays {
  GivenArray<glm::vec3> origins, directions;
  GivenArray<float> farthest;

  GivenRays(nb::handle givenOrigins, nb::handle givenDirections, nb::handle givenFarthest)
      : origins(rowsOf<glm::vec3>(givenOrigins, "origins")),
        directions(rowsOf<glm::vec3>(givenDirections, "directions")),
        farthest(listOf<float>(givenFarthest, "farthest")) {}

  RayArrays arrays() const { return {origins.values, directions.values, farthest.values}; }
};

/// A tracer, with the device that it was given.
struct PythonTracer {
  nb::object device;
  RayTracer tracer;
};

void makeTracer(PythonTracer* place, const PythonScene& scene, nb::object given) {
  const Device* device = given.is_none() ? nullptr : nb::cast<const Device*>(given);
  RayTracer tracer = [&] {
    const nb::gil_scoped_release released;
    return RayTracer(*scene.loaded, {device});
  }();
  new (place) PythonTracer{std::move(given), std::move(tracer)};
}

PythonHits closestOf(PythonTracer& tracer, nb::handle origins, nb::handle directions, nb::handle farthest) {
  const GivenRays rays(origins, directions, farthest);
  const nb::gil_scoped_release released;
  auto hits = std::make_shared<std::vector<ArrayHit>>(rays.origins.values.size());
  tracer.tracer.closest(rays.arrays(), *hits);
  return {std::move(hits)};
}

Result<bool, 1> blockedOf(PythonTracer& tracer, nb::handle origins, nb::handle directions,
                          nb::handle farthest) {
  const GivenRays rays(origins, directions, farthest);
  std::vector<std::uint8_t> blocked(rays.origins.values.size());
  {
    const nb::gil_scoped_release released;
    tracer.tracer.blocked(rays.arrays(), blocked);
  }
  const std::size_t count = blocked.size();
  return arrayFrom<bool, 1>(std::move(blocked), {count});
}

}  // namespace

void bindTracing(nb::module_& module) {
  nb::class_<PythonHits>(module, "Hits", "What rays meet first, in arrays that share their memory.")
      .def_prop_ro(
          "distance", [](const PythonHits& h) { return memberIn(h, &ArrayHit::distance); },
          "[ray], m; infinite where nothing is hit.", nb::rv_policy::automatic)
      .def_prop_ro(
          "triangle", [](const PythonHits& h) { return memberIn(h, &ArrayHit::triangle); },
          "[ray], into the scene's triangles; -1 where nothing is hit.", nb::rv_policy::automatic)
      .def_prop_ro("weights", &weightsIn, "[ray, 2], barycentric, of the triangle's second and third vertex.",
                   nb::rv_policy::automatic)
      .def("__len__", [](const PythonHits& h) { return h.hits->size(); });
  nb::class_<PythonTracer>(module, "RayTracer", "A scene that rays are traced in again and again.")
      .def("__init__", &makeTracer, "scene"_a, "device"_a = nb::none(), "Builds the scene's hierarchy.")
      .def("trace", &closestOf, "origins"_a, "directions"_a, "farthest"_a = nb::none(),
           "The closest hit of each ray. `origins` and `directions`: [ray, xyz] of float32, world space, m; "
           "`farthest`: [ray] of float32, m.")
      .def("blocked", &blockedOf, "origins"_a, "directions"_a, "farthest"_a = nb::none(),
           "[ray], whether something lies on it; cheaper than the closest.");
}

}  // namespace prelight::python
