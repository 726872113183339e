#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <map>
#include <string>
#include <vector>

#include "prelight/transfer.h"
#include "python/held_part.h"
#include "python/module.h"
#include "python/result_arrays.h"
#include "python/vectors.h"

namespace prelight::python {

namespace {

void bindOccluders(nb::module_& module) {
  using Occluders = Held<OccluderTransfer>;
  nb::class_<Occluders>(module, "VectorOccluders",
                        "The view of every occluder from every vertex, as sparse rows of records.")
      .def_prop_ro(
          "names", [](const Occluders& o) { return o.part->names; }, "[occluder].")
      .def_prop_ro(
          "stored",
          [](const Occluders& o) {
            std::vector<std::string> names;
            for (const OccluderVector vector : o.part->stored)
              names.emplace_back(occluderVectorNames[static_cast<std::size_t>(vector)]);
            return names;
          },
          "Names of the vectors in a record.")
      .def_prop_ro(
          "offsets",
          [](const Occluders& o) {
            return viewOf<std::uint32_t, 1>(o.part->offsets.data(), {o.part->offsets.size()}, o.part);
          },
          "First record of each vertex [vertex], then the end.", nb::rv_policy::automatic)
      .def_prop_ro(
          "occluders",
          [](const Occluders& o) {
            return viewOf<std::uint32_t, 1>(o.part->occluders.data(), {o.part->occluders.size()}, o.part);
          },
          "Index into `names` [record].", nb::rv_policy::automatic)
      .def_prop_ro(
          "vectors",
          [](const Occluders& o) {
            return viewOf<float, 3>(o.part->vectors.data(), {o.part->recordCount(), o.part->stored.size(), 4},
                                    o.part);
          },
          "[record, stored, xyzw].", nb::rv_policy::automatic);
}

void bindVolume(nb::module_& module) {
  using Volume = Held<VolumeTransfer>;
  nb::class_<Volume>(module, "Volume", "SH transfer of points in the air, on a grid of cubic cells.")
      .def_prop_ro(
          "bounds",
          [](const Volume& v) {
            return std::make_pair(numbersOf(v.part->grid.min), numbersOf(v.part->grid.max));
          },
          "Least and greatest world coordinates, m; values belong to the cells' centres.")
      .def_prop_ro("order", [](const Volume& v) { return v.part->order; })
      .def_prop_ro("bounces", [](const Volume& v) { return v.part->bounces; })
      .def_prop_ro(
          "coefficients",
          [](const Volume& v) {
            const glm::ivec3& size = v.part->grid.size;
            const auto length = [](int count) { return static_cast<std::size_t>(count); };
            return viewOf<float, 5>(
                v.part->coefficients.data(),
                {length(size.z), length(size.y), length(size.x), length(v.part->channels), v.part->columns()},
                v.part);
          },
          "[z, y, x, channel, i]: mean radiance over all directions = sum L_i T_i.",
          nb::rv_policy::automatic);
}

/// A chart map together with the transfer that it belongs to.
struct HeldChart {
  Shared<ChartTransfer> transfer;
  const ChartTransfer::Map* map;
};

void bindCharts(nb::module_& module) {
  nb::class_<HeldChart>(module, "ChartMap", "SH transfer at the texels of a primitive's own charts.")
      .def_prop_ro(
          "primitive", [](const HeldChart& c) { return c.map->primitive; }, "Index of the scene's primitive.")
      .def_prop_ro(
          "tex_coords",
          [](const HeldChart& c) {
            return viewOf<float, 2>(c.map->coords.data(), {c.map->coords.size(), 2}, c.transfer);
          },
          "[vertex of the primitive, uv]; the first row is at v = 0.", nb::rv_policy::automatic)
      .def_prop_ro(
          "coefficients",
          [](const HeldChart& c) {
            const auto channels = static_cast<std::size_t>(c.transfer->channels);
            return viewOf<float, 4>(
                c.map->coefficients.data(),
                {static_cast<std::size_t>(c.map->height), static_cast<std::size_t>(c.map->width), channels,
                 c.transfer->rowLength() / channels},
                c.transfer);
          },
          "[row, column, channel, i].", nb::rv_policy::automatic);
}

void bindAnimation(nb::module_& module) {
  using Animation = Held<AnimatedTransfer>;
  nb::class_<Animation>(module, "AnimatedTransfer", "SH transfer at moments of an animation.")
      .def_prop_ro(
          "animation", [](const Animation& a) { return a.part->animation; }, "Its number.")
      .def_prop_ro(
          "times", [](const Animation& a) { return a.part->times; }, "[key], s.")
      .def_prop_ro(
          "keys",
          [](const Animation& a) {
            std::vector<Held<HarmonicTransfer>> keys;
            for (const HarmonicTransfer& key : a.part->keys)
              keys.push_back({Shared<HarmonicTransfer>(a.part, &key)});
            return keys;
          },
          "Times of the keys [key], between which transfer is interpolated.");
}

std::optional<std::vector<HeldChart>> chartsIn(const PythonBake& baked) {
  if (!baked.bake->chartTransfer) return std::nullopt;
  const Shared<ChartTransfer> transfer(baked.bake, &*baked.bake->chartTransfer);
  std::vector<HeldChart> charts;
  for (const ChartTransfer::Map& map : transfer->maps) charts.push_back({transfer, &map});
  return charts;
}

/// Returns arrays [..., value] by encoding, whose rows have `count` values.
std::map<std::string, View<float, 2>> encodedIn(const std::vector<EncodedLight>& encoded, std::size_t count,
                                                const std::shared_ptr<const void>& owner) {
  std::map<std::string, View<float, 2>> found;
  for (const EncodedLight& light : encoded)
    found.emplace(
        light.encoding,
        viewOf<float, 2>(light.values.data(), {count, count == 0 ? 0 : light.values.size() / count}, owner));
  return found;
}

}  // namespace

void bindFurtherParts(nb::module_& module) {
  bindOccluders(module);
  bindVolume(module);
  bindCharts(module);
  bindAnimation(module);
}

void bindFurtherBakedParts(nb::class_<PythonBake>& bake) {
  bake.def_prop_ro("occluders", [](const PythonBake& b) { return heldOf(b, &Bake::occluders); })
      .def_prop_ro("volume", [](const PythonBake& b) { return heldOf(b, &Bake::volume); })
      .def_prop_ro("charts", &chartsIn, "Transfer at the texels of each primitive that has charts.")
      .def_prop_ro("animation", [](const PythonBake& b) { return heldOf(b, &Bake::animation); })
      .def_prop_ro(
          "near_lamps",
          [](const PythonBake& b) -> std::optional<View<std::uint16_t, 3>> {
            if (!b.bake->nearLamps) return std::nullopt;
            const NearLampTransfer& lamps = *b.bake->nearLamps;
            const auto shells = static_cast<std::size_t>(lamps.shells);
            return viewOf<std::uint16_t, 3>(
                lamps.halves.data(),
                {lamps.halves.size() / (shells * lamps.columns()), shells, lamps.columns()}, b.bake);
          },
          "[vertex, shell, i]: numpy's float16 after .view(numpy.float16).", nb::rv_policy::automatic)
      .def_prop_ro(
          "encoded_light",
          [](const PythonBake& b) {
            const std::size_t vertices = b.bake->irradiance ? b.bake->irradiance->size() : 0;
            return encodedIn(b.bake->encodedLight, vertices, b.bake);
          },
          "Incident light of the vertices [vertex, value], by the name of an encoding.",
          nb::rv_policy::automatic);
}

}  // namespace prelight::python
