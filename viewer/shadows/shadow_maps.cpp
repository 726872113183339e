#include "viewer/shadows/shadow_maps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "viewer/programs/texture_units.h"

namespace prelight::viewer {
namespace {

constexpr int filterBorder = 2;        ///< texels around a cube's side that the filter reaches into
constexpr int usualSide = 1024;        ///< texels of a view of a light that casts sharp shadows
constexpr int directionalSide = 2048;  ///< the same of one that sees the whole scene
constexpr int sampleSide = 256;        ///< of a sample that shines together with many others
constexpr int leastSide = 64;
constexpr std::size_t mostTexels = std::size_t{1} << 26;  ///< of all maps: 256 MiB
constexpr float nearShare = 1e-4f;                        ///< of the scene's radius
constexpr double widestCone = 1.1;                        ///< radians, half: wider spots take half a cube

bool sees(const ShadedLight& light) {
  return std::max({light.intensity.r, light.intensity.g, light.intensity.b}) > 0.0f;
}

/// Rows x, y and z of a right-handed frame that looks along `forward`.
glm::mat3 frameAlong(const glm::vec3& forward) {
  const glm::vec3 z = glm::normalize(forward);
  const glm::vec3 side = std::abs(z.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 x = glm::normalize(glm::cross(side, z));
  return {x, glm::cross(z, x), z};
}

/// The frame of a view of a cube: 0 looks along z, then x, -x, y, -y, -z. As faceOf() of shadows.glsl.
glm::mat3 viewFrame(const glm::mat3& axes, int view) {
  const glm::vec3 &x = axes[0], &y = axes[1], &z = axes[2];
  switch (view) {
    case 1:
      return {y, z, x};
    case 2:
      return {y, z, -x};
    case 3:
      return {z, x, y};
    case 4:
      return {z, x, -y};
    case 5:
      return {x, y, -z};
    default:
      return {x, y, z};
  }
}

float radiusOf(const CompiledScene& compiled) {
  const float radius = 0.5f * glm::length(compiled.boundsMax - compiled.boundsMin);
  return radius > 0.0f ? radius : 1.0f;
}

int usualSideOf(const ShadedLight& light) {
  if (light.isSample) return sampleSide;
  return light.kind == LightKind::Directional ? directionalSide : usualSide;
}

}  // namespace

ShadowMaps::Frame ShadowMaps::frameOf(const ShadedLight& light, const CompiledScene& compiled, int side) {
  const float radius = radiusOf(compiled);
  Frame frame;
  frame.room = frame.side = side;
  frame.eye.position = light.position;
  frame.eye.near = nearShare * radius;
  frame.eye.scale = static_cast<float>(side - 2 * filterBorder) / static_cast<float>(side);
  switch (light.kind) {
    case LightKind::Directional:
      frame.eye.axes = frameAlong(light.direction);
      frame.eye.position = 0.5f * (compiled.boundsMin + compiled.boundsMax);
      frame.eye.near = 0.0f;
      frame.eye.scale /= 1.001f * radius;
      frame.eye.depthScale = 0.5f / (1.001f * radius);
      frame.views = 1;
      break;
    case LightKind::Point:
    case LightKind::Profiled:
      frame.views = 6;
      break;
    case LightKind::Spot:
    case LightKind::Cookie: {
      frame.eye.axes = frameAlong(light.direction);
      // cos(outer) is where the cone ends: clamp(cos * scale + offset, 0, 1).
      const double outer =
          std::acos(std::clamp(-double{light.coneOffset} / double{light.coneScale}, -1.0, 1.0));
      frame.views = outer < widestCone ? 1 : 5;
      if (outer < widestCone) frame.eye.scale /= static_cast<float>(std::tan(outer));
      break;
    }
    case LightKind::Emitter:
    case LightKind::Area:  // whose samples have shadows
      frame.eye.axes = frameAlong(light.direction);
      frame.views = light.twoSided ? 6 : 5;
      break;
  }
  return frame;
}

/// Frame of the light with half as many texels per side, in the corner of its room in the atlas.
ShadowMaps::Frame ShadowMaps::coarse(const ShadedLight& light, const CompiledScene& compiled,
                                     const Frame& fine) {
  if (fine.views == 0) return fine;
  Frame frame = frameOf(light, compiled, std::max(std::min(leastSide, fine.side), fine.side / 2));
  frame.room = fine.room;
  frame.firstView = fine.firstView;
  return frame;
}

std::vector<ShadowMaps::Frame> ShadowMaps::framesOf(std::span<const ShadedLight> lights,
                                                    const CompiledScene& compiled) const {
  for (int halvings = 0;; ++halvings) {
    std::vector<Frame> frames;
    std::size_t texels = 0, views = 0;
    for (const ShadedLight& light : lights) {
      const int side = std::max(leastSide, usualSideOf(light) >> halvings);
      const bool hasRoom = room_ == Room::OfAll || sees(light);
      frames.push_back(hasRoom ? frameOf(light, compiled, side) : Frame{});
      frames.back().firstView = views;
      views += static_cast<std::size_t>(frames.back().views);
      texels += static_cast<std::size_t>(frames.back().views * side) * static_cast<std::size_t>(side);
    }
    if (texels <= mostTexels || (directionalSide >> halvings) <= leastSide) return frames;
  }
}

void ShadowMaps::makeAtlas() {
  std::vector<glm::ivec2> sizes;
  for (const Frame& frame : frames_)
    sizes.insert(sizes.end(), static_cast<std::size_t>(frame.views), glm::ivec2(frame.room));
  int side = leastSide;
  for (const glm::ivec2& size : sizes) side = std::max(side, size.x);
  atlas_ = packCharts(sizes, std::max(side, sizes.size() > 16 ? directionalSide : side));
  depths_ = gl::makeDepthArray(atlas_.side, std::max(atlas_.layers, 1), "shadow maps");
}

std::vector<ShadowBlock> ShadowMaps::blocks() const {
  std::vector<ShadowBlock> lights;
  for (const Frame& frame : frames_)
    lights.push_back(
        {glm::vec4(frame.eye.axes[0], static_cast<float>(frame.firstView)),
         glm::vec4(frame.eye.axes[1], static_cast<float>(frame.views)),
         glm::vec4(frame.eye.axes[2], frame.eye.near > 0.0f ? frame.eye.near : -frame.eye.depthScale),
         glm::vec4(frame.eye.position, frame.eye.scale)});
  return lights;
}

void ShadowMaps::uploadFrames() {
  std::vector<ShadowBlock> lights = blocks();
  std::vector<glm::vec4> views;
  for (const Frame& frame : frames_) {
    for (int view = 0; view < frame.views; ++view) {
      const ChartAtlas::Place& place = atlas_.places[frame.firstView + static_cast<std::size_t>(view)];
      views.emplace_back(place.x, place.y, place.layer, frame.side);
    }
  }
  lights.resize(maxLights);
  if (views.empty()) views.emplace_back(0.0f);
  viewTexels_ = gl::makeBufferTexture(views, "views of lights");
  lightBlock_.fill(GL_UNIFORM_BUFFER, std::span<const ShadowBlock>(lights), GL_STREAM_DRAW);
}

void ShadowMaps::drawView(const RenderScene& scene, const Frame& frame, int view) const {
  const ChartAtlas::Place& place = atlas_.places[frame.firstView + static_cast<std::size_t>(view)];
  glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depths_.name(), 0, place.layer);
  glViewport(place.x, place.y, frame.side, frame.side);
  glScissor(place.x, place.y, frame.side, frame.side);
  glClear(GL_DEPTH_BUFFER_BIT);
  ShadowEye eye = frame.eye;
  eye.axes = viewFrame(eye.axes, view);
  pass_.draw(scene, eye, frame.isCoarse() || room_ == Room::OfAll);
}

/// Which maps have to be drawn, and how.
std::vector<ShadowMaps::Frame> ShadowMaps::prepare(const CompiledScene& compiled,
                                                   std::span<const ShadedLight> lights, bool sceneMoved,
                                                   Effort& effort) {
  std::vector<Frame> wanted = framesOf(lights, compiled);
  const auto sameShape = [](const Frame& a, const Frame& b) {
    return a.views == b.views && a.room == b.room;
  };
  const bool kept =
      wanted.size() == frames_.size() && std::equal(wanted.begin(), wanted.end(), frames_.begin(), sameShape);
  if (!kept) {
    frames_ = wanted;
    stale_.assign(frames_.size(), true);
    makeAtlas();
    uploadFrames();
    effort.mostSampleViews = everything;
  }
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    bool shown = frames_[i] == wanted[i];
    if (effort.draft && !lights[i].isSample) {
      wanted[i] = coarse(lights[i], compiled, wanted[i]);
      shown = shown || frames_[i] == wanted[i];
    }
    if (sceneMoved || !shown) stale_[i] = true;
  }
  return wanted;
}

