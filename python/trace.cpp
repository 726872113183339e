#include "prelight/trace.h"

#include <memory>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

#include "prelight/device.h"
#include "prelight/error.h"
#include "python/array_checks.h"
#include "python/module.h"
#include "python/result_arrays.h"
#include "python/scene.h"
#include "python/unlocked_work.h"

namespace prelight::python {

using namespace nb::literals;

namespace {

/// Keeps the memory of freed results for the next ones, since fresh pages cost as much as writing to them.
/// One piece is kept; several threads may return theirs at the same time.
class SparePages {
 public:
  /// Returns fresh memory or that of a freed result; it returns to `pages` at its end.
  template <typename T>
  static std::shared_ptr<T> roomFor(const std::shared_ptr<SparePages>& pages, std::size_t count) {
    Pages room = pages->take(count * sizeof(T));
    const std::size_t bytes = room.bytes;
    return {static_cast<T*>(room.memory.release()), [pages, bytes](T* given) {
              pages->giveBack({Memory(given), bytes});
            }};
  }

 private:
  struct Release {
    void operator()(void* memory) const { ::operator delete(memory); }
  };
  using Memory = std::unique_ptr<void, Release>;
  struct Pages {
    Memory memory;
    std::size_t bytes = 0;
  };

  Pages take(std::size_t bytes) {
    const std::lock_guard lock(guard_);
    if (spare_.memory != nullptr && spare_.bytes == bytes) return std::exchange(spare_, {});
    return {Memory(::operator new(bytes)), bytes};
  }

  void giveBack(Pages&& pages) {
    const std::lock_guard lock(guard_);
    spare_ = std::move(pages);
  }

  std::mutex guard_;
  Pages spare_;
};

/// Hits for Python. The arrays of its members look into them.
struct PythonHits {
  std::shared_ptr<ArrayHit> hits;  ///< `count` of them
  std::size_t count = 0;

  std::span<ArrayHit> values() const { return {hits.get(), count}; }
};

template <typename T>
View<T, 1> memberIn(const PythonHits& found, const T ArrayHit::*member) {
  const T* first = found.count == 0 ? nullptr : &(found.hits.get()->*member);
  return memberOf<T, 1>(first, sizeof(ArrayHit), {found.count}, found.hits);
}

View<float, 2> weightsIn(const PythonHits& found) {
  const float* first = found.count == 0 ? nullptr : &found.hits->weights.x;
  return memberOf<float, 2>(first, sizeof(ArrayHit), {found.count, 2}, found.hits);
}

/// Rays from Python's arrays.
struct GivenRays {
  GivenArray<glm::vec3> origins, directions;
  GivenArray<float> farthest;

  GivenRays(nb::handle givenOrigins, nb::handle givenDirections, nb::handle givenFarthest)
      : origins(rowsOf<glm::vec3>(givenOrigins, "origins")),
        directions(rowsOf<glm::vec3>(givenDirections, "directions")),
        farthest(listOf<float>(givenFarthest, "farthest")) {}

  RayArrays arrays() const { return {origins.values, directions.values, farthest.values}; }
};

/// A tracer, and the device that it was given.
struct PythonTracer {
  nb::object device;
  RayTracer tracer;
  std::shared_ptr<SparePages> pages = std::make_shared<SparePages>();
};

void makeTracer(PythonTracer* place, const PythonScene& scene, nb::object given) {
  const Device* device = given.is_none() ? nullptr : nb::cast<const Device*>(given);
  RayTracer tracer = [&] {
    const UnlockedWork unlocked;
    return RayTracer(*scene.loaded, {device});
  }();
  new (place) PythonTracer{std::move(given), std::move(tracer)};
}

PythonHits closestOf(PythonTracer& tracer, nb::handle origins, nb::handle directions, nb::handle farthest) {
  const GivenRays rays(origins, directions, farthest);
  const UnlockedWork unlocked;
  const std::size_t count = rays.origins.values.size();
  PythonHits found{SparePages::roomFor<ArrayHit>(tracer.pages, count), count};
  tracer.tracer.closest(rays.arrays(), found.values());
  return found;
}

Result<bool, 1> blockedOf(PythonTracer& tracer, nb::handle origins, nb::handle directions,
                          nb::handle farthest) {
  const GivenRays rays(origins, directions, farthest);
  std::vector<std::uint8_t> blocked(rays.origins.values.size());
  {
    const UnlockedWork unlocked;
    tracer.tracer.blocked(rays.arrays(), blocked);
  }
  const std::size_t count = blocked.size();
  return arrayFrom<bool, 1>(std::move(blocked), {count});
}

}  // namespace

void bindTracing(nb::module_& module) {
  nb::class_<PythonHits>(module, "Hits", "The closest hits of rays, in arrays that share their memory.")
      .def_prop_ro(
          "distance", [](const PythonHits& h) { return memberIn(h, &ArrayHit::distance); },
          "[ray], m; infinite where nothing is hit.", nb::rv_policy::automatic)
      .def_prop_ro(
          "triangle", [](const PythonHits& h) { return memberIn(h, &ArrayHit::triangle); },
          "[ray], into the scene's triangles; -1 where nothing is hit.", nb::rv_policy::automatic)
      .def_prop_ro("weights", &weightsIn, "[ray, 2], barycentric, of the triangle's second and third vertex.",
                   nb::rv_policy::automatic)
      .def("__len__", [](const PythonHits& h) { return h.count; });
  nb::class_<PythonTracer>(module, "RayTracer", "A scene prepared for tracing rays several times.")
      .def("__init__", &makeTracer, "scene"_a, "device"_a = nb::none(), "Builds the scene's hierarchy.")
      .def("trace", &closestOf, "origins"_a, "directions"_a, "farthest"_a = nb::none(),
           "The closest hits of rays. `origins` and `directions`: [ray, xyz] of float32, world space, m; "
           "`farthest`: [ray] of float32, m.")
      .def("blocked", &blockedOf, "origins"_a, "directions"_a, "farthest"_a = nb::none(),
           "Whether each ray hits anything [ray]; cheaper than the closest hits.");
}

}  // namespace prelight::python
