#include "viewer/window/controls.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <utility>

#include "occluders/wave_table.h"
#include "viewer/options/shading_options.h"

namespace prelight::viewer {
namespace {

using std::numbers::pi;
constexpr double steepest = 0.995;            ///< sine of the steepest view up or down
constexpr double zoomPerStep = 0.9;           ///< distance after a step of the wheel
constexpr float groupStep = 1.189207115f;     ///< factor a key press: doubles in four
constexpr double skyStep = 5.0 * pi / 180.0;  ///< radians a key press

glm::dmat4 turnAbout(const glm::dvec3& point, double angle, const glm::dvec3& axis) {
  return glm::translate(glm::dmat4(1.0), point) * glm::rotate(glm::dmat4(1.0), angle, axis) *
         glm::translate(glm::dmat4(1.0), -point);
}

}  // namespace

Controls::Controls(View view, const CompiledScene& scene, std::function<bool(Shading)> canShade,
                   std::vector<std::string> groups, std::vector<DragNode> nodes)
    : view_(std::move(view)),
      firstCamera_(view_.camera),
      canShade_(std::move(canShade)),
      groups_(std::move(groups)),
      selectedGroup_(groups_.empty() ? -1 : 0),
      nodes_(std::move(nodes)),
      selectedNode_(nodes_.empty() ? -1 : 0) {
  view_.nodeShifts.resize(nodes_.size(), glm::dvec3(0.0));
  view_.groupFactors.resize(groups_.size(), glm::vec3(1.0f));
  const glm::dvec3 lower(scene.boundsMin);
  const glm::dvec3 upper(scene.boundsMax);
  center_ = scene.origin + 0.5 * (lower + upper);
  const double radius = 0.5 * glm::length(upper - lower);
  if (radius > 0.0) radius_ = radius;
  selectedLight_ = view_.lights.empty() ? -1 : 0;
  run(Command::ResetView);
}

Light* Controls::selected() { return selectedLight_ < 0 ? nullptr : &view_.lights[selectedLight_]; }

void Controls::drag(Drag what, const glm::dvec2& delta) {
  switch (what) {
    case Drag::None:
      return;
    case Drag::Orbit:
      return orbit(delta);
    case Drag::Pan:
      return pan(delta);
    case Drag::Sky:
      return setSkyRotation(view_.skyRotation + delta.x * pi);
    case Drag::Light:
      return turnLight(delta);
    case Drag::Node:
      return moveNode(delta);
  }
}

void Controls::orbit(const glm::dvec2& delta) {
  glm::dmat4 world = turnAbout(target_, -delta.x * pi, {0.0, 1.0, 0.0}) * view_.camera.world;
  const glm::dmat4 pitched = turnAbout(target_, delta.y * pi, glm::normalize(glm::dvec3(world[0]))) * world;
  // Not over the poles: there the horizontal drag would turn the other way.
  const double slope = std::abs(glm::normalize(glm::dvec3(pitched[2])).y);
  if (slope < steepest || slope < std::abs(axis(2).y)) world = pitched;
  view_.camera.world = world;
  cameraMoved();
}

void Controls::pan(const glm::dvec2& delta) {
  const double distance = glm::length(glm::dvec3(view_.camera.world[3]) - target_);
  const glm::dvec3 shift = -heightAt(distance) * (delta.x * axis(0) + delta.y * axis(1));
  target_ += shift;
  view_.camera.world[3] += glm::dvec4(shift, 0.0);
  cameraMoved();
}

double Controls::heightAt(double depth) const {
  return view_.camera.perspective ? 2.0 * std::tan(0.5 * view_.camera.yFov) * depth : 2.0 * view_.camera.yMag;
}

void Controls::moveNode(const glm::dvec2& delta) {
  if (selectedNode_ < 0) return;
  const auto node = static_cast<std::size_t>(selectedNode_);
  const glm::dvec3 center = nodes_[node].center + view_.nodeShifts[node];
  const double depth = glm::dot(center - glm::dvec3(view_.camera.world[3]), -axis(2));
  if (view_.camera.perspective && !(depth > 0.0)) return;  // behind the eye
  view_.nodeShifts[node] += heightAt(depth) * (delta.x * axis(0) + delta.y * axis(1));
  ++changes_;
}

void Controls::selectNode(int index) {
  if (index < 0 || index >= static_cast<int>(nodes_.size())) return;
  selectedNode_ = index;
}

void Controls::scroll(double steps, bool light) {
  const double factor = std::pow(zoomPerStep, steps);
  if (!light) return zoom(factor);
  Light* const chosen = selected();
  if (chosen == nullptr || chosen->type == LightType::Directional) return;
  chosen->position = center_ + (chosen->position - center_) / factor;
  ++changes_;
}

void Controls::zoom(double factor) {
  if (view_.camera.perspective) {
    const glm::dvec3 away = (glm::dvec3(view_.camera.world[3]) - target_) * factor;
    view_.camera.world[3] = glm::dvec4(target_ + away, 1.0);
  } else {
    view_.camera.xMag *= factor;
    view_.camera.yMag *= factor;
  }
  cameraMoved();
}

void Controls::cameraMoved() {
  hasOwnCamera_ = true;
  // The camera's own planes were made for where it stood.
  view_.camera.zNear = std::min(view_.camera.zNear, 1e-3 * radius_);
  view_.camera.zFar = 0.0;
  ++changes_;
}

void Controls::turnLight(const glm::dvec2& delta) {
  Light* const light = selected();
  if (light == nullptr) return;
  const glm::dmat4 turn =
      turnAbout(center_, delta.x * pi, {0.0, 1.0, 0.0}) * turnAbout(center_, -delta.y * pi, axis(0));
  light->position = glm::dvec3(turn * glm::dvec4(light->position, 1.0));
  light->direction = glm::normalize(glm::dvec3(turn * glm::dvec4(light->direction, 0.0)));
  ++changes_;
  if (light->profile == nullptr && light->shape == nullptr && light->cookie == nullptr)
    return;  // they have no other side
  const glm::dvec3 side(turn * glm::dvec4(light->side, 0.0));
  light->side = glm::normalize(side - glm::dot(side, light->direction) * light->direction);
}

void Controls::addLight() {
  Light light;
  light.type = LightType::Directional;
  light.name = "added";
  light.direction =
      glm::normalize(-axis(2) + 0.5 * axis(0) - 0.7 * axis(1));  // over the viewer's left shoulder
  light.intensity = glm::vec3(3.0f);
  view_.lights.push_back(light);
  selectLight(static_cast<int>(view_.lights.size()) - 1);
}

void Controls::run(Command command) {
  switch (command) {
    case Command::SkyLeft:
      return setSkyRotation(view_.skyRotation + skyStep);
    case Command::SkyRight:
      return setSkyRotation(view_.skyRotation - skyStep);
    case Command::AddLight:
      return addLight();
    case Command::NextLight:
      if (selectedLight_ >= 0) selectLight((selectedLight_ + 1) % static_cast<int>(view_.lights.size()));
      return;
    case Command::NextNode:
      if (selectedNode_ >= 0) selectNode((selectedNode_ + 1) % static_cast<int>(nodes_.size()));
      return;
    case Command::PlayOrPause:
      playback_.toggle();
      return showMoment();
    case Command::FrameBack:
    case Command::FrameOn:
      playback_.step(command == Command::FrameOn ? 1 : -1);
      return showMoment();
    case Command::ToStart:
      return seek(playback_.start());
    case Command::Slower:
    case Command::Faster:
      return setSpeed(playback_.speed() * (command == Command::Faster ? 2.0 : 0.5));
    case Command::NextGroup:
      if (selectedGroup_ >= 0) selectGroup((selectedGroup_ + 1) % static_cast<int>(groups_.size()));
      return;
    case Command::BrightenGroup:
    case Command::DimGroup:
      if (selectedGroup_ >= 0)
        setGroupFactor(view_.groupFactors[selectedGroup_] *
                       (command == Command::DimGroup ? 1.0f / groupStep : groupStep));
      return;
    case Command::ToggleProbes:
      view_.hidesProbes = extras_.probes && !view_.hidesProbes;
      ++changes_;
      return;
    case Command::NextDebugView:
      return showNextDebugView();
    case Command::ResetView:
      view_.camera = firstCamera_;
      hasOwnCamera_ = false;
      return aimAhead();
  }
}

/// The camera turns about what it looks at, as deep as the scene's centre.
void Controls::aimAhead() {
  const glm::dvec3 eye(view_.camera.world[3]);
  const double depth = glm::dot(center_ - eye, -axis(2));
  target_ = eye - axis(2) * (depth > 0.0 ? depth : radius_);
  ++changes_;
}

void Controls::setShading(Shading shading) {
  if (!canShade_(shading) || shading == view_.shading) return;
  view_.shading = shading;
  ++changes_;
}

void Controls::setSkyRotation(double angle) {
  view_.skyRotation = std::remainder(angle, 2.0 * pi);
  ++changes_;
}

void Controls::selectLight(int index) {
  if (index < 0 || index >= static_cast<int>(view_.lights.size())) return;
  selectedLight_ = index;
  ++changes_;
}

void Controls::setLightIntensity(const glm::vec3& intensity) {
  if (Light* const light = selected()) light->intensity = glm::max(intensity, glm::vec3(0.0f));
  ++changes_;
}

void Controls::selectGroup(int index) {
  if (index < 0 || index >= static_cast<int>(groups_.size())) return;
  selectedGroup_ = index;
  ++changes_;
}

void Controls::setGroupFactor(const glm::vec3& factor) {
  if (selectedGroup_ < 0) return;
  view_.groupFactors[selectedGroup_] = glm::max(factor, glm::vec3(0.0f));
  ++changes_;
}

void Controls::setDebug(const DebugOptions& options) {
  DebugOptions wanted = options;
  wanted.treeDepth = std::clamp(options.treeDepth, 0, DebugOptions::deepestTree);
  if (wanted == view_.debug) return;
  view_.debug = wanted;
  ++changes_;
}

void Controls::showNextDebugView() {
  const std::vector<DebugView>& views = extras_.debugViews;
  if (views.empty()) return;
  const auto shown = std::ranges::find(views, view_.debug.shown);
  DebugOptions next = view_.debug;
  next.shown = shown == views.end() || shown + 1 == views.end() ? views.front() : *(shown + 1);
  setDebug(next);
}

void Controls::setOptions(const ShadingOptions& options) {
  const ShadingOptions wanted = withinRanges(options);
  ShadingOptions& current = view_;
  if (wanted == current) return;
  current = wanted;
  ++changes_;
}

void Controls::setPlayback(const Playback& playback) {
  playback_ = playback;
  showMoment();
}

void Controls::choosePlayed(std::size_t which) {
  playback_.choose(which);
  showMoment();
}

void Controls::seek(double seconds) {
  playback_.seek(seconds);
  showMoment();
}

void Controls::setSpeed(double factor) { playback_.setSpeed(factor); }

void Controls::setLoop(bool loop) { playback_.setLoop(loop); }

void Controls::showMoment() {
  if (view_.moment == playback_.moment()) return;
  view_.moment = playback_.moment();
  ++changes_;
}

void Controls::startFollowing(const SceneLook& look, const Following& what) {
  following_ = what;
  if (what.lights) followedLights_.assign(look.lights.begin(), look.lights.end());
  if (what.camera) followedCamera_ = look.cameras[*what.camera];
}

void Controls::follow(const SceneLook& look) {
  for (std::size_t i = 0; following_.lights && i < followedLights_.size(); ++i) {
    if (look.lights[i] == followedLights_[i]) continue;
    view_.lights[i] = followedLights_[i] = look.lights[i];
    ++changes_;
  }
  if (!following_.camera || look.cameras[*following_.camera] == followedCamera_) return;
  firstCamera_ = followedCamera_ = look.cameras[*following_.camera];
  if (hasOwnCamera_) return;
  view_.camera = firstCamera_;
  aimAhead();
}

void Controls::playOn(double seconds) {
  playback_.advance(seconds);
  showMoment();
}

void Controls::passTime(double seconds) {
  playOn(seconds);
  if (view_.shading != Shading::Vo || !areAnimated(view_.occluders)) return;
  ShadingOptions later = view_;
  later.occluders.seconds = std::fmod(later.occluders.seconds + seconds, effectPeriod);
  setOptions(later);
}

void Controls::resize(int width, int height) {
  if (width == view_.width && height == view_.height) return;
  view_.width = width;
  view_.height = height;
  ++changes_;
}

}  // namespace prelight::viewer
