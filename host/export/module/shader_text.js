// Shaders are the texts of Prelight's own viewer. Here they become GLSL ES: version and precisions differ; what else does stands in
// the texts themselves, behind GL_ES.
const shaderHead = '#version 300 es\n' + ['float', 'int', 'sampler2D', 'usampler2D', 'isampler2D', 'sampler2DArray']
  .map(type => `precision highp ${type};\n`).join('');

// The constants of a variant that lights need, where no surface is drawn.
const variantOfLights = ['hasDirectionalLights', 'hasPointLights', 'hasSpotLights', 'hasProfiledLights', 'hasEmitterLights', 'hasCookieLights', 'hasAreaLights']
  .map(name => `const bool ${name} = false;\n`).join('');

class ShaderTexts {
  constructor(texts) { this.texts = texts; }

  // A text with what it includes, but for files that others take the place of.
  expanded(name, replaced) {
    return (replaced[name] ?? this.texts[name])
      .replace(/^#version.*$/m, '')
      .replace(/^\s*#include\s+"([^"]+)"\s*$/mg, (line, included) => this.expanded(included, replaced));
  }

  of(name, variant) {
    if (!variant) return shaderHead + this.expanded(name, {});
    const ambient = this.texts[variant.ambient ?? 'ambient.glsl'];
    return shaderHead + this.expanded(name, { 'variant.glsl': this.variantText(variant), 'ambient.glsl': ambient });
  }

  // The constants of a variant: those that it does not name are false, or as they are for any surface.
  variantText(variant) {
    return this.texts['variant.glsl'].replace(/const (int|bool) (\w+) = [^;]+;/g, (line, type, name) =>
      type === 'bool' ? `const bool ${name} = ${Boolean(variant[name])};`
        : name in variant ? `const int ${name} = ${variant[name]};` : line);
  }
}
