#pragma once

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Five objects of 9.8 k triangles with their ground under a point light, after Figure 7.22 of Sherif's
/// thesis.
GltfDocument makeShapesScene();
/// A Cornell box of 2 m: coloured walls, open to +Z, two boxes, an emissive quad that shines down.
GltfDocument makeCornellScene();
/// The Cornell box with a solid glass sphere and a mirror box.
GltfDocument makeCausticsScene();
/// Two closed rooms joined by a door opening; a point light in the left, the camera in the right.
GltfDocument makeRoomsScene();
GltfDocument makeSealedRoomsScene();
/// A ground of cobbles and a rough wall, by normal maps, and a block that reaches into the ground; all
/// unfolded for light maps.
GltfDocument makeBumpsScene();
/// A ground under an emissive lamp with a box that turns, a ball that crosses and a board that swings: one
/// animation of 4 s.
GltfDocument makeSwingScene();

}  // namespace prelight
