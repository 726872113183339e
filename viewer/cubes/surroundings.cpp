#include "viewer/cubes/surroundings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <string>

#include "viewer/programs/drawn_transfer.h"
#include "viewer/programs/texture_units.h"

namespace prelight::viewer {

namespace {

/// Returns the solid angle of a triangle at a point, over that of all directions, about: positive where its
/// front is seen. Too large close to it.
double shareOfDirections(const CompiledScene& compiled, std::uint32_t triangle, const glm::vec3& from) {
  const glm::uvec3 corners = compiled.triangles[triangle];
  const glm::dvec3 middle =
      (glm::dvec3(compiled.positions[corners.x]) + glm::dvec3(compiled.positions[corners.y]) +
       glm::dvec3(compiled.positions[corners.z])) /
      3.0;
  const glm::dvec3 path = glm::dvec3(from) - middle;
  const double distance = std::max(glm::length(path), 1e-20);
  const double facing = 0.5 * glm::dot(geometricNormal(compiled, triangle), path) / distance;
  return std::clamp(facing / (4.0 * std::numbers::pi * distance * distance), -0.5, 0.5);
}

}  // namespace

Surroundings::Surroundings(const RenderScene& scene, const CompiledScene& compiled, Reflecting reflecting)
    : scene_(scene), compiled_(compiled), reflecting_(reflecting) {
  chooseNodes();
  makeMaps();
  changed();
}

void Surroundings::chooseNodes() {
  nodes_.clear();
  borrowing_.clear();
  leftOut_ = alone_ = 0;
  findNodes();
  keepLargest(static_cast<std::size_t>(reflecting_ == Reflecting::Mirrors ? mostNodes : mostTried));
  if (nodes_.empty()) return;
  place();
  if (reflecting_ == Reflecting::Lobes) leaveOutAlone();
  keepLargest(mostNodes);
}

/// Makes black maps for the nodes.
void Surroundings::makeMaps() {
  next_ = facesSeen_ = 0;
  lobes_.reset();
  if (nodes_.empty()) return;
  const bool isRough = reflecting_ == Reflecting::Lobes && std::ranges::none_of(nodes_, &Node::narrow);
  side_ = isRough ? sideOfRough : side;
  target_ = std::make_unique<gl::Framebuffer>(2 * side_, 2 * side_);
  cubes_ = makeCubeMaps(side_, nodes_.size(), true);
  if (reflecting_ == Reflecting::Lobes) lobes_.emplace(side_, nodes_.size());
  quickTarget_ = std::make_unique<gl::Framebuffer>(side_ / 2, side_ / 2);
  const bool glass = std::any_of(nodes_.begin(), nodes_.end(), [](const Node& n) { return n.glass; });
  insides_ = makeCubeMaps(side_, glass ? nodes_.size() : 1, false);
  if (!glass) return;
  insideProgram_ = std::make_unique<gl::Program>("inside.vert", "inside.frag");
  insideProgram_->use();
  insideProgram_->set("triangleNormals", static_cast<int>(triangleNormalsUnit));
}

void Surroundings::findNodes() {
  std::map<int, Node> found;
  for (std::size_t i = 0; i < scene_.batches().size(); ++i) {
    const Batch& batch = scene_.batches()[i];
    if (nodeOf(batch) < 0) continue;
    const Surface& surface = scene_.surfaces()[batch.surface];
    Node& node = found[nodeOf(batch)];
    node.node = nodeOf(batch);
    node.glass = node.glass || (reflecting_ == Reflecting::Mirrors && surface.isBody());
    node.narrow = node.narrow || surface.showsNarrowLobes;
    node.batches.push_back(i);
    for (std::uint32_t t = 0; t < batch.triangleCount; ++t)
      node.area += static_cast<float>(0.5 * glm::length(geometricNormal(compiled_, batch.firstTriangle + t)));
  }
  for (auto& [number, node] : found) nodes_.push_back(std::move(node));
  std::stable_sort(nodes_.begin(), nodes_.end(),
                   [](const Node& a, const Node& b) { return a.area > b.area; });
}

/// Leaves out the smallest of more nodes than `most`.
void Surroundings::keepLargest(std::size_t most) {
  if (nodes_.size() <= most) return;
  leftOut_ += nodes_.size() - most;
  if (reflecting_ == Reflecting::Mirrors)
    borrowing_.assign(nodes_.begin() + static_cast<std::ptrdiff_t>(most), nodes_.end());
  nodes_.resize(most);
}

/// Leaves out the nodes that would reflect little but the sky, and finds out which see themselves.
void Surroundings::leaveOutAlone() {
  for (Node& node : nodes_) {
    double itself = 0.0;
    for (const std::size_t number : node.batches) {
      const Batch& batch = scene_.batches()[number];
      if (scene_.surfaces()[batch.surface].material.doubleSided) continue;
      for (std::uint32_t t = 0; t < batch.triangleCount; ++t)
        itself += std::max(shareOfDirections(compiled_, batch.firstTriangle + t, node.center), 0.0);
    }
    node.seesItself = itself >= leastAround;
  }
  alone_ = std::erase_if(nodes_, [&](const Node& node) { return !hasSurroundings(node); });
}

/// Whether surfaces fill enough of what a node's middle sees.
bool Surroundings::hasSurroundings(const Node& node) const {
  if (node.seesItself) return true;
  double share = 0.0;
  for (const Batch& batch : scene_.batches()) {
    if (nodeOf(batch) == node.node) continue;
    const bool twoSided = scene_.surfaces()[batch.surface].material.doubleSided;
    for (std::uint32_t t = 0; t < batch.triangleCount && share < leastAround; ++t) {
      const double seen = shareOfDirections(compiled_, batch.firstTriangle + t, node.center);
      share += twoSided ? std::abs(seen) : std::max(seen, 0.0);
    }
  }
  return share >= leastAround;
}

std::vector<TwoSidedBody> Surroundings::twoSidedBodies() const {
  std::map<int, TwoSidedBody> found;
  for (const Batch& batch : scene_.batches()) {
    const Surface& surface = scene_.surfaces()[batch.surface];
    if (!surface.material.doubleSided || surface.isBlended()) continue;
    TwoSidedBody& body = found[nodeOf(batch)];
    body.node = nodeOf(batch);
    body.triangles.push_back(batch.triangles());
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

/// The middle of a node's bounds, and half their diagonal.
void Surroundings::findCenter(Node& node) const {
  glm::vec3 lower(3e38f), upper(-3e38f);
  for (const std::size_t number : node.batches) {
    const Batch& batch = scene_.batches()[number];
    for (std::uint32_t t = 0; t < batch.triangleCount; ++t)
      for (int k = 0; k < 3; ++k) {
        const glm::vec3& p = compiled_.positions[compiled_.triangles[batch.firstTriangle + t][k]];
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
      }
  }
  node.center = 0.5f * (lower + upper);
  node.radius = 0.5f * glm::length(upper - lower);
}

void Surroundings::place() {
  const std::vector<TwoSidedBody> bodies = twoSidedBodies();
  for (Node& node : borrowing_) findCenter(node);
  for (Node& node : nodes_) {
    findCenter(node);
    if (node.glass) continue;  // its inside is seen from there as well
    std::vector<TriangleRange> own;
    for (const std::size_t number : node.batches) own.push_back(scene_.batches()[number].triangles());
    std::vector<TwoSidedBody> others;
    for (const TwoSidedBody& body : bodies)
      if (body.node != node.node) others.push_back(body);
    node.center = placeOutside(compiled_, own, node.center, others);
  }
  placed_ = true;
  insidesDrawn_ = false;
}

/// Returns how many faces rounds have from the next one on. With lobes, the last is a cube's last, after
/// which they are filtered.
std::size_t Surroundings::facesOf(std::size_t rounds) const {
  const std::size_t ofRest = lobes_ ? (facesOfACube - next_ % facesOfACube) % facesOfACube : 0;
  return rounds * facesOfARound() + ofRest;
}

void Surroundings::changed() {
  // Twice where nodes may show each other: what the first round drew is seen in the second.
  waiting_ = facesOf(nodes_.size() > 1 ? 2 : 1);
}

void Surroundings::sceneMoved() {
  placed_ = false;
  if (reflecting_ == Reflecting::Lobes) {  // other nodes may reflect now, or have something around them
    const std::vector<Node> before = std::move(nodes_);
    chooseNodes();
    const auto hasSameMap = [](const Node& a, const Node& b) {
      return a.node == b.node && a.narrow == b.narrow;
    };
    if (!std::ranges::equal(before, nodes_, hasSameMap)) makeMaps();
  }
  changed();
}

void Surroundings::takeLight(const FoundLight&) {
  const std::size_t few = reflecting_ == Reflecting::Mirrors ? 1 : facesOf(1);
  waiting_ = std::max(waiting_, nodes_.empty() ? std::size_t{0} : few);
}

void Surroundings::prepare(const PictureState& picture, SceneDrawer& drawer) {
  if (!nodes_.empty()) {
    const bool coarse = picture.transfer != nullptr && picture.transfer->isCoarse();
    if (light_ != picture.light || transfer_ != picture.transfer || (coarse_ && !coarse)) changed();
    light_ = picture.light;
    transfer_ = picture.transfer;
    coarse_ = coarse;
  }
  // Pictures of their own do not depend on those before: nodes show one another once they are drawn anew.
  if (lobes_ && !picture.pace.spread && waiting_ > 0) {
    next_ = facesSeen_ = 0;
    changed();
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
    // Faces of a round before the last are seen only in the maps that the next round draws.
    const bool isQuick = !picture.pace.spread && waiting_ > facesOfARound();
    drawFace(next_, isQuick ? *quickTarget_ : *target_, picture, drawer);
    if (lobes_ && next_ % facesOfACube == facesOfACube - 1) lobes_->filter(next_ / facesOfACube);
    next_ = (next_ + 1) % facesOfARound();
    if (facesSeen_ >= facesOfARound() || ++facesSeen_ % facesOfACube != 0) continue;
    // The nodes that come next may show this one, which looks its map up blurred where it is rough.
    blur();
  }
  blur();
  return drawn;
}

/// Fills the mip levels of the maps. Lobes have their own.
void Surroundings::blur() const {
  if (lobes_) return;
  gl::bind(surroundingsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes_);
  glGenerateMipmap(GL_TEXTURE_CUBE_MAP_ARRAY);
}

void Surroundings::drawFace(std::size_t face, const gl::Framebuffer& target, const PictureState& picture,
                            SceneDrawer& drawer) {
  const Node& node = nodes_[face / facesOfACube];
  const Camera camera = cubeFaceCamera(compiled_.origin + glm::dvec3(node.center), face % facesOfACube,
                                       nearestInCube(compiled_, node.radius));
  std::vector<int> borrowers;
  for (const Node& borrower : borrowing_) borrowers.push_back(borrower.node);
  const LeftOut mirrors{.node = node.node, .furtherNodes = borrowers},
      lobes{.reflectingNode = node.seesItself ? -1 : node.node};
  const int pixels = std::min(side_, target.width());
  drawer.drawFace(picture, {camera, pixels, lobes_ ? lobes : mirrors}, target);
  copyToCube(target, copyTarget_, cubes_, face, side_);
  if (lobes_) lobes_->takeFace(target, face % facesOfACube);
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
      drawTriangles(batch.triangles());
    }
    glBindVertexArray(0);
    copyToCube(*target_, copyTarget_, insides_, facesOfACube * place + face, side_);
  }
  gl::check("drawing a body from within");
}

void Surroundings::bindTextures() const {
  gl::bind(surroundingsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes_);
  gl::bind(insidesUnit, GL_TEXTURE_CUBE_MAP_ARRAY, insides_);
  if (lobes_) gl::bind(reflectionsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, lobes_->lobes());
}

void Surroundings::addFeatures(Features& features) const {
  features.add(Feature::LocalReflections, lobes_.has_value());
}

/// Returns the node of a batch, which has a map or borrows one; nullptr: neither.
const Surroundings::Node* Surroundings::nodeWith(const Batch& batch) const {
  if (nodeOf(batch) < 0) return nullptr;
  for (const std::vector<Node>* nodes : {&nodes_, &borrowing_})
    for (const Node& node : *nodes)
      if (node.node == nodeOf(batch)) return &node;
  return nullptr;
}

/// Returns the node whose map shows what lies around a node: itself once its map was drawn, else, among
/// mirrors, the nearest with one. nullptr: there is none.
const Surroundings::Node* Surroundings::mapFor(const Node& node) const {
  const std::span<const Node> drawn = std::span(nodes_).first(facesSeen_ / facesOfACube);
  const auto own = std::ranges::find_if(drawn, [&](const Node& other) { return other.node == node.node; });
  if (own != drawn.end()) return &*own;
  if (reflecting_ == Reflecting::Lobes || drawn.empty()) return nullptr;
  const auto distance = [&](const Node& other) { return glm::distance(other.center, node.center); };
  return &*std::ranges::min_element(drawn, {}, distance);
}

void Surroundings::set(const gl::Program& program, const Batch& batch) const {
  const Node* node = nodeWith(batch);
  const Node* shown = node != nullptr ? mapFor(*node) : nullptr;
  program.set("cube", shown != nullptr ? static_cast<int>(shown - nodes_.data()) : -1);
  program.set("isOwnCube", shown != nullptr && shown == node ? 1 : 0);
  if (shown == nullptr) return;
  program.set("cubeCenter", shown->center);
  program.set("cubeReach", glm::length(compiled_.boundsMax - compiled_.boundsMin));
}

void Surroundings::addPlan(std::vector<PlannedPass>& plan) const {
  const std::string nodes = std::to_string(nodes_.size());
  if (reflecting_ == Reflecting::Mirrors) {
    plan.push_back({Pass::EnvironmentMaps, !nodes_.empty(),
                    !nodes_.empty() ? nodes + " nodes mirror what is around them or are glass"
                                    : "no node is a mirror, glass, metal or nearly a mirror"});
  } else if (!nodes_.empty()) {
    plan.push_back({Pass::EnvironmentMaps, true, nodes + " nodes reflect what lies around them"});
  } else if (alone_ > 0) {
    plan.push_back({Pass::EnvironmentMaps, false, "little but the sky lies around what reflects"});
  }
}

void Surroundings::describe(Warnings& notes) const {
  if (leftOut_ == 0) return;
  const std::string what =
      reflecting_ == Reflecting::Mirrors
          ? " of the nodes that mirror or are glass are small and show what the nearest others see"
          : " of the nodes that reflect are small and show only the mean of what lies around them";
  notes.push_back(std::to_string(leftOut_) + what + ": the largest " + std::to_string(mostNodes) +
                  " have environment maps");
}

extern const PassRow surroundingsRow = {
    .isIn = [](Shading shading, const RenderInputs&) { return showsAllLight(shading); },
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<TechniquePass> {
      return std::make_unique<Surroundings>(of.scene, of.inputs.compiled, Reflecting::Mirrors);
    },
};

/// Cube maps around placed objects take the same place in shaders.
extern const PassRow localReflectionsRow = {
    .isIn =
        [](Shading shading, const RenderInputs& inputs) {
          return !showsAllLight(shading) && !infoOf(shading).bakeOption.empty() && inputs.cubeLit.empty();
        },
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<TechniquePass> {
      return std::make_unique<Surroundings>(of.scene, of.inputs.compiled, Reflecting::Lobes);
    },
};

}  // namespace prelight::viewer
