// Skies that the page carries.
const cosineBands = [1, 2 / 3, 1 / 4];  // of the clamped cosine over pi

class Skies {
  constructor(gl, page, data) {
    this.data = data;
    this.all = page.skies.map(sky => ({ ...sky, texture: skyTexture(gl, sky.width, sky.height, colorsOfShared(data.array(sky.array))),
      lobes: sky.lobes ? lobeTexture(gl, sky.lobes.width, colorsOfShared(data.array(sky.lobes.array))) : null }));
    this.dark = { name: 'none', width: 1, height: 1, lights: [], isDark: true, coefficients: [], texture: skyTexture(gl, 1, 1, new Float32Array(3)) };
  }

  at(index) { return this.all[index] ?? this.dark; }

  // [texel] RGB.
  colorsOf(sky) { return sky.colors ??= colorsOfShared(this.data.array(sky.array)); }

  // [i] RGB of a sky that is turned.
  turned(sky, angle, order) {
    const numbers = Array.from({ length: order * order }, (_, i) => sky.coefficients[i] ?? [0, 0, 0]);
    return sky.isDark ? numbers : turnedAboutY(numbers, angle, order);
  }

  // Numbers of a sky as smoothed until it is negative nowhere: SkyCoefficients::smoothing() of viewer/lights/lighting.h.
  smoothed(numbers, sky, order) {
    return smoothedBy(numbers, sky.smoothing?.[order] ?? 0);
  }

  // A sky without its lamps.
  withoutLamps(sky) { return { ...sky, ...sky.apart.rest }; }

  // ambient[] of shaders/frame.glsl.
  ambient(sky, angle) {
    const strength = i => i === 0 ? sky.smoothing?.[3] ?? 0 : 0;
    return this.turned(sky, angle, 3).flatMap((rgb, i) => [...scale(rgb, cosineBands[Math.floor(Math.sqrt(i))]), strength(i)]);
  }

  // The sky's lamps as lights.
  lampsOf({ apart }, angle) {
    return apart.lamps.map(lamp => lightOfLamp(lamp, angle));
  }

  // Lights that stand for a sky, as vector occluders take it; their highlights are those of the map.
  occluderLights(sky, angle) {
    return sky.lights.map(({ direction, irradiance }) =>
      [0, 0, 0, kinds.directional, ...scale(turned(direction, [0, 1, 0], angle), -1), 0, ...irradiance, 0, 0, 0, 0, 0]);
  }
}
