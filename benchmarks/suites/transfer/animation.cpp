#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "bake/key_choice.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/scenes/bending_column.h"
#include "benchmarks/suites/transfer/transfer_suite.h"
#include "compress/compression_error.h"
#include "scene/deform.h"
#include "scene/pose.h"
#include "techniques/sh/animated_transfer.h"
#include "techniques/sh/bent_transfer.h"

namespace prelight::benchmarks {

namespace {

/// Returns the Cornell box with its tall box turning once and its short one sliding to the front within 4 s.
BenchmarkScene movingCornell() {
  BenchmarkScene cornell = loadBuiltinScene("cornell");
  cornell.name = "cornell, boxes moving";
  Animation animation{"boxes", {}, {}};
  AnimationSampler turn{Interpolation::Linear, {0, 1, 2, 3, 4}, {}};
  for (int quarter = 0; quarter <= 4; ++quarter) {
    const double half = 0.15 + quarter * 0.78539816339744831;
    turn.values.emplace_back(0.0, std::sin(half), 0.0, std::cos(half));
  }
  AnimationSampler slide{Interpolation::Linear, {0, 4}, {}};
  for (const MeshNode& node : cornell.scene.meshNodes) {
    if (node.name == "Tall box") animation.channels.push_back({node.sceneNode, AnimatedPath::Rotation, 0});
    if (node.name != "Short box") continue;
    animation.channels.push_back({node.sceneNode, AnimatedPath::Translation, 1});
    const glm::vec4 place(glm::vec3(cornell.scene.nodes[node.sceneNode].translation), 0.0f);
    slide.values = {place, place + glm::vec4(0.2f, 0.0f, 0.3f, 0.0f)};
  }
  animation.samplers = {turn, slide};
  cornell.scene.animations = {animation};
  return cornell;
}

/// Bakes of the poses of one scene, each made once.
class PoseBakes {
 public:
  PoseBakes(const BenchmarkScene& rest, const Device& device, const TransferOptions& options,
            const Progress& progress)
      : posed_(rest), device_(device), progress_(progress) {
    request_.sh.order = options.compressOrder;
    request_.bounces = options.compressBounces;
    request_.effort.rays = options.bakeRays;
  }

  const HarmonicTransfer& at(double seconds, std::uint64_t seed = 0) {
    const auto known = bakes_.find({seconds, seed});
    if (known != bakes_.end()) return known->second;
    pose(seconds);
    BakeRequest request = request_;
    request.seed = seed;
    return bakes_[{seconds, seed}] = timedBake(posed_, request, device_, progress_).bake.sh.value();
  }

  /// Returns the relative RMS difference over the surface at a moment.
  double difference(const HarmonicTransfer& baked, const HarmonicTransfer& other, double seconds) {
    pose(seconds);
    return compressionError(baked, other, surfaceOfVertices(posed_.compiled)).vectorRms;
  }

  HarmonicTransfer between(double first, double last, double seconds, KeyMix mix) {
    const AnimatedTransfer keys{0, {first, last}, {at(first), at(last)}};
    return transferAt(keys, posed_.scene, posed_.compiled, seconds, mix);
  }

  /// Returns the transfer of one moment for another without keys (bentTransfer).
  HarmonicTransfer followed(double first, double seconds) {
    const HarmonicTransfer& baked = at(first);
    pose(first);
    const CompiledScene before = posed_.compiled;
    pose(seconds);
    return bentTransfer(baked, bendBetween(before, posed_.compiled));
  }

 private:
  void pose(double seconds) {
    Warnings said;
    setPose(posed_.scene, 0, seconds);
    posed_.compiled = compileScene(posed_.scene, said);
  }

  BenchmarkScene posed_;
  const Device& device_;
  const Progress& progress_;
  BakeRequest request_;
  std::map<std::pair<double, std::uint64_t>, HarmonicTransfer> bakes_;
};

class Measurement {
 public:
  Measurement(const BenchmarkScene& scene, PoseBakes& bakes, const TransferOptions& options,
              std::vector<BenchmarkResult>& results)
      : name_(scene.name), bakes_(bakes), results_(results) {
    start_ = scene.scene.animations[0].startTime();
    end_ = scene.scene.animations[0].endTime();
    // These moments avoid the binary fractions at which keys lie.
    for (int i = 0; i < options.animationMoments; ++i)
      moments_.push_back(start_ + (end_ - start_) * (i + 0.37) / options.animationMoments);
  }

