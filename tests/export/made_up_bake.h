#pragma once

#include <utility>

#include "charts/make_light_map_layout.h"
#include "export/export_bake.h"
#include "scene/gltf/load/loader.h"
#include "scene/settle_sides.h"
#include "support/gltf_files.h"

namespace prelight::test {

/// A scene with a made-up bake.
struct Baked {
  GltfDocument document;
  Scene scene;
  CompiledScene compiled;
  Bake bake;
};

inline Baked bakedOf(GltfDocument document) {
  Baked baked{std::move(document), {}, {}, {}};
  Warnings warnings;
  baked.scene = loadScene(baked.document, warnings);
  baked.compiled = settleSides(baked.scene, warnings);
  LightMapLayoutRequest request;
  request.texels = 2048;
  LightMap map;
  map.layout = makeLightMapLayout(baked.scene, baked.compiled, request);
  map.values.assign(3 * map.layout.texelCount(), 0.0f);
  for (const LightMapTexel& texel : map.layout.texels)
    for (std::size_t c = 0; c < 3; ++c) map.values[3 * texel.texel + c] = static_cast<float>(texel.face % 7);
  baked.bake.lightMap = std::move(map);
  baked.bake.irradiance = std::vector<glm::vec3>(baked.compiled.vertexCount(), glm::vec3(2.0f));
  for (std::uint32_t v = 0; v < baked.compiled.vertexCount(); ++v)
    baked.bake.ao.push_back(static_cast<float>(v % 11) / 10.0f);
  return baked;
}

/// The exported .glb, read back.
inline GltfDocument exported(const Baked& baked, const ExportRequest& request,
                             ExportReport* report = nullptr) {
  const TemporaryFolder folder;
  const ExportReport done =
      exportBake({baked.document, baked.scene, baked.compiled, baked.bake, nullptr, &*baked.bake.lightMap},
                 folder / "out.glb", "out", request);
  if (report != nullptr) *report = done;
  Warnings warnings;
  return readGltf(folder / "out.glb", warnings);
}

}  // namespace prelight::test
