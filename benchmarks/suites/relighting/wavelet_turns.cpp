#include "benchmarks/suites/relighting/wavelet_turns.h"
#include "benchmarks/lab/wavelet_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>

#include "basis/cube_overlap.h"
#include "benchmarks/lab/haar_rotation.h"

namespace prelight::benchmarks {

double relativeRms(const Lit& values, const Lit& exact) {
  FlickerMeter meter;
  meter.add(values, exact, 0);
  return meter.error();
}

void FlickerMeter::add(const Lit& shown, const Lit& exact, std::size_t coefficients) {
  double changes = 0.0, squares = 0.0;
  glm::dvec3 meanChange(0.0), mean(0.0);
  Lit difference(shown.size());
  for (std::size_t v = 0; v < shown.size(); ++v) {
    difference[v] = shown[v] - exact[v];
    errorSquares_ += glm::dot(difference[v], difference[v]);
    squares += glm::dot(exact[v], exact[v]);
    mean += exact[v];
    if (before_.empty()) continue;
    const glm::dvec3 change = difference[v] - before_[v];
    changes += glm::dot(change, change);
    meanChange += change;
  }
  exactSquares_ += squares;
  changeSquares_ += changes;
  worst_ = std::max(worst_, std::sqrt(changes / squares));
  jump_ = std::max(jump_, glm::length(meanChange) / glm::length(mean));
  coefficients_ += static_cast<double>(coefficients);
  before_ = std::move(difference);
  ++frames_;
}

double FlickerMeter::error() const { return std::sqrt(errorSquares_ / exactSquares_); }

double FlickerMeter::flicker() const {
  const double meanSquare = exactSquares_ / frames_;
  return frames_ > 1 ? std::sqrt(changeSquares_ / (frames_ - 1) / meanSquare) : 0.0;
}

double FlickerMeter::worst() const { return worst_; }
double FlickerMeter::jump() const { return jump_; }
double FlickerMeter::coefficients() const { return coefficients_ / frames_; }

namespace {

CubeMap smoothSky(int faceSize) {
  CubeMap map = darkCube(faceSize);
  for (std::uint32_t i = 0; i < map.radiance.size(); ++i) {
    const auto up = static_cast<float>(cubeTexelDirection(i, faceSize).y);
    map.radiance[i] = glm::vec3(0.4f + 0.3f * up, 0.5f + 0.4f * up, 0.7f + 0.3f * up);
  }
  return map;
}

CubeMap sunnySky(int faceSize) {
  CubeMap map = smoothSky(faceSize);
  const double halfAngle = 1.5 * std::numbers::pi / 180.0;
  addDisk(map, glm::normalize(glm::dvec3(0.5, 0.7, 0.3)), halfAngle, glm::vec3(1500.0f, 1400.0f, 1200.0f));
  return map;
}

CubeMap windows(int faceSize) {
  CubeMap map = darkCube(faceSize);
  for (glm::vec3& texel : map.radiance) texel = glm::vec3(0.05f);
  const CubeTexels texels(faceSize);
  for (int window = 0; window < 4; ++window) {
    const double azimuth = 0.4 + 1.5 * window, low = 0.2 + 0.1 * window;
    const auto corner = [&](double turn, double height) {
      return glm::dvec3(std::sin(azimuth + turn), height, -std::cos(azimuth + turn));
    };
    const std::array<glm::dvec3, 4> corners = {corner(-0.15, low), corner(0.15, low), corner(0.15, low + 0.5),
                                               corner(-0.15, low + 0.5)};
    std::vector<TexelOverlap> overlaps;
    overlapTexels(corners, faceSize, overlaps);
    const glm::vec3 radiance(8.0f, 7.0f + 0.5f * static_cast<float>(window),
                             10.0f - static_cast<float>(window));
    for (const TexelOverlap& overlap : overlaps) {
      map.radiance[overlap.texel] +=
          static_cast<float>(overlap.solidAngle / texels.solidAngle(overlap.texel)) * radiance;
    }
  }
  return map;
}

/// Returns the rotation about +Y by one degree per frame.
glm::dmat3 frameRotation(int frame) {
  const double angle = frame * std::numbers::pi / 180.0;
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, 0.0, -s}, {0.0, 1.0, 0.0}, {s, 0.0, c}};
}

