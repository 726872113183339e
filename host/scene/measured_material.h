#pragma once

#include <memory>
#include <vector>

#include "prelight/error.h"
#include "prelight/load.h"

namespace prelight {

/// Makes a material reflect as measured. Its other reflection parameters are replaced by an approximation, a
/// diffuse body and a GGX lobe, which bakes and rasterised pictures show. Coverage, bumps and emission are
/// unchanged.
void setMeasured(const std::shared_ptr<const MeasuredBrdf>& brdf, Material& material);

/// Reads the named files and assigns them to their materials. Throws UsageError for a material that the scene
/// does not have, InputError for a file.
void giveMeasured(Scene& scene, const std::vector<MaterialBrdf>& brdfs, Warnings& warnings);

}  // namespace prelight
