#pragma once

#include <cstdint>

#include "scene/gltf/gltf_document.h"

namespace prelight::benchmarks {

/// Bumpy balls in rows on a floor, of about `triangles` triangles (from 2 k on): a tenth of them in the
/// floor, every ball a mesh of its own. The same scene anywhere for the same number. No back can be seen, and
/// no material has a texture.
GltfDocument makeBumpyBalls(std::uint64_t triangles);

}  // namespace prelight::benchmarks
