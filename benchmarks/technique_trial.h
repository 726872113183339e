#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/charts.h"
#include "benchmarks/compared_scenes.h"
#include "benchmarks/picture_error.h"
#include "benchmarks/suite.h"
#include "benchmarks/techniques.h"
#include "benchmarks/time_shares.h"
#include "benchmarks/truth.h"
#include "prelight/picture.h"

namespace prelight::viewer {
class Renderer;
}

namespace prelight::benchmarks {

/// What a technique takes and shows.
struct TechniqueResult {
  std::string name;
  std::optional<ThesisRow> thesis;
  double firstPass = 0.0;              ///< s of its bake: visibility
  double secondPass = 0.0;             ///< s: interreflection and matrices
  std::size_t bytes = 0;               ///< in the baked file
  double frameSeconds = 0.0;           ///< by the clock, light changing
  double frameProcessorSeconds = 0.0;  ///< of all cores
  int claim = 0;                       ///< segments of the paths of light that it claims to show
  MeasuredError error;                 ///< against all light
  MeasuredError ofClaim;               ///< against the light that it claims to show
  double flip = 0.0;                   ///< of what is displayed, against all light
  int rank = 0;                        ///< 1 is the best; none is told from the truth's noise of a better one
  Picture picture;
  std::vector<glm::vec3> displayed;  ///< [row][column], tone-mapped and sRGB-encoded
};

struct SceneComparison {
  std::string name;
  std::string light;  ///< "20 lights", "a sky"
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  int width = 0;
  int height = 0;
  Truth truth;                      ///< of all light
  std::vector<Truth> claimed = {};  ///< of less, that some claim to show
  std::vector<TechniqueResult> techniques = {};
};

/// Ranks by the error against all light. Those whose errors the truth's noise does not tell apart share a
/// rank.
void rank(std::vector<TechniqueResult>& techniques);

/// The truth's error is at most this share of the best technique's, where it has samples enough.
constexpr double wantedShare = 0.1;

/// What the truth's noise is beside the error of the best technique.
struct TruthShare {
  double picture = 0.0;  ///< the truth's own error
  double left = 0.0;     ///< what of it is left in the technique's measured error
};
TruthShare truthShare(const SceneComparison& scene);

/// A scene with a bake and a renderer for each technique that shows something of its own in it. Needs a
/// current OpenGL context; the arguments outlive it.
class TechniqueTrial {
 public:
  /// Bakes everything with `rays` a vertex; tells `steps` of each technique.
  TechniqueTrial(const ComparedScene& scene, const std::vector<Technique>& techniques, std::uint64_t rays,
                 const Device& device, const BenchmarkOptions& options, const Progress& progress,
                 StepCounter& steps);
  ~TechniqueTrial();

  /// Draws, times and compares with a truth that it traces until `end`, but for a share of `seconds`.
  SceneComparison compare(const Deadline& end, double seconds);

  /// Frames a second, light changing, over the number of point lights around the scene: of the quickest of
  /// some.
  std::vector<Curve> framesByLights(const std::vector<std::size_t>& counts);

 private:
  struct Entry;

  void add(const Technique& technique);
  void lightFully(Entry& entry);
  void makeVirtualLights(Entry& entry);
  TechniqueResult draw(Entry& entry) const;
  void compareWithTruths(SceneComparison& result, double seconds) const;
  void measureFrames(std::vector<TechniqueResult>& results);

  const ComparedScene& scene_;
  const Device& device_;
  std::uint64_t rays_;
  const BenchmarkOptions& options_;
  const Progress& progress_;
  std::vector<std::unique_ptr<Entry>> entries_;
};

/// Bakes a little of each technique, so that its kernels are compiled when it is measured.
void warmUp(const std::vector<Technique>& techniques, const Device& device, const Progress& progress);

}  // namespace prelight::benchmarks
