#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "prelight/bake.h"

namespace prelight::cli {

/// A technique that a bake holds.
struct BakedTechnique {
  std::string key;              ///< in JSON; as the file's extension calls it
  std::string text;             ///< for people: shape and size
  nlohmann::ordered_json json;  ///< the same for programs; arrays' "bytes" as they are in the file
};

/// Every technique of a bake of `vertices` vertices, in the order of the options of `prelight bake`.
std::vector<BakedTechnique> bakedTechniques(const Bake& bake, std::size_t vertices);

/// All of them and how they were made. `ao` and `bentNormal` are there always, false where they are missing.
nlohmann::ordered_json bakedJson(const Bake& bake, std::size_t vertices);

/// "553 k rays, seed 0, AO error 0.021, by Prelight 0.1.0".
std::string bakedOriginText(const BakeInfo& info);

}  // namespace prelight::cli
