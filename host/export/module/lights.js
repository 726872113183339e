// The scene's lights are as the file has them, and as they were moved and dimmed.
const kinds = { directional: 0, point: 1, spot: 2, emitter: 3, profiled: 4, area: 5, cookie: 6 };
const mostLights = 240;
const kindNames = ['sun', 'lamp', 'spot', 'surface', 'lamp', 'area light', 'projector'];

class SceneLights {
  constructor(page) {
    this.bounds = page.bounds;
    this.own = page.lights.map(light => ({ ...light, factor: 1 }));
    this.lamps = this.own.filter(light => !light.isSample);
    this.lamps.forEach((lamp, i) => lamp.label = lamp.name || `${kindNames[lamp.kind]} ${i + 1}`);
    this.emission = 1;  // factor of the light that emissive surfaces send
  }

  // Nothing of the scene lies behind a light outside of its bounds.
  moveTo(lamp, position) {
    const by = subtract(position, lamp.position);
    lamp.position = position;
    const [low, high] = this.bounds;
    lamp.throughTransfer = lamp.kind === kinds.directional || position.some((x, i) => x < low[i] || x > high[i]);
    for (const sample of [...lamp.samples ?? [], ...lamp.shadowPlaces ?? []]) sample.position = add(sample.position, by);
  }

  aim(lamp, direction) { lamp.direction = normalize(direction); }

  // As they shine; `asSamples`: area lights are sums of small ones.
  shining(asSamples) {
    const scaled = (light, factor) => factor === 1 ? light : { ...light, intensity: scale(light.intensity, factor), mean: scale(light.mean, factor) };
    return this.own.flatMap(light => {
      const factor = light.isSample ? this.emission : light.factor;
      if (factor === 0) return [];
      return asSamples && light.samples ? light.samples.map(sample => scaled(sample, factor)) : [scaled(light, factor)];
    }).slice(0, mostLights);
  }
}

// Returns lights with a sky's lamps behind their own lamps and before their samples: as many of the lights as there is room for.
function withLampsOfSky(lights, lampsOfSky) {
  const own = lights.slice(0, mostLights - lampsOfSky.length), lamps = own.filter(light => !light.isSample).length;
  return [...own.slice(0, lamps), ...lampsOfSky, ...own.slice(lamps)];
}

// What arrives of a light that faces a point, and its way: perpendicularIrradiance() of shaders/lights.glsl; of what shines unevenly
// the mean.
function arrivingAt(light, point) {
  if (light.kind === kinds.directional) return { direction: light.direction, intensity: light.intensity };
  if (light.samples) {
    const all = light.samples.map(sample => arrivingAt(sample, point)), strength = ({ intensity }) => intensity[0] + intensity[1] + intensity[2];
    const way = all.reduce((sum, one) => add(sum, scale(one.direction, strength(one))), [0, 0, 0]);
    const whole = all.reduce((sum, one) => sum + strength(one), 0), narrow = whole > 0 ? length(way) / whole : 0;
    return { direction: normalize(way), intensity: scale(all.reduce((sum, one) => add(sum, one.intensity), [0, 0, 0]), narrow) };
  }
  const path = subtract(point, light.position), square = dot(path, path), direction = normalize(path), cosine = dot(light.direction, direction);
  if (light.kind === kinds.emitter) {
    const lobe = light.twoSided ? Math.abs(cosine) : Math.max(cosine, 0);
    return { direction, intensity: scale(light.intensity, lobe * light.area / (square + light.area / Math.PI)) };
  }
  let falloff = 1 / Math.max(square, light.leastDistance ** 2);
  if (light.range > 0) falloff *= Math.max(0, Math.min(1, 1 - (square / light.range ** 2) ** 2));
  if (light.kind === kinds.spot || light.kind === kinds.cookie) falloff *= Math.max(0, Math.min(1, cosine * light.cone[0] + light.cone[1])) ** 2;
  return { direction, intensity: scale(light.mean, falloff) };
}

const isTransferred = light => light.throughTransfer;
const isTransferredLamp = light => light.throughTransfer && light.kind !== kinds.directional;
const isDirectional = light => light.kind === kinds.directional;

