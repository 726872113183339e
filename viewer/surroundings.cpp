#include "viewer/surroundings.h"

#include <algorithm>
#include <array>
#include <map>

namespace prelight::viewer {
namespace {

constexpr std::size_t faceCount = 6;

/// Forward and up of the faces of a cube map, in OpenGL's order.
constexpr std::array<std::array<glm::dvec3, 2>, faceCount> faceAxes = {{
    {{{1, 0, 0}, {0, -1, 0}}},
    {{{-1, 0, 0}, {0, -1, 0}}},
    {{{0, 1, 0}, {0, 0, 1}}},
    {{{0, -1, 0}, {0, 0, -1}}},
    {{{0, 0, 1}, {0, -1, 0}}},
    {{{0, 0, -1}, {0, -1, 0}}},
}};

Camera faceCamera(const glm::dvec3& world, std::size_t face, double near) {
  const auto& [forward, up] = faceAxes[face];
  Camera camera;
  camera.world = glm::dmat4(glm::dvec4(glm::cross(forward, up), 0.0), glm::dvec4(up, 0.0),
                            glm::dvec4(-forward, 0.0), glm::dvec4(world, 1.0));
  camera.yFov = 1.5707963267948966;
  camera.aspect = 1.0;
  camera.zNear = near;
  return camera;
}

/// The nearest that a cube map shows: what lies close behind a surface would show through it if depth began
/// at nothing, and small nodes of large scenes are to see what lies near them.
double nearestSeen(const CompiledScene& compiled, float nodeRadius) {
  const double scene = glm::length(glm::dvec3(compiled.boundsMax - compiled.boundsMin));
  return std::clamp(0.1 * static_cast<double>(nodeRadius), 1e-5 * scene, 1e-3 * scene);
}

gl::Texture makeCubes(std::size_t count, bool mipmapped) {
  gl::Texture texture;
  glBindTexture(GL_TEXTURE_CUBE_MAP_ARRAY, texture.name());
  const std::vector<float> black(4 * faceCount * count * Surroundings::side * Surroundings::side, 0.0f);
  glTexImage3D(GL_TEXTURE_CUBE_MAP_ARRAY, 0, GL_RGBA32F, Surroundings::side, Surroundings::side,
               static_cast<GLsizei>(faceCount * count), 0, GL_RGBA, GL_FLOAT, black.data());
  glTexParameteri(GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_MIN_FILTER,
                  mipmapped ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  glTexParameteri(GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  if (mipmapped) glGenerateMipmap(GL_TEXTURE_CUBE_MAP_ARRAY);
  gl::check("making environment maps");
  return texture;
}

/// Means of two by two samples.
void copyFace(const gl::Framebuffer& from, const gl::Object<gl::FramebufferTraits>& target,
              const gl::Texture& to, std::size_t layer) {
  from.bind();
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.name());
  glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, to.name(), 0,
                            static_cast<GLint>(layer));
  glBlitFramebuffer(0, 0, from.width(), from.height(), 0, 0, Surroundings::side, Surroundings::side,
                    GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

}  // namespace

Surroundings::Surroundings(const RenderScene& scene, const CompiledScene& compiled) : scene_(scene) {
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  findNodes(compiled);
  if (nodes_.empty()) return;
  target_ = std::make_unique<gl::Framebuffer>(2 * side, 2 * side);
  cubes_ = makeCubes(nodes_.size(), true);
  const bool glass = std::any_of(nodes_.begin(), nodes_.end(), [](const Node& n) { return n.glass; });
  insides_ = makeCubes(glass ? nodes_.size() : 1, false);
  if (glass) {
    insideProgram_ = std::make_unique<gl::Program>("inside.vert", "inside.frag");
    insideProgram_->use();
    insideProgram_->set("triangleNormals", static_cast<int>(triangleNormalsUnit));
  }
  place(compiled);
  changed();
}

void Surroundings::findNodes(const CompiledScene& compiled) {
  std::map<int, Node> found;
  for (const Batch& batch : scene_.batches()) {
    if (batch.node < 0) continue;
    Node& node = found[batch.node];
    node.node = batch.node;
    node.glass = node.glass || scene_.surfaces()[batch.surface].isBody();
    node.batches.push_back(&batch);
    for (std::uint32_t t = 0; t < batch.triangleCount; ++t)
      node.area += static_cast<float>(0.5 * glm::length(geometricNormal(compiled, batch.firstTriangle + t)));
  }
  for (auto& [number, node] : found) nodes_.push_back(std::move(node));
  std::stable_sort(nodes_.begin(), nodes_.end(),
                   [](const Node& a, const Node& b) { return a.area > b.area; });
  if (nodes_.size() > mostNodes) {
    leftOut_ = nodes_.size() - mostNodes;
    nodes_.resize(mostNodes);
  }
}

std::vector<TwoSidedBody> Surroundings::twoSidedBodies(const CompiledScene& compiled) const {
  std::map<int, TwoSidedBody> found;
  for (const Batch& batch : scene_.batches()) {
    const Surface& surface = scene_.surfaces()[batch.surface];
    if (!surface.material.doubleSided || surface.isBlended()) continue;
    TwoSidedBody& body = found[batch.node];
    body.node = batch.node;
    body.triangles.push_back({batch.firstTriangle, batch.triangleCount});
    for (std::uint32_t t = 0; t < batch.triangleCount; ++t)
      for (int k = 0; k < 3; ++k) {
        const glm::vec3& p = compiled.positions[compiled.triangles[batch.firstTriangle + t][k]];
        body.lower = glm::min(body.lower, p);
        body.upper = glm::max(body.upper, p);
      }
  }
  std::vector<TwoSidedBody> bodies;
  for (auto& [number, body] : found) bodies.push_back(std::move(body));
  return bodies;
}

void Surroundings::place(const CompiledScene& compiled) {
  const std::vector<TwoSidedBody> bodies = twoSidedBodies(compiled);
  for (Node& node : nodes_) {
    glm::vec3 lower(3e38f), upper(-3e38f);
    for (const Batch* batch : node.batches)
      for (std::uint32_t t = 0; t < batch->triangleCount; ++t)
        for (int k = 0; k < 3; ++k) {
          const glm::vec3& p = compiled.positions[compiled.triangles[batch->firstTriangle + t][k]];
          lower = glm::min(lower, p);
          upper = glm::max(upper, p);
        }
    node.center = 0.5f * (lower + upper);
    node.radius = 0.5f * glm::length(upper - lower);
    if (node.glass) continue;  // its inside is seen from there as well
    std::vector<TriangleRange> own;
    for (const Batch* batch : node.batches) own.push_back({batch->firstTriangle, batch->triangleCount});
    std::vector<TwoSidedBody> others;
    for (const TwoSidedBody& body : bodies)
      if (body.node != node.node) others.push_back(body);
    node.center = placeOutside(compiled, own, node.center, others);
  }
  placed_ = true;
  insidesDrawn_ = false;
}

void Surroundings::changed() {
  // Twice where nodes may show each other: what the first round drew is seen in the second.
  waiting_ = (nodes_.size() > 1 ? 2 : 1) * faceCount * nodes_.size();
}

void Surroundings::moved() {
  placed_ = false;
  changed();
}

void Surroundings::changedSlowly() { waiting_ = std::max(waiting_, nodes_.empty() ? std::size_t{0} : 1); }

void Surroundings::update(const CompiledScene& compiled, std::size_t mostFaces,
                          const std::function<void(const Face&, const gl::Framebuffer&)>& draw) {
  facesDrawn_ = 0;
  if (waiting_ == 0) return;
  if (!placed_) place(compiled);
  if (!insidesDrawn_)
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (nodes_[i].glass) drawInside(i, compiled);
  insidesDrawn_ = true;
  for (; waiting_ > 0 && facesDrawn_ < mostFaces; --waiting_, ++facesDrawn_) {
    drawFace(next_, compiled, draw);
    next_ = (next_ + 1) % (faceCount * nodes_.size());
    if (facesSeen_ >= faceCount * nodes_.size() || ++facesSeen_ % faceCount != 0) continue;
    // The nodes that come next may show this one, which looks its map up blurred where it is rough.
    gl::bind(surroundingsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes_);
    glGenerateMipmap(GL_TEXTURE_CUBE_MAP_ARRAY);
  }
  gl::bind(surroundingsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes_);
  glGenerateMipmap(GL_TEXTURE_CUBE_MAP_ARRAY);
}

void Surroundings::drawFace(std::size_t face, const CompiledScene& compiled,
                            const std::function<void(const Face&, const gl::Framebuffer&)>& draw) {
  const Node& node = nodes_[face / faceCount];
  draw({faceCamera(compiled.origin + glm::dvec3(node.center), face % faceCount,
                   nearestSeen(compiled, node.radius)),
        node.node},
       *target_);
  copyFace(*target_, copyTarget_, cubes_, face);
  gl::check("drawing an environment map");
}

void Surroundings::drawInside(std::size_t place, const CompiledScene& compiled) {
  const Node& node = nodes_[place];
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  gl::bind(triangleNormalsUnit, GL_TEXTURE_BUFFER, scene_.triangleNormals());
  for (std::size_t face = 0; face < faceCount; ++face) {
    const CameraMatrices camera = cameraMatrices(
        faceCamera(compiled.origin + glm::dvec3(node.center), face, nearestSeen(compiled, node.radius)),
        compiled, 1.0);
    target_->bind();
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    insideProgram_->use();
    insideProgram_->set("clipFromScene", glm::mat4(camera.projection * camera.view));
    insideProgram_->set("center", node.center);
    glBindVertexArray(scene_.vertexArray().name());
    for (const Batch* batch : node.batches) {
      if (!scene_.surfaces()[batch->surface].isBody()) continue;
      insideProgram_->set("firstTriangle", static_cast<int>(batch->firstTriangle));
      drawTriangles(*batch);
    }
    glBindVertexArray(0);
    copyFace(*target_, copyTarget_, insides_, faceCount * place + face);
  }
  gl::check("drawing a body from within");
}

void Surroundings::bind() const {
  gl::bind(surroundingsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes_);
  gl::bind(insidesUnit, GL_TEXTURE_CUBE_MAP_ARRAY, insides_);
}

void Surroundings::set(const gl::Program& program, const Batch& batch) const {
  const auto found = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& node) {
    return batch.node >= 0 && node.node == batch.node;
  });
  const bool shown =
      found != nodes_.end() && facesSeen_ >= faceCount * static_cast<std::size_t>(found - nodes_.begin() + 1);
  program.set("cube", shown ? static_cast<int>(found - nodes_.begin()) : -1);
  if (shown) program.set("cubeCenter", found->center);
}

}  // namespace prelight::viewer
