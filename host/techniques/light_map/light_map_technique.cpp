#include "techniques/light_map/light_map_technique.h"

#include <fmt/format.h>

#include "techniques/light_map/light_map_file.h"
#include "techniques/summary_text.h"

namespace prelight {

namespace {

/// Reads all entries together, when what is at vertices is known to fit.
class LightMapEntryReader final : public TechniqueReader {
 public:
  explicit LightMapEntryReader(const BakedInput& input) : input_(input) {}

  void finish(Bake& bake) override {
    bake.lightMap = readLightMap(input_.document, input_.root, input_.scene);
  }

 private:
  const BakedInput& input_;
};

void summarizeLightMap(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.lightMap) return;
  const LightMap& map = *bake.lightMap;
  const LightMapLayout& layout = map.layout;
  const std::size_t bytes = bytesOf(map.values);
  found.push_back({"lightMap",
                   fmt::format("light map of {} x {} texels, {} charts, {} texels on the surface{}",
                               layout.width, layout.height, layout.chartCount, layout.texels.size(),
                               map.coefficients > 1 ? ", with radiance for bump maps" : ""),
                   bytes,
                   false,
                   {{"width", layout.width},
                    {"height", layout.height},
                    {"charts", layout.chartCount},
                    {"texels", layout.texels.size()},
                    {"coefficients", map.coefficients},
                    {"bytes", bytes}}});
}

}  // namespace

Technique lightMapTechnique() {
  return {.name = "lightmap",
          .members = {"lightmap"},
          .everywhere = false,
          .use = {.scattering = true, .lights = true},
          .accessors = {"texCoord", "indices"},
          .makeReader = makeTechniqueReader<LightMapEntryReader>,
          .summarize = summarizeLightMap};
}

}  // namespace prelight
