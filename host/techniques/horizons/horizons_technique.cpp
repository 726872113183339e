#include "techniques/horizons/horizons_technique.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/values/append_values.h"
#include "io/values/value_reader.h"
#include "io/values/vertex_values.h"
#include "techniques/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

constexpr float highestHorizon = 0.5f * std::numbers::pi_v<float>;
constexpr float rounding = 1e-6f;  // of a right angle

std::size_t horizonsBytes(const Bake& bake) {
  return bake.horizons ? bytesOf(bake.horizons->angles) + bytesOf(bake.horizons->feet) : 0;
}

void writeHorizonsEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.horizons) return;
  const HorizonTransfer& horizons = *output.bake.horizons;
  entry["horizons"] = {{"sectors", horizons.sectors},
                       {"angles", appendVertices(output.document, horizons.angles, ranges,
                                                 static_cast<std::size_t>(horizons.sectors))}};
  if (!horizons.feet.empty())
    entry["horizons"]["feet"] =
        appendVertices(output.document, horizons.feet, ranges, static_cast<std::size_t>(horizons.sectors));
}

class HorizonsReader final : public TechniqueReader {
 public:
  explicit HorizonsReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("horizons");
    if (!json) return;
    const int sectors = readNumber(json->at("sectors"), BakeRequest::minSectors, BakeRequest::maxSectors);
    if (!bake.horizons) bake.horizons = HorizonTransfer{sectors, {}, {}};
    expectSame(*json, sectors == bake.horizons->sectors, "sectors");
    const auto width = static_cast<std::size_t>(sectors);
    const std::size_t count = vertexCount(ranges) * width;
    const std::vector<float> horizons = anglesIn(json->at("angles"), count);
    placeVertices(horizons, ranges, width, input_.scene, bake.horizons->angles);
    const auto feet = json->find("feet");  // older files have none
    if (feet) placeVertices(anglesIn(*feet, count), ranges, width, input_.scene, bake.horizons->feet);
  }

 private:
  std::vector<float> anglesIn(const JsonCursor& json, std::size_t count) const {
    std::vector<float> values = values_.floats(json, "SCALAR", count);
    for (const float angle : values)
      if (angle < 0.0f || angle > highestHorizon + rounding)
        json.fail(fmt::format("expected angles from 0 to pi/2, radians, got {:g}", angle), rebake);
    return values;
  }

  const BakedInput& input_;
  ValueReader values_;
};

void summarizeHorizons(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.horizons) return;
  const std::size_t bytes = horizonsBytes(bake);
  found.push_back({"horizons",
                   fmt::format("horizons in {} sectors of azimuth", bake.horizons->sectors),
                   bytes,
                   true,
                   {{"sectors", bake.horizons->sectors}, {"bytes", bytes}}});
}

}  // namespace

Technique horizonsTechnique() {
  return {.name = "horizons",
          .members = {"horizons"},
          .use = {.bounces = false},
          .accessors = {"angles", "feet"},
          .storedBytes = horizonsBytes,
          .writeEntry = writeHorizonsEntry,
          .makeReader = makeTechniqueReader<HorizonsReader>,
          .summarize = summarizeHorizons};
}

}  // namespace prelight
