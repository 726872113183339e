#include <array>

#include "gi/probes/probe_light.h"
#include "options/rows.h"

namespace prelight {

namespace {

using namespace options;
using Row = Rows<ProbeRequest>;

constexpr auto rows = std::to_array<Option<ProbeRequest>>({
    Row::number<&ProbeRequest::size>(
        whole(2, ProbeRequest::mostSize),
        {.field = "ProbeRequest::size",
         .name = "probes",
         .help = "probes along the scene's longest side, if probes are exported"}),
    Row::number<&ProbeRequest::order>(whole(1, ProbeRequest::mostOrder),
                                      {.field = "ProbeRequest::order",
                                       .name = "probe-order",
                                       .help = "bands of their spherical harmonics"}),
    Row::number<&ProbeRequest::rays>(
        whole(256, 8192), {.field = "ProbeRequest::rays", .name = "rays", .help = "rays per probe"}),
});

}  // namespace

template <>
std::span<const Option<ProbeRequest>> optionsOf<ProbeRequest>() {
  return rows;
}

}  // namespace prelight
