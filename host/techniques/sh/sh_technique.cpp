#include "techniques/sh/sh_technique.h"

#include "techniques/sh/harmonic_technique.h"

namespace prelight {

namespace {

struct ShKind {
  static constexpr auto transfer = &Bake::sh;
  static constexpr const char* key = "sh";
  static constexpr const char* title = "SH";
};

}  // namespace

Technique shTechnique() { return Harmonic<ShKind>::technique(); }

}  // namespace prelight
