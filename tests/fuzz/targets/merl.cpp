// Measured BRDFs in MERL's format. A right file has 33 MB: the input is its begin, and what follows repeats
// it.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "fuzz/target.h"
#include "scene/codecs/merl_brdf.h"

namespace prelight::fuzz {

namespace {

/// Returns a file of the full size that begins with the input and repeats all after its header.
std::vector<std::uint8_t> fullSize(Bytes input) {
  std::vector<std::uint8_t> file(merlBytes);
  std::memcpy(file.data(), input.data(), input.size());
  std::size_t known = input.size();
  while (known < merlBytes) {  // twice as many periods each time
    const std::size_t more = std::min(known - merlHeaderBytes, merlBytes - known);
    std::memcpy(file.data() + known, file.data() + merlHeaderBytes, more);
    known += more;
  }
  return file;
}

void readMerl(Bytes input) {
  const bool grows =
      input.size() > merlHeaderBytes && input.size() < merlBytes && input.size() % 8 == merlHeaderBytes % 8;
  const std::vector<glm::vec3> values =
      grows ? parseMerlBrdf(fullSize(input), "paint.binary") : parseMerlBrdf(input, "paint.binary");
  constexpr std::size_t step = 997;  // to look at all of them takes most of the time
  for (std::size_t i = 0; i < values.size(); i += step)
    for (int c = 0; c < 3; ++c)
      require(std::isfinite(values[i][c]) && (values[i][c] >= 0.0f || values[i][c] == -1.0f),
              "reflectance is finite, and -1 where nothing was measured");
}

}  // namespace

Target merl() { return {"merl", readMerl}; }

}  // namespace prelight::fuzz
