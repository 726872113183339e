#pragma once

#include <string>
#include <vector>

#include "compress/stored_forms.h"
#include "io/values/quantized_column.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"
#include "prelight/save_compressed.h"

namespace prelight {

/// Compresses what a bake holds of the parts that are asked for, replaces compressed SH transfer and
/// occluders by what a reader of the file gets, and returns the forms of the rest. Appends messages about
/// sizes and errors. Throws Interrupted; unfinished work is kept.
StoredForms compressBake(const FileCompression& compression, const CompiledScene& scene, Bake& bake,
                         std::vector<std::string>& notes, const Progress& progress = Progress());

/// Replaces the parts of a bake that a file would store in these forms by what a reader of the file gets,
/// except for an animation's moments. `document` is the scene's.
void decodeStored(const GltfDocument& document, const CompiledScene& scene, const StoredForms& forms,
                  Bake& bake);

/// Returns messages about columns that were stored as bytes.
std::vector<std::string> savingsTexts(const SavingsByColumn& saved);

}  // namespace prelight
