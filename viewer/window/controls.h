#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viewer/follow/playback.h"
#include "viewer/frame/renderer.h"

namespace prelight::viewer {

/// Target of dragging the mouse.
enum class Drag { None, Orbit, Pan, Sky, Light, Node };

/// Actions of keys on the view.
enum class Command {
  SkyLeft,
  SkyRight,
  NextLight,
  NextNode,
  AddLight,
  PlayOrPause,
  FrameBack,
  FrameOn,
  ToStart,
  Slower,
  Faster,
  NextGroup,
  BrightenGroup,
  DimGroup,
  ToggleProbes,
  NextDebugView,
  ResetView,
};

/// Whether light of a shading follows nodes that are dragged.
inline bool followsNodes(Shading shading) { return infoOf(shading).traits.movableNodes; }

/// A node that can be dragged.
struct DragNode {
  std::string name;
  glm::dvec3 center{0.0};  ///< at rest, world
};

/// Lights and cameras of a scene, which move with its animations.
struct SceneLook {
  std::span<const Light> lights;
  std::span<const Camera> cameras;
};

/// The parts of a view that are the scene's and follow its animations.
struct Following {
  bool lights = false;                ///< the view's first ones, in the scene's order
  std::optional<std::size_t> camera;  ///< that the first view is of
};

/// Features of a window besides its scene.
struct Extras {
  bool objects = false;  ///< that are lit anew wherever they are dragged
  bool probes = false;
  std::vector<DebugView> debugViews = {};  ///< that can be shown, None first
};

/// Applies the user's input to a view, free of any window system. Every change counts up `changes`.
class Controls {
 public:
  /// `canShade` says which shadings may be switched to; `groups` are the names of the bake's light groups.
  Controls(View view, const CompiledScene& scene, std::function<bool(Shading)> canShade,
           std::vector<std::string> groups = {}, std::vector<DragNode> nodes = {});

  const View& view() const { return view_; }
  std::size_t changes() const { return changes_; }
  int selectedLight() const { return selectedLight_; }  ///< into View::lights; -1 without lights
  const std::vector<std::string>& groups() const { return groups_; }
  /// The shading that the groups belong to: `lights` where the bake has groups of it.
  Shading groupShading() const { return canShade(Shading::Lights) ? Shading::Lights : Shading::Radiosity; }
  int selectedGroup() const { return selectedGroup_; }  ///< into groups(); -1 without any
  const std::vector<DragNode>& nodes() const { return nodes_; }
  int selectedNode() const { return selectedNode_; }  ///< into nodes(); -1 without any
  bool canShade(Shading shading) const { return canShade_(shading); }
  void offer(const Extras& extras) { extras_ = extras; }
  const Extras& extras() const { return extras_; }
  /// Whether the view's light follows nodes that are dragged.
  bool nodesMoveNow() const { return !nodes_.empty() && (extras_.objects || followsNodes(view_.shading)); }

  /// `delta` is in window heights, +x right and +y up. Light moves the selected light on its sphere around
  /// the scene's centre (a directional one: turns it). Node moves the selected node across the picture.
  void drag(Drag what, const glm::dvec2& delta);

  /// Zooms by steps of the wheel, positive nearer; with `light` the selected light's distance from the
  /// centre.
  void scroll(double steps, bool light);

  void run(Command command);
  void setShading(Shading shading);
  void setSkyRotation(double angle);
  void selectLight(int index);
  void setLightIntensity(const glm::vec3& intensity);
  void selectGroup(int index);
  void selectNode(int index);
  void setGroupFactor(const glm::vec3& factor);  ///< of the selected group
  void setDebug(const DebugOptions& options);
  void setOptions(const ShadingOptions& options);  ///< cuts numbers to their ranges
  /// Moves the time of effects on, where they show, and the animation.
  void passTime(double seconds);
  /// The animation alone, where it plays.
  void playOn(double seconds);

  /// Sets the animations that can be played.
  void setPlayback(const Playback& playback);
  const Playback& playback() const { return playback_; }
  void choosePlayed(std::size_t which);  ///< into Playback::animations()
  void seek(double seconds);
  void setSpeed(double factor);
  void setLoop(bool loop);

  /// The lights and the camera that follow the scene, which is as it was at first.
  void startFollowing(const SceneLook& look, const Following& what);

  /// Where an animation has changed a light or the camera since the last call, the view has it as it is now;
  /// a camera that the user has moved stays until the view is reset.
  void follow(const SceneLook& look);
  void resize(int width, int height);

 private:
  void orbit(const glm::dvec2& delta);
  void pan(const glm::dvec2& delta);
  void zoom(double factor);
  void turnLight(const glm::dvec2& delta);
  void moveNode(const glm::dvec2& delta);
  void showNextDebugView();
  double heightAt(double depth) const;
  void addLight();
  void cameraMoved();
  void aimAhead();
  void showMoment();
  glm::dvec3 axis(int index) const { return glm::normalize(glm::dvec3(view_.camera.world[index])); }
  Light* selected();

  View view_;
  Camera firstCamera_;
  std::function<bool(Shading)> canShade_;
  glm::dvec3 center_{0.0};  ///< of the scene, world
  double radius_ = 1.0;
  glm::dvec3 target_{0.0};  ///< what the camera turns around, world
  int selectedLight_ = -1;
  std::vector<std::string> groups_;
  int selectedGroup_ = -1;
  std::vector<DragNode> nodes_;
  int selectedNode_ = -1;
  Playback playback_;
  Following following_;
  std::vector<Light> followedLights_;
  Camera followedCamera_;
  bool hasOwnCamera_ = false;  ///< that does not follow the scene's
  Extras extras_;
  std::size_t changes_ = 0;
};

}  // namespace prelight::viewer
