#include "pictures/session/lost_techniques.h"

#include <algorithm>

#include "techniques/registry/registry.h"

namespace prelight::pictures {

std::vector<std::string> techniqueKeys(const Bake& bake, std::size_t vertices) {
  std::vector<std::string> keys;
  for (const BakedSummary& summary : summariesOf(bake, vertices)) keys.push_back(summary.key);
  return keys;
}

std::string lostTechniques(const std::vector<std::string>& had, const Bake& kept, std::size_t vertices) {
  const std::vector<std::string> there = techniqueKeys(kept, vertices);
  std::string lost;
  for (const std::string& key : had)
    if (std::ranges::find(there, key) == there.end()) lost += (lost.empty() ? "" : ", ") + key;
  return lost;
}

}  // namespace prelight::pictures
