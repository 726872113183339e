#include <array>

#include "gi/probes/probe_light.h"
#include "parameters/rows.h"

namespace prelight {

namespace {

using namespace parameters;

constexpr auto rows = std::to_array<Parameter<ProbeRequest>>({
    row<ProbeRequest, &ProbeRequest::size>({"ProbeRequest::size", "probes", whole(2, ProbeRequest::mostSize),
                                            "",
                                            "probes along the scene's longest side, of ExportRequest::form "
                                            "probes"}),
    row<ProbeRequest, &ProbeRequest::order>({"ProbeRequest::order", "probe-order",
                                             whole(1, ProbeRequest::mostOrder), "",
                                             "bands of their spherical harmonics"}),
    row<ProbeRequest, &ProbeRequest::rays>(
        {"ProbeRequest::rays", "rays", whole(256, 8192), "", "rays per probe"}),
});

}  // namespace

template <>
std::span<const Parameter<ProbeRequest>> parametersOf<ProbeRequest>() {
  return rows;
}

}  // namespace prelight
