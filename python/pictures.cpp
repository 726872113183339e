#include "python/pictures.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "prelight/error.h"
#include "python/array_checks.h"
#include "python/module.h"
#include "python/result_arrays.h"
#include "python/scene.h"
#include "python/vectors.h"

namespace prelight::python {

using namespace nb::literals;

namespace {

Picture pictureOf(nb::handle pixels) {
  const GivenArray<float> given = arrayOf<float>(pixels, "picture", {-1, -1, 3});
  Picture picture{static_cast<int>(given.held.shape(1)), static_cast<int>(given.held.shape(0)), {}};
  const auto* first = reinterpret_cast<const glm::vec3*>(given.values.data());
  picture.pixels.assign(first, first + given.values.size() / 3);
  return picture;
}

/// Returns the colour given by one number or by three.
glm::vec3 colorOf(nb::handle given) {
  Numbers3 numbers{};
  double grey = 0.0;
  if (nb::try_cast(given, numbers)) return vectorOf(numbers);
  if (nb::try_cast(given, grey)) return glm::vec3(static_cast<float>(grey));
  throw UsageError("constant_sky: radiance",
                   fmt::format("got {}, expected one number or three", nb::repr(given).c_str()));
}

PythonSky keep(Environment&& sky) { return {std::make_shared<const Environment>(std::move(sky))}; }

PythonSky skyOf(nb::handle radiance) {
  const Picture picture = pictureOf(radiance);
  if (picture.pixels.empty())
    throw UsageError("Sky: radiance",
                     fmt::format("got {} x {} texels, expected at least one", picture.width, picture.height));
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (!(picture.pixels[i][c] >= 0.0f) || !std::isfinite(picture.pixels[i][c]))
        throw UsageError("Sky: radiance",
                         fmt::format("texel ({}, {}) is {}, expected a finite number >= 0",
                                     i / static_cast<std::size_t>(picture.width),
                                     i % static_cast<std::size_t>(picture.width), picture.pixels[i][c]));
  return keep({picture.width, picture.height, picture.pixels});
}

/// Returns the exposure that is given by a number, or by "auto" for the one that suits the picture.
double exposureOf(const Picture& picture, nb::handle given) {
  std::string text;
  if (nb::try_cast(given, text) && text == "auto") return meteredExposure(picture);
  double factor = 0.0;
  if (!nb::try_cast(given, factor) || !(factor >= leastExposure && factor <= mostExposure))
    throw UsageError("exposure", fmt::format("got {}, expected a number from {:g} to {:g}, or \"auto\"",
                                             nb::repr(given).c_str(), leastExposure, mostExposure));
  return factor;
}

/// Returns the channels of further layers of an .exr: NAME.Y of [row, column], NAME.R, NAME.G and NAME.B of
/// [row, column, rgb].
std::vector<PictureChannel> channelsOf(const nb::dict& layers, const Picture& picture) {
  std::vector<PictureChannel> channels;
  for (const auto& [key, value] : layers) {
    const std::string name = nb::cast<std::string>(key);
    const bool grey = nb::cast<std::size_t>(value.attr("ndim")) == 2;
    const GivenArray<float> given = grey
                                        ? arrayOf<float>(value, "layers", {picture.height, picture.width})
                                        : arrayOf<float>(value, "layers", {picture.height, picture.width, 3});
    const std::size_t count = grey ? 1 : 3, first = channels.size();
    for (std::size_t c = 0; c < count; ++c) channels.push_back({name + "." + (grey ? 'Y' : "RGB"[c]), {}});
    for (std::size_t i = 0; i < given.values.size(); ++i)
      channels[first + i % count].values.push_back(given.values[i]);
  }
  return channels;
}

void writeGiven(const std::filesystem::path& path, nb::handle pixels, nb::object exposure,
                const nb::dict& layers) {
  Picture picture = pictureOf(pixels);
  const double factor = exposureOf(picture, exposure);
  if (factor != 1.0) picture = exposed(std::move(picture), factor);
  if (layers.size() == 0)
    writePicture(path, picture);
  else
    writePicture(path, picture, channelsOf(layers, picture));
}

View<float, 3> radianceOf(const PythonSky& sky) {
  const Environment& map = *sky.environment;
  return viewOf<float, 3>(map.radiance.data(),
                          {static_cast<std::size_t>(map.height), static_cast<std::size_t>(map.width), 3},
                          sky.environment);
}

}  // namespace

void bindPictures(nb::module_& module) {
  nb::class_<PythonSky>(module, "Sky", "Light from all around: an equirectangular map of linear radiance.")
      .def(
          "__init__", [](PythonSky* place, nb::handle radiance) { new (place) PythonSky(skyOf(radiance)); },
          "radiance"_a, "[row, column, rgb] of float32, W/(m2 sr); the upper row is at +Y.")
      .def_prop_ro("radiance", &radianceOf, nb::rv_policy::automatic);
  module.def(
      "read_sky", [](const std::filesystem::path& path) { return keep(readEnvironment(path)); }, "path"_a,
      "A sky from an .hdr or .exr file.");
  module.def(
      "constant_sky", [](nb::handle radiance) { return keep(constantEnvironment(colorOf(radiance))); },
      "radiance"_a = Numbers3{1.0, 1.0, 1.0},
      nb::sig("def constant_sky(radiance: float | tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Sky"),
      "A sky with the same radiance everywhere.");
  module.def(
      "studio_sky", [] { return keep(studioEnvironment()); }, "A photographer's studio.");
  module.def(
      "read_picture", [](const std::filesystem::path& path) { return pixelsOf(readPicture(path)); }, "path"_a,
      "[row, column, rgb], linear radiance.");
  module.def(
      "write_picture", &writeGiven, "path"_a, "picture"_a, "exposure"_a = 1.0, "layers"_a = nb::dict(),
      "Writes an .exr, or a tone-mapped .png. `exposure`: a factor of radiance, or \"auto\" for the one that "
      "suits the picture. `layers` of an .exr: arrays [row, column] or [row, column, rgb] by their names.");
  module.def(
      "tone_map",
      [](nb::handle given, nb::object exposure) {
        Picture picture = pictureOf(given);
        const double factor = exposureOf(picture, exposure);
        picture = exposed(std::move(picture), factor);
        for (glm::vec3& pixel : picture.pixels) pixel = toneMap(pixel);
        return pixelsOf(std::move(picture));
      },
      "picture"_a, "exposure"_a = 1.0,
      "The pixels of a picture's .png: sRGB, 0 to 1. `exposure`: a factor of radiance, or \"auto\".");
}

}  // namespace prelight::python
