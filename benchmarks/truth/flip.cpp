#include "benchmarks/truth/flip.h"

#include <fstream>
#include <sstream>
#include <string>

#include "benchmarks/plot/python.h"
#include "benchmarks/run/work_folder.h"

namespace prelight::benchmarks {

namespace {

constexpr const char* flipLibrary = "flip_evaluator";

}  // namespace

bool canMeasureFlip() { return !pythonWith(flipLibrary).empty(); }

std::vector<double> measureFlip(std::span<const DisplayedPair> pairs, int width, int height) {
  const std::string python = pythonWith(flipLibrary);
  if (python.empty()) return {};
  const WorkFolder folder;
  const std::string file = folder / "pictures";
  {
    std::ofstream out(file, std::ios::binary);
    for (const DisplayedPair& pair : pairs)
      for (const std::span<const glm::vec3> picture : {pair.reference, pair.test}) {
        const std::span<const std::byte> bytes = std::as_bytes(picture);
        out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      }
  }
  std::istringstream printed(
      runScript(python, "flip.py", {file, std::to_string(width), std::to_string(height)}));
  std::vector<double> values;
  for (double value = 0.0; printed >> value;) values.push_back(value);
  return values;
}

}  // namespace prelight::benchmarks
