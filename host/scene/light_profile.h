#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "base/state_file.h"
#include "prelight/scene.h"

namespace prelight {

/// Returns the intensity, W/sr, in a direction of world space of a light with a profile, before
/// multiplication by the light's own intensity.
double profileTowards(const Light& light, const glm::dvec3& direction);

/// Returns the power, W, that a profile sends between the two turns and two heights of a cell.
double cellPower(const LightProfile& profile, std::size_t column, std::size_t row);

/// Returns the power, W, that a profile sends in all directions.
double profilePower(const LightProfile& profile);

/// Returns the axis of a light's profile in world space.
glm::vec3 profilePole(const Light& light);

/// Returns the azimuth at which the profile's turns begin, relative to that of
/// kernels/transport/profile_funcs.cl.
float profileTurn(const Light& light);

/// Adds a light's profile to a hash.
void addProfile(const Light& light, StateHash& hash);

/// Profiles packed for kernels/transport/profile_funcs.cl, each stored once.
class PackedProfiles {
 public:
  /// Adds a light's profile, unless it is stored already, and returns its first entry.
  std::size_t add(const Light& light);
  /// Returns the first entry of a profile that has been added; nullopt for another one.
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

/// Greatest number of texels per side of a cookie.
constexpr int mostCookieSide = 256;

/// Returns a picture prepared as a cookie: at most mostCookieSide texels per side, averaged where it is
/// larger; negative values and NaN become 0.
Picture cookieOf(const Picture& picture);

/// Returns the share that a spot light's cookie lets through in a direction in which light leaves it:
/// bilinear between the texels of the square around the outer cone; outside the square the value at its edge.
glm::dvec3 cookieTowards(const Light& light, const glm::dvec3& direction);

/// Returns the mean of a cookie's texels.
glm::dvec3 cookieMean(const Picture& cookie);

}  // namespace prelight
