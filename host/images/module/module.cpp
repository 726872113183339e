#include "images/module/functions.h"

extern "C" const prelight::ImageLibrary* prelightImageLibrary() {
  namespace images = prelight::images;
  static constexpr prelight::ImageLibrary library{images::readPixels, images::readPictureLayers,
                                                  images::encodePng, images::decodeImage,
                                                  images::encodePicturePng};
  return &library;
}
