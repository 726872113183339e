#include "python/module.h"

#include "python/errors.h"
#include "python/scene.h"
#include "python/unlocked_work.h"

NB_MODULE(_native, module) {
  using namespace prelight::python;
  module.doc() = "The native part of prelight; import prelight instead.";
  module.attr("__version__") = PRELIGHT_VERSION;
  bindErrors(module);
  bindInterpreterEnd();
  bindDevices(module);
  bindPictures(module);
  bindSceneParts(module);
  bindScenes(module);
  bindTransfer(module);
  bindBaking(module);
  bindRendering(module);
  bindTracing(module);
  bindPhotons(module);
  bindBasis(module);
  bindHarmonicLights(module);
  bindRelighting(module);
}
