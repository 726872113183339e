// Streams of KHR_draco_mesh_compression, and values of every type that an accessor may ask for.
#include <array>

#include "fuzz/target.h"
#include "prelight/error.h"
#include "scene/codecs/draco_mesh.h"

namespace prelight::fuzz {

namespace {

constexpr std::uint64_t mostMeshBytes = std::uint64_t{1} << 26;  ///< as the least budget of a document
constexpr std::array<std::uint64_t, 6> componentTypes = {5120, 5121, 5122, 5123, 5125, 5126};

void readDraco(Bytes input) {
  const std::unique_ptr<DracoMesh> mesh = decodeDraco(input, mostMeshBytes, "a.glb: /stream");
  for (const std::uint32_t index : mesh->indices())
    require(index < mesh->vertices(), "triangles name vertices that there are");
  for (std::uint32_t attribute = 0; attribute < 4; ++attribute)
    for (const std::uint64_t type : componentTypes)
      for (const std::size_t components : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{4}}) {
        try {
          (void)mesh->values({attribute, type, components}, "a.glb: /stream");
        } catch (const InputError&) {  // most combinations are none that the stream has
        }
      }
}

}  // namespace

Target draco() { return {"draco", readDraco}; }

}  // namespace prelight::fuzz
