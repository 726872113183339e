#include "scene/builtin/salon_scene.h"

#include "scene/builtin/salon_parts.h"

namespace prelight {

GltfDocument makeSalonScene() {
  GltfBuilder builder("salon");
  const SalonMaterials materials = addSalonMaterials(builder);
  addSalonRoom(builder, materials);
  addSalonFurniture(builder, materials);
  addSalonTable(builder, materials);
  addSalonCourt(builder, materials);
  builder.addCamera("Camera", {0.45, 1.42, 3.15}, {-0.22, 1.12, -2.2}, 0.82, 16.0 / 9.0);
  return builder.take();
}

}  // namespace prelight
