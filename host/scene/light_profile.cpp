#include "scene/light_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight {

namespace {

constexpr double circle = 2.0 * std::numbers::pi;

/// Returns the rotation from the lamp's frame to the world.
glm::dmat3 frameOf(const Light& light) {
  return {light.side, glm::cross(-light.direction, light.side), -light.direction};
}

/// Returns the last interval that begins at or before an angle, which lies within the angles.
std::size_t intervalOf(const std::vector<double>& angles, double angle) {
  const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
  return static_cast<std::size_t>(above - angles.begin()) - 1;
}

/// Returns the direction across a pole at which turns are 0, as in kernels/transport/profile_funcs.cl.
glm::vec3 acrossPole(const glm::vec3& pole) {
  const glm::vec3 other = std::abs(pole.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  return glm::normalize(other - glm::dot(other, pole) * pole);
}

}  // namespace

double profileTowards(const Light& light, const glm::dvec3& direction) {
  const LightProfile& p = *light.profile;
  const glm::dvec3 d = glm::transpose(frameOf(light)) * direction;
  const glm::dvec3 across = glm::cross(p.start, p.pole);
  const double x = glm::dot(d, p.start), y = glm::dot(d, across);
  const double height = std::atan2(std::hypot(x, y), glm::dot(d, p.pole));
  const double first = p.turns.front(), around = std::atan2(y, x) - first;
  const double turn = first + around - circle * std::floor(around / circle);
  if (height < p.heights.front() || height > p.heights.back() || turn > p.turns.back()) return 0.0;
  const std::size_t row = intervalOf(p.heights, height), column = intervalOf(p.turns, turn);
  const double v = (height - p.heights[row]) / (p.heights[row + 1] - p.heights[row]);
  const double u = (turn - p.turns[column]) / (p.turns[column + 1] - p.turns[column]);
  const double* near = p.values.data() + column * p.heights.size() + row;
  const double* next = near + p.heights.size();
  return (1.0 - u) * ((1.0 - v) * near[0] + v * near[1]) + u * ((1.0 - v) * next[0] + v * next[1]);
}

double cellPower(const LightProfile& p, std::size_t column, std::size_t row) {
  const double a = p.heights[row], b = p.heights[row + 1], size = b - a;
  const double* near = p.values.data() + column * p.heights.size() + row;
  const double* next = near + p.heights.size();
  const double upper = 0.5 * (near[0] + next[0]), lower = 0.5 * (near[1] + next[1]);
  const double solid = std::cos(a) - std::cos(b);  // integral of the sine
  // Integral of the sine times the height above a.
  const double rising = std::sin(b) - std::sin(a) - size * std::cos(b);
  const double power =
      (p.turns[column + 1] - p.turns[column]) * (upper * solid + (lower - upper) * rising / size);
  return std::max(power, 0.0);  // in narrow cells the rounding error may exceed the power
}

double profilePower(const LightProfile& profile) {
  double sum = 0.0;
  for (std::size_t column = 0; column + 1 < profile.turns.size(); ++column)
    for (std::size_t row = 0; row + 1 < profile.heights.size(); ++row) sum += cellPower(profile, column, row);
  return sum;
}

glm::vec3 profilePole(const Light& light) { return frameOf(light) * light.profile->pole; }

float profileTurn(const Light& light) {
  const glm::vec3 pole = profilePole(light), x = acrossPole(pole),
                  start(frameOf(light) * light.profile->start);
  return std::atan2(glm::dot(start, glm::cross(x, pole)), glm::dot(start, x));
}

void addProfile(const Light& light, StateHash& hash) {
  const LightProfile& p = *light.profile;
  hash.values(p.heights).values(p.turns).values(p.values);
  for (int c = 0; c < 3; ++c) hash.value(p.pole[c]).value(p.start[c]).value(light.side[c]);
}

std::size_t PackedProfiles::add(const Light& light) {
  const LightProfile& p = *light.profile;
  const auto known =
      std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.profile == &p; });
  if (known != known_.end()) return known->entry;
  const std::size_t entry = texels_.size(), columns = p.turns.size() - 1, rows = p.heights.size() - 1;
  known_.push_back({&p, entry});
  texels_.emplace_back(columns, rows, 0.0f, 0.0f);
  for (const double height : p.heights) texels_.emplace_back(height, 0.0f, 0.0f, 0.0f);
  for (const double turn : p.turns) texels_.emplace_back(turn, 0.0f, 0.0f, 0.0f);
  for (std::size_t column = 0; column < columns; ++column)
    for (std::size_t row = 0; row < rows; ++row) {
      const double* near = p.values.data() + column * p.heights.size() + row;
      const double* next = near + p.heights.size();
      texels_.emplace_back(near[0], near[1], next[0], next[1]);
    }
  return entry;
}

