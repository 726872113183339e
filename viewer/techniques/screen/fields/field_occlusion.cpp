#include "viewer/techniques/screen/fields/field_occlusion.h"

#include <array>
#include <glm/gtc/packing.hpp>

namespace prelight::viewer {
namespace {

constexpr std::size_t texelsOfCell = 3;

/// The rows of the map from scene coordinates to a shape's cells, then its cells and the first of them in the
/// buffer.
std::array<glm::vec4, 4> placeTexels(const FieldShapes::Placed& placed, const VolumeGrid& grid,
                                     const glm::dvec3& origin, std::uint32_t firstCell) {
  std::array<glm::vec4, 4> texels{};
  const glm::dmat3 back = glm::transpose(placed.motion.rotation) / grid.cell();
  const glm::dvec3 start = -(back * placed.motion.translation) - (grid.min - origin) / grid.cell();
  for (int row = 0; row < 3; ++row)
    texels[static_cast<std::size_t>(row)] =
        glm::vec4(glm::dvec4(back[0][row], back[1][row], back[2][row], start[row]));
  texels[3] = glm::vec4(grid.size, static_cast<float>(firstCell));
  return texels;
}

}  // namespace

std::size_t FieldOcclusion::bytesOf(const OcclusionField& field) {
  return field.grid.count() * texelsOfCell * sizeof(std::uint64_t);
}

const Device& FieldOcclusion::device() {
  if (device_ == nullptr) device_ = &opened_.emplace(Device::open({}));
  return *device_;
}

void FieldOcclusion::cast(const Ready& wanted) {
  shapes_ = std::make_unique<FieldShapes>(
      scene_, device(),
      OcclusionFieldOptions{wanted.radius, static_cast<std::size_t>(wanted.cells),
                            static_cast<std::uint32_t>(wanted.rays)});
  triangles_ = scene_.triangles;
  const std::vector<float> own = shapes_->ownAccessibility(scene_);
  own_.emplace(Attribute::Accessibility, std::span<const float>(own));
  const std::vector<float> owners = shapes_->ownersOf(scene_);
  owners_ = gl::makeBufferTexture(std::span<const float>(owners), 1, GL_R32F, "objects of triangles");
  uploadCells();
}

/// Halves: numbers of directions are of at most 4 pi.
void FieldOcclusion::uploadCells() {
  std::vector<std::uint64_t> texels;
  firstCells_.clear();
  for (const FieldShape& shape : shapes_->shapes()) {
    firstCells_.push_back(static_cast<std::uint32_t>(texels.size() / texelsOfCell));
    const std::vector<float>& hidden = shape.field.hidden;
    for (std::size_t i = 0; i < hidden.size(); i += OcclusionField::moments) {
      texels.push_back(glm::packHalf4x16({hidden[i], hidden[i + 1], hidden[i + 2], hidden[i + 3]}));
      texels.push_back(glm::packHalf4x16({hidden[i + 4], hidden[i + 5], hidden[i + 6], hidden[i + 7]}));
      texels.push_back(glm::packHalf4x16({hidden[i + 8], 0.0f, 0.0f, 0.0f}));
    }
  }
  if (texels.empty()) texels.resize(texelsOfCell, 0);  // nothing that occludes
  cells_ =
      gl::makeBufferTexture(std::span<const std::uint64_t>(texels), 1, GL_RGBA16F, "fields of occlusion");
}

void FieldOcclusion::uploadPlaces() {
  std::vector<glm::vec4> texels;
  for (const FieldShapes::Placed& placed : shapes_->objects()) {
    std::array<glm::vec4, 4> texelsOfObject{};  // without cells
    if (placed.shape != FieldShapes::none)
      texelsOfObject = placeTexels(placed, shapes_->shapes()[placed.shape].field.grid, scene_.origin,
                                   firstCells_[placed.shape]);
    texels.insert(texels.end(), texelsOfObject.begin(), texelsOfObject.end());
  }
  if (texels.empty()) texels.resize(4, glm::vec4(0.0f));
  places_ = gl::makeBufferTexture(texels, "places of fields");
}

void FieldOcclusion::prepare(const ScreenOcclusionOptions& options, double radius) {
  const Ready wanted{radius, options.cells, options.fieldRays};
  const bool isNew = shapes_ == nullptr || wanted != ready_ || triangles_ != scene_.triangles;
  if (isNew) {
    cast(wanted);
    ready_ = wanted;
  } else if (moved_) {
    shapes_->follow(scene_);
  }
  if (isNew || moved_) uploadPlaces();
  moved_ = false;
  gl::check("occlusion by fields");
}

void FieldOcclusion::attach(GLuint unit) const {
  gl::bind(unit, GL_TEXTURE_BUFFER, places_.texture);
  gl::bind(unit + 1, GL_TEXTURE_BUFFER, cells_.texture);
}

void FieldOcclusion::setUniforms(const gl::Program& program, GLuint unit) {
  program.set("fieldPlaces", static_cast<int>(unit));
  program.set("fieldCells", static_cast<int>(unit) + 1);
}

void FieldOcclusion::bind(const gl::Program& program) const {
  own_->attach();
  gl::bind(encodedVerticesUnit, GL_TEXTURE_BUFFER, owners_.texture);
  program.set("owners", static_cast<int>(encodedVerticesUnit));
}

}  // namespace prelight::viewer
