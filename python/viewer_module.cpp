#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "prelight/device.h"
#include "prelight/draw_options.h"
#include "prelight/load.h"
#include "python/bake.h"
#include "python/option_rows.h"
#include "python/pictures.h"
#include "python/progress.h"
#include "python/scene.h"
#include "python/vectors.h"

namespace prelight::python {

using namespace nb::literals;

namespace {

/// A file, the place of its origin in m, its yaw in degrees and its scale.
using GivenObject = std::tuple<std::filesystem::path, Numbers3, double, double>;
/// A pattern of nodes, their displacement in m and their yaw in degrees.
using GivenMove = std::tuple<std::string, Numbers3, double>;

/// Returns the channels of an .exr as arrays: "ao.Y" becomes ao [row, column], "direct.R", "direct.G" and
/// "direct.B" become direct [row, column, rgb].
nb::dict layersOf(const Drawing& drawing) {
  const auto width = static_cast<std::size_t>(drawing.picture.width);
  const std::size_t count = drawing.picture.pixels.size(), height = width == 0 ? 0 : count / width;
  nb::dict layers;
  for (std::size_t i = 0; i < drawing.layers.size(); ++i) {
    const PictureChannel& channel = drawing.layers[i];
    const std::string layer = channel.name.substr(0, channel.name.rfind('.'));
    if (!channel.name.ends_with(".R")) {
      layers[layer.c_str()] = arrayFrom<float, 2>(std::vector<float>(channel.values), {height, width});
      continue;
    }
    std::vector<glm::vec3> pixels(count);
    for (std::size_t p = 0; p < count; ++p)
      pixels[p] = {channel.values[p], drawing.layers[i + 1].values[p], drawing.layers[i + 2].values[p]};
    layers[layer.c_str()] = arrayFrom<float, 3>(std::move(pixels), {height, width, 3});
    i += 2;
  }
  return layers;
}

nb::tuple drawScene(const PythonScene& scene, const PythonBake* baked, const DrawRequest& request,
                    const Device* device, nb::object progress) {
  Drawing drawing = interruptibly(std::move(progress), [&](Progress& told) {
    return draw(
        *scene.loaded, request,
        {.bake = baked != nullptr ? baked->bake.get() : nullptr, .device = device, .progress = &told});
  });
  const nb::dict layers = layersOf(drawing);
  return nb::make_tuple(pixelsOf(std::move(drawing.picture)), layers, drawing.notes, drawing.approximations,
                        drawing.warnings);
}

void setObjects(DrawRequest& request, const std::vector<GivenObject>& objects) {
  request.objects.objects.clear();
  for (const auto& [file, at, yaw, scale] : objects)
    request.objects.objects.push_back({file, {at[0], at[1], at[2]}, yaw, scale});
}

void setMoves(DrawRequest& request, const std::vector<GivenMove>& moves) {
  request.pose.moves.clear();
  for (const auto& [pattern, by, yaw] : moves)
    request.pose.moves.push_back({pattern, {by[0], by[1], by[2]}, yaw});
}

void setGroups(DrawRequest& request, const std::vector<std::pair<std::string, Numbers3>>& factors) {
  request.groups.clear();
  for (const auto& [name, factor] : factors) request.groups.push_back({name, vectorOf(factor)});
}

/// Binds a member that Python sets and never reads. Reading gives an empty `Value`, by which messages tell
/// what is expected (prelight/arguments.py).
template <typename Value, typename Set>
void bindMember(nb::class_<DrawRequest>& request, const char* name, const Set& set) {
  request.def_prop_rw(
      name, [](const DrawRequest&) { return Value(); }, set, nb::for_setter(nb::arg().none()));
}

/// Binds the table of options, as bindRows() binds those of one structure.
void bindDrawOptions(nb::handle request) {
  nb::list rows;
  for (const DrawOption& option : drawOptions()) rows.append(describe(option.info, option.usual));
  request.attr("_options") = rows;
}

/// Sets an option and returns whether there is one of this name. None leaves an option without a default
/// unset.
bool setOption(DrawRequest& request, const std::string& name, nb::handle value) {
  for (const DrawOption& option : drawOptions()) {
    if (argumentOf(option.info) != name) continue;
    if (!value.is_none() || option.usual) option.set(request, valueOf(option.info, value));
    return true;
  }
  return false;
}

void bindRequest(nb::module_& module) {
  nb::class_<DrawRequest> request(module, "DrawRequest");
  request.def(nb::init<>())
      .def("_set", &setOption, nb::arg(), nb::arg().none())
      .def_rw("height", &DrawRequest::height)
      .def_rw("width", &DrawRequest::width, nb::arg().none())
      .def_rw("lights", &DrawRequest::lights, nb::arg().none())
      .def_rw("sky_rotation", &DrawRequest::skyRotation)
      .def_rw("samples_per_axis", &DrawRequest::samplesPerAxis)
      .def_rw("encoding", &DrawRequest::encoding)
      .def_rw("denoise", &DrawRequest::denoise)
      .def_rw("layers", &DrawRequest::layers)
      .def_rw("baking", &DrawRequest::bake)
      .def_rw("camera", &DrawRequest::camera, nb::arg().none())
      .def_rw("camera_index", &DrawRequest::cameraIndex, nb::arg().none())
      .def_rw("sky_name", &DrawRequest::skyName);
  bindMember<std::string>(request, "shading", [](DrawRequest& r, const std::optional<std::string>& name) {
    r.shading = name ? std::optional(shadingNamed(*name)) : std::nullopt;
  });
  bindMember<std::optional<int>>(request, "sky", [](DrawRequest& r, const std::optional<PythonSky>& sky) {
    r.sky = sky ? sky->environment : nullptr;
  });
  bindMember<bool>(request, "rasterised", [](DrawRequest& r, bool drawn) { r.full.rasterised = drawn; });
  bindMember<std::vector<GivenObject>>(request, "objects", setObjects);
  bindMember<std::vector<GivenMove>>(request, "moves", setMoves);
  bindMember<std::vector<std::string>>(request, "group", setGroups);
  bindMember<double>(request, "at",
                     [](DrawRequest& r, const std::optional<double>& seconds) { r.pose.at = seconds; });
  bindMember<std::string>(request, "animation",
                          [](DrawRequest& r, const std::string& name) { r.pose.animation = name; });
  bindDrawOptions(request);
}

}  // namespace

}  // namespace prelight::python

NB_MODULE(_viewer, module) {
  namespace nb = nanobind;
  nb::module_::import_("prelight._native");  // defines the classes that these functions take
  prelight::python::bindInterpreterEnd();
  prelight::python::bindRequest(module);
  module.def("shadings", [] {
    std::vector<std::string> names;
    for (const prelight::ShadingSummary& shading : prelight::shadings()) names.emplace_back(shading.name);
    return names;
  });
  module.def("draw", &prelight::python::drawScene, nb::arg(), nb::arg().none(), nb::arg(), nb::arg().none(),
             nb::arg().none());
}
