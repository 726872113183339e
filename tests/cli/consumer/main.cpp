#include <filesystem>
#include <iostream>
#include <prelight/prelight.h>

/// Reading needs the module of picture formats, which lies beside the library.
bool readsWhatItWrites() {
  const prelight::Picture picture{2, 1, {{0.5f, 1.0f, 2.0f}, {0.0f, 3.0f, 1e-3f}}};
  prelight::writePicture("consumer.exr", picture);
  const bool same = prelight::readPicture("consumer.exr").pixels == picture.pixels;
  std::filesystem::remove("consumer.exr");
  return same;
}

int main() {
  prelight::Warnings warnings;
  const prelight::GltfDocument document = prelight::makeBuiltinScene("cornell");
  const prelight::Scene scene = prelight::loadScene(document, warnings);
  const prelight::CompiledScene compiled = prelight::compileScene(scene, warnings);
  std::cout << compiled.triangleCount() << " triangles, " << prelight::listDevices().size() << " devices\n";
  return compiled.triangleCount() > 0 && readsWhatItWrites() ? 0 : 1;
}
