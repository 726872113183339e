#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "base/state_file.h"
#include "prelight/scene.h"

namespace prelight {

/// W/sr in a direction of world space, of a light that has a profile: what its intensity is multiplied by.
double profileTowards(const Light& light, const glm::dvec3& direction);

/// What a profile sends between two turns and two heights, W: of column and row that begin there.
double cellPower(const LightProfile& profile, std::size_t column, std::size_t row);

/// What it sends in all directions, W.
double profilePower(const LightProfile& profile);

/// The axis of a light's profile in world space.
glm::vec3 profilePole(const Light& light);

/// Where its turns begin, by kernels/transport/profile_funcs.cl's reckoning about that axis.
float profileTurn(const Light& light);

/// Adds what a light's profile changes about it.
void addProfile(const Light& light, StateHash& hash);

/// Profiles as kernels/transport/profile_funcs.cl reads them, each once.
class PackedProfiles {
 public:
  /// The entry at which a light's profile begins.
  std::size_t add(const Light& light);
  /// The same of one that has been added; nullopt of another.
  std::optional<std::size_t> entryOf(const Light& light) const;

  const std::vector<glm::vec4>& texels() const { return texels_; }

 private:
  struct Known {
    const LightProfile* profile;
    std::size_t entry;
  };
  std::vector<Known> known_;
  std::vector<glm::vec4> texels_;
};

}  // namespace prelight
