#include <array>
#include <set>
#include <sstream>

#include "base/text.h"
#include "export/relight_module.h"
#include "prelight/error.h"
#include "viewer/gl/shader_sources.h"
#include "viewer/programs/shader_variant.h"
#include "viewer/web/page_parts.h"

namespace prelight::viewer {
namespace {

constexpr std::array<const char*, 9> programs = {
    "surface.vert",  "surface.frag",   "background.frag",       "fullscreen.vert", "present.frag",
    "transfer.vert", "occluders.vert", "occluder_records.vert", "near_lamps.vert"};

std::string sourceOf(const std::string& name) {
  if (name == "variant.glsl") return textOf(variantOfAnySurface());
  const auto found = shaderSources().find(name);
  if (found == shaderSources().end()) throw Error(ExitCode::RuntimeFailure, "shader " + name, "no such file");
  return found->second;
}

void addWithIncludes(const std::string& name, nlohmann::ordered_json& texts) {
  if (texts.contains(name)) return;
  const std::string source = sourceOf(name);
  if (!relightShaders().contains(name)) texts[name] = source;  // prelight.js has the others
  std::istringstream lines(source);
  for (std::string line; std::getline(lines, line);)
    if (const std::string included = includedPath(line); !included.empty()) addWithIncludes(included, texts);
}

}  // namespace

nlohmann::ordered_json pageShaders(const std::set<std::string>& ambients) {
  nlohmann::ordered_json texts = nlohmann::ordered_json::object();
  for (const char* program : programs) addWithIncludes(program, texts);
  for (const std::string& ambient : ambients) addWithIncludes(ambient, texts);
  return texts;
}

}  // namespace prelight::viewer
