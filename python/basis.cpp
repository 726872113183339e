#include "prelight/basis.h"

#include <nanobind/stl/array.h>

#include <utility>
#include <vector>

#include "python/array_checks.h"
#include "python/module.h"
#include "python/result_arrays.h"
#include "python/scene.h"
#include "python/vectors.h"

namespace prelight::python {

using namespace nb::literals;

namespace {

constexpr std::size_t channels = 3;

std::size_t termsOf(int order) { return static_cast<std::size_t>(order) * static_cast<std::size_t>(order); }

Result<double, 2> valuesOf(HarmonicBasis basis, nb::handle directions, int order) {
  const GivenArray<glm::dvec3> given = rowsOf<glm::dvec3>(directions, "directions");
  std::vector<double> values = basisValues(basis, given.values, order);
  return arrayFrom<double, 2>(std::move(values), {given.values.size(), termsOf(order)});
}

/// A function from rows of coefficients to rows of coefficients.
using Map = std::vector<double> (*)(std::span<const double>, int);

Result<double, 2> mapped(Map map, nb::handle rows, int order) {
  const GivenArray<double> given = arrayOf<double>(rows, "coefficients", {-1, -1});
  std::vector<double> values = map(given.values, order);
  return arrayFrom<double, 2>(std::move(values), {given.held.shape(0), given.held.shape(1)});
}

Result<double, 2> rotated(HarmonicBasis basis, nb::handle rows, int order, const Rows3& rotation) {
  const GivenArray<double> given = arrayOf<double>(rows, "coefficients", {-1, -1});
  std::vector<double> values = rotateHarmonics(basis, given.values, order, matrixOf(rotation));
  return arrayFrom<double, 2>(std::move(values), {given.held.shape(0), given.held.shape(1)});
}

nb::tuple rule(int degree) {
  SphereRule made = sphereRule(degree);
  const std::size_t count = made.weights.size();
  return nb::make_tuple(arrayFrom<double, 2>(std::move(made.directions), {count, 3}),
                        arrayFrom<double, 1>(std::move(made.weights), {count}));
}

void bindHarmonics(nb::module_& module) {
  nb::enum_<HarmonicBasis>(module, "_HarmonicBasis")
      .value("sh", HarmonicBasis::Sh)
      .value("ch", HarmonicBasis::Ch);
  module.def("_basis_values", &valuesOf);
  module.def("_rotate_harmonics", &rotated);
  module.def("_ch_from_sh", [](nb::handle rows, int order) { return mapped(&chFromSh, rows, order); });
  module.def("_sh_from_ch", [](nb::handle rows, int order) { return mapped(&shFromCh, rows, order); });
  module.def("_ch_moments", [](nb::handle rows, int order) { return mapped(&chMomentsFromSh, rows, order); });
  module.def("_sphere_rule", &rule);
  module.def("_project_sky", [](const PythonSky& sky, int order) {
    std::vector<double> light = projectSky(*sky.environment, order);
    return arrayFrom<double, 2>(std::move(light), {channels, termsOf(order)});
  });
}

/// A Haar transform that changes the values of one or several cube maps in place.
using Transform = void (*)(std::span<float>, int);

Result<float, 2> transformed(Transform transform, nb::handle maps, int faceSize) {
  const GivenArray<float> given = arrayOf<float>(maps, "maps", {-1, -1});
  std::vector<float> values(given.values.begin(), given.values.end());
  transform(values, faceSize);
  return arrayFrom<float, 2>(std::move(values), {given.held.shape(0), given.held.shape(1)});
}

Result<float, 2> cubeOf(const PythonSky& sky, int faceSize) {
  std::vector<glm::vec3> texels = cubeOfSky(*sky.environment, faceSize);
  const std::size_t count = texels.size();
  return arrayFrom<float, 2>(std::move(texels), {count, channels});
}

void bindWavelets(nb::module_& module) {
  module.def("_haar_forward",
             [](nb::handle maps, int size) { return transformed(&haarForward, maps, size); });
  module.def("_haar_inverse",
             [](nb::handle maps, int size) { return transformed(&haarInverse, maps, size); });
  module.def("_cube_of_sky", &cubeOf);
  module.def("_cube_directions", [](int faceSize) {
    std::vector<glm::dvec3> directions = cubeDirections(faceSize);
    const std::size_t count = directions.size();
    return arrayFrom<double, 2>(std::move(directions), {count, 3});
  });
  module.def("_rotate_cube", [](nb::handle maps, int faceSize, const Rows3& rotation) {
    const GivenArray<float> given = arrayOf<float>(maps, "maps", {-1, -1});
    std::vector<float> turned = rotateCube(given.values, faceSize, matrixOf(rotation));
    return arrayFrom<float, 2>(std::move(turned), {given.held.shape(0), given.held.shape(1)});
  });
  module.def("_haar_kept", [](nb::handle coefficients, double error) {
    const GivenArray<float> given = listOf<float>(coefficients, "coefficients");
    std::vector<std::uint32_t> kept = haarKept(given.values, error);
    const std::size_t count = kept.size();
    return arrayFrom<std::uint32_t, 1>(std::move(kept), {count});
  });
}

}  // namespace

void bindBasis(nb::module_& module) {
  bindHarmonics(module);
  bindWavelets(module);
}

}  // namespace prelight::python
