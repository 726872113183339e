#pragma once

#include <memory>
#include <vector>

#include "prelight/error.h"
#include "prelight/load.h"

namespace prelight {

/// Makes a material reflect as was measured. What else is said of its reflection is replaced by what comes
/// near: a diffuse body and a GGX lobe, which bakes and rasterised pictures show. Coverage, bumps and
/// emission stay.
void setMeasured(const std::shared_ptr<const MeasuredBrdf>& brdf, Material& material);

/// Reads the files that are named and gives them to their materials. Throws UsageError for a material that
/// the scene has not, InputError for a file.
void giveMeasured(Scene& scene, const std::vector<MaterialBrdf>& brdfs, Warnings& warnings);

}  // namespace prelight
