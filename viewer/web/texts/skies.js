// Skies that the page carries.
const cosineBands = [1, 2 / 3, 1 / 4];  // of the clamped cosine over pi

class Skies {
  constructor(gl, page, data) {
    this.upright = page.upright;
    this.data = data;
    this.all = page.skies.map(sky => ({ ...sky, texture: skyTexture(gl, sky.width, sky.height, colorsOfShared(data.array(sky.array))) }));
    this.dark = { name: 'none', width: 1, height: 1, lights: [], isDark: true, coefficients: [], texture: skyTexture(gl, 1, 1, new Float32Array(3)) };
  }

  at(index) { return this.all[index] ?? this.dark; }

  // [texel] RGB.
  colorsOf(sky) { return sky.colors ??= colorsOfShared(this.data.array(sky.array)); }

  // Of a sky and lights that are alike everywhere, [i] RGB.
  numbersOf(sky, angle, lights, order) {
    const numbers = this.turned(sky, angle, order);
    for (const light of lights) {
      evaluateSh(scale(normalize(light.direction), -1), order).forEach((value, i) => {
        const factor = value * deltaWindow(Math.floor(Math.sqrt(i)), order);
        numbers[i] = add(numbers[i], scale(light.intensity, factor));
      });
    }
    return numbers;
  }

  // [i] RGB of a sky that is turned.
  turned(sky, angle, order) {
    const numbers = Array.from({ length: order * order }, (_, i) => sky.coefficients[i] ?? [0, 0, 0]);
    return sky.isDark ? numbers : turnedAboutY(numbers, angle, this.upright, order);
  }

  // ambient[] of shaders/frame.glsl; `coefficients`: the sky's, or those without its sun.
  ambient(sky, angle, coefficients) {
    return this.turned({ ...sky, coefficients }, angle, 3).flatMap((rgb, i) => [...scale(rgb, cosineBands[Math.floor(Math.sqrt(i))]), 0]);
  }

  // The sky's sun as a lamp: sunLight() of viewer/lights/lighting.cpp.
  sunOf({ sun }, angle) {
    return { kind: kinds.directional, position: [0, 0, 0], direction: scale(turned(sun.direction, [0, 1, 0], angle), -1), intensity: sun.irradiance, range: 0,
      cone: [0, 1], radius: sun.radius, ofSky: true, throughTransfer: true, shadow: -1 };
  }

  // Lights that stand for a sky, as vector occluders take it; their highlights are those of the map.
  occluderLights(sky, angle) {
    return sky.lights.map(({ direction, irradiance }) =>
      [0, 0, 0, kinds.directional, ...scale(turned(direction, [0, 1, 0], angle), -1), 0, ...irradiance, 0, 0, 0, 0, 0]);
  }
}
