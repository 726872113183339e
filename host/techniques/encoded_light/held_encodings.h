#pragma once

#include <string_view>
#include <vector>

#include "prelight/bake.h"
#include "techniques/drawing_rules.h"

namespace prelight {

/// Light in encodings that a bake holds for a rule of drawing; nullptr: it holds none.
const std::vector<EncodedLight>* encodedFor(Ambient rule, const Bake& bake);

/// Light in an encoding for a rule of drawing; nullptr: the bake holds none.
const EncodedLight* encodedFor(Ambient rule, const Bake& bake, std::string_view encoding);

}  // namespace prelight
