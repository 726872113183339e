#include "viewer/cubes/surroundings.h"

#include <algorithm>
#include <map>
#include <string>

#include "viewer/cubes/cube_faces.h"
#include "viewer/programs/drawn_transfer.h"
#include "viewer/programs/texture_units.h"

namespace prelight::viewer {

Surroundings::Surroundings(const RenderScene& scene, const CompiledScene& compiled)
    : scene_(scene), compiled_(compiled) {
  findNodes();
  if (nodes_.empty()) return;
  target_ = std::make_unique<gl::Framebuffer>(2 * side, 2 * side);
  cubes_ = makeCubeMaps(side, nodes_.size(), true);
  const bool glass = std::any_of(nodes_.begin(), nodes_.end(), [](const Node& n) { return n.glass; });
  insides_ = makeCubeMaps(side, glass ? nodes_.size() : 1, false);
  if (glass) {
    insideProgram_ = std::make_unique<gl::Program>("inside.vert", "inside.frag");
    insideProgram_->use();
    insideProgram_->set("triangleNormals", static_cast<int>(triangleNormalsUnit));
  }
  place();
  changed();
}

void Surroundings::findNodes() {
  std::map<int, Node> found;
  for (std::size_t i = 0; i < scene_.batches().size(); ++i) {
    const Batch& batch = scene_.batches()[i];
    if (batch.node < 0) continue;
    Node& node = found[batch.node];
    node.node = batch.node;
    node.glass = node.glass || scene_.surfaces()[batch.surface].isBody();
    node.batches.push_back(i);
    for (std::uint32_t t = 0; t < batch.triangleCount; ++t)
      node.area += static_cast<float>(0.5 * glm::length(geometricNormal(compiled_, batch.firstTriangle + t)));
  }
  for (auto& [number, node] : found) nodes_.push_back(std::move(node));
  std::stable_sort(nodes_.begin(), nodes_.end(),
                   [](const Node& a, const Node& b) { return a.area > b.area; });
  if (nodes_.size() > mostNodes) {
    leftOut_ = nodes_.size() - mostNodes;
    nodes_.resize(mostNodes);
  }
}

std::vector<TwoSidedBody> Surroundings::twoSidedBodies() const {
  std::map<int, TwoSidedBody> found;
  for (const Batch& batch : scene_.batches()) {
    const Surface& surface = scene_.surfaces()[batch.surface];
    if (!surface.material.doubleSided || surface.isBlended()) continue;
    TwoSidedBody& body = found[batch.node];
    body.node = batch.node;
    body.triangles.push_back({batch.firstTriangle, batch.triangleCount});
    for (std::uint32_t t = 0; t < batch.triangleCount; ++t)
      for (int k = 0; k < 3; ++k) {
        const glm::vec3& p = compiled_.positions[compiled_.triangles[batch.firstTriangle + t][k]];
        body.lower = glm::min(body.lower, p);
        body.upper = glm::max(body.upper, p);
      }
  }
  std::vector<TwoSidedBody> bodies;
  for (auto& [number, body] : found) bodies.push_back(std::move(body));
  return bodies;
}

void Surroundings::place() {
  const std::vector<TwoSidedBody> bodies = twoSidedBodies();
  for (Node& node : nodes_) {
    glm::vec3 lower(3e38f), upper(-3e38f);
    std::vector<TriangleRange> own;
    for (const std::size_t number : node.batches) {
      const Batch& batch = scene_.batches()[number];
      own.push_back({batch.firstTriangle, batch.triangleCount});
      for (std::uint32_t t = 0; t < batch.triangleCount; ++t)
        for (int k = 0; k < 3; ++k) {
          const glm::vec3& p = compiled_.positions[compiled_.triangles[batch.firstTriangle + t][k]];
          lower = glm::min(lower, p);
          upper = glm::max(upper, p);
        }
    }
    node.center = 0.5f * (lower + upper);
    node.radius = 0.5f * glm::length(upper - lower);
    if (node.glass) continue;  // its inside is seen from there as well
    std::vector<TwoSidedBody> others;
    for (const TwoSidedBody& body : bodies)
      if (body.node != node.node) others.push_back(body);
    node.center = placeOutside(compiled_, own, node.center, others);
  }
  placed_ = true;
  insidesDrawn_ = false;
}

void Surroundings::changed() {
  // Twice where nodes may show each other: what the first round drew is seen in the second.
  waiting_ = (nodes_.size() > 1 ? 2 : 1) * facesOfACube * nodes_.size();
}

void Surroundings::sceneMoved() {
  placed_ = false;
  changed();
}

void Surroundings::takeLight(const FoundLight&) {
  waiting_ = std::max(waiting_, nodes_.empty() ? std::size_t{0} : 1);
}

void Surroundings::prepare(const PictureState& picture, SceneDrawer& drawer) {
  if (!nodes_.empty()) {
    const bool coarse = picture.transfer != nullptr && picture.transfer->isCoarse();
    if (light_ != picture.light || transfer_ != picture.transfer || (coarse_ && !coarse)) changed();
    light_ = picture.light;
    transfer_ = picture.transfer;
    coarse_ = coarse;
  }
  const std::size_t drawn = draw(picture.pace.spread ? facesAPicture : waiting_, picture, drawer);
  picture.passed({FramePass::EnvironmentMaps, drawn});
}

/// Returns how many faces were drawn.
std::size_t Surroundings::draw(std::size_t mostFaces, const PictureState& picture, SceneDrawer& drawer) {
  if (waiting_ == 0) return 0;
  if (!placed_) place();
  if (!insidesDrawn_)
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (nodes_[i].glass) drawInside(i);
  insidesDrawn_ = true;
  std::size_t drawn = 0;
  for (; waiting_ > 0 && drawn < mostFaces; --waiting_, ++drawn) {
    drawFace(next_, picture, drawer);
    next_ = (next_ + 1) % (facesOfACube * nodes_.size());
    if (facesSeen_ >= facesOfACube * nodes_.size() || ++facesSeen_ % facesOfACube != 0) continue;
    // The nodes that come next may show this one, which looks its map up blurred where it is rough.
    gl::bind(surroundingsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes_);
    glGenerateMipmap(GL_TEXTURE_CUBE_MAP_ARRAY);
  }
  gl::bind(surroundingsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes_);
  glGenerateMipmap(GL_TEXTURE_CUBE_MAP_ARRAY);
  return drawn;
}

void Surroundings::drawFace(std::size_t face, const PictureState& picture, SceneDrawer& drawer) {
  const Node& node = nodes_[face / facesOfACube];
  const Camera camera = cubeFaceCamera(compiled_.origin + glm::dvec3(node.center), face % facesOfACube,
                                       nearestInCube(compiled_, node.radius));
  drawer.drawFace(picture, {camera, side, {node.node, {}}}, *target_);
  copyToCube(*target_, copyTarget_, cubes_, face);
  gl::check("drawing an environment map");
}

void Surroundings::drawInside(std::size_t place) {
  const Node& node = nodes_[place];
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  gl::bind(triangleNormalsUnit, GL_TEXTURE_BUFFER, scene_.triangleNormals());
  for (std::size_t face = 0; face < facesOfACube; ++face) {
    const CameraMatrices camera = cameraMatrices(cubeFaceCamera(compiled_.origin + glm::dvec3(node.center),
                                                                face, nearestInCube(compiled_, node.radius)),
                                                 compiled_, 1.0);
    target_->bind();
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    insideProgram_->use();
    insideProgram_->set("clipFromScene", glm::mat4(camera.projection * camera.view));
    insideProgram_->set("center", node.center);
    glBindVertexArray(scene_.vertexArray().name());
    for (const std::size_t number : node.batches) {
      const Batch& batch = scene_.batches()[number];
      if (!scene_.surfaces()[batch.surface].isBody()) continue;
      insideProgram_->set("firstTriangle", static_cast<int>(batch.firstTriangle));
      drawTriangles(batch);
    }
    glBindVertexArray(0);
    copyToCube(*target_, copyTarget_, insides_, facesOfACube * place + face);
  }
  gl::check("drawing a body from within");
}

void Surroundings::bindTextures() const {
  gl::bind(surroundingsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes_);
  gl::bind(insidesUnit, GL_TEXTURE_CUBE_MAP_ARRAY, insides_);
}

void Surroundings::set(const gl::Program& program, const Batch& batch) const {
  const auto found = std::find_if(nodes_.begin(), nodes_.end(), [&](const Node& node) {
    return batch.node >= 0 && node.node == batch.node;
  });
  const bool shown = found != nodes_.end() &&
                     facesSeen_ >= facesOfACube * static_cast<std::size_t>(found - nodes_.begin() + 1);
  program.set("cube", shown ? static_cast<int>(found - nodes_.begin()) : -1);
  if (shown) program.set("cubeCenter", found->center);
}

void Surroundings::addPlan(std::vector<PlannedPass>& plan) const {
  const std::size_t nodes = nodes_.size();
  plan.push_back({Pass::EnvironmentMaps, nodes > 0,
                  nodes > 0 ? std::to_string(nodes) + " nodes mirror what is around them or are glass"
                            : "no node is a mirror, glass, metal or nearly a mirror"});
}

void Surroundings::describe(Warnings& notes) const {
  if (leftOut_ > 0)
    notes.push_back(std::to_string(leftOut_) +
                    " of the nodes that mirror or are glass are small and show the sky alone: the largest " +
                    std::to_string(mostNodes) + " have environment maps");
}

extern const PassRow surroundingsRow = {
    .isIn = [](Shading shading, const RenderInputs&) { return showsAllLight(shading); },
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<TechniquePass> {
      return std::make_unique<Surroundings>(of.scene, of.inputs.compiled);
    },
};

}  // namespace prelight::viewer
