#include "viewer/techniques/caustics/caustic_pass.h"

#include <array>
#include <cmath>

#include "base/directions.h"
#include "viewer/gl/texture.h"

namespace prelight::viewer {
namespace {

enum CausticUnit : GLuint { placesUnit = 0, powerUnit = 1, normalsUnit = 2, marksUnit = 3 };

constexpr int cellSide = CausticPass::cellSide;

struct PhotonVertex {
  glm::vec3 position;
  glm::vec3 power;
  float place;  ///< as techniques/caustics/surface_places.glsl
};

std::vector<PhotonVertex> verticesOf(std::span<const device::Photon> photons, const CompiledScene& scene) {
  std::vector<PhotonVertex> vertices;
  vertices.reserve(photons.size());
  for (const device::Photon& photon : photons) {
    const bool back =
        glm::dot(unpackDirection(photon.direction), geometricNormal(scene, photon.triangle)) < 0.0;
    const float number = static_cast<float>(photon.triangle + 1);
    vertices.push_back({{photon.position[0], photon.position[1], photon.position[2]},
                        {photon.power[0], photon.power[1], photon.power[2]},
                        back ? -number : number});
  }
  return vertices;
}

int cellsOf(int pixels) { return (pixels + cellSide - 1) / cellSide; }

void attach(GLuint location, GLint components, std::size_t offset) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, sizeof(PhotonVertex),
                        reinterpret_cast<const void*>(offset));
}

void clear(const gl::Framebuffer& target, float value) {
  target.bind();
  glClearColor(value, value, value, value);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace

CausticPass::Targets::Targets(int width, int height)
    : places(width, height),
      power(width, height),
      irradiance(width, height),
      marks(cellsOf(width), cellsOf(height)) {}

CausticPass::CausticPass(const Caustics& caustics, const CompiledScene& scene)
    : photonProgram_("photon.vert", "photon.frag"),
      markProgram_("photon_mark.vert", "mark.frag"),
      filterProgram_("caustic_cells.vert", "caustic_filter.frag") {
  update(caustics, scene);
  glBindVertexArray(photonArray_.name());
  glBindBuffer(GL_ARRAY_BUFFER, photons_.name());
  attach(0, 3, offsetof(PhotonVertex, position));
  attach(1, 3, offsetof(PhotonVertex, power));
  attach(2, 1, offsetof(PhotonVertex, place));
  glBindVertexArray(0);
  for (const gl::Program* program : {&photonProgram_, &markProgram_, &filterProgram_}) {
    program->bindBlock("Frame", 0);
    program->use();
    program->set("surfacePlaces", static_cast<int>(placesUnit));
    program->set("photonPower", static_cast<int>(powerUnit));
    program->set("triangleNormals", static_cast<int>(normalsUnit));
    program->set("marks", static_cast<int>(marksUnit));
  }
  gl::check("preparing caustics");
}

void CausticPass::update(const Caustics& caustics, const CompiledScene& scene) {
  filter_ = caustics.filter;
  skipCells_ = caustics.skipCells;
  photonCount_ = static_cast<GLsizei>(caustics.photons.size());
  photons_.fill(GL_ARRAY_BUFFER, std::span<const PhotonVertex>(verticesOf(caustics.photons, scene)),
                GL_DYNAMIC_DRAW);
}

const gl::Framebuffer& CausticPass::places(int width, int height) {
  if (targets_ == nullptr || targets_->places.width() != width || targets_->places.height() != height)
    targets_ = std::make_unique<Targets>(width, height);
  return targets_->places;
}

void CausticPass::setPicture(const gl::Program& program, double pixelWidth,
                             const gl::Texture& triangleNormals) const {
  program.use();
  program.set("pixelWidth", static_cast<float>(pixelWidth));
  gl::bind(placesUnit, GL_TEXTURE_2D, targets_->places.color());
  gl::bind(powerUnit, GL_TEXTURE_2D, targets_->power.color());
  gl::bind(normalsUnit, GL_TEXTURE_BUFFER, triangleNormals);
  gl::bind(marksUnit, GL_TEXTURE_2D, targets_->marks.color());
}

void CausticPass::drawPhotons(const gl::Program& program, const gl::Framebuffer& target, bool add) const {
  clear(target, 0.0f);
  program.use();
  (add ? glEnable : glDisable)(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  glBindVertexArray(photonArray_.name());
  glDrawArrays(GL_POINTS, 0, photonCount_);
  glBindVertexArray(0);
  glDisable(GL_BLEND);
}

void CausticPass::draw(double pixelWidth, const gl::Texture& triangleNormals) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  const gl::Framebuffer& picture = targets_->irradiance;
  const glm::ivec4 cells(cellsOf(picture.width()), cellsOf(picture.height()), cellSide, 0);
  const glm::vec4 size(picture.width(), picture.height(), 0, 0);
  setPicture(photonProgram_, pixelWidth, triangleNormals);
  drawPhotons(photonProgram_, targets_->power, true);
  if (skipCells_) {
    markProgram_.use();
    markProgram_.set("cells", cells);
    markProgram_.set("size", size);
    drawPhotons(markProgram_, targets_->marks, false);
  } else {
    clear(targets_->marks, 1.0f);
  }
  clear(picture, 0.0f);
  setPicture(filterProgram_, pixelWidth, triangleNormals);
  filterProgram_.set("cells", cells);
  filterProgram_.set("size", size);
  filterProgram_.set("radii",
                     glm::vec4(filter_.radius, filter_.density.minRadius, filter_.density.nearest, margin));
  glBindVertexArray(noVertices_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, cells.x * cells.y);
  glBindVertexArray(0);
  glEnable(GL_DEPTH_TEST);
  gl::check("drawing caustics");
}

}  // namespace prelight::viewer
