#include "viewer/hemisphere/hemisphere_raster.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "basis/sh.h"
#include "basis/sh_rotation.h"
#include "prelight/error.h"
#include "radiosity/elements.h"
#include "scene/surface/tangent_space.h"

namespace prelight::viewer {
namespace {

constexpr int leastRasterSide = 8, mostSide = 256;
constexpr int atlasSide = 512;
/// Edges over the diagonal of the scene's bounds, where straight edges become arcs that are drawn straight.
constexpr double longestEdge = 1.0 / 24.0;
constexpr float nearestOfDiagonal = 1e-4f;
constexpr GLuint seenUnit = 0, weightsUnit = 1;

int checkedSide(int side) {
  if (side >= leastRasterSide && side <= mostSide && std::has_single_bit(static_cast<unsigned>(side)))
    return side;
  throw Error(ExitCode::RuntimeFailure, "side of a hemisphere's picture",
              std::to_string(side) + " texels; a power of two from " + std::to_string(leastRasterSide) +
                  " to " + std::to_string(mostSide) + " is needed");
}

const HemiPlane& checkedPlane(const HemiPlane& plane) {
  if (plane.halfWidth > 0.0 && std::isfinite(plane.halfWidth)) return plane;
  throw Error(ExitCode::RuntimeFailure, "half width of a hemi-plane",
              std::to_string(plane.halfWidth) + " at distance 1; a finite number above 0 is needed");
}

/// Columns: a receiver's axes.
glm::dmat3 frameOf(const HemisphereReceiver& receiver) {
  const glm::dvec3 across = anyPerpendicular(receiver.normal), along = glm::cross(receiver.normal, across);
  const double c = std::cos(receiver.turn), s = std::sin(receiver.turn);
  return {c * across + s * along, c * along - s * across, receiver.normal};
}

DiscReceiver discReceiver(const HemisphereReceiver& receiver) {
  return {glm::vec3(receiver.position), receiver.triangle, glm::mat3(frameOf(receiver)),
          receiver.geometricNormal};
}

std::size_t divideUp(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

/// The vector whose product with directions the values of the first bands of a function are the integrals of.
glm::dvec3 meanDirection(std::span<const double> values) {
  constexpr double squared = 3.0 / (4.0 * std::numbers::pi);  // length of the second band of a unit vector
  glm::dvec3 mean(0.0);
  std::array<double, 4> axis{};
  for (int a = 0; a < 3; ++a) {
    glm::dvec3 direction(0.0);
    direction[a] = 1.0;
    sh::evaluate(direction, 2, axis);
    for (std::size_t c = 1; c < 4; ++c) mean[a] += values[c] * axis[c] / squared;
  }
  return mean;
}

/// Turned to the world's axes; `local` begins each receiver's row with its coefficients in its own frame.
std::vector<double> worldTransfer(std::span<const HemisphereReceiver> receivers,
                                  std::span<const glm::vec4> local, int order) {
  const auto count = static_cast<std::size_t>(sh::coefficientCount(order));
  std::vector<double> values(count), result;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const auto row = local.subspan(i * (local.size() / receivers.size()));
    for (std::size_t c = 0; c < count; ++c) values[c] = row[c / 4][static_cast<int>(c % 4)];
    const std::vector<double> world = sh::rotate(values, order, frameOf(receivers[i]));
    result.insert(result.end(), world.begin(), world.end());
  }
  return result;
}

}  // namespace

HemisphereRaster::HemisphereRaster(const CompiledScene& scene, HemisphereMap map, int side, HemisphereSums by,
                                   const HemiPlane& plane, DiscEdges edges)
    : scene_(scene),
      map_(map),
      plane_(checkedPlane(plane)),
      edges_(edges),
      side_(checkedSide(side)),
      levels_(std::countr_zero(static_cast<unsigned>(side))),
      tilesASide_(atlasSide / side),
      faces_(facesOf(map, plane)),
      texels_(texelsOf(map, side, plane)),
      drawProgram_("hemisphere.vert", "hemisphere.frag"),
      weighProgram_("fullscreen.vert", "hemisphere_weights.frag"),
      positions_(Attribute::Position, std::span<const glm::vec3>()),
      radiance_(Attribute::Radiance, std::span<const glm::vec3>()),
      atlas_(atlasSide, atlasSide),
      products_(atlasSide, atlasSide) {
  farthest_ = glm::length(scene.boundsMax - scene.boundsMin);
  nearest_ = nearestOfDiagonal * farthest_;
  if (isDisc(map) && edges == DiscEdges::Exact)
    discs_.emplace(scene, map == HemisphereMap::Orthographic, side_, farthest_);
  else
    makeCorners();
  glBindVertexArray(vertices_.name());
  positions_.attach();
  radiance_.attach();
  glBindVertexArray(0);
  glBindTexture(GL_TEXTURE_2D, products_.color().name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, levels_);
  glGenerateMipmap(GL_TEXTURE_2D);  // Mesa draws to the levels of before until a framebuffer is bound again
  weighProgram_.use();
  weighProgram_.set("seen", static_cast<int>(seenUnit));
  weighProgram_.set("weights", static_cast<int>(weightsUnit));
  if (by == HemisphereSums::FourPasses) fourPasses_.emplace(atlasSide, side_);
  gl::check("preparing pictures of hemispheres");
}

void HemisphereRaster::makeCorners() {
  const double longest =
      edges_ == DiscEdges::Pieces ? longestEdge * farthest_ : std::numeric_limits<double>::max();
  const RadiosityElements pieces = makeElements(scene_, longest);
  std::vector<glm::vec3> positions;
  for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t)
    for (std::uint32_t piece = 0; piece < pieces.splits[t] * pieces.splits[t]; ++piece)
      for (const glm::dvec2& corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
        const glm::dvec2 w = pointOfPiece(pieces.splits[t], piece, corner);
        corners_.push_back({t, glm::vec2(w)});
        const glm::uvec3& v = scene_.triangles[t];
        const glm::dvec3 a(scene_.positions[v.x]);
        positions.emplace_back(a + w.x * (glm::dvec3(scene_.positions[v.y]) - a) +
                               w.y * (glm::dvec3(scene_.positions[v.z]) - a));
      }
  positions_.fill(std::span<const glm::vec3>(positions));
  radiance_.fill(std::span<const glm::vec3>(std::vector<glm::vec3>(positions.size(), glm::vec3(0.0f))));
}

