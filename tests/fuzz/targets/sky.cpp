// Skies: .hdr and .exr files as --env takes them, and what is taken out of them.
#include "fuzz/scratch_file.h"
#include "fuzz/sound.h"
#include "fuzz/target.h"
#include "images/sky_lamps.h"
#include "prelight/picture.h"

namespace prelight::fuzz {

namespace {

constexpr std::size_t mostTexels = 4096;  ///< of skies whose lamps are looked for, which takes long

void readSky(Bytes input) {
  const ScratchFile file("sky.hdr", input);
  const Environment sky = readEnvironment(file.path());
  requireSound(sky);
  if (sky.radiance.size() <= mostTexels) requireSound(takeLampsOut(sky).rest);
}

}  // namespace

Target sky() { return {"sky", readSky}; }

}  // namespace prelight::fuzz
