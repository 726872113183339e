#include "prelight/harmonic_lights.h"

#include <nanobind/stl/array.h>

#include <utility>
#include <vector>

#include "prelight/basis.h"
#include "python/array_checks.h"
#include "python/module.h"
#include "python/result_arrays.h"
#include "python/vectors.h"

namespace prelight::python {

namespace {

Result<double, 1> listFrom(std::vector<double> values) {
  const std::size_t count = values.size();
  return arrayFrom<double, 1>(std::move(values), {count});
}

GivenArray<double> coefficientsOf(nb::handle values) { return listOf<double>(values, "coefficients"); }

Result<double, 2> matrixOfProduct(nb::handle f, int fOrder, int order) {
  std::vector<double> matrix = productMatrix(coefficientsOf(f).values, fOrder, order);
  const std::size_t terms = static_cast<std::size_t>(order) * static_cast<std::size_t>(order);
  return arrayFrom<double, 2>(std::move(matrix), {terms, terms});
}

nb::tuple triplesOf(int order, int kOrder) {
  std::vector<std::uint32_t> indices;
  std::vector<double> values;
  for (const TripleProduct& triple : tripleProducts(order, kOrder)) {
    indices.insert(indices.end(), {triple.i, triple.j, triple.k});
    values.push_back(triple.value);
  }
  const std::size_t count = values.size();
  return nb::make_tuple(arrayFrom<std::uint32_t, 2>(std::move(indices), {count, 3}),
                        listFrom(std::move(values)));
}

nb::tuple dominantOf(nb::handle radiance, int order, std::size_t most) {
  const GivenArray<double> given = arrayOf<double>(radiance, "radiance", {3, -1});
  DominantLights found = dominantLights(given.values, order, most);
  std::vector<glm::dvec3> towards, irradiance;
  for (const DominantLight& light : found.lights) {
    towards.push_back(light.towards);
    irradiance.push_back(light.irradiance);
  }
  const std::size_t count = towards.size(), terms = found.residual.size() / 3;
  return nb::make_tuple(arrayFrom<double, 2>(std::move(towards), {count, 3}),
                        arrayFrom<double, 2>(std::move(irradiance), {count, 3}),
                        arrayFrom<double, 2>(std::move(found.residual), {3, terms}));
}

void bindProducts(nb::module_& module) {
  module.def("_multiply_sh", [](nb::handle f, int fOrder, nb::handle g, int gOrder, int order) {
    return listFrom(multiplySh(coefficientsOf(f).values, fOrder, coefficientsOf(g).values, gOrder, order));
  });
  module.def("_product_matrix", &matrixOfProduct);
  module.def("_triple_products", &triplesOf);
}

void bindZonal(nb::module_& module) {
  module.def("_zonal_clamped_cosine", [](int order) { return listFrom(zonalClampedCosine(order)); });
  module.def("_zonal_cap", [](double angle, int order) { return listFrom(zonalCap(angle, order)); });
  module.def("_zonal_cosine_power",
             [](double exponent, int order) { return listFrom(zonalCosinePower(exponent, order)); });
  module.def("_rotate_zonal", [](nb::handle zonal, const Numbers3& axis) {
    return listFrom(rotateZonal(listOf<double>(zonal, "zonal").values, vectorOf(axis)));
  });
  module.def("_convolve_sh", [](nb::handle coefficients, nb::handle zonal) {
    return listFrom(convolveSh(coefficientsOf(coefficients).values, listOf<double>(zonal, "zonal").values));
  });
}

void bindLights(nb::module_& module) {
  module.def("_sh_of_direction", [](const Numbers3& towards, int order) {
    return listFrom(shOfDirection(vectorOf(towards), order));
  });
  module.def("_sh_of_point", [](const Numbers3& position, int order) {
    return listFrom(shOfPoint(vectorOf(position), order));
  });
  module.def("_sh_of_cap", [](const Numbers3& towards, double halfAngle, int order) {
    return listFrom(shOfCap(vectorOf(towards), halfAngle, order));
  });
  module.def("_sh_of_sphere", [](const Numbers3& centre, double radius, int order) {
    return listFrom(shOfSphere(vectorOf(centre), radius, order));
  });
  module.def("_sh_of_disk", [](const Numbers3& centre, const Numbers3& normal, double radius, int order) {
    return listFrom(shOfDisk(vectorOf(centre), vectorOf(normal), radius, order));
  });
  module.def("_sh_of_polygon", [](nb::handle vertices, int order) {
    return listFrom(shOfPolygon(rowsOf<glm::dvec3>(vertices, "vertices").values, order));
  });
  module.def("_dominant_lights", &dominantOf);
}

}  // namespace

void bindHarmonicLights(nb::module_& module) {
  bindProducts(module);
  bindZonal(module);
  bindLights(module);
}

}  // namespace prelight::python
