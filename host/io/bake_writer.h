#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "techniques/technique.h"

namespace prelight {

/// Returns the entry of PRELIGHT_transfer for one primitive: the baked data at its vertices, as accessors
/// that are appended to the document. docs/file-format.md describes every member.
nlohmann::ordered_json entryToJson(const BakedOutput& output, const PrimitiveRanges& ranges);

/// Returns the approximate bytes that entryToJson() appends in total, without compressed and animated data
/// and light maps.
std::size_t storedBytes(const Bake& bake);

/// Adds the techniques' members of the root's extension: names of light groups, times of keys, tables of
/// compression, volumes.
void addRootMembers(const BakedOutput& output, nlohmann::ordered_json& root);

}  // namespace prelight
