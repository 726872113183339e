#pragma once

#include <filesystem>
#include <string>

#include "encodings/encoding.h"
#include "prelight/bake.h"
#include "prelight/techniques.h"
#include "viewer/core/shading.h"

namespace prelight::pictures {

/// Returns the encoding of a name; nullptr for an empty one. Throws UsageError at `where` for an unknown
/// name.
const Encoding* encodingNamed(const char* where, const std::string& name);

/// Throws UsageError for a shading that draws no encodings, and InputError if the file holds what the shading
/// needs but not in this encoding. `encoding` may be nullptr for none.
void checkEncoding(const std::filesystem::path& file, const Bake& bake, viewer::Shading shading,
                   const Encoding* encoding);

/// Asks for light in an encoding, in place of the light that the shading would have otherwise: by a light map
/// as `asked` has it.
void askForEncoding(const Encoding& encoding, const BakeRequest& asked, BakeRequest& request);

}  // namespace prelight::pictures
