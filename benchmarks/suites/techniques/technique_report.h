#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/suites/techniques/technique_trial.h"

namespace prelight::benchmarks {

/// All that was compared.
struct TechniqueReport {
  std::string where;  ///< device and version
  std::vector<SceneComparison> scenes;
  std::vector<FrameCurve> framesByLights;
  std::string curveScene;
  std::vector<std::string> notes;  ///< what readers must know of the numbers
};

/// Writes techniques.md (everything), techniques.csv (a row for each scene and technique),
/// techniques-lights.csv, the pictures of each scene and techniques.json, from which contact sheets of them,
/// techniques-SCENE.png, are drawn, into a folder that exists. Throws Error when one cannot be written.
void writeTechniqueReport(const std::filesystem::path& folder, const TechniqueReport& report);

}  // namespace prelight::benchmarks
