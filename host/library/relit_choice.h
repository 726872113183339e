#pragma once

#include <string>

#include "prelight/bake.h"
#include "relight/device/relighting.h"

namespace prelight {

/// Transfer that a relighter multiplies, and why.
struct RelitChoice {
  std::string technique;  ///< its name in `techniques()`
  const Relighting* relighting = nullptr;
  std::string reason;  ///< technique, its form on the device, why it is this one, what else the bake holds
};

/// Returns the transfer of a technique, or, for an empty name, the preferred one that the bake holds. Throws
/// UsageError for a name that no technique with relighting has, and InputError when the bake lacks it.
RelitChoice chooseTransfer(const Bake& bake, const std::string& wanted);

/// Returns the parts that add their light to vertices at rest.
std::vector<std::unique_ptr<RelitPart>> makeAddedParts(const RelitSource& source);

}  // namespace prelight
