#include "techniques/ch/ch_technique.h"

#include "techniques/sh/harmonic_technique.h"

namespace prelight {

namespace {

struct ChKind {
  static constexpr auto transfer = &Bake::ch;
  static constexpr const char* key = "ch";
  static constexpr const char* title = "CH";
};

}  // namespace

Technique chTechnique() { return Harmonic<ChKind>::technique(); }

}  // namespace prelight
