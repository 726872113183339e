#include "prelight/transfer.h"

#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "prelight/relight.h"
#include "python/array_checks.h"
#include "python/held_part.h"
#include "python/module.h"
#include "python/result_arrays.h"

namespace prelight::python {

using namespace nb::literals;

namespace {

/// Returns values [vertex] of a bake, or None if there are none.
std::optional<View<float, 1>> numbersIn(const PythonBake& baked, const std::vector<float>& values) {
  if (values.empty()) return std::nullopt;
  return viewOf<float, 1>(values.data(), {values.size()}, baked.bake);
}

std::optional<View<float, 2>> vectorsIn(const PythonBake& baked, const std::vector<glm::vec3>& values) {
  if (values.empty()) return std::nullopt;
  return viewOf<float, 2>(values.data(), {values.size(), 3}, baked.bake);
}

View<float, 3> coefficientsIn(const Shared<HarmonicTransfer>& transfer) {
  const auto terms = static_cast<std::size_t>(transfer->order * transfer->order);
  const auto channels = static_cast<std::size_t>(transfer->channels);
  return viewOf<float, 3>(transfer->coefficients.data(),
                          {transfer->coefficients.size() / (terms * channels), channels, terms}, transfer);
}

template <typename T>
View<T, 1> listIn(const Shared<HaarTransfer>& transfer, const std::vector<T>& values) {
  return viewOf<T, 1>(values.data(), {values.size()}, transfer);
}

Result<float, 2> listOfColors(std::vector<glm::vec3> colors) {
  const std::size_t count = colors.size();
  return arrayFrom<float, 2>(std::move(colors), {count, 3});
}

void bindHarmonicTransfer(nb::module_& module) {
  using Transfer = Held<HarmonicTransfer>;
  nb::class_<Transfer>(module, "HarmonicTransfer", "Diffuse transfer of every vertex in SH or CH.")
      .def_prop_ro("order", [](const Transfer& t) { return t.part->order; })
      .def_prop_ro(
          "channels", [](const Transfer& t) { return t.part->channels; }, "3 with bounces, 1 without.")
      .def_prop_ro("bounces", [](const Transfer& t) { return t.part->bounces; })
      .def_prop_ro(
          "coefficients", [](const Transfer& t) { return coefficientsIn(t.part); },
          "[vertex, channel, i]: radiance = albedo x sum L_i T_i.", nb::rv_policy::automatic)
      .def(
          "irradiance",
          [](const Transfer& transfer, nb::handle light) {
            const GivenArray<double> given = arrayOf<double>(light, "light", {3, -1});
            int order = 0;
            while (static_cast<std::size_t>((order + 1) * (order + 1)) <= given.held.shape(1)) ++order;
            return listOfColors(irradiance(*transfer.part, given.values, order));
          },
          "light"_a,
          "Irradiance [vertex, rgb], W/m2, under light from far away; `light` [rgb, i] of float64 are SH "
          "coefficients, for CH moments.");
}

void bindHaarTransfer(nb::module_& module) {
  using Transfer = Held<HaarTransfer>;
  nb::class_<Transfer>(module, "HaarTransfer",
                       "Diffuse transfer of every vertex in Haar wavelets, sparse rows.")
      .def_prop_ro("face_size", [](const Transfer& t) { return t.part->faceSize; })
      .def_prop_ro("channels", [](const Transfer& t) { return t.part->channels; })
      .def_prop_ro("bounces", [](const Transfer& t) { return t.part->bounces; })
      .def_prop_ro(
          "offsets", [](const Transfer& t) { return listIn(t.part, t.part->offsets); },
          "First entry of each row [vertex x channels + channel], then the end.", nb::rv_policy::automatic)
      .def_prop_ro(
          "indices", [](const Transfer& t) { return listIn(t.part, t.part->indices); },
          nb::rv_policy::automatic)
      .def_prop_ro(
          "values", [](const Transfer& t) { return listIn(t.part, t.part->values); },
          nb::rv_policy::automatic)
      .def(
          "irradiance",
          [](const Transfer& transfer, nb::handle light) {
            const GivenArray<float> given = arrayOf<float>(light, "light", {3, -1});
            return listOfColors(irradiance(*transfer.part, given.values));
          },
          "light"_a,
          "Irradiance [vertex, rgb], W/m2; `light` [rgb, i] of float32 are the wavelet coefficients of a "
          "cube map.");
}

void bindLightGroups(nb::module_& module) {
  using Transfer = Held<LightGroupTransfer>;
  nb::class_<Transfer>(module, "LightGroups",
                       "Transfer of the scene's own lights at every vertex, group by group.")
      .def_prop_ro("names",
                   [](const Transfer& t) {
                     std::vector<std::string> names;
                     for (const LightGroup& group : t.part->groups) names.push_back(group.name);
                     return names;
                   })
      .def_prop_ro(
          "colors",
          [](const Transfer& t) {
            std::vector<glm::vec3> colors;
            for (const LightGroup& group : t.part->groups) colors.push_back(group.color);
            return listOfColors(std::move(colors));
          },
          "The groups' colours in the file [group, rgb].", nb::rv_policy::automatic)
      .def_prop_ro(
          "coefficients",
          [](const Transfer& t) {
            const std::size_t groups = t.part->groups.size();
            const auto channels = static_cast<std::size_t>(t.part->channels);
            const std::size_t row = groups * channels;
            return viewOf<float, 3>(t.part->coefficients.data(),
                                    {row == 0 ? 0 : t.part->coefficients.size() / row, channels, groups},
                                    t.part);
          },
          "[vertex, channel, group], exit radiance over albedo per unit of the group's colour.",
          nb::rv_policy::automatic)
      .def(
          "irradiance",
          [](const Transfer& transfer, nb::handle colors) {
            const GivenArray<glm::vec3> given = rowsOf<glm::vec3>(colors, "colors");
            return listOfColors(irradiance(*transfer.part, given.values));
          },
          "colors"_a, "Irradiance [vertex, rgb], W/m2, with the groups' colours [group, rgb] of float32.");
}

void bindLightMap(nb::module_& module) {
  using Map = Held<LightMap>;
  nb::class_<Map>(module, "LightMap", "Light of the scene's own lights, texel by texel.")
      .def_prop_ro("width", [](const Map& m) { return m.part->layout.width; })
      .def_prop_ro("height", [](const Map& m) { return m.part->layout.height; })
      .def_prop_ro(
          "values",
          [](const Map& m) {
            const LightMap& map = *m.part;
            return viewOf<float, 4>(
                map.values.data(),
                {static_cast<std::size_t>(map.layout.height), static_cast<std::size_t>(map.layout.width), 3,
                 static_cast<std::size_t>(map.coefficients)},
                m.part);
          },
          "[row, column, rgb, coefficient]; the first coefficient is irradiance, W/m2.",
          nb::rv_policy::automatic)
      .def_prop_ro(
          "corners",
          [](const Map& m) {
            const std::vector<glm::vec2>& corners = m.part->layout.corners;
            return viewOf<float, 3>(corners.data(), {corners.size() / 3, 3, 2}, m.part);
          },
          "[face, corner, xy], in texels from the upper left; a face is a triangle's front, or, after all "
          "fronts, its back.",
          nb::rv_policy::automatic)
      .def_prop_ro(
          "charts",
          [](const Map& m) {
            const std::vector<std::uint32_t>& charts = m.part->layout.chartOf;
            return viewOf<std::uint32_t, 1>(charts.data(), {charts.size()}, m.part);
          },
          "[face]; 4294967295 for a face that has none.", nb::rv_policy::automatic)
      .def_prop_ro(
          "encoded",
          [](const Map& m) {
            const auto width = static_cast<std::size_t>(m.part->layout.width);
            const auto height = static_cast<std::size_t>(m.part->layout.height);
            std::map<std::string, View<float, 3>> found;
            for (const EncodedLight& light : m.part->encoded)
              found.emplace(
                  light.encoding,
                  viewOf<float, 3>(light.values.data(),
                                   {height, width, light.values.size() / (width * height)}, m.part));
            return found;
          },
          "Incident light [row, column, value], by the name of an encoding.", nb::rv_policy::automatic);
}

}  // namespace

void bindTransfer(nb::module_& module) {
  bindHarmonicTransfer(module);
  bindHaarTransfer(module);
  bindLightGroups(module);
  bindLightMap(module);
  bindFurtherParts(module);
}

void bindBakedParts(nb::class_<PythonBake>& bake) {
  bindFurtherBakedParts(bake);
  bake.def_prop_ro(
          "ao", [](const PythonBake& b) { return numbersIn(b, b.bake->ao); },
          "[vertex], cosine-weighted accessibility, 1: open.", nb::rv_policy::automatic)
      .def_prop_ro(
          "bent_normals", [](const PythonBake& b) { return vectorsIn(b, b.bake->bentNormals); },
          nb::rv_policy::automatic)
      .def_prop_ro(
          "apertures", [](const PythonBake& b) { return numbersIn(b, b.bake->apertures); },
          nb::rv_policy::automatic)
      .def_prop_ro(
          "thickness", [](const PythonBake& b) { return numbersIn(b, b.bake->thickness); },
          "[vertex], mean length of rays through the body below, m.", nb::rv_policy::automatic)
      .def_prop_ro("sh", [](const PythonBake& b) { return heldOf(b, &Bake::sh); })
      .def_prop_ro("ch", [](const PythonBake& b) { return heldOf(b, &Bake::ch); })
      .def_prop_ro("haar", [](const PythonBake& b) { return heldOf(b, &Bake::haar); })
      .def_prop_ro("light_groups", [](const PythonBake& b) { return heldOf(b, &Bake::lightGroups); })
      .def_prop_ro("light_map", [](const PythonBake& b) { return heldOf(b, &Bake::lightMap); })
      .def_prop_ro(
          "horizons",
          [](const PythonBake& b) -> std::optional<View<float, 2>> {
            if (!b.bake->horizons) return std::nullopt;
            const auto sectors = static_cast<std::size_t>(b.bake->horizons->sectors);
            const std::vector<float>& angles = b.bake->horizons->angles;
            return viewOf<float, 2>(angles.data(), {angles.size() / sectors, sectors}, b.bake);
          },
          "[vertex, sector], radians above the tangent plane.", nb::rv_policy::automatic)
      .def_prop_ro(
          "glossy",
          [](const PythonBake& b) -> std::optional<View<float, 4>> {
            if (!b.bake->glossy) return std::nullopt;
            const GlossyTransfer& glossy = *b.bake->glossy;
            const auto terms = static_cast<std::size_t>(glossy.order * glossy.order);
            const auto channels = static_cast<std::size_t>(glossy.channels);
            return viewOf<float, 4>(
                glossy.matrices.data(),
                {glossy.matrices.size() / (channels * terms * terms), channels, terms, terms}, b.bake);
          },
          "[vertex, channel, i, j]: matrices from incident to reflected radiance.", nb::rv_policy::automatic)
      .def_prop_ro(
          "irradiance",
          [](const PythonBake& b) -> std::optional<View<float, 2>> {
            return b.bake->irradiance ? vectorsIn(b, *b.bake->irradiance) : std::nullopt;
          },
          "[vertex, rgb], W/m2 of the scene's static lights, by radiosity.", nb::rv_policy::automatic);
}

}  // namespace prelight::python
