#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "prelight/shading.h"
#include "techniques/drawing_rules.h"

namespace prelight {

constexpr int shadingCount = static_cast<int>(countNamed(shadingName));

/// Properties of a shading: the light that it shows, and what it follows.
struct ShadingTraits {
  /// Lights of every kind have shadow maps, mirrors and glass show what lies around them, and light comes
  /// from the inputs of a picture, not from a bake.
  bool allLight = false;
  bool causticsOfItsOwn = false;     ///< the inputs of its light hold photons of caustics
  bool bakedLight = false;           ///< it shows the light of its bake, whatever shines now
  bool bounces = false;              ///< bounces of a bake add to its light
  bool bouncesOfLamps = false;       ///< also to that of lamps within the scene
  bool bakedForWindows = false;      ///< windows bake it without being asked
  bool skyLampsApart = false;        ///< lamps are taken out of a sky and shine as lights
  bool shadowsOfItsOwn = false;      ///< its data know what shadows lamps anywhere
  bool areaLightsAsSamples = false;  ///< it knows no area lights
  bool accessibility = false;        ///< it knows how open surfaces are
  bool tellsOpenSky = false;         ///< its data tell others how open the sky is
  bool creaseCorrection = false;     ///< `--ao-correction` adds light that creases reflect into themselves
  bool followsAnimation = false;     ///< it changes with what an animation moves
  bool movableNodes = false;         ///< windows let the user move nodes in it
  bool objectsInCubes = false;       ///< placed objects can be lit by cube maps of what lies around them
  bool followsLamps = false;         ///< windows solve its light anew for lamps that they dim or move
  bool relitOnDevice = false;        ///< an OpenCL device multiplies its transfer by the light
};

/// The relMSE of a shading's pictures against all light, as measured over the built-in scenes
/// (docs/notes/techniques.md), by what lights them.
struct ExpectedError {
  float sky = 1.0f;
  float outside = 1.0f;  ///< lamps outside of the scene
  float inside = 1.0f;   ///< lamps and emissive surfaces within it
};

/// Numbers that a bake holds for each vertex, in rows one behind the other.
struct VertexRows {
  std::span<const float> numbers;
  std::size_t width = 0;  ///< numbers of a row; 0: there are none
};

/// A shading: its name, what it is baked from and its rules of drawing. How OpenGL draws it stands in
/// viewer/techniques (viewer/programs/drawn_shading.h), unless numbers of vertices are all that it needs.
struct ShadingInfo {
  Shading shading = Shading::Phong;
  std::string_view summary;  ///< for lists of names
  /// Option of `bake` for what it needs, with an example, without dashes; empty: it needs nothing.
  std::string_view bakeOption = {};
  std::string_view bakedName = {};  ///< what the bake holds then, as texts name it
  DrawingRules rules = {};
  ShadingTraits traits = {};
  ExpectedError error = {};

  /// Whether a bake has all that it needs. No bake has what a shading of all light needs.
  bool (*carriedBy)(const Bake&) = [](const Bake&) { return true; };
  /// Whether a request names what it needs.
  bool (*askedBy)(const BakeRequest&) = [](const BakeRequest&) { return false; };
  /// Asks for what it needs: as `asked` does, or by default.
  void (*addTo)(BakeRequest& request, const BakeRequest& asked) = [](BakeRequest&, const BakeRequest&) {};
  /// Throws Error where the numbers that a bake holds for it do not fit the scene or cannot be drawn.
  void (*check)(const Bake&, const CompiledScene&) = [](const Bake&, const CompiledScene&) {};
  /// Moves what a bake holds for it into another bake.
  void (*take)(Bake& into, Bake& from) = [](Bake&, Bake&) {};

  /// The mean share of their sky that vertices see, 0 to 1, of a bake that carries the shading; nullptr: it
  /// does not tell.
  double (*openness)(const Bake&) = nullptr;

  /// The transfer of a bake that may change for some vertices while it is drawn; nullptr: none may.
  VertexRows (*changingRows)(const Bake&) = nullptr;
  /// The rule by which it draws light in an encoding, where a bake holds that in its place; Open: it does
  /// not.
  Ambient encoded = Ambient::Open;

  /// Returns three numbers for each vertex, [vertex], which its text reads as vTransferred; they are the same
  /// in any light. nullptr: OpenGL gets its data by a row in viewer/techniques, if it needs any.
  std::vector<glm::vec3> (*vertexNumbers)(const Bake&, const CompiledScene&) = nullptr;

  constexpr std::string_view name() const { return shadingName(shading); }
};

/// Data of a bake that no shading is baked from, but that pictures show along with one.
struct BakedPart {
  /// Asks for it with what a request already has, as `asked` does.
  void (*addTo)(BakeRequest& request, const BakeRequest& asked) = [](BakeRequest&, const BakeRequest&) {};
  /// Throws Error where its numbers do not fit the scene or cannot be drawn.
  void (*check)(const Bake&, const CompiledScene&);
  /// Moves it into another bake.
  void (*take)(Bake& into, Bake& from);
};

}  // namespace prelight
