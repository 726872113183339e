// Photometric profiles of LM-63.
#include <algorithm>
#include <cmath>

#include "fuzz/target.h"
#include "scene/codecs/ies_profile.h"

namespace prelight::fuzz {

namespace {

void readIes(Bytes input) {
  const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
  const LightProfile profile = parseIesProfile(text, "lamp.ies");
  require(profile.heights.size() >= 2 && profile.turns.size() >= 2, "profiles have two angles at least");
  require(profile.values.size() == profile.heights.size() * profile.turns.size(),
          "profiles have an intensity for each pair of angles");
  require(std::ranges::is_sorted(profile.heights) && std::ranges::is_sorted(profile.turns), "angles ascend");
  for (const double value : profile.values)
    require(std::isfinite(value) && value >= 0.0, "intensities are finite and not negative");
  for (const std::vector<double>* angles : {&profile.heights, &profile.turns})
    for (const double angle : *angles) require(std::isfinite(angle), "angles are finite");
}

}  // namespace

Target ies() { return {"ies", readIes}; }

}  // namespace prelight::fuzz
