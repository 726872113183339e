#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/technique_trial.h"

namespace prelight::benchmarks {

/// All that was compared.
struct TechniqueReport {
  std::string where;  ///< device and version
  std::vector<SceneComparison> scenes;
  std::vector<Curve> framesByLights;
  std::string curveScene;
  std::vector<std::string> notes;  ///< what is missing, and why
};

/// Writes techniques.md (everything, with the pictures), techniques.csv (a row a scene and technique),
/// techniques-lights.csv, techniques-lights.png (frames a second by lights) and a contact sheet of each
/// scene, techniques-SCENE.png, into a folder that exists. Throws Error when one cannot be written.
void writeTechniqueReport(const std::filesystem::path& folder, const TechniqueReport& report);

}  // namespace prelight::benchmarks