  void evenKeys(int count) {
    const std::vector<double> times = evenTimes(start_, end_, count);
    for (const KeyMix mix : {KeyMix::Linear, KeyMix::Turned})
      add(fmt::format("{} keys/{}", count, mix == KeyMix::Linear ? "linear" : "turned"), times, mix);
  }

  void keysByError(double error) {
    const KeyOperations<double> operations{
        [&](double seconds) {
          bakes_.at(seconds);
          return seconds;
        },
        [&](double, double first, double, double last, double seconds, double) {
          return bakes_.difference(bakes_.at(seconds), bakes_.between(first, last, seconds, KeyMix::Turned),
                                   seconds);
        }};
    KeyRequest request;
    request.error = error;
    request.mostKeys = 65;
    const ChosenKeys<double> chosen = chooseKeys(start_, end_, request, operations);
    const std::string name = fmt::format("error {:g}/turned", error);
    results_.push_back({name_ + "/" + name, "keys", double(chosen.times.size()), "1", {}, {}});
    add(name, chosen.times, KeyMix::Turned);
  }

  /// Adds the difference of two bakes of one moment, below which interpolation cannot be seen to fall.
  void noise() {
    const double seconds = moments_.front();
    const double both = bakes_.difference(bakes_.at(seconds), bakes_.at(seconds, 1), seconds);
    results_.push_back({name_ + "/two seeds", "rms error", both, "1", {}, {}});
  }

  /// Adds the error of the first moment's transfer at the others, left as it is and following the surface.
  void oneBake() {
    addErrors("one bake/stays", [&](double) { return bakes_.at(start_); });
    addErrors("one bake/follows", [&](double moment) { return bakes_.followed(start_, moment); });
  }

 private:
  void add(const std::string& name, const std::vector<double>& times, KeyMix mix) {
    addErrors(name, [&](double moment) {
      const auto last = std::upper_bound(times.begin(), times.end(), moment);
      return bakes_.between(*std::prev(last), *last, moment, mix);
    });
  }

  void addErrors(const std::string& name, const std::function<HarmonicTransfer(double moment)>& shown) {
    double squares = 0.0, worst = 0.0;
    for (const double moment : moments_) {
      const HarmonicTransfer there = shown(moment);
      const double error = bakes_.difference(bakes_.at(moment), there, moment);
      squares += error * error / static_cast<double>(moments_.size());
      worst = std::max(worst, error);
    }
    const std::string place = name_ + "/" + name;
    results_.push_back({place, "rms error", std::sqrt(squares), "1", {}, {}});
    results_.push_back({place, "worst error", worst, "1", {}, {}});
  }

  std::string name_;
  PoseBakes& bakes_;
  std::vector<BenchmarkResult>& results_;
  double start_ = 0.0;
  double end_ = 0.0;
  std::vector<double> moments_;
};

}  // namespace

void runAnimation(const Device& device, const TransferOptions& options, SuiteRun& run) {
  const std::vector<BenchmarkScene> scenes = {loadBuiltinScene("swing"), movingCornell(), bendingColumn()};
  StepCounter steps(run, "bench animation",
                    scenes.size() * (1 + options.animationKeys.size() + options.animationErrors.size()));
  std::vector<BenchmarkResult>& results = run.results();
  for (const BenchmarkScene& scene : scenes) {
    PoseBakes bakes(scene, device, options, run);
    Measurement measurement(scene, bakes, options, results);
    measurement.noise();
    measurement.oneBake();
    steps.advance();
    for (const int count : options.animationKeys) {
      measurement.evenKeys(count);
      steps.advance();
    }
    for (const double error : options.animationErrors) {
      measurement.keysByError(error);
      steps.advance();
    }
  }
}

}  // namespace prelight::benchmarks
