// Light that surfaces emit, as samples: small disks that send the same light together. viewer/lights/lighting.cpp.
const emitterSamples = 32;
const mostSpread = 16;  // squared extent of a group of samples over its surface, above which one place does not stand for all

// Samples of triangles [{corners, radiance, twoSided}], evenly by power, each somewhere on its triangle.
function sampledEmitters(triangles) {
  const emitters = triangles.map(triangle => {
    const [a, b, c] = triangle.corners, across = cross(subtract(b, a), subtract(c, a)), area = 0.5 * length(across);
    return { ...triangle, area, direction: normalize(across), power: area * luminanceOf(triangle.radiance) };
  }).filter(({ power }) => power > 0);
  const total = emitters.reduce((sum, { power }) => sum + power, 0), fraction = value => value - Math.floor(value);
  let current = 0, passed = 0;
  return emitters.length === 0 ? [] : Array.from({ length: emitterSamples }, (_, i) => {
    const target = (i + 0.5) / emitterSamples * total;
    while (current + 1 < emitters.length && passed + emitters[current].power < target) passed += emitters[current++].power;
    const { corners: [a, b, c], radiance, twoSided, area, direction, power } = emitters[current];
    let u = fraction(0.5 + 0.7548776662466927 * i), v = fraction(0.5 + 0.5698402909980532 * i);  // Roberts' R2 sequence
    if (u + v > 1) [u, v] = [1 - u, 1 - v];
    const position = add(a, add(scale(subtract(b, a), u), scale(subtract(c, a), v)));
    return { kind: kinds.emitter, position, direction, intensity: radiance, area: total / emitterSamples * area / power, twoSided, isSample: true, shadow: -1, throughTransfer: false };
  });
}

// Gives groups of samples the shadows from `first` on, as many as there are up to `end`: NearLampPass::choose().
function shareShadows(samples, first, end) {
  const extentOf = group => [0, 1, 2].map(axis => Math.max(...group.map(({ position }) => position[axis])) - Math.min(...group.map(({ position }) => position[axis])));
  const groups = samples.length > 0 && end > first ? [samples] : [];
  while (groups.length > 0 && groups.length < end - first) {
    const widest = groups.reduce((most, group) => length(extentOf(group)) > length(extentOf(most)) ? group : most), extent = extentOf(widest);
    const axis = extent.indexOf(Math.max(...extent));
    if (!(extent[axis] > 0)) break;
    const sorted = [...widest].sort((a, b) => a.position[axis] - b.position[axis]), middle = widest.length >> 1;
    groups.splice(groups.indexOf(widest), 1, sorted.slice(0, middle));
    groups.push(sorted.slice(middle));
  }
  let shadow = first;
  for (const group of groups) {
    const extent = extentOf(group), area = group.reduce((sum, sample) => sum + sample.area, 0);
    if (dot(extent, extent) > mostSpread * area) continue;
    for (const sample of group) sample.shadow = shadow;
    ++shadow;
  }
}
