#include "refine/shadowed_floor.h"

#include <vector>

#include "prelight/make_scene.h"
#include "support/scenes.h"

namespace prelight::test {

LoadedScene shadowedFloor(bool withBox) {
  const CompiledScene floor = ground(1, 5.0f);
  const CompiledScene above = box(1, {-1.0f, 0.3f, -1.0f}, {1.0f, 2.3f, 1.0f}, false);
  SceneArrays arrays;
  arrays.materials.push_back({});
  arrays.meshes.push_back(
      {.name = "Floor", .positions = floor.positions, .triangles = floor.triangles, .material = 0});
  if (withBox)
    arrays.meshes.push_back(
        {.name = "Box", .positions = above.positions, .triangles = above.triangles, .material = 0});
  return makeScene(arrays);
}

}  // namespace prelight::test
