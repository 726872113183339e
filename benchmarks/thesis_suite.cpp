#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "base/parallel.h"
#include "benchmarks/measure.h"
#include "benchmarks/suites.h"
#include "relight/dense_relighter.h"
#include "relight/glossy_relighter.h"

// [1] Sherif, "Vector occluders: an empirical approximation for rendering global illumination effects in
// real-time",
//     2013, Table 7.1.

namespace prelight::benchmarks {

namespace {

/// A row of [1]; seconds of both passes, frames a second with 1 light, and numbers stored.
struct ThesisRow {
  const char* name;
  int shOrder;
  int chOrder;
  int glossyOrder;
  double firstPass;
  double secondPass;
  double frames;
  double numbers;
};

constexpr std::array<ThesisRow, 9> rows = {{{"AO", 0, 0, 0, 58, 0, 5500, 5013},
                                            {"SH3/DD", 3, 0, 0, 60, 63, 5100, 135351},
                                            {"CH3/DD", 0, 3, 0, 56, 61, 5100, 135351},
                                            {"SH6/DD", 6, 0, 0, 62, 68, 2500, 541404},
                                            {"CH6/DD", 0, 6, 0, 60, 66, 2500, 541404},
                                            {"SH3/DD+SS", 3, 0, 3, 105, 70, 114, 1353510},
                                            {"CH3/DD+SS", 0, 3, 3, 103, 70, 97, 1353510},
                                            {"SH6/DD+SS", 6, 0, 6, 142, 175, 25, 20031948},
                                            {"CH6/DD+SS", 0, 6, 6, 142, 173, 22, 20031948}}};

BakeRequest requestOf(const ThesisRow& row, std::uint64_t rays) {
  BakeRequest request;
  request.rays = rays;
  request.ao = row.shOrder + row.chOrder == 0;
  request.shOrder = row.shOrder;
  request.chOrder = row.chOrder;
  request.glossyOrder = row.glossyOrder;
  request.bounces = request.ao ? 0 : 1;
  return request;
}

const HarmonicTransfer* diffusePart(const Bake& bake) {
  return bake.sh ? &*bake.sh : bake.ch ? &*bake.ch : nullptr;
}

double storedNumbers(const Bake& bake) {
  const HarmonicTransfer* diffuse = diffusePart(bake);
  return static_cast<double>((diffuse != nullptr ? diffuse->coefficients.size() : bake.ao.size()) +
                             (bake.glossy ? bake.glossy->matrices.size() : 0));
}

/// Seconds of a frame in which the light has changed: every vertex' radiance, for the glossy ones in one
/// direction each.
double relightSeconds(const Bake& bake, DeviceContext& device, int runs) {
  const HarmonicTransfer& diffuse = *diffusePart(bake);
  const auto n = static_cast<std::size_t>(diffuse.order * diffuse.order);
  const std::size_t vertices = diffuse.coefficients.size() / (n * static_cast<std::size_t>(diffuse.channels));
  std::vector<double> light(3 * n, 0.1);
  DenseRelighter dense(device, diffuse);
  dense.setLight(light);
  Buffer<float> radiance(device, 3 * vertices);
  std::optional<GlossyRelighter> glossy;
  if (bake.glossy) glossy.emplace(device, *bake.glossy);
  std::vector<float> up(3 * vertices, 0.0f);
  for (std::size_t v = 0; v < vertices; ++v) up[3 * v + 1] = 1.0f;
  Buffer<float> directions(device, std::span<const float>(up));
  const std::vector<double> lobe(static_cast<std::size_t>(diffuse.order), 0.5);
  const auto frame = [&] {
    dense.relight(radiance);
    if (glossy) {
      glossy->light(light);
      glossy->shade(directions, lobe, radiance);
    }
    device.finish();
  };
  frame();  // warms up
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) seconds.push_back(secondsOf(frame));
  return median(seconds);
}

/// Seconds of a bake's first pass (visibility) and second (interreflection, matrices), as the thesis divides
/// them.
struct PassSeconds {
  double first = 0.0;
  double second = 0.0;
};

PassSeconds passesOf(const BakeReport& report) {
  PassSeconds passes;
  for (const auto& [stage, seconds] : report.stageSeconds)
    (stage == "bounce" || stage == "glossy" ? passes.second : passes.first) += seconds;
  return passes;
}

void measureRow(const BenchmarkScene& scene, const ThesisRow& row, const Device& device,
                const BenchmarkOptions& options, const Progress& progress,
                std::vector<BenchmarkResult>& results) {
  std::vector<double> first, second;
  TimedBake last;
  for (int run = 0; run <= options.thesisRuns; ++run) {
    last = timedBake(scene, requestOf(row, options.thesisRays), device, progress);
    if (run == 0) continue;  // warms up
    first.push_back(passesOf(last.report).first);
    second.push_back(passesOf(last.report).second);
  }
  const std::string name = fmt::format("{}/{}", scene.name, row.name);
  const auto add = [&](const char* metric, double value, const char* unit, double thesis, bool lessIsBetter) {
    BenchmarkResult result{"thesis", name, metric, value, unit, {}, {}};
    if (thesis > 0.0 && value > 0.0) {
      result.peer = fmt::format("thesis {:g}", thesis);
      result.ratio = lessIsBetter ? thesis / value : value / thesis;
    }
    results.push_back(std::move(result));
  };
  add("pass 1", median(first), "s", row.firstPass, true);
  if (row.secondPass > 0.0) add("pass 2", median(second), "s", row.secondPass, true);
  add("numbers", storedNumbers(last.bake), "1", row.numbers, true);
  add("storage", storedNumbers(last.bake) * sizeof(float), "B", row.numbers * sizeof(float), true);
  if (diffusePart(last.bake) == nullptr) return;
  add("frames", 1.0 / relightSeconds(last.bake, device.context(), 5 * options.thesisRuns), "1/s", row.frames,
      false);
}

}  // namespace

std::vector<BenchmarkResult> runThesisSuite(const Device& device, const BenchmarkOptions& options,
                                            Progress& progress) {
  const BenchmarkScene scene = loadBuiltinScene("shapes");
  StepCounter steps(progress, "bench thesis", rows.size());
  std::vector<BenchmarkResult> results;
  for (const ThesisRow& row : rows) {
    if (std::max(row.shOrder, row.chOrder) > options.thesisOrder) continue;
    measureRow(scene, row, device, options, progress, results);
    steps.advance();
  }
  return results;
}

}  // namespace prelight::benchmarks