/// A light in every frame, and the receivers lit exactly.
struct Turn {
  std::vector<std::vector<float>> byArea;
  std::vector<std::vector<float>> byPoint;
  std::vector<Lit> exact;
};

Turn turnLight(const WaveletScene& scene, const CubeMap& map, int frames) {
  Turn turn;
  for (int frame = 0; frame < frames; ++frame) {
    const glm::dmat3 rotation = frameRotation(frame);
    turn.byArea.push_back(haar::transformLight(rotateByArea(rotation, map.faceSize).apply(map)));
    turn.byPoint.push_back(haar::transformLight(rotateByPoint(rotation, map.faceSize).apply(map)));
    turn.exact.push_back(haar::relight(scene.transfer, turn.byArea.back()));
  }
  return turn;
}

/// Returns the light in a frame with the coefficients that a way of choosing them keeps.
using Choice = std::function<haar::SparseLight(int frame)>;

/// Returns the compared ways for one number of coefficients.
std::map<std::string, Choice> choices(const WaveletScene& scene, const Turn& turn, std::size_t count) {
  const haar::TransferModel& model = scene.model;
  const auto plain = [&model, count](const std::vector<float>& light) {
    return haar::selectLight(light, model.rms, count);
  };
  const auto steady = [&model, count](float hysteresis, int frames) {
    return [selection = std::make_shared<haar::SteadySelection>(count, hysteresis, frames),
            &model](const std::vector<float>& light) { return selection->next(light, model.rms); };
  };
  return {
      {"point", [=, &turn](int f) { return plain(turn.byPoint[f]); }},
      {"area", [=, &turn](int f) { return plain(turn.byArea[f]); }},
      {"area, fitted",
       [=, &turn, &model](int f) {
         return haar::fitSelection(turn.byArea[f], plain(turn.byArea[f]), model);
       }},
      {"area, soft",
       [=, &turn, &model](int f) { return haar::selectLightSoftly(turn.byArea[f], model.rms, count, 2.0f); }},
      {"area, steady", [next = steady(1.0f, 1), &turn](int f) { return next(turn.byArea[f]); }},
      {"area, steady, 8 frames", [next = steady(1.0f, 8), &turn](int f) { return next(turn.byArea[f]); }},
      {"area, steady, fitted",
       [next = steady(1.0f, 1), &turn, &model](int f) {
         return haar::fitSelection(turn.byArea[f], next(turn.byArea[f]), model);
       }},
  };
}

void reportTurns(const std::string& name, const FlickerMeter& meter, std::vector<BenchmarkResult>& results) {
  const auto add = [&](const char* metric, double value, const char* unit) {
    results.push_back({name, metric, value, unit, {}, {}});
  };
  add("error", 100.0 * meter.error(), "%");
  add("flicker", 100.0 * meter.flicker(), "%");
  add("worst flicker", 100.0 * meter.worst(), "%");
  add("brightness jump", 100.0 * meter.jump(), "%");
  add("coefficients", meter.coefficients(), "");
}

