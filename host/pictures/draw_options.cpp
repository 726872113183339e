#include "prelight/draw_options.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "pictures/picture_request.h"
#include "pictures/traced_picture.h"
#include "viewer/options/shading_options.h"

namespace prelight {

namespace {

using pictures::PictureRequest;

/// Adds the rows of a table, all or those that are named. `read` returns the part of a request that they
/// describe, and `write` puts it back.
template <typename Part, typename Read, typename Write>
void addRows(std::vector<DrawOption>& options, const Read& read, const Write& write,
             std::initializer_list<std::string_view> names = {}) {
  for (const Option<Part>& row : optionsOf<Part>()) {
    if (names.size() > 0 && std::find(names.begin(), names.end(), row.name) == names.end()) continue;
    options.push_back(
        {row, row.usualValue(), [set = row.set, read, write](DrawRequest& request, double value) {
           Part part = read(request);
           set(part, value);
           write(request, part);
         }});
  }
}

std::vector<DrawOption> makeOptions() {
  std::vector<DrawOption> options;
  addRows<ShadingOptions>(
      options, [](const DrawRequest& r) { return r.options; },
      [](DrawRequest& r, const ShadingOptions& part) { r.options = part; });
  addRows<viewer::RenderOptions>(
      options, [](const DrawRequest&) { return viewer::RenderOptions(); },
      [](DrawRequest& r, const viewer::RenderOptions& part) { r.lobe = part.lobe; }, {"lobe"});
  addRows<pictures::FullRequest>(
      options, [](const DrawRequest& r) { return pictures::fullRequest(r.full); },
      [](DrawRequest& r, const pictures::FullRequest& part) {
        const bool rasterised = r.full.rasterised;
        r.full = pictures::fullOptions(part);
        r.full.rasterised = rasterised;
      });
  addRows<InstantOptions>(
      options, [](const DrawRequest& r) { return r.instant; },
      [](DrawRequest& r, const InstantOptions& part) { r.instant = part; });
  addRows<PictureRequest>(
      options,
      [](const DrawRequest& r) {
        PictureRequest part;
        part.causticPhotons = r.causticPhotons;
        part.objects = r.objects;
        return part;
      },
      [](DrawRequest& r, const PictureRequest& part) {
        r.causticPhotons = part.causticPhotons;
        r.objects = part.objects;
      },
      {"caustics", "object-light", "object-shadow", "probes"});
  return options;
}

}  // namespace

std::span<const DrawOption> drawOptions() {
  static const std::vector<DrawOption> options = makeOptions();
  return options;
}

}  // namespace prelight