// What an open receiver makes of a light of irradiance 1, cut to the bands of an order: sh::openTowards() of host/basis/sh_zonal.h.
function openTowards(cosine, order) {
  let before = 0, legendre = 1, band = 1, sum = 0;
  for (let l = 0; l < order; ++l) {
    sum += (l === 1 ? 2 / 3 : l % 2 === 0 ? band : 0) * (2 * l + 1) * legendre;
    if (l % 2 === 0) band *= (1 - l) / (l + 4);
    [before, legendre] = [legendre, ((2 * l + 1) * cosine * legendre - l * before) / (l + 1)];
  }
  return sum / (4 * Math.PI);
}

const leastSoft = 0.014;  // rad

// Whether a light is so large that its shadows have soft edges: SeenLamp::isSoft of host/basis/lights/lamp_through_transfer.h.
function isSoft(light, point) {
  const distance = Math.max(length(subtract(light.position, point)), 1e-9);
  if (light.kind === kinds.area) return true;
  if (light.kind === kinds.directional) return (light.radius ?? 0) >= leastSoft;
  if (light.kind === kinds.emitter) return Math.atan(Math.sqrt(light.area / Math.PI) / distance) >= leastSoft;
  return Math.asin(Math.min((light.radius ?? 0) / distance, 1)) >= leastSoft;
}

// Radiance over albedo of a lamp that comes through the transfer, at a receiver: host/basis/lights/lamp_through_transfer.h. `through` gives the
// transfer's value and that of an open receiver in a direction: [RGB, open].
function lampThrough(lamp, point, normal, isSharp, through) {
  const { direction, intensity } = arrivingAt(lamp, point), toLamp = scale(direction, -1), cosine = dot(normal, toLamp);
  if (!intensity.some(value => value !== 0)) return [0, 0, 0];
  const [value, towards] = through(toLamp, cosine), open = Math.abs(towards) < 1e-4 ? 1e-4 : towards, slope = isSharp && !isSoft(lamp, point) ? 2 : 1;
  return value.map((t, c) => {
    const share = Math.max(0, Math.min(1, t / open)), arriving = Math.max(0, Math.min(1, 0.5 + slope * (share - 0.5)));
    return Math.max(0, intensity[c] * (t - share * open + arriving * Math.max(cosine, 0) / Math.PI));
  });
}

// As in viewer/lights/light_block.cpp.
const sizeOrFlag = light => [kinds.directional, kinds.emitter, kinds.area].includes(light.kind) ? flag(light.twoSided || light.ofSky) : light.radius ?? 0;

// The uniform block of shaders/light_block.glsl.
function lightBlock(lights) {
  const block = new Float32Array(16 * mostLights);
  lights.forEach((light, i) => {
    const tabled = light.kind === kinds.profiled || light.kind === kinds.area || light.kind === kinds.cookie;
    block.set([
      ...light.position, light.kind,
      ...light.direction, light.kind === kinds.emitter ? light.area : light.kind === kinds.directional ? light.radius ?? 0 : light.leastDistance ** 2,
      ...light.intensity, light.range,
      tabled ? light.profileStart : light.cone[0], tabled ? light.entry : light.cone[1], light.throughTransfer ? 1 : light.shadow >= 0 ? 2 + light.shadow : 0, sizeOrFlag(light),
    ], 16 * i);
  });
  return block;
}

// OccluderLight of shared/occluder_light_types.h.
function occluderLight(light) {
  const kind = light.kind === kinds.profiled ? kinds.point : light.kind === kinds.cookie ? kinds.spot : light.kind;
  const extent = light.kind === kinds.emitter ? light.area : light.leastDistance ** 2;
  return [...light.position, kind, ...light.direction, extent, ...light.mean, light.range, ...light.cone, 1, light.twoSided ? 1 : 0];
}

// Which constants of variant.glsl lights make true.
function lightFeatures(lights) {
  const has = (...some) => lights.some(light => some.includes(light.kind));
  const samples = lights.filter(light => light.isSample).length, lamps = lights.length - samples;
  return {
    lampCount: lamps <= 4 ? lamps : -1,
    sampleCount: lamps <= 4 && samples <= 8 ? samples : -1,
    hasDirectionalLights: has(kinds.directional), hasPointLights: has(kinds.point, kinds.spot, kinds.profiled, kinds.cookie),
    hasSpotLights: has(kinds.spot), hasProfiledLights: has(kinds.profiled), hasEmitterLights: has(kinds.emitter),
    hasCookieLights: has(kinds.cookie), hasAreaLights: has(kinds.area),
  };
}