/// Measures lights whose coefficients are chosen once and turned. All lights share columns.
void measureWaveletRotation(const WaveletScene& scene, const std::vector<NamedLight>& lights,
                            const std::vector<Turn>& turns, const RelightingOptions& options,
                            double columnError, const Progress& progress,
                            std::vector<BenchmarkResult>& results) {
  std::map<std::pair<std::size_t, std::size_t>, FlickerMeter> meters;
  for (int frame = 0; frame < options.waveletFrames; ++frame) {
    haar::WaveletRotation rotation(frameRotation(frame), scene.texels.faceSize(), columnError);
    for (std::size_t l = 0; l < lights.size(); ++l) {
      const std::vector<float> light = haar::transformLight(lights[l].map);
      for (const std::size_t count : options.waveletCounts) {
        const haar::SparseLight kept = haar::selectFitted(light, count, scene.model);
        const haar::SparseLight turned = rotation.rotate(kept);
        meters[{l, count}].add(scene.relight(turned), turns[l].exact[frame], turned.indices.size());
      }
      progress.check();
    }
  }
  for (const auto& [key, meter] : meters) {
    const std::string name = fmt::format("turn/{}/{}/wavelet basis, columns to {:g} %",
                                         lights[key.first].name, key.second, 100.0 * columnError);
    reportTurns(name, meter, results);
  }
}

}  // namespace

std::vector<NamedLight> waveletLights(int faceSize, const std::vector<std::filesystem::path>& skies) {
  std::vector<NamedLight> lights = {
      {"smooth", smoothSky(faceSize)}, {"sun", sunnySky(faceSize)}, {"windows", windows(faceSize)}};
  for (const std::filesystem::path& sky : skies) {
    lights.push_back({sky.stem().string(), cubeFromEnvironment(readEnvironment(sky), faceSize)});
  }
  return lights;
}

WaveletScene::WaveletScene(int faceSize, int receiverCount)
    : texels(faceSize),
      receivers(receiverCount, 12, 1),
      transfer(receivers.transfer(texels, 0.0)),
      model(haar::modelTransfer(transfer, haar::usualRank)),
      columns(texels.count() * receivers.count(), 0.0f) {
  for (std::size_t v = 0; v < receivers.count(); ++v) {
    for (std::uint32_t k = transfer.offsets[v]; k < transfer.offsets[v + 1]; ++k) {
      columns[transfer.indices[k] * receivers.count() + v] = transfer.values[k];
    }
  }
}

Lit WaveletScene::relight(const haar::SparseLight& light) const {
  Lit lit(receivers.count(), glm::dvec3(0.0));
  for (std::size_t k = 0; k < light.indices.size(); ++k) {
    const float* column = columns.data() + light.indices[k] * receivers.count();
    const glm::dvec3 value(light.values[k]);
    for (std::size_t v = 0; v < lit.size(); ++v) lit[v] += static_cast<double>(column[v]) * value;
  }
  return lit;
}

void measureTurns(const WaveletScene& scene, const std::vector<NamedLight>& lights,
                  const RelightingOptions& options, const Progress& progress,
                  std::vector<BenchmarkResult>& results) {
  std::vector<Turn> turns;
  for (const NamedLight& light : lights) {
    turns.push_back(turnLight(scene, light.map, options.waveletFrames));
    const Turn& turn = turns.back();
    FlickerMeter allByPoint;
    for (int f = 0; f < options.waveletFrames; ++f) {
      allByPoint.add(haar::relight(scene.transfer, turn.byPoint[f]), turn.exact[f], scene.texels.count());
    }
    reportTurns(fmt::format("turn/{}/all/point", light.name), allByPoint, results);
    for (const std::size_t count : options.waveletCounts) {
      for (const auto& [name, choose] : choices(scene, turn, count)) {
        FlickerMeter meter;
        for (int f = 0; f < options.waveletFrames; ++f) {
          const haar::SparseLight part = choose(f);
          meter.add(scene.relight(part), turn.exact[f], part.indices.size());
        }
        reportTurns(fmt::format("turn/{}/{}/{}", light.name, count, name), meter, results);
        progress.check();
      }
    }
  }
  for (const double columnError : {0.0, 0.01}) {
    measureWaveletRotation(scene, lights, turns, options, columnError, progress, results);
  }
}

}  // namespace prelight::benchmarks
