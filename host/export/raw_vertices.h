#pragma once

#include <nlohmann/json.hpp>

#include "export/raw_arrays.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// Adds the per-vertex data of a bake to `arrays`: occlusion, bent normals, irradiance, transfer in SH
/// (compressed or not), in CH and in wavelets, and vector occluders. Returns the further data that a program
/// needs: which vertices belong to which primitive of the file.
nlohmann::ordered_json addRawVertices(const CompiledScene& scene, const Bake& bake, RawArrays& arrays);

}  // namespace prelight
