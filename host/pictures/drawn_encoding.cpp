#include "pictures/drawn_encoding.h"

#include <fmt/format.h>

#include <algorithm>

#include "prelight/error.h"
#include "techniques/encoded_light/encoding_names.h"
#include "techniques/encoded_light/held_encodings.h"

namespace prelight::pictures {

namespace {

std::string namesOf(const std::vector<EncodedLight>& lights) {
  std::string names;
  for (const EncodedLight& light : lights) names += (names.empty() ? "" : ", ") + light.encoding;
  return names;
}

}  // namespace

const Encoding* encodingNamed(const char* where, const std::string& name) {
  return name.empty() ? nullptr : &requireEncoding(where, name);
}

void checkEncoding(const std::filesystem::path& file, const Bake& bake, viewer::Shading shading,
                   const Encoding* encoding) {
  if (encoding == nullptr) return;
  const viewer::ShadingInfo& info = viewer::infoOf(shading);
  if (info.encoded == Ambient::Open)
    throw UsageError("DrawRequest::encoding",
                     fmt::format("only lightmap and radiosity shading draw encodings, and this is {} shading",
                                 viewer::shadingName(shading)),
                     "add DrawRequest::shading lightmap or DrawRequest::shading radiosity");
  if (!info.carriedBy(bake)) return;
  if (encodedFor(info.encoded, bake, encoding->name) != nullptr) return;
  const std::string names = namesOf(*encodedFor(info.encoded, bake));
  throw InputError(
      file.string(),
      fmt::format("its light is not stored as {}{}", encoding->name,
                  names.empty() ? ", nor in any other encoding" : ", but as " + names),
      fmt::format("bake it with BakeRequest::lightMap EncodedLightRequest::encodings {}", encoding->name));
}

void askForEncoding(const Encoding& encoding, const BakeRequest& asked, BakeRequest& request) {
  request.radiosity.wanted = false;
  request.lightMap = asked.lightMap;
  request.lightMap.wanted = true;
  std::vector<std::string>& names = request.encodedLight.encodings;
  if (std::ranges::find(names, encoding.name) == names.end()) names.emplace_back(encoding.name);
}

}  // namespace prelight::pictures
