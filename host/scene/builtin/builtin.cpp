#include "scene/builtin/builtin.h"

#include <algorithm>

#include "base/suggestion.h"
#include "prelight/error.h"
#include "scene/builtin/builtin_scenes.h"

namespace prelight {

namespace {

struct Recipe {
  BuiltinScene scene;
  GltfDocument (*make)();
};

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> list = {
      {{"shapes", "a ground and five smooth objects under a point light (9.8 k triangles)"}, makeShapesScene},
      {{"cornell", "a Cornell box with two boxes under an emissive ceiling light"}, makeCornellScene},
      {{"caustics", "a Cornell box with a solid glass sphere and a mirror box"}, makeCausticsScene},
      {{"rooms", "two closed rooms joined by a door, a light in one and the camera in the other"},
       makeRoomsScene},
      {{"rooms-sealed", "these two rooms with the door closed: the camera's room is dark"},
       makeSealedRoomsScene},
      {{"swing", "a turning box, a crossing ball and a swinging board under a lamp (an animation of 4 s)"},
       makeSwingScene},
      {{"bumps", "a ground of cobbles, a rough wall and a block, by normal maps, unfolded for light maps"},
       makeBumpsScene},
  };
  return list;
}

}  // namespace

const std::vector<BuiltinScene>& builtinScenes() {
  static const std::vector<BuiltinScene> scenes = [] {
    std::vector<BuiltinScene> list;
    for (const Recipe& recipe : recipes()) list.push_back(recipe.scene);
    return list;
  }();
  return scenes;
}

GltfDocument makeBuiltinScene(const std::string& name) {
  std::vector<std::string> names;
  std::string known;
  for (const Recipe& recipe : recipes()) {
    if (recipe.scene.name == name) return recipe.make();
    names.push_back(recipe.scene.name);
    known += (known.empty() ? "" : ", ") + recipe.scene.name;
  }
  throw UsageError("scene", "no built-in scene \"" + name + "\"",
                   didYouMean(name, names) + "known scenes: " + known);
}

}  // namespace prelight
