#include "scene/builtin/builtin_scenes.h"
#include "scene/builtin/gltf_builder.h"

namespace prelight {

GltfDocument makeShapesScene() {
  GltfBuilder builder("shapes");
  // Objects hover by a centimetre: no face lies in the ground's plane.
  constexpr float lift = 0.01f;
  builder.addObject("Ground", makeGrid({-4.0, 0.0, 4.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, -8.0}, 32, 32),
                    builder.addDiffuse("Ground", {0.7f, 0.7f, 0.7f}));
  builder.addObject("Sphere", makeSphere(0.8f, 36, 26), builder.addDiffuse("Red", {0.75f, 0.15f, 0.12f}),
                    {-1.9f, lift, 0.9f});
  builder.addObject("Torus", makeTorus(0.7f, 0.3f, 48, 24),
                    builder.addDiffuse("Yellow", {0.8f, 0.65f, 0.12f}), {0.1f, lift, 1.6f});
  builder.addObject("Box", makeBox({1.2, 1.2, 1.2}, 8, true),
                    builder.addDiffuse("Blue", {0.15f, 0.25f, 0.75f}), {1.9f, lift, 0.6f}, 0.4);
  builder.addObject("Cone", makeCone(0.7f, 1.7f, 40, 12, 4), builder.addDiffuse("Green", {0.2f, 0.65f, 0.2f}),
                    {-0.9f, lift, -1.3f});
  builder.addObject("Cylinder", makeCylinder(0.5f, 1.5f, 40, 14, 4),
                    builder.addDiffuse("Violet", {0.55f, 0.25f, 0.65f}), {1.1f, lift, -1.5f});
  builder.addPointLight("Light", {1.5f, 5.0f, 2.5f}, {1.0f, 1.0f, 1.0f}, 80.0);
  builder.addCamera("Camera", {0.0, 4.2, 7.6}, {0.0, 0.5, 0.0}, 0.6, 4.0 / 3.0);
  return builder.take();
}

}  // namespace prelight
