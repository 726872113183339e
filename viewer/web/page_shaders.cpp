#include <array>
#include <sstream>

#include "base/text.h"
#include "prelight/error.h"
#include "viewer/gl/shader_sources.h"
#include "viewer/programs/shader_variant.h"
#include "viewer/web/page_parts.h"
#include "viewer/web/page_texts.h"

namespace prelight::viewer {
namespace {

constexpr std::array<const char*, 9> programs = {
    "surface.vert",  "surface.frag",   "background.frag",       "fullscreen.vert", "present.frag",
    "transfer.vert", "occluders.vert", "occluder_records.vert", "near_lamps.vert"};

/// What the shadings of pages put in the place of ambient.glsl; as the techniques of page_techniques.cpp.
constexpr std::array ambients = {Ambient::Open, Ambient::Accessible, Ambient::Transferred, Ambient::LightMap,
                                 Ambient::Cone};

/// Pages have no cube maps of what lies around: texts of their own take the place of these.
std::string sourceOf(const std::string& name) {
  const auto own = webPageTexts().find(name);
  if (own != webPageTexts().end()) return own->second;
  if (name == "variant.glsl") return textOf(variantOfAnySurface());
  const auto found = shaderSources().find(name);
  if (found == shaderSources().end()) throw Error(ExitCode::RuntimeFailure, "shader " + name, "no such file");
  return found->second;
}

void addWithIncludes(const std::string& name, nlohmann::ordered_json& texts) {
  if (texts.contains(name)) return;
  const std::string source = sourceOf(name);
  texts[name] = source;
  std::istringstream lines(source);
  for (std::string line; std::getline(lines, line);)
    if (const std::string included = includedPath(line); !included.empty()) addWithIncludes(included, texts);
}

}  // namespace

nlohmann::ordered_json pageShaders() {
  nlohmann::ordered_json texts = nlohmann::ordered_json::object();
  for (const char* program : programs) addWithIncludes(program, texts);
  for (const Ambient ambient : ambients) addWithIncludes(std::string(ambientFile(ambient)), texts);
  return texts;
}

}  // namespace prelight::viewer