/// Each receiver's picture of a face into the atlas.
void HemisphereRaster::draw(const HemisphereFace& face, std::span<const HemisphereReceiver> receivers,
                            bool radiance) {
  if (!discs_) return drawTriangles(face, receivers);
  std::vector<DiscReceiver> discs;
  for (const HemisphereReceiver& receiver : receivers) discs.push_back(discReceiver(receiver));
  discs_->draw(atlas_, discs, radiance);
}

void HemisphereRaster::drawTriangles(const HemisphereFace& face,
                                     std::span<const HemisphereReceiver> receivers) {
  atlas_.bind();
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CLIP_DISTANCE0);
  glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  drawProgram_.use();
  drawProgram_.set("window", glm::vec4(face.window));
  drawProgram_.set("depths", glm::vec4(nearest_, farthest_,
                                       map_ == HemisphereMap::Stereographic  ? 1.0f
                                       : map_ == HemisphereMap::Orthographic ? 2.0f
                                                                             : 0.0f,
                                       0.0f));
  glBindVertexArray(vertices_.name());
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const int tile = static_cast<int>(i);
    glViewport(tile % tilesASide_ * side_, tile / tilesASide_ * side_, side_, side_);
    drawProgram_.set("receiver", glm::vec3(receivers[i].position));
    drawProgram_.set("toFace", glm::mat4(glm::mat3(glm::transpose(frameOf(receivers[i]) * face.frame))));
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners_.size()));
  }
  glBindVertexArray(0);
  glDisable(GL_CLIP_DISTANCE0);
}

/// [picture of the atlas]
std::vector<glm::vec4> HemisphereRaster::sumsOfProducts() {
  if (fourPasses_) {
    fourPasses_->run(products_.color());
    return fourPasses_->read();
  }
  glActiveTexture(GL_TEXTURE0 + seenUnit);
  glBindTexture(GL_TEXTURE_2D, products_.color().name());
  glGenerateMipmap(GL_TEXTURE_2D);
  std::vector<glm::vec4> sums(static_cast<std::size_t>(tilesASide_ * tilesASide_));
  glGetTexImage(GL_TEXTURE_2D, levels_, GL_RGBA, GL_FLOAT, sums.data());
  for (glm::vec4& mean : sums) mean *= static_cast<float>(side_ * side_);
  return sums;
}

