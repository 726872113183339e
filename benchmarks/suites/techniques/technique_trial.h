#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/scenes/compared_scenes.h"
#include "benchmarks/suites/techniques/compared_techniques.h"
#include "benchmarks/suites/techniques/techniques_suite.h"
#include "benchmarks/truth/picture_error.h"
#include "benchmarks/truth/truth.h"
#include "prelight/picture.h"

namespace prelight::viewer {
class Renderer;
}
namespace prelight::benchmarks {

/// Costs and picture of a technique.
struct TechniqueResult {
  std::string name;
  std::optional<ThesisRow> thesis;
  double firstPass = 0.0;              ///< seconds of its bake: visibility
  double secondPass = 0.0;             ///< seconds of its bake: interreflection and matrices
  std::size_t bytes = 0;               ///< in the baked file
  double frameSeconds = 0.0;           ///< wall time with changing light, s
  double frameProcessorSeconds = 0.0;  ///< processor time of a frame, s
  int claim = 0;                       ///< segments of the paths of light that it claims to show
  MeasuredError error;                 ///< against all light
  MeasuredError ofClaim;               ///< against the light that it claims to show
  std::optional<double> flip;  ///< FLIP of the displayed picture against all light, if it can be measured
  int rank = 0;  ///< 1 is the best; techniques that the truth's noise does not tell apart share a rank
  Picture picture;
  std::vector<glm::vec3> displayed;  ///< [row][column], tone-mapped and sRGB-encoded
};

/// Frames per second over the number of point lights.
struct FrameCurve {
  std::string technique;
  std::vector<Point> points;
};

struct SceneComparison {
  std::string name;
  std::string light;  ///< "20 lights", "a sky"
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  int width = 0;
  int height = 0;
  Truth truth;                           ///< truth of all light
  std::optional<double> truthFlip = {};  ///< FLIP of one half of the truth against the other
  std::vector<Truth> claimed = {};       ///< truths of the light that some techniques claim to show
  std::vector<TechniqueResult> techniques = {};
};

/// Sets ranks by the error against all light. Techniques whose errors the truth's noise does not tell apart
/// share a rank.
void rank(std::vector<TechniqueResult>& techniques);

/// Largest error of a truth with enough samples, as a share of the best technique's.
constexpr double wantedShare = 0.1;

/// Noise of the truth as shares of the best technique's error.
struct TruthShare {
  double picture = 0.0;  ///< the truth's own error
  double left = 0.0;     ///< the part of it that remains in the technique's measured error
};
TruthShare truthShare(const SceneComparison& scene);

/// A scene with a bake and a renderer for each technique that shows something of its own in it. Needs a
/// current OpenGL context. The arguments must outlive it.
class TechniqueTrial {
 public:
  /// Bakes everything with `rays` per vertex. Advances `steps` per technique.
  TechniqueTrial(const ComparedScene& scene, const std::vector<Technique>& techniques, std::uint64_t rays,
                 const Device& device, const TechniquesOptions& options, const Progress& progress,
                 StepCounter& steps);
  ~TechniqueTrial();

  /// Draws and times pictures, and compares them with a truth that is traced until `end`, for at least a
  /// share of `seconds`.
  SceneComparison compare(const Deadline& end, double seconds);

  /// Returns frames per second, with changing light, by the number of point lights around the scene.
  std::vector<FrameCurve> framesByLights(const std::vector<std::size_t>& counts);

 private:
  struct Entry;

  void add(const Technique& technique);
  void lightFully(Entry& entry);
  void makeVirtualLights(Entry& entry);
  TechniqueResult draw(Entry& entry) const;
  void compareWithTruths(SceneComparison& result, double seconds) const;
  static void measureFlips(SceneComparison& result);
  void measureFrames(std::vector<TechniqueResult>& results);

  const ComparedScene& scene_;
  const Device& device_;
  std::uint64_t rays_;
  const TechniquesOptions& options_;
  const Progress& progress_;
  std::vector<std::unique_ptr<Entry>> entries_;
};

/// Makes a small bake per technique, so that its kernels are compiled before it is measured.
void warmUp(const std::vector<Technique>& techniques, const Device& device, const Progress& progress);

/// Results of a comparison of techniques.
struct TechniqueReport {
  std::string where;  ///< device and version
  std::vector<SceneComparison> scenes;
  std::vector<FrameCurve> framesByLights;
  std::string curveScene;
  std::vector<std::string> notes;  ///< remarks that readers of the numbers need
};

/// Writes into an existing folder: techniques.md (everything), techniques.csv (a row per scene and
/// technique), techniques-lights.csv, the pictures of each scene, and techniques.json, from which contact
/// sheets techniques-SCENE.png are drawn. Throws Error if a file cannot be written.
void writeTechniqueReport(const std::filesystem::path& folder, const TechniqueReport& report);

}  // namespace prelight::benchmarks
