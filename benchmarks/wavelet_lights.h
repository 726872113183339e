#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "basis/cube_map.h"

namespace prelight::benchmarks {

struct NamedLight {
  std::string name;
  CubeMap map;
};

/// A sky that brightens towards the zenith ("smooth"), the same with a sun of 3 degrees ("sun"), four bright
/// windows in a dark room ("windows"), and the given pictures of skies, named after their files.
std::vector<NamedLight> waveletLights(int faceSize, const std::vector<std::filesystem::path>& skies);

}  // namespace prelight::benchmarks
