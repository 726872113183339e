#include "scene/codecs/draco_mesh.h"

#include "base/module.h"

namespace prelight {

std::unique_ptr<DracoMesh> decodeDracoHere(std::span<const std::uint8_t> bytes, std::uint64_t mostBytes,
                                           const std::string& where) {
  void* function = moduleFunction("libprelight_draco.so", "prelightDecodeDraco");
  std::unique_ptr<DracoMesh> mesh;
  reinterpret_cast<decltype(&prelightDecodeDraco)>(function)(bytes, mostBytes, where, mesh);
  return mesh;
}

}  // namespace prelight
