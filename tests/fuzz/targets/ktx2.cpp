// KTX2 pictures of Basis Universal (ETC1S and UASTC), whose decoder is our own.
#include "images/basis/ktx2.h"
#include "fuzz/sound.h"
#include "fuzz/target.h"
#include "images/picture_codecs.h"

namespace prelight::fuzz {

namespace {

void readKtx2(Bytes input) {
  if (pictureFormat(input) != PictureFormat::Ktx2) return;
  checkExtent(input, "a.glb: /images/0");
  requireSound(decodeKtx2(input, "a.glb: /images/0"));
}

}  // namespace

Target ktx2() { return {"ktx2", readKtx2}; }

}  // namespace prelight::fuzz
