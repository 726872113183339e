#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "prelight/scene.h"

namespace prelight {

/// Ways from materials to pictures that leave features out. Methods that follow rays (reference, full,
/// photons, light maps) leave out none, except that bodies scatter light only in `reference`; shadings in
/// OpenGL that use transfer draw all lobes and show what scattering was baked.
enum class MaterialPath : std::uint8_t {
  DrawnFull,  ///< full shading in OpenGL
  Transfer,   ///< bakes of transfer and radiosity
};
constexpr std::size_t materialPathCount = 2;

/// A feature of materials and the paths that leave it out, as in the table of docs/materials.md.
struct DroppedFeature {
  const char* what;
  bool (*has)(const CompiledMaterial&);
  bool droppedBy[materialPathCount];  ///< [MaterialPath]
};

std::span<const DroppedFeature> droppedFeatures();

/// Adds a warning, naming the materials, for each feature that `path` leaves out of materials of the scene's
/// triangles. `who` names the path ("sh shading", "the bake").
void noteDroppedFeatures(const Scene& scene, const CompiledScene& compiled, MaterialPath path,
                         const std::string& who, Warnings& notes);

}  // namespace prelight
