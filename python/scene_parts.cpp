#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <fmt/format.h>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "prelight/error.h"
#include "prelight/make_scene.h"
#include "python/scene.h"
#include "python/vectors.h"

namespace prelight::python {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

constexpr double farthest = 1e9;  // m

void makeMaterial(PlainMaterial* place, const std::string& name, const Numbers4& color,
                  const Numbers3& emission) {
  new (place) PlainMaterial();
  place->name = name;
  place->baseColor = glm::vec4(color[0], color[1], color[2], color[3]);
  place->emission = vectorOf(emission);
}

Light makeLight(LightType type, const std::string& name, const Numbers3& intensity) {
  Light light;
  light.type = type;
  light.name = name;
  light.intensity = vectorOf(intensity);
  return light;
}

/// Sets the size of a light. `name`: the argument that it comes from.
void setSize(Light& light, double radius, double most, const char* name) {
  if (!(radius >= 0.0 && radius <= most))
    throw UsageError(name, fmt::format("got {}, expected 0 to {:.6g}", radius, most));
  light.radius = static_cast<float>(radius);
}

Light pointLight(const Numbers3& position, const Numbers3& intensity, double range, const std::string& name,
                 double radius) {
  Light light = makeLight(LightType::Point, name, intensity);
  light.position = vectorOf(position);
  light.range = static_cast<float>(range);
  setSize(light, radius, farthest, "radius");
  return light;
}

Light directionalLight(const Numbers3& direction, const Numbers3& irradiance, const std::string& name,
                       double angle) {
  Light light = makeLight(LightType::Directional, name, irradiance);
  light.direction = glm::normalize(vectorOf(direction));
  setSize(light, angle, glm::half_pi<double>(), "angle");
  return light;
}

Light spotLight(const Numbers3& position, const Numbers3& direction, const Numbers3& intensity,
                const Numbers2& angles, double range, const std::string& name, double radius) {
  Light light = pointLight(position, intensity, range, name, radius);
  light.type = LightType::Spot;
  light.direction = glm::normalize(vectorOf(direction));
  light.innerConeAngle = static_cast<float>(angles[0]);
  light.outerConeAngle = static_cast<float>(angles[1]);
  return light;
}

Camera lookAt(const Numbers3& eye, const Numbers3& target, const Numbers3& up, double yFov, double aspect) {
  Camera camera;
  camera.name = "Camera";
  camera.world = glm::inverse(glm::lookAt(vectorOf(eye), vectorOf(target), vectorOf(up)));
  camera.yFov = yFov;
  camera.aspect = aspect;
  return camera;
}

void bindMaterials(nb::module_& module) {
  nb::class_<PlainMaterial>(
      module, "Material",
      "A material without textures; by default a white Lambertian surface. Colours are linear.")
      .def("__init__", &makeMaterial, "name"_a = "", "base_color"_a = Numbers4{1.0, 1.0, 1.0, 1.0},
           "emission"_a = Numbers3{0.0, 0.0, 0.0})
      .def_rw("name", &PlainMaterial::name)
      .def_prop_rw(
          "base_color",
          [](const PlainMaterial& m) {
            return Numbers4{m.baseColor.x, m.baseColor.y, m.baseColor.z, m.baseColor.w};
          },
          [](PlainMaterial& m, const Numbers4& c) { m.baseColor = glm::vec4(c[0], c[1], c[2], c[3]); },
          "Linear RGB and alpha, 0 to 1.")
      .def_prop_rw(
          "emission", [](const PlainMaterial& m) { return numbersOf(m.emission); },
          [](PlainMaterial& m, const Numbers3& c) { m.emission = vectorOf(c); }, "W/(m2 sr).")
      .def_rw("metallic", &PlainMaterial::metallic)
      .def_rw("roughness", &PlainMaterial::roughness)
      .def_rw("specular", &PlainMaterial::specular, "Strength of a dielectric's reflection; 0: pure Lambert.")
      .def_rw("transmission", &PlainMaterial::transmission, "Share of a dielectric that is glass.")
      .def_rw("solid", &PlainMaterial::solid, "Glass with an inside, which refracts.")
      .def_rw("ior", &PlainMaterial::ior)
      .def_rw("double_sided", &PlainMaterial::doubleSided);
}

void bindLights(nb::module_& module) {
  nb::enum_<LightType>(module, "LightKind")
      .value("directional", LightType::Directional)
      .value("point", LightType::Point)
      .value("spot", LightType::Spot)
      .value("area", LightType::Area);
  nb::class_<Light>(module, "Light", "A light, in world space.")
      .def_ro("kind", &Light::type)
      .def_rw("name", &Light::name)
      .def_prop_rw(
          "intensity", [](const Light& light) { return numbersOf(light.intensity); },
          [](Light& light, const Numbers3& color) { light.intensity = vectorOf(color); },
          "W/sr (point, spot), W/m2 (directional) or W/(m2 sr) (area).")
      .def_prop_ro("position", [](const Light& light) { return numbersOf(light.position); })
      .def_prop_ro(
          "direction", [](const Light& light) { return numbersOf(light.direction); },
          "The direction in which its light travels.")
      .def_ro(
          "radius", &Light::radius,
          "Radius of a point or spot light's ball, m; half the angle that a directional light is seen at, "
          "radians. 0: no size.");
  module.def("point_light", &pointLight, "position"_a, "intensity"_a, "range"_a = 0.0, "name"_a = "",
             "radius"_a = 0.0,
             "A lamp of `intensity` W/sr that shines in all directions, up to `range` m; 0: without limit. A "
             "ball of `radius` m softens its shadows.");
  module.def("directional_light", &directionalLight, "direction"_a, "irradiance"_a, "name"_a = "",
             "angle"_a = 0.0,
             "Light from far away that travels along `direction`, with `irradiance` W/m2 on a surface that "
             "faces it. `angle` is half of that which its disk is seen at, radians: 0.00465 for the sun.");
  module.def("spot_light", &spotLight, "position"_a, "direction"_a, "intensity"_a,
             "angles"_a = Numbers2{0.0, 0.785398163}, "range"_a = 0.0, "name"_a = "", "radius"_a = 0.0,
             "A lamp that fades from its inner to its outer cone, whose `angles` (radians) are measured from "
             "its axis. A ball of `radius` m softens its shadows.");
}

void bindCameras(nb::module_& module) {
  nb::class_<Camera>(module, "Camera", "The point of view and the angle of view of a picture.")
      .def_ro("name", &Camera::name)
      .def_prop_rw(
          "world", [](const Camera& camera) { return rowsOf(camera.world); },
          [](Camera& camera, const Rows4& rows) { camera.world = matrixOf(rows); },
          "Rows of the matrix from the camera's space, where it looks along -Z, to the world.")
      .def_rw("y_fov", &Camera::yFov, "Vertical angle of view, radians.")
      .def_rw("aspect", &Camera::aspect, "Width over height; 0: the picture decides.");
  module.def("look_at", &lookAt, "eye"_a, "target"_a, "up"_a = Numbers3{0.0, 1.0, 0.0},
             "y_fov"_a = 0.785398163, "aspect"_a = 0.0, "A camera at `eye` that looks at `target`.");
}

}  // namespace

void bindSceneParts(nb::module_& module) {
  bindMaterials(module);
  bindLights(module);
  bindCameras(module);
}

}  // namespace prelight::python
