#include "viewer/window_scene.h"

#include <glm/gtc/matrix_transform.hpp>

namespace prelight::test {

QuadScene windowScene() {
  QuadScene scene;
  for (int i = 0; i < 3; ++i) {
    const glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(i - 1.0, 0.3 * i, -0.5 * i));
    scene.add(lambertian(glm::vec3(0.9f - 0.3f * static_cast<float>(i), 0.5f, 0.3f * static_cast<float>(i))),
              0.6f, glm::rotate(place, -0.4 * i, glm::dvec3(1, 0.5, 0)));
  }
  Light light;
  light.position = {1, 2, 3};
  light.intensity = glm::vec3(12, 10, 8);
  scene.scene.lights = {light};
  scene.setSky(halvedSky());
  scene.compile();
  scene.bakeOpen(4, 1, 0.6f, 0.8);
  return scene;
}

viewer::RenderOptions windowOptions() {
  viewer::RenderOptions options;
  options.width = 320;
  options.height = 240;
  return options;
}

}  // namespace prelight::test
