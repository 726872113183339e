#include "prelight/photons.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

#include <utility>

#include "prelight/device.h"
#include "python/module.h"
#include "python/option_rows.h"
#include "python/progress.h"
#include "python/result_arrays.h"
#include "python/scene.h"
#include "python/vectors.h"

namespace prelight::python {

using namespace nb::literals;

namespace {

/// Photons for Python. The arrays of its members look into them.
struct PythonPhotons {
  std::shared_ptr<const PhotonResult> result;
};

template <typename Scalar, typename Vector>
View<Scalar, 2> vectorsIn(const PythonPhotons& landed, const Vector LandedPhoton::*member) {
  const std::vector<LandedPhoton>& photons = landed.result->photons;
  const Scalar* first = photons.empty() ? nullptr : &(photons.front().*member).x;
  return memberOf<Scalar, 2>(first, sizeof(LandedPhoton), {photons.size(), 3}, landed.result);
}

View<std::uint32_t, 1> numbersIn(const PythonPhotons& landed, const std::uint32_t LandedPhoton::*member) {
  const std::vector<LandedPhoton>& photons = landed.result->photons;
  const std::uint32_t* first = photons.empty() ? nullptr : &(photons.front().*member);
  return memberOf<std::uint32_t, 1>(first, sizeof(LandedPhoton), {photons.size()}, landed.result);
}

PythonPhotons send(const PythonScene& scene, const PhotonOptions& wanted, const std::optional<PythonSky>& sky,
                   const Device* device, nb::object progress) {
  return {interruptibly(std::move(progress), [&](Progress& told) {
    PhotonOptions options = wanted;
    options.sky = sky ? sky->environment.get() : nullptr;
    options.device = device;
    options.progress = &told;
    return std::make_shared<const PhotonResult>(photons(*scene.loaded, options));
  })};
}

}  // namespace

void bindPhotons(nb::module_& module) {
  nb::class_<PhotonOptions> options(module, "_PhotonOptions");
  bindRows(options);
  options.def(nb::init<>()).def_rw("seed", &PhotonOptions::seed);
  module.def("_photons", &send, nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none(), nb::arg().none());
  nb::class_<PythonPhotons>(module, "Photons",
                            "Photons at the places where they landed, in arrays that share their memory.")
      .def_prop_ro(
          "positions", [](const PythonPhotons& p) { return vectorsIn<double>(p, &LandedPhoton::position); },
          "[photon, xyz], world space, m.", nb::rv_policy::automatic)
      .def_prop_ro(
          "powers", [](const PythonPhotons& p) { return vectorsIn<float>(p, &LandedPhoton::power); },
          "[photon, rgb], W.", nb::rv_policy::automatic)
      .def_prop_ro(
          "directions", [](const PythonPhotons& p) { return vectorsIn<float>(p, &LandedPhoton::direction); },
          "[photon, xyz], unit, towards the photon's origin.", nb::rv_policy::automatic)
      .def_prop_ro(
          "triangles", [](const PythonPhotons& p) { return numbersIn(p, &LandedPhoton::triangle); },
          nb::rv_policy::automatic)
      .def_prop_ro(
          "paths", [](const PythonPhotons& p) { return numbersIn(p, &LandedPhoton::path); },
          "[photon]; equal numbers mark one photon at its successive surfaces.", nb::rv_policy::automatic)
      .def_prop_ro(
          "sent", [](const PythonPhotons& p) { return p.result->sent; },
          "Number of photons that left the lights.")
      .def_prop_ro(
          "emitted", [](const PythonPhotons& p) { return numbersOf(p.result->emitted); }, "W.")
      .def_prop_ro(
          "absorbed", [](const PythonPhotons& p) { return numbersOf(p.result->absorbed); }, "W.")
      .def_prop_ro(
          "escaped", [](const PythonPhotons& p) { return numbersOf(p.result->escaped); }, "W.")
      .def("__len__", [](const PythonPhotons& p) { return p.result->photons.size(); });
}

}  // namespace prelight::python
