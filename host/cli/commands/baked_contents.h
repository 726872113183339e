#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/baked_strip.h"
#include "prelight/bake.h"

namespace prelight::cli {

/// A technique that a bake holds.
struct BakedTechnique {
  std::string key;              ///< its name in JSON, which is that of the file's extension
  std::string text;             ///< shape and size as text for people
  nlohmann::ordered_json json;  ///< shape and size for programs; the "bytes" of arrays are those in the file
};

/// Returns every technique in a bake of `vertices` vertices, in the order of the options of `prelight bake`.
/// `quantized` are sizes of those that its file stores as bytes.
std::vector<BakedTechnique> bakedTechniques(const Bake& bake, std::size_t vertices,
                                            const QuantizedBytes& quantized);

/// Returns all techniques and how they were made. `ao` and `bentNormal` are always there, false if they are
/// missing.
nlohmann::ordered_json bakedJson(const Bake& bake, std::size_t vertices, const QuantizedBytes& quantized);

/// Returns a text such as "553 k rays, seed 0, AO error 0.021, by Prelight 0.1.0".
std::string bakedOriginText(const BakeInfo& info);

}  // namespace prelight::cli
