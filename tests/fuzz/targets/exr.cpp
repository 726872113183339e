// Layers of .exr files, as light maps have them.
#include <cmath>

#include "fuzz/scratch_file.h"
#include "fuzz/target.h"
#include "images/pixels.h"

namespace prelight::fuzz {

namespace {

void readExr(Bytes input) {
  const ScratchFile file("map.exr", input);
  const PictureLayers layers = readPictureLayers(file.path());
  require(layers.width > 0 && layers.height > 0, "pictures have texels");
  for (const PictureChannel& channel : layers.channels)
    require(channel.values.size() ==
                static_cast<std::size_t>(layers.width) * static_cast<std::size_t>(layers.height),
            "channels have as many texels as their picture");
}

}  // namespace

Target exr() { return {"exr", readExr}; }

}  // namespace prelight::fuzz
