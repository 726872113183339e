// Textures: PNG, JPEG, WebP, AVIF and KTX2 pictures, recognised by their first bytes.
#include "fuzz/sound.h"
#include "fuzz/target.h"
#include "images/picture_codecs.h"

namespace prelight::fuzz {

namespace {

void readPictureBytes(Bytes input) {
  (void)imageMimeType(input);
  requireSound(decodeImage(input, "a.glb: /images/0"));
}

}  // namespace

Target picture() { return {"picture", readPictureBytes}; }

}  // namespace prelight::fuzz
