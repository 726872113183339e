#pragma once

#include <vector>

#include "device/build_options.h"
#include "plan/plan.h"
#include "reference/light_tables.h"
#include "reference/reference.h"

namespace prelight::reference {

/// What the kernels are built with: only the code that a scene needs.
struct Features {
  bool punctual = false;
  bool emitters = false;
  bool sky = false;
  bool glass = false;
  bool mirror = false;
  bool glossy = false;
  bool absorption = false;
  bool layerTextures = false;
  bool scatters = false;  ///< some surface sends light on
};

Features findFeatures(const ReferenceInputs& inputs, const LightTables& lights);

/// The same for people, with reasons.
std::vector<PlannedPass> explainFeatures(const Features& features, const ReferenceRequest& request);

/// Build options of kernels/reference, added to those of the surface.
BuildOptions buildOptions(const Features& features, const ReferenceRequest& request,
                          BuildOptions surfaceOptions);

}  // namespace prelight::reference
