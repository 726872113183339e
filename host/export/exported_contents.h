#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "export/export_request.h"
#include "prelight/bake.h"

namespace prelight {

/// An export that holds a part of a bake.
struct ExportCarrier {
  std::string form;    ///< one of exportFormNames
  std::string target;  ///< one of exportTargetNames; empty: all that have the form
};

/// A part of a bake, as an export reports it.
struct ContentsPart {
  std::string what;                     ///< for people
  std::vector<ExportCarrier> carriers;  ///< exports that hold it; empty if none but pages may
};

/// Parts of a bake that an export holds and leaves out.
struct ExportedContents {
  std::vector<ContentsPart> taken;
  std::vector<ContentsPart> leftOut;
};

/// Returns the parts of a bake of `vertices` vertices by whether an export holds them.
ExportedContents exportedContents(const Bake& bake, std::size_t vertices, const ExportRequest& request);

/// Returns the parts of a bake that prelight.js relights, without others.
Bake relitParts(const Bake& bake);

/// Returns whether a bake holds transfer that prelight.js relights.
bool isRelit(const Bake& bake);

/// Returns {taken: [what], leftOut: [{what, carriedBy: [{as, target}]}]}.
nlohmann::ordered_json toJson(const ExportedContents& contents);

}  // namespace prelight
