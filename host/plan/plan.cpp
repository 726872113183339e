#include "prelight/plan.h"

#include <algorithm>

namespace prelight {

std::optional<Pass> passNamed(std::string_view name) {
  const auto found = std::find(passNames.begin(), passNames.end(), name);
  if (found == passNames.end()) return std::nullopt;
  return static_cast<Pass>(found - passNames.begin());
}

bool Plan::runs(Pass pass) const {
  return std::any_of(passes.begin(), passes.end(),
                     [&](const PlannedPass& p) { return p.pass == pass && p.runs; });
}

}  // namespace prelight
