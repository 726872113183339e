#include "export/relight_module.h"

#include <array>

namespace prelight {

namespace {

/// Parts of the module, in the order in which they know one another.
constexpr std::array<const char*, 16> parts = {
    "matrices.js",    "halves.js",         "shader_text.js", "gl.js",       "harmonics.js",    "cpherical.js",
    "lights.js",      "sky_lamps.js",      "skies.js",       "emitters.js", "lamp_shadows.js", "series.js",
    "baked_model.js", "three_material.js", "relighter.js",   "exports.js"};

constexpr const char* banner =
    "// Prelight's transfer in browsers: relights what `prelight bake` has baked. How to use it: "
    "docs/exporting.md.\n"
    "// No build step; WebGL 2. The shaders at the end are those of Prelight's own viewer.\n\n";

/// Returns a text as a template literal of JavaScript.
std::string literalOf(const std::string& text) {
  std::string literal = "`";
  for (const char c : text) {
    if (c == '`' || c == '\\' || c == '$') literal += '\\';
    literal += c;
  }
  return literal + "`";
}

}  // namespace

std::string relightModule() {
  std::string text = banner;
  for (const char* part : parts) text += relightModuleParts().at(part) + "\n";
  text += "const relightShaders = {\n";
  for (const auto& [name, shader] : relightShaders()) text += "'" + name + "': " + literalOf(shader) + ",\n";
  return text + "};\n";
}

}  // namespace prelight
