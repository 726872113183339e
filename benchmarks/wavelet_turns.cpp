#include "benchmarks/wavelet_turns.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>

#include "basis/cube_rotation.h"
#include "benchmarks/flicker.h"
#include "benchmarks/lab/haar_rotation.h"

namespace prelight::benchmarks {

namespace {

/// About +Y, a degree a frame.
glm::dmat3 frameRotation(int frame) {
  const double angle = frame * std::numbers::pi / 180.0;
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, 0.0, -s}, {0.0, 1.0, 0.0}, {s, 0.0, c}};
}

/// A light in every frame, and what it should look like.
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

/// What a way of choosing shows in a frame.
using Choice = std::function<haar::SparseLight(int frame)>;

/// The ways that are compared, for one number of coefficients.
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
    results.push_back({"wavelets", name, metric, value, unit, {}, {}});
  };
  add("error", 100.0 * meter.error(), "%");
  add("flicker", 100.0 * meter.flicker(), "%");
  add("worst flicker", 100.0 * meter.worst(), "%");
  add("brightness jump", 100.0 * meter.jump(), "%");
  add("coefficients", meter.coefficients(), "");
}

/// The light's coefficients are chosen once and turned; columns are shared by all lights.
void measureWaveletRotation(const WaveletScene& scene, const std::vector<NamedLight>& lights,
                            const std::vector<Turn>& turns, const BenchmarkOptions& options,
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
                  const BenchmarkOptions& options, const Progress& progress,
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
