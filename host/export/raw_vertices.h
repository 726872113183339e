#pragma once

#include <nlohmann/json.hpp>

#include "export/raw_arrays.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// What a bake holds of vertices: occlusion, bent normals, irradiance, transfer in SH, compressed or not, in
/// CH and in wavelets, vector occluders. Adds it to `arrays` and returns what else a program has to know:
/// which vertices are of which primitive of the file.
nlohmann::ordered_json addRawVertices(const CompiledScene& scene, const Bake& bake, RawArrays& arrays);

}  // namespace prelight
