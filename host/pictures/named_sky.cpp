#include "pictures/named_sky.h"

#include <algorithm>
#include <cstring>
#include <numbers>
#include <optional>
#include <system_error>
#include <vector>

#include "base/text.h"
#include "images/preetham_sky.h"
#include "io/baked_sky.h"
#include "prelight/error.h"

namespace prelight::pictures {
namespace {

namespace fs = std::filesystem;

/// Reads "preetham:TURBIDITY:ELEVATION[:AZIMUTH][:sun]", angles in degrees.
DaySky parseDaySky(const std::string& name) {
  const bool sun = name.ends_with(sunName);
  std::string fields = name.substr(std::strlen(dayName));
  if (sun) fields.resize(fields.size() - std::min(fields.size(), std::strlen(sunName)));
  std::replace(fields.begin(), fields.end(), ':', ',');
  const std::optional<std::vector<double>> numbers = numbersIn(fields, 360.0);
  const bool counted = numbers && (numbers->size() == 2 || numbers->size() == 3);
  const auto within = [&](std::size_t i, double least, double most) {
    return (*numbers)[i] >= least && (*numbers)[i] <= most;
  };
  if (!counted || !within(0, 2.0, 10.0) || !within(1, 0.0, 90.0))
    throw UsageError("DrawRequest::skyName " + name, "not a sky of this kind",
                     "expected preetham:TURBIDITY:ELEVATION[:AZIMUTH][:sun], with a turbidity from 2 to 10, "
                     "the sun's elevation from 0 to 90 degrees, its azimuth from -Z towards +X, and :sun for "
                     "its disk, as in preetham:3:35:120");
  constexpr double degree = std::numbers::pi / 180.0;
  DaySky day;
  day.turbidity = (*numbers)[0];
  day.elevation = degree * (*numbers)[1];
  day.azimuth = numbers->size() == 3 ? degree * (*numbers)[2] : 0.0;
  day.sun = sun;
  return day;
}

}  // namespace

bool isBuiltinSky(const std::string& name) {
  return name == studioName || name == neutralName || name.starts_with(dayName);
}

Environment readNamedSky(const std::filesystem::path& nameOrFile) {
  if (nameOrFile == studioName) return studioEnvironment();
  if (nameOrFile == neutralName) return constantEnvironment(glm::vec3(1.0f));
  if (nameOrFile.string().starts_with(dayName)) return daySky(parseDaySky(nameOrFile.string()));
  return readEnvironment(nameOrFile);
}

BakedSky recordOf(const fs::path& asked, const Environment& sky, double rotation, const fs::path& output) {
  BakedSky record{asked.string(), rotation, skyHash(sky)};
  if (isBuiltinSky(record.name)) return record;
  std::error_code unknown;
  const fs::path folder = fs::absolute(output, unknown).parent_path();
  const fs::path seen =
      fs::absolute(asked, unknown).lexically_normal().lexically_relative(folder.lexically_normal());
  record.name = (seen.empty() ? asked.filename() : seen).generic_string();
  return record;
}

}  // namespace prelight::pictures
