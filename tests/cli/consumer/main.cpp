#include <iostream>
#include <prelight/prelight.h>

int main() {
  prelight::Warnings warnings;
  const prelight::GltfDocument document = prelight::makeBuiltinScene("cornell");
  const prelight::Scene scene = prelight::loadScene(document, warnings);
  const prelight::CompiledScene compiled = prelight::compileScene(scene, warnings);
  std::cout << compiled.triangleCount() << " triangles, " << prelight::listDevices().size() << " devices\n";
  return compiled.triangleCount() > 0 ? 0 : 1;
}
