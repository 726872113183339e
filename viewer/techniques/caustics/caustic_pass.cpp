#include "viewer/techniques/caustics/caustic_pass.h"

#include <array>
#include <cmath>

#include "base/directions.h"
#include "viewer/gl/texture.h"

namespace prelight::viewer {
namespace {

enum CausticUnit : GLuint {
  placesUnit = 0,
  powerUnit = 1,
  normalsUnit = 2,
  marksUnit = 3,
  finestPlacesUnit = 4,
};

constexpr int cellSide = CausticPass::cellSide;

/// The coarsest level has texels of 32 pixels, so that a radius of 256 pixels is filtered in full.
constexpr int mostLevels = 6;

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

int cellsOf(int texels) { return (texels + cellSide - 1) / cellSide; }

/// Cells of a level, for caustic_cells.vert.
glm::ivec4 cellGrid(const LevelRaster& raster) {
  return {cellsOf(raster.width), cellsOf(raster.height), cellSide, pixelsPerTexel(raster.level)};
}

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
    : places(width, height), power(width, height), marks(cellsOf(width), cellsOf(height)) {}

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
    program->set("finestPlaces", static_cast<int>(finestPlacesUnit));
    program->set("photonPower", static_cast<int>(powerUnit));
    program->set("triangleNormals", static_cast<int>(normalsUnit));
    program->set("marks", static_cast<int>(marksUnit));
  }
  gl::check("preparing caustics");
}

void CausticPass::update(const Caustics& caustics, const CompiledScene& scene) {
  filter_ = caustics.filter;
  skipCells_ = caustics.skipCells;
  const std::vector<PhotonVertex> vertices = verticesOf(caustics.photons, scene);
  positions_.clear();
  positions_.reserve(vertices.size());
  for (const PhotonVertex& vertex : vertices) positions_.push_back(vertex.position);
  photons_.fill(GL_ARRAY_BUFFER, std::span<const PhotonVertex>(vertices), GL_DYNAMIC_DRAW);
}

int CausticPass::levelsFor(const CameraMatrices& camera, double pixelWidth) const {
  return levelsForRadius(positions_, filter_.radius, camera, pixelWidth, margin, mostLevels);
}

const gl::Framebuffer& CausticPass::places(const LevelRaster& raster) {
  const auto level = static_cast<std::size_t>(raster.level);
  if (levels_.size() <= level) levels_.resize(level + 1);
  std::unique_ptr<Targets>& targets = levels_[level];
  if (targets == nullptr || targets->places.width() != raster.width ||
      targets->places.height() != raster.height)
    targets = std::make_unique<Targets>(raster.width, raster.height);
  return targets->places;
}

void CausticPass::setLevel(const gl::Program& program, const Targets& targets, double pixelWidth,
                           const gl::Texture& triangleNormals) const {
  program.use();
  program.set("pixelWidth", static_cast<float>(pixelWidth));
  gl::bind(placesUnit, GL_TEXTURE_2D, targets.places.color());
  gl::bind(powerUnit, GL_TEXTURE_2D, targets.power.color());
  gl::bind(normalsUnit, GL_TEXTURE_BUFFER, triangleNormals);
  gl::bind(marksUnit, GL_TEXTURE_2D, targets.marks.color());
}

void CausticPass::drawPoints(const gl::Program& program, const gl::Framebuffer& target, bool add) const {
  clear(target, 0.0f);
  program.use();
  (add ? glEnable : glDisable)(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  glBindVertexArray(photonArray_.name());
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(positions_.size()));
  glBindVertexArray(0);
  glDisable(GL_BLEND);
}

void CausticPass::drawPhotons(const LevelRaster& raster, double pixelWidth,
                              const gl::Texture& triangleNormals) {
  const Targets& targets = *levels_[static_cast<std::size_t>(raster.level)];
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  setLevel(photonProgram_, targets, pixelWidth * pixelsPerTexel(raster.level), triangleNormals);
  drawPoints(photonProgram_, targets.power, true);
  if (skipCells_) {
    markProgram_.use();
    markProgram_.set("cells", cellGrid(raster));
    markProgram_.set("size", glm::vec4(raster.width, raster.height, 0, 0));
    drawPoints(markProgram_, targets.marks, false);
  } else {
    clear(targets.marks, 1.0f);
  }
  glEnable(GL_DEPTH_TEST);
  gl::check("drawing photons of caustics");
}

void CausticPass::filterLevel(const LevelRaster& raster, const LevelRaster& finest) const {
  const glm::ivec4 cells = cellGrid(raster);
  filterProgram_.set("cells", cells);
  filterProgram_.set("level",
                     glm::ivec4(finest.left - raster.left, finest.bottom - raster.bottom, raster.level, 0));
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, cells.x * cells.y);
}

void CausticPass::filter(std::span<const LevelRaster> rasters, double pixelWidth,
                         const gl::Texture& triangleNormals) {
  const LevelRaster& finest = rasters.front();
  if (irradiance_ == nullptr || irradiance_->width() != finest.width ||
      irradiance_->height() != finest.height)
    irradiance_ = std::make_unique<gl::Framebuffer>(finest.width, finest.height);
  clear(*irradiance_, 0.0f);
  glDisable(GL_CULL_FACE);
  glBindVertexArray(noVertices_.name());
  filterProgram_.use();
  filterProgram_.set("size", glm::vec4(finest.width, finest.height, 0, 0));
  filterProgram_.set("radii",
                     glm::vec4(filter_.radius, filter_.density.minRadius, filter_.density.nearest, margin));
  gl::bind(finestPlacesUnit, GL_TEXTURE_2D, levels_.front()->places.color());
  // Coarse levels first: what they filter is nearer in depth, so that finer levels leave it alone.
  for (auto raster = rasters.rbegin(); raster != rasters.rend(); ++raster) {
    setLevel(filterProgram_, *levels_[static_cast<std::size_t>(raster->level)], pixelWidth, triangleNormals);
    filterLevel(*raster, finest);
  }
  glBindVertexArray(0);
  gl::check("filtering caustics");
}

}  // namespace prelight::viewer