void ShadowMaps::update(const RenderScene& scene, const CompiledScene& compiled,
                        std::span<const ShadedLight> lights, bool sceneMoved, Effort effort) {
  viewsDrawn_ = texelsDrawn_ = 0;
  const std::vector<Frame> wanted = prepare(compiled, lights, sceneMoved, effort);
  if (!isBehind()) return;
  beginDrawing();
  std::size_t sampleViews = 0;
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    const std::size_t i = (next_ + k) % frames_.size();
    if (!stale_[i] || (lights[i].isSample && sampleViews >= effort.mostSampleViews)) continue;
    frames_[i] = wanted[i];
    stale_[i] = false;
    if (!sees(lights[i])) continue;
    const auto views = static_cast<std::size_t>(frames_[i].views),
               side = static_cast<std::size_t>(frames_[i].side);
    for (int view = 0; view < frames_[i].views; ++view) drawView(scene, frames_[i], view);
    viewsDrawn_ += views;
    texelsDrawn_ += views * side * side;
    if (!lights[i].isSample) continue;
    sampleViews += views;
    if (sampleViews >= effort.mostSampleViews) next_ = i + 1;
  }
  endDrawing();
  uploadFrames();
}

bool ShadowMaps::isBehind() const { return std::find(stale_.begin(), stale_.end(), true) != stale_.end(); }

bool ShadowMaps::areCoarse() const {
  return std::any_of(frames_.begin(), frames_.end(), [](const Frame& frame) { return frame.isCoarse(); });
}

void ShadowMaps::beginDrawing() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  glClearDepth(0.0);
}

void ShadowMaps::endDrawing() {
  glClearDepth(1.0);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_SCISSOR_TEST);
  gl::check("drawing shadow maps");
}

void ShadowMaps::bind() const {
  gl::bind(shadowMapsUnit, GL_TEXTURE_2D_ARRAY, depths_);
  glBindBufferBase(GL_UNIFORM_BUFFER, shadowBinding, lightBlock_.name());
  gl::bind(shadowViewsUnit, GL_TEXTURE_BUFFER, viewTexels_.texture);
}

}  // namespace prelight::viewer
