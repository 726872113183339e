// Light through transfer in wavelets on the faces of a cube (docs/notes/wavelets.md): the light as a cube map, transformed, times sparse rows.
const cubeFaces = 6;

// Texel that a direction looks through: host/basis/cube_map.h.
function cubeTexel([x, y, z], size) {
  const ax = Math.abs(x), ay = Math.abs(y), az = Math.abs(z);
  let face, a, b;
  if (ax >= ay && ax >= az) [face, a, b] = x > 0 ? [0, -z / ax, -y / ax] : [1, z / ax, -y / ax];
  else if (ay >= az) [face, a, b] = y > 0 ? [2, x / ay, z / ay] : [3, x / ay, -z / ay];
  else [face, a, b] = z > 0 ? [4, x / az, -y / az] : [5, -x / az, -y / az];
  const place = t => Math.max(0, Math.min(size - 1, Math.floor(0.5 * (t + 1) * size)));
  return (face * size + place(b)) * size + place(a);
}

// Solid angle of texels of a face, [row][column].
function texelAngles(size) {
  const corner = (a, b) => Math.atan2(a * b, Math.sqrt(a * a + b * b + 1)), at = i => 2 * i / size - 1;
  return Float64Array.from({ length: size * size }, (_, i) => {
    const row = Math.floor(i / size), column = i % size;
    return corner(at(column + 1), at(row + 1)) - corner(at(column), at(row + 1)) - corner(at(column + 1), at(row)) + corner(at(column), at(row));
  });
}

// Radiance of texels, [channel][texel].
class LightCube {
  constructor(size) {
    Object.assign(this, { size, texels: cubeFaces * size * size, angles: texelAngles(size) });
    this.radiance = new Float64Array(3 * this.texels);
  }

  // The mean over each texel of a sky that is turned, found at places of equal steps.
  addSky({ width, height }, colors, angle) {
    const { texels, size } = this, parts = Math.max(1, Math.min(8, Math.round(Math.sqrt(4e5 / (width * height)))));
    const sums = new Float64Array(3 * texels), weights = new Float64Array(texels);
    for (let y = 0; y < height * parts; ++y) {
      const theta = Math.PI * (y + 0.5) / (height * parts), sine = Math.sin(theta), cosine = Math.cos(theta), row = Math.floor(y / parts) * width;
      for (let x = 0; x < width * parts; ++x) {
        const phi = 2 * Math.PI * ((x + 0.5) / (width * parts) - 0.5) - angle, at = 3 * (row + Math.floor(x / parts));
        const texel = cubeTexel([sine * Math.sin(phi), cosine, -sine * Math.cos(phi)], size);
        weights[texel] += sine;
        for (let c = 0; c < 3; ++c) sums[c * texels + texel] += sine * colors[at + c];
      }
    }
    for (let i = 0; i < texels; ++i)
      for (let c = 0; c < 3; ++c) if (weights[i] > 0) this.radiance[c * texels + i] += sums[c * texels + i] / weights[i];
  }

  // A light in one direction, over a disk of about a texel: host/basis/cube_overlap.cpp.
  addDirection(toLight, irradiance) {
    const { texels, size } = this, places = 4096;
    const half = Math.min(Math.acos(1 - 4 * Math.PI / texels / (2 * Math.PI)), 0.25 * Math.PI), cap = 2 * Math.PI * (1 - Math.cos(half));
    const side = normalize(cross(toLight, Math.abs(toLight[0]) < 0.5 ? [1, 0, 0] : [0, 1, 0])), other = cross(toLight, side);
    const radiance = scale(irradiance, 1 / (Math.PI * Math.sin(half) ** 2));
    for (let i = 0; i < places; ++i) {
      const height = 1 - (i + 0.5) / places * (1 - Math.cos(half)), across = Math.sqrt(1 - height * height), turn = i * Math.PI * (3 - Math.sqrt(5));
      const texel = cubeTexel(add(scale(toLight, height), add(scale(side, across * Math.cos(turn)), scale(other, across * Math.sin(turn)))), size);
      const share = cap / places / this.angles[texel % (size * size)];
      for (let c = 0; c < 3; ++c) this.radiance[c * texels + texel] += share * radiance[c];
    }
  }

  // In place: host/basis/haar.h.
  transform() {
    const { size, radiance } = this;
    for (let face = 0; face < 3 * cubeFaces; ++face)
      for (let half = 1; half < size; half *= 2)
        for (let row = 0; row < size; row += 2 * half)
          for (let column = 0; column < size; column += 2 * half) {
            const p = (face * size + row) * size + column, s = p + half * size, q = p + half, t = s + half;
            const [a, b, c, d] = [radiance[p], radiance[q], radiance[s], radiance[t]];
            radiance[p] = 0.5 * (a + b + c + d);
            radiance[q] = 0.5 * (a - b + c - d);
            radiance[s] = 0.5 * (a + b - c - d);
            radiance[t] = 0.5 * (a - b - c + d);
          }
    return radiance;
  }
}

class HaarTechnique {
  constructor(gl, shaders, scene, { sides }) {
    Object.assign(this, { gl, scene, size: sides[0].faceSize });
    this.sides = sides.map(({ prefix, channels }) =>
      ({ channels, offsets: scene.data.array(`${prefix}Offsets`), indices: scene.data.array(`${prefix}Indices`), values: scene.data.numbers(`${prefix}Values`) }));
    const even = new Float64Array(3 * cubeFaces * this.size ** 2);
    for (let face = 0; face < 3 * cubeFaces; ++face) even[face * this.size ** 2] = this.size;
    const open = this.lightThrough(this.sides[0], even);
    this.vertices = { stride: sides.length, knowsThrough: sides.length > 1, open: openTexture(gl, null,
      Float32Array.from({ length: scene.vertices }, (_, v) => Math.max(0, Math.min(1, (open[3 * v] + open[3 * v + 1] + open[3 * v + 2]) / 3)))) };
  }

  // [vertex] RGB.
  lightThrough({ channels, offsets, indices, values }, light) {
    const result = new Float32Array(3 * this.scene.vertices), length = light.length / 3;
    for (let v = 0; v < this.scene.vertices; ++v)
      for (let c = 0; c < 3; ++c) {
        const row = v * channels + Math.min(c, channels - 1);
        let sum = 0;
        for (let i = offsets[row]; i < offsets[row + 1]; ++i) sum += values[i] * light[c * length + indices[i]];
        result[3 * v + c] = Math.max(sum, 0);
      }
    return result;
  }

  light({ lights, skies, sky, angle }) {
    const cube = new LightCube(this.size);
    if (!sky.isDark) cube.addSky(sky, skies.colorsOf(sky), angle);
    for (const { direction, intensity } of lights.filter(light => light.throughTransfer).map(seenFromCentre))
      cube.addDirection(scale(normalize(direction), -1), intensity);
    const coefficients = cube.transform(), all = this.sides.map(side => this.lightThrough(side, coefficients)), count = all.length;
    const texels = new Float32Array(4 * count * this.scene.vertices).fill(1);
    all.forEach((side, s) => {
      for (let v = 0; v < this.scene.vertices; ++v) texels.set(side.subarray(3 * v, 3 * v + 3), 4 * (v * count + s));
    });
    this.vertices.light = texelTexture(this.gl, texels, 4, this.vertices.light);
  }
}
