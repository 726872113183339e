// Streams of EXT_meshopt_compression and KHR_meshopt_compression. The first six bytes are the layout: mode,
// filter, bytes per element and, in two bytes, the number of elements.
#include <algorithm>

#include "fuzz/target.h"
#include "scene/codecs/meshopt_stream.h"

namespace prelight::fuzz {

namespace {

constexpr std::size_t layoutBytes = 6;

/// Returns a layout that readers of glTF let through (host/scene/gltf/meshopt_views.cpp).
MeshoptLayout streamLayout(Bytes input) {
  MeshoptLayout layout;
  layout.mode = static_cast<MeshoptMode>(input[0] % 3);
  layout.count = 1 + input[3] + 256u * input[4] + 65536u * (input[5] % 2);
  if (layout.mode != MeshoptMode::Attributes) {
    layout.stride = input[2] % 2 == 0 ? 2 : 4;
    if (layout.mode == MeshoptMode::Triangles) layout.count *= 3;
    return layout;
  }
  layout.filter = static_cast<MeshoptFilter>(input[1] % 5);
  layout.stride = 4 + 4 * (input[2] % 64u);
  if (layout.filter == MeshoptFilter::Octahedral || layout.filter == MeshoptFilter::Color)
    layout.stride = input[2] % 2 == 0 ? 4 : 8;
  if (layout.filter == MeshoptFilter::Quaternion) layout.stride = 8;
  return layout;
}

void readStream(Bytes input) {
  if (input.size() < layoutBytes) return;
  const MeshoptLayout layout = streamLayout(input);
  const std::vector<std::uint8_t> data =
      decodeMeshopt(input.subspan(layoutBytes), layout, "a.glb: /bufferViews/0");
  require(data.size() == layout.bytes(), "decoded views have the size of their layout");
}

}  // namespace

Target meshopt() { return {"meshopt", readStream}; }

}  // namespace prelight::fuzz
