#pragma once

#include <memory>

#include "techniques/shading.h"
#include "viewer/programs/drawn_transfer.h"
#include "viewer/programs/shader_variant.h"
#include "viewer/programs/technique_pass.h"

namespace prelight::viewer {

/// How OpenGL draws a shading: its row in the registry of techniques. A shading whose data are numbers of
/// vertices (ShadingInfo::vertexNumbers) needs no row.
struct DrawnShading {
  const ShadingInfo* info = nullptr;
  /// Uploads what it needs of a bake, or of other light, that the inputs have; nullptr: it needs nothing.
  std::unique_ptr<DrawnTransfer> (*make)(const TechniqueInputs&) = nullptr;
  const char* shader = "surface.frag";  ///< of fragments
  /// Changes the variant of programs as options of a view say; nullptr: none do.
  void (*vary)(const View&, Lobe, ShaderVariant&) = nullptr;

  /// Whether the inputs hold its light, for a shading of all light; else nullptr, and a bake has to carry it.
  bool (*offered)(const RenderInputs&) = nullptr;
  const char* missing = "";  ///< what is not among inputs that do not hold it
  const char* cure = "";     ///< what makes it
  /// Throws Error where its light does not fit the scene.
  void (*check)(const RenderInputs&) = nullptr;
};

}  // namespace prelight::viewer
