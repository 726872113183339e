#include "viewer/options/part_option.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

#include "base/text.h"
#include "prelight/error.h"

namespace prelight::viewer {
namespace {

constexpr double mostFactor = 1e6;

std::vector<std::string> partNames() {
  std::vector<std::string> names = {"all"};
  for (std::size_t part = 0; part < pictureParts; ++part)
    names.emplace_back(nameOf(static_cast<PicturePart>(part)));
  return names;
}

[[noreturn]] void refusePart(std::string_view text, const std::string& what) {
  throw UsageError("--part " + std::string(text), what, "for example caustic=0 or indirect=2");
}

float factorIn(std::string_view text, std::string_view number) {
  double value = 0.0;
  const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (status != std::errc{} || end != number.data() + number.size())
    refusePart(text, "expected a number after =, got '" + std::string(number) + "'");
  if (!(value >= 0.0 && value <= mostFactor)) refusePart(text, "a factor is a number from 0 to 1e6");
  return static_cast<float>(value);
}

}  // namespace

void setPartFactor(std::string_view text, LayerFactors& factors) {
  const auto equals = text.rfind('=');
  if (equals == std::string_view::npos || equals == 0)
    refusePart(text, "expected a part's name, = and a factor");
  const std::string name(text.substr(0, equals));
  const float factor = factorIn(text, text.substr(equals + 1));
  const std::vector<std::string> names = partNames();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    std::string known;
    for (const std::string& one : names) known += (known.empty() ? "" : ", ") + one;
    refusePart(text, "no part of light of this name; " + didYouMean(name, names) + "the parts are " + known);
  }
  const auto first = static_cast<std::size_t>(found - names.begin());
  for (std::size_t part = 0; part < pictureParts; ++part)
    if (first == 0 || first == part + 1) factors[part] = factor;
}

}  // namespace prelight::viewer
