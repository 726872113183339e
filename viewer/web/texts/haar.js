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

// Axis, right and down of each face.
const cubeFrames = [[[1, 0, 0], [0, 0, -1], [0, -1, 0]], [[-1, 0, 0], [0, 0, 1], [0, -1, 0]], [[0, 1, 0], [1, 0, 0], [0, 0, 1]],
  [[0, -1, 0], [1, 0, 0], [0, 0, -1]], [[0, 0, 1], [1, 0, 0], [0, -1, 0]], [[0, 0, -1], [-1, 0, 0], [0, -1, 0]]].map(([axis, right, down]) => ({ axis, right, down }));

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

// A light of irradiance 1 from about a direction, and what an open receiver makes of it: host/basis/haar_direction.h.
class DirectionFilter {
  constructor(size) {
    const block = size >= 16 ? 2 : 1, side = size / block;
    Object.assign(this, { size, block, side, angles: texelAngles(side) });
  }

  // { coefficients: [index, value], open }
  towards(direction, normal) {
    const { block, side, angles } = this, face = cubeTexel(direction, 1), { axis, right, down } = cubeFrames[face], along = dot(direction, axis);
    const place = [right, down].map(way => 0.5 * (dot(direction, way) / along + 1) * side - 0.5), sum = new Map();
    let open = 0;
    for (let corner = 0; corner < 4; ++corner) {
      const step = [corner % 2, corner >> 1], lower = place.map(Math.floor), at = lower.map((x, k) => Math.max(0, Math.min(side - 1, x + step[k])));
      const weight = place.reduce((product, x, k) => product * (step[k] ? x - lower[k] : 1 - (x - lower[k])), 1);
      const [column, row] = at, way = normalize(add(axis, add(scale(right, (2 * column + 1) / side - 1), scale(down, (2 * row + 1) / side - 1))));
      this.addBlock(face, block * row, block * column, weight / angles[row * side + column], sum);
      open += weight * Math.max(dot(normal, way), 0) / Math.PI;
    }
    return { coefficients: [...sum].sort(([a], [b]) => a - b), open };
  }

  addBlock(face, row, column, value, sum) {
    const { size, block } = this, whole = value * block * block;
    const put = (r, c, number) => { const i = (face * size + r) * size + c; sum.set(i, (sum.get(i) ?? 0) + number); };
    for (let half = block; half < size; half *= 2) {
      const top = row & ~(2 * half - 1), left = column & ~(2 * half - 1), across = (column & half ? -1 : 1) * whole / (2 * half), down = row & half ? -1 : 1;
      put(top, left + half, across);
      put(top + half, left, down * whole / (2 * half));
      put(top + half, left + half, down * across);
    }
    put(0, 0, whole / size);
  }
}

class HaarTechnique {
  constructor(gl, shaders, scene, { sides, nearLamps }) {
    Object.assign(this, { gl, scene, size: sides[0].faceSize, filter: new DirectionFilter(sides[0].faceSize) });
    if (nearLamps) this.nearLamps = nearLampsOf(gl, shaders, scene, nearLamps);
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

  // Adds the light of lamps at a finite distance to that of a side, [vertex] RGB.
  addLamps(lamps, side, isFront, sum) {
    const [positions, normals] = ['positions', 'normals'].map(name => this.scene.data.array(name)), isSharp = isFront && side.channels === 1;
    for (let v = 0; v < this.scene.vertices; ++v) {
      const point = [...positions.subarray(3 * v, 3 * v + 3)], normal = scale([...normals.subarray(3 * v, 3 * v + 3)], isFront ? 1 : -1);
      for (const lamp of lamps)
        lampThrough(lamp, point, normal, isSharp, toLamp => {
          const { coefficients, open } = this.filter.towards(toLamp, normal);
          return [this.valueAt(side, v, coefficients), open];
        }).forEach((value, c) => { sum[3 * v + c] += value; });
    }
  }

  // Sums of a light's coefficients, which ascend, times those of a vertex, by the channel.
  valueAt({ channels, offsets, indices, values }, vertex, coefficients) {
    const rows = Array.from({ length: channels }, (_, c) => {
      const row = vertex * channels + c, end = offsets[row + 1];
      let at = offsets[row], sum = 0;
      for (const [index, value] of coefficients) {
        for (let high = end; at < high;) {
          const middle = (at + high) >> 1;
          if (indices[middle] < index) at = middle + 1;
          else high = middle;
        }
        if (at < end && indices[at] === index) sum += value * values[at];
      }
      return sum;
    });
    return [0, 1, 2].map(c => rows[Math.min(c, channels - 1)]);
  }

  light({ lights, skies, sky, angle }) {
    const cube = new LightCube(this.size);
    if (!sky.isDark) cube.addSky(sky, skies.colorsOf(sky), angle);
    for (const { direction, intensity } of lights.filter(isDirectional))
      cube.addDirection(scale(normalize(direction), -1), intensity);
    const coefficients = cube.transform(), all = this.sides.map(side => this.lightThrough(side, coefficients)), count = all.length, lamps = lights.filter(isTransferredLamp);
    if (lamps.length > 0) all.forEach((sum, s) => this.addLamps(lamps, this.sides[s], s === 0, sum));
    const texels = new Float32Array(4 * count * this.scene.vertices).fill(1);
    all.forEach((side, s) => {
      for (let v = 0; v < this.scene.vertices; ++v) texels.set(side.subarray(3 * v, 3 * v + 3), 4 * (v * count + s));
    });
    this.vertices.light = texelTexture(this.gl, texels, 4, this.vertices.light);
  }
}
