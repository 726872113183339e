#include "export/exported_contents.h"

#include <algorithm>

#include "techniques/registry/registry.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

std::string nameOf(ExportForm form) { return std::string(exportFormNames[static_cast<std::size_t>(form)]); }
std::string nameOf(ExportTarget target) {
  return std::string(exportTargetNames[static_cast<std::size_t>(target)]);
}

bool takes(const ExportRequest& request, const TechniqueExports& exports, const std::string& key) {
  if (request.form == ExportForm::Transfer && request.target == ExportTarget::Three)
    return exports.copyRelit != nullptr;
  const bool hasNumbers = request.target == ExportTarget::Raw && !isOfAir(request.form);
  const bool hasForm = std::ranges::find(exports.forms, nameOf(request.form)) != exports.forms.end();
  return (hasForm && (exports.formsKey.empty() || exports.formsKey == key)) ||
         (hasNumbers && exports.asNumbers);
}

std::vector<ExportCarrier> carriersOf(const TechniqueExports& exports, const std::string& key) {
  std::vector<ExportCarrier> carriers;
  if (exports.formsKey.empty() || exports.formsKey == key)
    for (const std::string_view form : exports.forms) carriers.push_back({std::string(form), {}});
  const std::string transfer = nameOf(ExportForm::Transfer);
  if (exports.copyRelit != nullptr) carriers.push_back({transfer, nameOf(ExportTarget::Three)});
  if (exports.asNumbers) carriers.push_back({transfer, nameOf(ExportTarget::Raw)});
  return carriers;
}

std::vector<BakedSummary> partsOf(const Technique& technique, const Bake& bake, std::size_t vertices) {
  std::vector<BakedSummary> parts;
  if (technique.summarize != nullptr) technique.summarize(bake, vertices, parts);
  return parts;
}

}  // namespace

ExportedContents exportedContents(const Bake& bake, std::size_t vertices, const ExportRequest& request) {
  ExportedContents contents;
  for (const Technique& technique : techniques()) {
    for (const BakedSummary& part : partsOf(technique, bake, vertices)) {
      auto& parts = takes(request, technique.exports, part.key) ? contents.taken : contents.leftOut;
      parts.push_back({part.text, carriersOf(technique.exports, part.key)});
    }
  }
  return contents;
}

Bake relitParts(const Bake& bake) {
  Bake relit;
  relit.info = bake.info;
  for (const Technique& technique : techniques())
    if (technique.exports.copyRelit != nullptr) technique.exports.copyRelit(bake, relit);
  return relit;
}

bool isRelit(const Bake& bake) {
  return std::ranges::any_of(techniques(), [&](const Technique& technique) {
    return technique.exports.relitAlone && !partsOf(technique, bake, 1).empty();
  });
}

Json toJson(const ExportedContents& contents) {
  Json taken = Json::array(), leftOut = Json::array();
  for (const ContentsPart& part : contents.taken) taken.push_back(part.what);
  for (const ContentsPart& part : contents.leftOut) {
    Json carriers = Json::array();
    for (const ExportCarrier& carrier : part.carriers) {
      carriers.push_back({{"as", carrier.form}});
      if (!carrier.target.empty()) carriers.back()["target"] = carrier.target;
    }
    leftOut.push_back({{"what", part.what}, {"carriedBy", carriers}});
  }
  return {{"taken", taken}, {"leftOut", leftOut}};
}

}  // namespace prelight
