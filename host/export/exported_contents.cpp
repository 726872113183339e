#include "export/exported_contents.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "techniques/registry/registry.h"

namespace prelight {

namespace {

using Keys = std::vector<std::string_view>;

/// Keys of BakedSummary that prelight.js and the numbers of --target raw have.
const Keys relitKeys = {"sh", "shCompressed", "ch", "nearLamps", "lightGroups"};
const Keys rawKeys = {"ao", "bentNormal", "irradiance", "sh", "shCompressed", "ch", "haar", "vo"};

Keys keysOf(ExportForm form, ExportTarget target) {
  switch (form) {
    case ExportForm::LightMap:
    case ExportForm::Probes:
      return {"lightMap"};
    case ExportForm::VertexLight:
      return {"irradiance"};
    case ExportForm::Occlusion:
    case ExportForm::VertexOcclusion:
      return {"ao"};
    case ExportForm::Volume:
      return {"volume"};
    case ExportForm::Transfer:
      return target == ExportTarget::Three ? relitKeys : rawKeys;
  }
  return {};
}

struct Carrier {
  const Keys keys;
  const char* options;
};

/// The options that export a part; the first that suit it are named.
const std::array<Carrier, 7> carriers = {{{{"lightMap"}, "--as lightmap"},
                                          {{"ao"}, "--as occlusion"},
                                          {{"irradiance"}, "--as vertex-light"},
                                          {{"volume"}, "--as volume"},
                                          {relitKeys, "--target three --as transfer, or --target web"},
                                          {rawKeys, "--target raw, or --target web"},
                                          {{"glossy", "aperture", "texels", "through"}, "--target web"}}};

bool holds(const Keys& keys, const std::string& key) { return std::ranges::find(keys, key) != keys.end(); }

const char* carrierOf(const std::string& key) {
  const auto found =
      std::ranges::find_if(carriers, [&](const Carrier& carrier) { return holds(carrier.keys, key); });
  return found == carriers.end() ? "" : found->options;
}

}  // namespace

ExportedContents exportedContents(const Bake& bake, std::size_t vertices, const ExportRequest& request) {
  const Keys keys = keysOf(request.form, request.target);
  const bool hasNumbers = request.target == ExportTarget::Raw && !isOfAir(request.form);
  ExportedContents contents;
  for (const BakedSummary& part : summariesOf(bake, vertices)) {
    const bool taken = holds(keys, part.key) || (hasNumbers && holds(rawKeys, part.key));
    (taken ? contents.taken : contents.leftOut).push_back({part.text, carrierOf(part.key)});
  }
  return contents;
}

Bake relitParts(const Bake& bake) {
  Bake relit;
  relit.info = bake.info;
  relit.sh = bake.sh;
  relit.compressedSh = bake.compressedSh;
  relit.ch = bake.ch;
  relit.nearLamps = bake.nearLamps;
  relit.lightGroups = bake.lightGroups;
  return relit;
}

bool isRelit(const Bake& bake) { return bake.sh || bake.compressedSh || bake.ch || bake.lightGroups; }

nlohmann::ordered_json toJson(const ExportedContents& contents) {
  nlohmann::ordered_json taken = nlohmann::ordered_json::array(), leftOut = taken;
  for (const ContentsPart& part : contents.taken) taken.push_back(part.what);
  for (const ContentsPart& part : contents.leftOut)
    leftOut.push_back(
        {{"what", part.what},
         {"why", part.carriedBy.empty() ? "no export holds it" : part.carriedBy + " holds it"}});
  return {{"taken", taken}, {"leftOut", leftOut}};
}

}  // namespace prelight
