// Light of probes that Prelight exported, in three.js (0.151 or later).

// Reads NAME.probes.json and the file of numbers beside it.
export async function loadProbes(url) {
  const description = await (await fetched(url)).json();
  const numbers = await (await fetched(new URL(description.file, new URL(url, document.baseURI)).href)).arrayBuffer();
  return new Probes(description, numbers);
}

async function fetched(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  return response;
}

export class Probes {
  constructor(description, numbers) {
    const array = (name, Type) => {
      const { byteOffset, shape } = description.arrays[name];
      return new Type(numbers, byteOffset, shape.reduce((product, n) => product * n, 1));
    };
    this.size = description.grid.size;
    this.first = description.grid.first;
    this.spacing = description.grid.spacing;
    this.order = description.order;
    this.coefficients = array('coefficients', Float32Array);
    this.surfaces = array('surfaces', Float32Array);
    this.places = array('places', Float32Array);
    this.valid = array('valid', Uint8Array);
    this.side = description.arrays.surfaces.shape[3];
  }

  // Coefficients [function][channel] of SH at a point: of the probes around it that see it, so that no light comes through walls.
  at(x, y, z) {
    const point = [x, y, z], corners = this.#corners(point);
    const weigh = share => corners.reduce((sum, c) => sum + (c.share = this.valid[c.probe] ? c.weight * share(c.probe) : 0), 0);
    let sum = weigh(probe => this.#sees(probe, point) ? 1 : 0);
    if (sum < 1e-6) sum = weigh(() => 1);
    const length = 3 * this.order * this.order, values = new Float32Array(length);
    for (const { probe, share } of corners)
      if (share > 0) for (let i = 0; i < length; ++i) values[i] += share / sum * this.coefficients[length * probe + i];
    return values;
  }

  // Gives a THREE.LightProbe the light at an object's place: call it when the object has moved.
  setLightProbe(lightProbe, position) {
    const values = this.at(position.x, position.y, position.z);
    lightProbe.sh.coefficients.forEach((c, i) =>
      3 * i < values.length ? c.set(values[3 * i], values[3 * i + 1], values[3 * i + 2]) : c.set(0, 0, 0));
  }

  // The volume as the texture of LightProbeGrid, an addon of later versions of three.js: seven volumes of four numbers, of
  // the 27 of a probe, along z, each with a copy of its first and last layer around it.
  gridTexture(THREE) {
    const [nx, ny, nz] = this.size, layer = nx * ny, stride = 3 * this.order * this.order;
    const data = new Float32Array(4 * layer * 7 * (nz + 2));
    for (let part = 0; part < 7; ++part)
      for (let slice = 0; slice < nz + 2; ++slice)
        for (let i = 0; i < layer; ++i) {
          const probe = Math.min(Math.max(slice - 1, 0), nz - 1) * layer + i;
          for (let c = 0; c < 4; ++c) {
            const number = 4 * part + c;
            data[4 * ((part * (nz + 2) + slice) * layer + i) + c] = number < stride ? this.coefficients[stride * probe + number] : 0;
          }
        }
    const texture = new THREE.Data3DTexture(data, nx, ny, 7 * (nz + 2));
    texture.format = THREE.RGBAFormat;
    texture.type = THREE.FloatType;
    texture.magFilter = texture.minFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    return texture;
  }

  #corners(point) {
    const low = [], part = [];
    for (let a = 0; a < 3; ++a) {
      const at = Math.min(Math.max((point[a] - this.first[a]) / this.spacing, 0), this.size[a] - 1);
      low[a] = Math.min(Math.floor(at), Math.max(this.size[a] - 2, 0));
      part[a] = at - low[a];
    }
    const corners = [];
    for (let i = 0; i < 8; ++i) {
      const step = [i & 1, i >> 1 & 1, i >> 2 & 1];
      const place = low.map((l, a) => Math.min(l + step[a], this.size[a] - 1));
      const weight = part.reduce((product, p, a) => product * (step[a] ? p : 1 - p), 1);
      corners.push({ probe: (place[2] * this.size[1] + place[1]) * this.size[0] + place[0], weight, share: 0 });
    }
    return corners;
  }

  // Whether a point lies in front of all that a probe sees around its direction.
  #sees(probe, point) {
    const way = point.map((p, a) => p - this.places[3 * probe + a]), tolerance = 1e-3 * this.spacing;
    if (Math.hypot(...way) <= tolerance) return true;
    const sum = Math.abs(way[0]) + Math.abs(way[1]) + Math.abs(way[2]), [x, y, z] = way.map(w => w / sum);
    const sign = v => v < 0 ? -1 : 1;
    const folded = z >= 0 ? [x, y] : [(1 - Math.abs(y)) * sign(x), (1 - Math.abs(x)) * sign(y)];
    const low = folded.map(f => Math.floor((0.5 * f + 0.5) * this.side - 0.5));
    for (const [dx, dy] of [[0, 0], [1, 0], [0, 1], [1, 1]]) {
      const at = 4 * (probe * this.side * this.side + this.#texel(low[0] + dx, low[1] + dy)), s = this.surfaces;
      if (s[at] * way[0] + s[at + 1] * way[1] + s[at + 2] * way[2] + s[at + 3] < -tolerance) return false;
    }
    return true;
  }

  // Beyond an edge lies a texel within, mirrored about the middle of that edge.
  #texel(x, y) {
    const last = this.side - 1;
    if (x < 0 || x > last) y = last - y;
    if (y < 0 || y > last) x = last - x;
    const within = v => Math.min(Math.max(v, 0), last);
    return within(y) * this.side + within(x);
  }
}
