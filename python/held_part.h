#pragma once

#include <memory>
#include <optional>

#include "prelight/bake.h"
#include "python/bake.h"

namespace prelight::python {

/// A part of a bake that keeps the whole bake alive.
template <typename Part>
using Shared = std::shared_ptr<const Part>;

/// The class that Python sees for a part.
template <typename Part>
struct Held {
  Shared<Part> part;
};

template <typename Part>
Held<Part> held(const PythonBake& baked, const Part& part) {
  return {Shared<Part>(baked.bake, &part)};
}

/// Returns None if the bake does not have the part.
template <typename Part>
std::optional<Held<Part>> heldOf(const PythonBake& baked, std::optional<Part> TechniqueParts::*member) {
  const std::optional<Part>& part = (*baked.bake).*member;
  if (!part) return std::nullopt;
  return held(baked, *part);
}

}  // namespace prelight::python
