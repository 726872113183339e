#include "fuzz/target.h"

namespace prelight::fuzz {

std::vector<Target> allTargets() {
  return {baked(),   draco(), exr(),     gltf(),    ies(), ktx2(),  merl(), meshopt(),
          options(), part(),  picture(), kernels(), sky(), state(), uri()};
}

}  // namespace prelight::fuzz
