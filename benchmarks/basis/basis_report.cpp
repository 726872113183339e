// Prints the tables of docs/notes/bases.md, or the SH coefficients of a sky for other programs to compare
// with:
//   prelight_basis_report
//   prelight_basis_report SKY.exr ORDER     a line a coefficient: index, R, G, B
#include <fmt/format.h>

#include <cstdlib>

#include "basis/sh.h"
#include "prelight/error.h"
#include "prelight/picture.h"
#include "tables.h"

namespace prelight {
namespace {

void printSky(const char* file, int order) {
  const auto sky = sh::projectEnvironment(readEnvironment(file), order);
  const std::size_t count = sh::coefficientCount(order);
  for (std::size_t i = 0; i < count; ++i) {
    fmt::print("{} {:.17g} {:.17g} {:.17g}\n", i, sky[i], sky[count + i], sky[2 * count + i]);
  }
}

void printTables() {
  printOrthonormality(Device::open({}));
  printRotationDrift();
  printRotationTimes();
  printChTable();
  printChReconstruction();
  printBallShadows();
}

}  // namespace
}  // namespace prelight

int main(int argc, char** argv) {
  try {
    if (argc == 3) {
      prelight::printSky(argv[1], std::atoi(argv[2]));
    } else if (argc == 1) {
      prelight::printTables();
    } else {
      fmt::print(stderr, "usage: prelight_basis_report [SKY ORDER]\n");
      return 2;
    }
  } catch (const prelight::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
