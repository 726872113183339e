#include "pictures/drawn_encoding.h"

#include <fmt/format.h>

#include <algorithm>

#include "prelight/error.h"
#include "techniques/encoded_light/encoding_names.h"
#include "viewer/techniques/encoded_light/encoded_lighting.h"

namespace prelight::pictures {

namespace {

std::string namesOf(const std::vector<EncodedLight>& lights) {
  std::string names;
  for (const EncodedLight& light : lights) names += (names.empty() ? "" : ", ") + light.encoding;
  return names;
}

}  // namespace

void checkEncoding(const std::filesystem::path& file, const Bake& bake, viewer::Shading shading,
                   const Encoding* encoding) {
  if (encoding == nullptr) return;
  if (shading != viewer::Shading::LightMap && shading != viewer::Shading::Radiosity)
    throw UsageError("--encoding",
                     fmt::format("only lightmap and radiosity shading draw encodings, and this is {} shading",
                                 viewer::shadingName(shading)),
                     "add --shading lightmap or --shading radiosity");
  if (!viewer::infoOf(shading).carriedBy(bake)) return;
  const std::vector<EncodedLight>& held =
      shading == viewer::Shading::LightMap ? bake.lightMap->encoded : bake.encodedLight;
  if (viewer::findEncoded(held, encoding->name) != nullptr) return;
  const std::string names = namesOf(held);
  throw InputError(file.string(),
                   fmt::format("its light is not stored as {}{}", encoding->name,
                               names.empty() ? ", nor in any other encoding" : ", but as " + names),
                   fmt::format("bake it with --lightmap --encode {}", encoding->name));
}

void askForEncoding(const Encoding& encoding, BakeRequest& request) {
  request.radiosity.wanted = false;
  request.lightMap.wanted = true;
  std::vector<std::string>& names = request.encodedLight.encodings;
  if (std::ranges::find(names, encoding.name) == names.end()) names.emplace_back(encoding.name);
}

}  // namespace prelight::pictures