void HemisphereRaster::addSums(const gl::BufferTexture& weights, std::size_t face, Counts counts,
                               std::span<glm::vec4> sums) {
  products_.bind();
  glDisable(GL_DEPTH_TEST);
  weighProgram_.use();
  weighProgram_.set("tile", glm::ivec4(side_, static_cast<int>(face) * side_ * side_,
                                       counts == Counts::Radiance ? 1 : 0, 0));
  gl::bind(seenUnit, GL_TEXTURE_2D, atlas_.color());
  gl::bind(weightsUnit, GL_TEXTURE_BUFFER, weights.texture);
  glBindVertexArray(noVertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glEnable(GL_DEPTH_TEST);
  const std::vector<glm::vec4> found = sumsOfProducts();
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += found[i];
  gl::check("summing up pictures of hemispheres");
}

std::vector<gl::BufferTexture> HemisphereRaster::upload(std::span<const Weights> weights) const {
  std::vector<gl::BufferTexture> uploaded;
  for (const Weights& four : weights)
    uploaded.push_back(
        gl::makeBufferTexture(std::span<const glm::vec4>(four.ofTexels), "weights of hemispheres"));
  return uploaded;
}

/// Sums of a receiver that sees nothing but the sky, in its own frame, rounded as those of all receivers are.
std::vector<double> HemisphereRaster::openSums(int order) {
  const std::vector<Weights> weights = transferWeights(order);
  const std::vector<gl::BufferTexture> uploaded = upload(weights);
  std::vector<glm::vec4> found(weights.size(), glm::vec4(0.0f));
  atlas_.bind();
  glClearColor(1.0f, 1.0f, 1.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (std::size_t w = 0; w < weights.size(); ++w)
      addSums(uploaded[w], f, Counts::WhatIsOpen, std::span(&found[w], 1));
  std::vector<double> sums;
  for (const glm::vec4& four : found) sums.insert(sums.end(), {four.x, four.y, four.z, four.w});
  return sums;
}

/// [receiver][of weights].
std::vector<glm::vec4> HemisphereRaster::sums(std::span<const HemisphereReceiver> receivers,
                                              std::span<const Weights> weights) {
  const std::vector<gl::BufferTexture> uploaded = upload(weights);
  const bool radiance =
      std::ranges::any_of(weights, [](const Weights& four) { return four.counts == Counts::Radiance; });
  std::vector<glm::vec4> result(receivers.size() * weights.size(), glm::vec4(0.0f));
  const auto batch = static_cast<std::size_t>(tilesASide_ * tilesASide_);
  for (std::size_t first = 0; first < receivers.size(); first += batch) {
    const auto some = receivers.subspan(first, std::min(batch, receivers.size() - first));
    std::vector<std::vector<glm::vec4>> found(weights.size(), std::vector<glm::vec4>(some.size()));
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      draw(faces_[f], some, radiance);
      for (std::size_t w = 0; w < weights.size(); ++w) addSums(uploaded[w], f, weights[w].counts, found[w]);
    }
    for (std::size_t i = 0; i < some.size(); ++i)
      for (std::size_t w = 0; w < weights.size(); ++w) result[(first + i) * weights.size() + w] = found[w][i];
  }
  return result;
}

double HemisphereRaster::lostShare() const {
  return map_ == HemisphereMap::HemiPlane ? shareBeside(plane_) : 0.0;
}

/// Scales the weights of texels, so that they and the replacement of the lost share add up to the hemisphere.
double HemisphereRaster::scale() const {
  const double seen = plane_.lost == LostLight::Mean ? 1.0 : 1.0 - lostShare();
  return seen / coverageOf(texels_);
}

/// Weights of the coefficients, four to a pass, in the receiver's frame.
std::vector<HemisphereRaster::Weights> HemisphereRaster::transferWeights(int order) const {
  const auto count = static_cast<std::size_t>(sh::coefficientCount(order));
  std::vector<Weights> weights(divideUp(count, 4),
                               {Counts::WhatIsOpen, std::vector<glm::vec4>(texels_.size(), glm::vec4(0.0f))});
  std::vector<double> values(count);
  const auto add = [&](std::size_t texel, const glm::dvec3& direction, double share) {
    if (share <= 0.0) return;
    sh::evaluate(direction, order, values);
    for (std::size_t c = 0; c < count; ++c)
      weights[c / 4].ofTexels[texel][static_cast<int>(c % 4)] += static_cast<float>(share * values[c]);
  };
  const double ofTexels = std::numbers::inv_pi * scale();
  for (std::size_t t = 0; t < texels_.size(); ++t) {
    const HemisphereTexel& texel = texels_[t];
    add(t, texel.direction, ofTexels * texel.direction.z * texel.solidAngle);
    if (plane_.lost == LostLight::Rim) add(t, texel.beside, texel.shareBeside);
  }
  return weights;
}

HemisphereRaster::Weights HemisphereRaster::irradianceWeights() const {
  Weights weights{Counts::Radiance, std::vector<glm::vec4>(texels_.size(), glm::vec4(0.0f))};
  const double ofTexels = scale();
  for (std::size_t t = 0; t < texels_.size(); ++t) {
    const HemisphereTexel& texel = texels_[t];
    double weight = ofTexels * std::max(texel.direction.z, 0.0) * texel.solidAngle;
    if (plane_.lost == LostLight::Rim) weight += std::numbers::pi * texel.shareBeside;
    weights.ofTexels[t].x = static_cast<float>(weight);
  }
  return weights;
}

void HemisphereRaster::setRadiance(std::span<const glm::vec3> radiance) {
  std::vector<glm::vec3> ofCorners;
  if (discs_) {
    for (const glm::uvec3& v : scene_.triangles)
      for (int c = 0; c < 3; ++c) ofCorners.push_back(radiance[v[c]]);
    return discs_->setRadiance(ofCorners);
  }
  for (const Corner& corner : corners_) {
    const glm::uvec3& v = scene_.triangles[corner.triangle];
    ofCorners.push_back((1.0f - corner.weights.x - corner.weights.y) * radiance[v.x] +
                        corner.weights.x * radiance[v.y] + corner.weights.y * radiance[v.z]);
  }
  radiance_.fill(std::span<const glm::vec3>(ofCorners));
}

std::vector<double> HemisphereRaster::transfer(std::span<const HemisphereReceiver> receivers, int order) {
  sh::checkOrder(order, "order of rasterised transfer");
  return worldTransfer(receivers, sums(receivers, transferWeights(order)), order);
}

std::vector<HemisphereView> HemisphereRaster::look(std::span<const HemisphereReceiver> receivers, int order) {
  const int bands = std::max(order, 2);  // the first two have the open share and the mean direction
  sh::checkOrder(bands, "order of rasterised transfer");
  const std::vector<double> open = openSums(bands);
  const std::vector<Weights> weights = transferWeights(bands);
  const std::vector<glm::vec4> found = sums(receivers, weights);
  std::vector<HemisphereView> views;
  std::vector<double> values(static_cast<std::size_t>(bands * bands));
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const glm::vec4* local = &found[i * weights.size()];
    const double share = std::clamp(double(local[0].x) / open[0], 0.0, 1.0);
    for (std::size_t c = 0; c < values.size(); ++c)
      values[c] = double(local[c / 4][static_cast<int>(c % 4)]) - share * open[c];
    const std::vector<double> world = sh::rotate(values, bands, frameOf(receivers[i]));
    views.push_back({static_cast<float>(share),
                     glm::vec3(meanDirection(world)),
                     {world.begin(), world.begin() + order * order}});
  }
  return views;
}

std::vector<glm::vec3> HemisphereRaster::irradiance(std::span<const HemisphereReceiver> receivers,
                                                    std::span<const glm::vec3> radiance) {
  setRadiance(radiance);
  const Weights weights = irradianceWeights();
  const std::vector<glm::vec4> found = sums(receivers, std::span(&weights, 1));
  return {found.begin(), found.end()};
}

HemisphereGather HemisphereRaster::gather(std::span<const HemisphereReceiver> receivers, int order,
                                          std::span<const glm::vec3> radiance) {
  sh::checkOrder(order, "order of rasterised transfer");
  setRadiance(radiance);
  std::vector<Weights> weights = transferWeights(order);
  weights.push_back(irradianceWeights());
  const std::vector<glm::vec4> found = sums(receivers, weights);
  HemisphereGather result{worldTransfer(receivers, found, order), {}};
  for (std::size_t i = 0; i < receivers.size(); ++i)
    result.irradiance.emplace_back(found[(i + 1) * weights.size() - 1]);
  return result;
}

}  // namespace prelight::viewer
