#include "viewer/hemisphere/opengl_hemispheres.h"
#include "prelight/draw.h"

namespace prelight {

HemisphereRendererMaker openGlHemispheres() {
  return [](const CompiledScene& scene) { return std::make_unique<viewer::OpenGlHemispheres>(scene); };
}

}  // namespace prelight
