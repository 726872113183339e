#include "cli/option_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace prelight::cli {
namespace {

constexpr auto options = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"BakeRequest::ao", "--ao"},
    {"BakeRequest::lightGroups", "--light-groups"},
    {"BakeRequest::lightMap", "--lightmap"},
    {"BakeRequest::maxMemory", "--max-memory"},
    {"BakeRequest::radiosity", "--radiosity"},
    {"BakeRequest::shadowSets", "--shadow-set"},
    {"BakeRequest::specular", "--specular-transport"},
    {"BakeRequest::subsurface", "--subsurface-transport"},
    {"ChartTransferRequest::size", "--texels"},
    {"CompressionRequest", "--compress"},
    {"CompressionRequest::clusters", "--compress"},
    {"CompressionRequest::components", "--compress"},
    {"DeviceOptions::dumpKernels", "--dump-kernels"},
    {"DeviceOptions::selector", "--device"},
    {"Effort::rays", "--rays"},
    {"ExportRequest::form", "--as"},
    {"ExportRequest::target", "--target"},
    {"HaarRequest::error", "--haar-error"},
    {"HaarRequest::size", "--haar"},
    {"LightGroupRequest::name", "--light-group"},
    {"LightMapRequest::caustics", "--caustics"},
    {"LightMapRequest::denoise", "--denoise"},
    {"LightMapRequest::error", "--texel-error"},
    {"LightMapRequest::texelSize", "--texel-size"},
    {"LoadOptions::allowOutside", "--allow-outside"},
    {"LoadOptions::brdfs", "--brdf"},
    {"LoadOptions::scale", "--scale"},
    {"LoadOptions::scene", "--scene"},
    {"LoadOptions::variant", "--variant"},
    {"OccluderKind::Auto", "--occluders auto:N"},
    {"OccluderKind::Node", "--occluders node"},
    {"RadiosityRequest::environment", "--env"},
    {"RadiosityRequest::patchSize", "--patch-size"},
    {"RenderOptions::method", "--integrator"},
    {"ShRequest::order", "--sh"},
    {"VolumeRequest::size", "--volume"},
});

bool isOfName(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ':'; }

/// End of the name that begins at `at`. A colon that no letter follows ends a sentence's part, not a name.
std::size_t endOfName(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && isOfName(text[end])) ++end;
  while (end > at && text[end - 1] == ':') --end;
  return std::max(end, at + 1);
}

}  // namespace

std::string withOptions(std::string_view text) {
  std::string replaced;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = endOfName(text, at);
    const std::string_view name = text.substr(at, end - at);
    const auto* option = std::find_if(options.begin(), options.end(),
                                      [&](const auto& candidate) { return candidate.first == name; });
    replaced += option == options.end() ? name : option->second;
    at = end;
  }
  return replaced;
}

}  // namespace prelight::cli
