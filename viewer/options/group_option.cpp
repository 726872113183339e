#include "viewer/options/group_option.h"

#include <charconv>
#include <cmath>

#include "prelight/error.h"

namespace prelight::viewer {
namespace {

[[noreturn]] void refuseGroup(std::string_view text, const std::string& what) {
  throw UsageError("--group " + std::string(text), what, "for example Lamp=0.5 or Lamp=1,0.8,0.6");
}

float parseFactor(std::string_view text, std::string_view part) {
  double value = 0.0;
  const auto [end, status] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (status != std::errc{} || end != part.data() + part.size() || part.empty())
    refuseGroup(text, std::string("expected a number, got '").append(part).append("'"));
  if (!(value >= 0.0 && value <= 1e9)) refuseGroup(text, "a factor is a number from 0 to 1e9");
  return static_cast<float>(value);
}

}  // namespace

GroupFactor parseGroupFactor(std::string_view text) {
  const auto equals = text.rfind('=');
  if (equals == std::string_view::npos || equals == 0)
    refuseGroup(text, "expected a group's name, = and one factor or three");
  GroupFactor result{std::string(text.substr(0, equals)), {}};
  std::vector<float> factors;
  std::string_view rest = text.substr(equals + 1);
  for (;;) {
    const auto end = rest.find(',');
    factors.push_back(parseFactor(text, rest.substr(0, end)));
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
  if (factors.size() != 1 && factors.size() != 3)
    refuseGroup(text, "expected one factor or three, got " + std::to_string(factors.size()));
  const std::size_t last = factors.size() - 1;
  result.factor = {factors[0], factors[last / 2], factors[last]};
  return result;
}

std::vector<std::string> namesOf(const LightGroupTransfer& transfer) {
  std::vector<std::string> names;
  for (const LightGroup& group : transfer.groups) names.push_back(group.name);
  return names;
}

std::vector<glm::vec3> groupFactors(std::span<const std::string> groups, std::span<const GroupFactor> asked) {
  std::vector<glm::vec3> factors(groups.size(), glm::vec3(1.0f));
  for (const GroupFactor& wanted : asked) {
    bool found = false;
    for (std::size_t g = 0; g < factors.size(); ++g) {
      if (groups[g] != wanted.name) continue;
      factors[g] = wanted.factor;
      found = true;
    }
    if (found) continue;
    std::string names;
    for (const std::string& group : groups) names += (names.empty() ? "" : ", ") + group;
    throw UsageError("--group " + wanted.name, "no light group of this name", "the groups are: " + names);
  }
  return factors;
}

}  // namespace prelight::viewer
