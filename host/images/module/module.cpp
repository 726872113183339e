#include "images/module/functions.h"

extern "C" const prelight::ImageLibrary* prelightImageLibrary() {
  namespace images = prelight::images;
  static constexpr prelight::ImageLibrary library{images::decodePixels, images::decodeLayers,
                                                  images::decodeImage,  images::useOneThread,
                                                  images::encodePng,    images::encodePicturePng};
  return &library;
}
