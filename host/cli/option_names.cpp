#include "cli/option_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "gi/probes/probe_light.h"
#include "prelight/parameters.h"

namespace prelight::cli {
namespace {

/// The library's names of settings that are not numbers, or whose options are named otherwise.
constexpr auto options = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"BakeRequest::ao", "--ao"},
    {"BakeRequest::lightGroups", "--light-groups"},
    {"BakeRequest::lightMap", "--lightmap"},
    {"BakeRequest::radiosity", "--radiosity"},
    {"BakeRequest::shadowSets", "--shadow-set"},
    {"BakeRequest::specular", "--specular-transport"},
    {"BakeRequest::subsurface", "--subsurface-transport"},
    {"ChartTransferRequest::relief", "--relief"},
    {"CompressionRequest", "--compress"},
    {"CompressionRequest::clusters", "--compress"},
    {"CompressionRequest::components", "--compress"},
    {"DeviceOptions::dumpKernels", "--dump-kernels"},
    {"DeviceOptions::selector", "--device"},
    {"EncodedLightRequest::encodings", "--encode"},
    {"ExportRequest::form", "--as"},
    {"ExportRequest::target", "--target"},
    {"LightGroupRequest::name", "--light-group"},
    {"LightMapRequest::caustics", "--caustics"},
    {"LightMapRequest::denoise", "--denoise"},
    {"LoadOptions::allowOutside", "--allow-outside"},
    {"LoadOptions::brdfs", "--brdf"},
    {"LoadOptions::scene", "--scene"},
    {"LoadOptions::variant", "--variant"},
    {"OccluderKind::Auto", "--occluders auto:N"},
    {"OccluderKind::Node", "--occluders node"},
    {"OccluderRequest::records", "--occluders auto:N"},
    {"PhotonOptions::photons", "--photons"},
    {"PhotonOptions::skyRotation", "--rotate-env"},
    {"RadiosityRequest::environment", "--env"},
    {"RadiosityRequest::skyRotation", "--rotate-env"},
    {"RenderOptions::height", "--size"},
    {"RenderOptions::method", "--integrator"},
    {"RenderOptions::skyRotation", "--rotate-env"},
    {"RenderOptions::width", "--size"},
});

bool isOfName(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ':'; }

/// Returns the end of the name that begins at `at`. A colon without a letter after it ends part of a
/// sentence, not a name.
std::size_t endOfName(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && isOfName(text[end])) ++end;
  while (end > at && text[end - 1] == ':') --end;
  return std::max(end, at + 1);
}

template <typename Options>
std::string optionAmong(std::string_view field) {
  for (const Parameter<Options>& row : parametersOf<Options>())
    if (field == row.field && *row.option != '\0') return std::string("--") + row.option;
  return {};
}

/// Returns the option that sets what the library calls `name`, or an empty text if there is none.
std::string optionOf(std::string_view name) {
  const auto* option = std::find_if(options.begin(), options.end(),
                                    [&](const auto& candidate) { return candidate.first == name; });
  if (option != options.end()) return std::string(option->second);
  if (name.find("::") == std::string_view::npos) return {};
  for (const auto among : {optionAmong<BakeRequest>, optionAmong<AnimationKeys>, optionAmong<RenderOptions>,
                           optionAmong<ReferenceGoal>, optionAmong<PhotonOptions>, optionAmong<LoadOptions>,
                           optionAmong<ProbeRequest>})
    if (const std::string found = among(name); !found.empty()) return found;
  return {};
}

}  // namespace

std::string withOptions(std::string_view text) {
  std::string replaced;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = endOfName(text, at);
    const std::string_view name = text.substr(at, end - at);
    const std::string option = optionOf(name);
    replaced += option.empty() ? name : option;
    at = end;
  }
  return replaced;
}

}  // namespace prelight::cli
