#include "techniques/summary_text.h"

#include <fmt/format.h>

namespace prelight {

std::string counted(std::size_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

std::string channelsText(int channels, int bounces) {
  return counted(static_cast<std::size_t>(channels), "channel") + ", " +
         counted(static_cast<std::size_t>(bounces), "bounce");
}

}  // namespace prelight
