#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/charts.h"
#include "benchmarks/compared_scenes.h"
#include "benchmarks/suite.h"
#include "benchmarks/techniques.h"
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
  double rmse = 0.0;                   ///< of radiance up to 1 W/(m2 sr), against the truth
  double flip = 0.0;                   ///< of what is displayed
  std::vector<glm::vec3> displayed;    ///< [row][column], tone-mapped and sRGB-encoded
};

/// A path-traced picture: the mean of two of independent samples, which tell how good it is.
struct Truth {
  std::uint64_t samples = 0;  ///< a pixel
  double seconds = 0.0;
  double rmse = 0.0;  ///< standard error of the picture, in the measure of TechniqueResult
  double flip = 0.0;  ///< of one half against the other
  Picture picture;
  std::vector<glm::vec3> displayed;
};

struct SceneComparison {
  std::string name;
  std::string light;  ///< "20 lights", "a sky"
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  int width = 0;
  int height = 0;
  Truth truth;
  std::vector<TechniqueResult> techniques;
};

/// A scene with a bake and a renderer for each technique that shows something of its own in it. Needs a
/// current OpenGL context; the arguments outlive it.
class TechniqueTrial {
 public:
  /// Bakes everything with `rays` a vertex; tells `steps` of each technique.
  TechniqueTrial(const ComparedScene& scene, const std::vector<Technique>& techniques, std::uint64_t rays,
                 const Device& device, const BenchmarkOptions& options, const Progress& progress,
                 StepCounter& steps);
  ~TechniqueTrial();

  /// Draws, times and compares with a truth that it traces.
  SceneComparison compare();

  /// Frames a second, light changing, over the number of point lights around the scene: of the quickest of
  /// some.
  std::vector<Curve> framesByLights(const std::vector<std::size_t>& counts);

 private:
  struct Entry;

  void add(const Technique& technique);
  void measureFrames(std::vector<TechniqueResult>& results);
  Truth trace();
  Picture traceHalf(std::uint64_t seed, Truth& truth);

  const ComparedScene& scene_;
  const Device& device_;
  std::uint64_t rays_;
  const BenchmarkOptions& options_;
  const Progress& progress_;
  std::vector<std::unique_ptr<Entry>> entries_;
};

/// Bakes a little of each technique, so that its kernels are compiled when it is measured.
void warmUp(const std::vector<Technique>& techniques, const Device& device, const Progress& progress);

/// Root of the mean square over pixels and channels of radiance, all above 1 taken for 1, which is about a
/// display's white. Pictures are of one size.
double pictureRmse(const Picture& first, const Picture& second);

}  // namespace prelight::benchmarks
