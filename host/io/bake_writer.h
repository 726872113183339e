#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "projectors/technique.h"

namespace prelight {

/// The entry of PRELIGHT_transfer for one primitive: what was baked at its vertices, as accessors that are
/// appended to the document. docs/file-format.md has every member.
nlohmann::ordered_json entryToJson(const BakedOutput& output, const PrimitiveRanges& ranges);

/// About what entryToJson() appends in all, without what is compressed, animated or in light maps.
std::size_t storedBytes(const Bake& bake);

/// The members of the root's extension that techniques have: names of light groups, times of keys,
/// compression's tables, volumes.
void addRootMembers(const BakedOutput& output, nlohmann::ordered_json& root);

}  // namespace prelight
