// The lamps of a sky's picture: takeLampsOut() of host/images/sky_lamps.cpp, which says what the constants are. Angles in rad.
const reachesOfLamps = [2.5, 5, 10].map(angle => angle * Math.PI / 180), ringOfLamp = 1.6, leastGrowth = 1.15, largestLamp = 9 * Math.PI / 180;
const leastShareOfSky = 1 / 30, leastBrightness = 5, mostLamps = 6, mostTries = 48, centerings = 2, mostWidth = 1024;
const leastReach = ({ height }) => 2 * Math.PI / height;  // that a picture resolves, two rows
const luminanceOf = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
const angleBetween = (a, b) => Math.atan2(length(cross(a, b)), dot(a, b));

const areaOfTexel = ({ width, height }, row) => 2 * Math.PI / width * (Math.cos(Math.PI * row / height) - Math.cos(Math.PI * (row + 1) / height));

function wayOfTexel({ width, height }, index) {
  const around = 2 * Math.PI * ((index % width + 0.5) / width - 0.5), down = Math.PI * (Math.floor(index / width) + 0.5) / height;
  return [Math.sin(down) * Math.sin(around), Math.cos(down), -Math.sin(down) * Math.cos(around)];
}

// A picture of means of two by two texels, halved until it is at most as wide as that or a side is odd: averagedTo() of host/images.
function averagedTo(picture, mostWidth) {
  const { width, height, colors } = picture;
  if (width <= mostWidth || width % 2 !== 0 || height % 2 !== 0) return picture;
  const half = new Float32Array(3 * width * height / 4), row = 3 * width;
  for (let y = 0, to = 0; y < height / 2; ++y)
    for (let x = 0; x < width / 2; ++x)
      for (let c = 0, at = 2 * y * row + 6 * x; c < 3; ++c, ++at) half[to++] = 0.25 * (colors[at] + colors[at + 3] + colors[at + row] + colors[at + row + 3]);
  return averagedTo({ width: width / 2, height: height / 2, colors: half }, mostWidth);
}

// How many columns of a row on either side of a direction's own may lie within an angle of a cosine; less than 0: none.
function columnsBeside({ width, height }, row, middle, least) {
  const polar = Math.PI * (row + 0.5) / height, up = Math.cos(polar) * middle[1], flat = Math.sin(polar) * Math.hypot(middle[0], middle[2]);
  if (up + flat < least) return -1;
  return up - flat >= least ? width : Math.floor(Math.acos((least - up) / flat) / (2 * Math.PI) * width) + 2;
}

// Texels within the ring of the largest reach around a direction: {index, direction, area, cosine}.
function texelsNear(picture, middle) {
  const { width, height } = picture, least = Math.cos(ringOfLamp * reachesOfLamps.at(-1)), near = [];
  const column = Math.floor((Math.atan2(middle[0], -middle[2]) / (2 * Math.PI) + 0.5) * width);
  for (let y = 0; y < height; ++y) {
    const beside = columnsBeside(picture, y, middle, least), isWhole = 2 * beside + 1 >= width;
    for (let x = isWhole ? 0 : column - beside; x <= (isWhole ? width - 1 : column + beside); ++x) {
      const index = y * width + (x + width) % width, direction = wayOfTexel(picture, index), cosine = dot(direction, middle);
      if (cosine >= least) near.push({ index, direction, area: areaOfTexel(picture, y), cosine });
    }
  }
  return near;
}

// What shines within a reach more than its surroundings: {lamp, cosine, around, flux}, or null.
function foundWithin({ colors }, near, reach) {
  const inner = Math.cos(reach), outer = Math.cos(ringOfLamp * reach);
  const colorAt = ({ index }) => [colors[3 * index], colors[3 * index + 1], colors[3 * index + 2]];
  const ring = near.filter(({ cosine }) => cosine < inner && cosine >= outer), disk = near.filter(({ cosine }) => cosine >= inner);
  const whole = ring.reduce((sum, texel) => sum + texel.area, 0);
  if (!(whole > 0)) return null;
  const around = scale(ring.reduce((sum, texel) => add(sum, scale(colorAt(texel), texel.area)), [0, 0, 0]), 1 / whole);
  const above = disk.map(texel => scale(colorAt(texel).map((value, c) => Math.max(value - around[c], 0)), texel.area));
  const flux = above.reduce((sum, light) => sum + luminanceOf(light), 0);
  if (!(flux > 0)) return null;
  const direction = normalize(disk.reduce((sum, texel, i) => add(sum, scale(texel.direction, luminanceOf(above[i]))), [0, 0, 0]));
  const spread = disk.reduce((sum, texel, i) => sum + luminanceOf(above[i]) / flux * angleBetween(texel.direction, direction) ** 2, 0);
  const irradiance = disk.reduce((sum, texel, i) => add(sum, scale(above[i], dot(texel.direction, direction))), [0, 0, 0]);
  return { lamp: { direction, radius: Math.sqrt(2 * spread), irradiance }, cosine: inner, around, flux };
}

// What shines around the middle of `near`, in the smallest reach that has nearly all of its light.
function foundAt(picture, near) {
  let best = null;
  for (const reach of reachesOfLamps) {
    if (reach < leastReach(picture)) continue;
    const found = foundWithin(picture, near, reach);
    if (found && !(found.flux <= leastGrowth * (best?.flux ?? 0))) best = found;
  }
  return best;
}

// The lamps of a picture, [{direction, radius, irradiance}], and the picture without them.
function withoutItsLamps(sky) {
  const picture = averagedTo(sky, mostWidth);
  const { width, height } = picture, rest = { width, height, colors: Float32Array.from(picture.colors) }, lamps = [];
  if (reachesOfLamps.at(-1) < leastReach(picture)) return { lamps, rest };
  const shine = Float32Array.from({ length: width * height }, (_, i) => luminanceOf(rest.colors.subarray(3 * i, 3 * i + 3)));
  const whole = shine.reduce((sum, value, i) => sum + value * areaOfTexel(picture, Math.floor(i / width)), 0);
  for (let attempt = 0; attempt < mostTries && lamps.length < mostLamps; ++attempt) {
    const brightest = shine.reduce((at, value, i) => value > shine[at] ? i : at, 0);
    if (!(shine[brightest] > leastBrightness * whole / (4 * Math.PI))) break;
    const first = texelsNear(picture, wayOfTexel(picture, brightest));
    let near = first, found = foundAt(rest, near);
    for (let step = 0; found && step < centerings; ++step) {
      near = texelsNear(picture, found.lamp.direction);
      found = foundAt(rest, near);
    }
    shine[brightest] = 0;
    const isLamp = found !== null && found.flux > leastShareOfSky * whole && found.lamp.radius <= largestLamp;
    const least = isLamp ? found.cosine : Math.cos(reachesOfLamps.at(-1));
    for (const { index, cosine } of isLamp ? near : [...first, ...near]) {
      if (cosine < least) continue;
      if (isLamp) for (let c = 0; c < 3; ++c) rest.colors[3 * index + c] = Math.min(rest.colors[3 * index + c], found.around[c]);
      shine[index] = 0;
    }
    if (isLamp) lamps.push(found.lamp);
  }
  return { lamps, rest };
}

// A lamp of a sky as a light that shines through transfer: lightOf() of viewer/lights/lighting.cpp.
const lightOfLamp = ({ direction, radius, irradiance }, angle) => ({ kind: kinds.directional, position: [0, 0, 0], direction: scale(turned(direction, [0, 1, 0], angle), -1),
  intensity: irradiance, range: 0, cone: [0, 1], radius, ofSky: true, throughTransfer: true, shadow: -1 });