std::optional<std::size_t> PackedProfiles::entryOf(const Light& light) const {
  const auto known = std::find_if(known_.begin(), known_.end(),
                                  [&](const Known& k) { return k.profile == light.profile.get(); });
  if (known == known_.end()) return std::nullopt;
  return known->entry;
}

namespace {

glm::vec3 usable(const glm::vec3& texel) {
  glm::vec3 result(0.0f);
  for (int c = 0; c < 3; ++c)
    if (std::isfinite(texel[c])) result[c] = std::max(texel[c], 0.0f);
  return result;
}

glm::dvec3 texelAt(const Picture& cookie, int column, int row) {
  const int x = std::clamp(column, 0, cookie.width - 1), y = std::clamp(row, 0, cookie.height - 1);
  return glm::dvec3(cookie.pixels[static_cast<std::size_t>(y) * cookie.width + x]);
}

}  // namespace

Picture cookieOf(const Picture& picture) {
  const int step = (std::max(picture.width, picture.height) + mostCookieSide - 1) / mostCookieSide;
  Picture cookie{(picture.width + step - 1) / step, (picture.height + step - 1) / step, {}};
  for (int row = 0; row < cookie.height; ++row)
    for (int column = 0; column < cookie.width; ++column) {
      glm::vec3 sum(0.0f);
      int count = 0;
      for (int y = row * step; y < std::min((row + 1) * step, picture.height); ++y)
        for (int x = column * step; x < std::min((column + 1) * step, picture.width); ++x, ++count)
          sum += usable(picture.pixels[static_cast<std::size_t>(y) * picture.width + x]);
      cookie.pixels.push_back(sum / static_cast<float>(count));
    }
  return cookie;
}

glm::dvec3 cookieTowards(const Light& light, const glm::dvec3& direction) {
  const Picture& cookie = *light.cookie;
  const double along = glm::dot(direction, light.direction);
  if (!(along > 0.0)) return glm::dvec3(0.0);
  const double widest = along * std::tan(double(light.outerConeAngle));
  const glm::dvec3 up = glm::cross(light.direction, light.side);
  const double u = 0.5 * (1.0 - glm::dot(direction, light.side) / widest) * cookie.width - 0.5;
  const double v = 0.5 * (1.0 - glm::dot(direction, up) / widest) * cookie.height - 0.5;
  const double column = std::floor(std::clamp(u, -1.0, double(cookie.width)));
  const double row = std::floor(std::clamp(v, -1.0, double(cookie.height)));
  const int x = static_cast<int>(column), y = static_cast<int>(row);
  const double right = std::clamp(u - column, 0.0, 1.0), below = std::clamp(v - row, 0.0, 1.0);
  return glm::mix(glm::mix(texelAt(cookie, x, y), texelAt(cookie, x + 1, y), right),
                  glm::mix(texelAt(cookie, x, y + 1), texelAt(cookie, x + 1, y + 1), right), below);
}

glm::dvec3 cookieMean(const Picture& cookie) {
  glm::dvec3 sum(0.0);
  for (const glm::vec3& texel : cookie.pixels) sum += glm::dvec3(texel);
  return sum / static_cast<double>(cookie.pixels.size());
}

}  // namespace prelight
