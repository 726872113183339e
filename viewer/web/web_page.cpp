#include "viewer/web/web_page.h"

#include <array>
#include <map>
#include <string_view>

#include "base/text.h"
#include "export/relight_module.h"
#include "prelight/error.h"
#include "techniques/registry/registry.h"
#include "viewer/web/page_parts.h"
#include "viewer/web/page_texts.h"

namespace prelight::viewer {
namespace {

/// The page's program, in the order in which its parts know one another. They use prelight.js, which stands
/// before them.
constexpr std::array<const char*, 15> scripts = {
    "page_data.js",  "target.js",   "textures.js",          "skies.js",  "camera.js",
    "charts.js",     "haar.js",     "series_techniques.js", "motion.js", "occluders.js",
    "techniques.js", "renderer.js", "controls.js",          "panel.js",  "main.js"};

std::string joinedScripts() {
  std::string text = relightModule();
  for (const char* script : scripts) text += webPageTexts().at(script) + "\n";
  return text;
}

/// Returns JSON for a script element, which "</" could end, and which "<!--" or "<script" could keep open.
std::string scriptJson(const nlohmann::ordered_json& json) {
  std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  constexpr std::string_view less = "\\u003c";
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    const char next = at + 1 < text.size() ? text[at + 1] : '\0';
    if (next == '/' || next == '!' || next == 's' || next == 'S') text.replace(at, 1, less);
  }
  return text;
}

using Parts = std::map<std::string, std::string, std::less<>>;

/// `text` with parts in place of their {NAMES}; what stands in parts stays as it is.
std::string filledIn(std::string_view text, const Parts& parts) {
  std::string filled;
  while (true) {
    const std::size_t open = text.find('{'), close = text.find('}', open);
    filled += text.substr(0, open);
    if (close == std::string_view::npos) return filled;
    filled += parts.at(std::string(text.substr(open + 1, close - open - 1)));
    text.remove_prefix(close + 1);
  }
}

void requireTechnique(const PageScene& page) {
  if (!page.description["techniques"].empty()) return;
  throw UsageError("page", "the bake holds nothing that a page shows",
                   "bake with ShRequest::order, HaarRequest::size, BakeRequest::ao, BakeRequest::lightMap, "
                   "BakeRequest::radiosity, BakeRequest::lightGroups or vector occluders");
}

/// The texts of ambient light that the page's shadings include.
std::set<std::string> ambientsOf(const nlohmann::ordered_json& description) {
  std::set<std::string> files = {description["before"]["rules"]["ambient"].get<std::string>()};
  for (const auto& technique : description["techniques"])
    files.insert(technique["rules"]["ambient"].get<std::string>());
  return files;
}

}  // namespace

PageScene pageScene(const PageContents& contents) {
  checkBake(*contents.inputs.bake, contents.inputs.compiled);
  PageScene page;
  page.description = {{"title", contents.title}, {"exposure", contents.exposure}};
  addGeometry(contents.inputs, page);
  addSurfaces(contents, page);
  addCameras(contents.inputs, page);
  addLights(contents.inputs, page);
  addTechniques(contents.inputs, page);
  requireTechnique(page);
  addMotion(contents.inputs, page);
  addSkies(contents, page);
  page.description["arrays"] = page.data.arrays();
  return page;
}

nlohmann::ordered_json pageReport(const PageScene& page) {
  nlohmann::ordered_json report = {{"shadings", nlohmann::ordered_json::array()},
                                   {"leftOut", page.description["leftOut"]}};
  for (const auto& technique : page.description["techniques"])
    report["shadings"].push_back({{"name", technique["name"]}, {"bytes", technique["bytes"]}});
  if (page.description.contains("motion")) {
    const auto& motion = page.description["motion"];
    report["animation"] = {{"name", motion["name"]}, {"bytes", motion["bytes"]}, {"notes", motion["notes"]}};
  }
  return report;
}

std::string webPage(const PageScene& page) {
  return filledIn(webPageTexts().at("page.html"),
                  {{"TITLE", escapedText(page.description["title"].get<std::string>())},
                   {"STYLE", webPageTexts().at("page.css")},
                   {"SHADERS", scriptJson(pageShaders(ambientsOf(page.description)))},
                   {"DESCRIPTION", scriptJson(page.description)},
                   {"SCRIPT", joinedScripts()},
                   {"DATA", toBase64(page.data.bytes())}});
}

}  // namespace prelight::viewer
