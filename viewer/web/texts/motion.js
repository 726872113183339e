// A scene that an animation moves: its nodes are moved as stiff bodies, and transfer is that of the keys around a moment.

// Numbers of the scene in a texture, some of which move.
class MovedTexels {
  constructor(gl, values, components, texture) {
    Object.assign(this, { gl, rest: values, components, texture });
    this.now = new Float32Array(rowsOf(values.length / components) * rowTexels * components);
    this.now.set(values);
  }

  // Directions or, with `offset`, places of some texels. Further components stay.
  move(first, count, linear, offset) {
    const { rest, now, components } = this;
    for (let i = components * first; i < components * (first + count); i += components) {
      const x = rest[i], y = rest[i + 1], z = rest[i + 2];
      let sum = [0, 1, 2].map(row => linear[row] * x + linear[3 + row] * y + linear[6 + row] * z);
      sum = offset ? add(sum, offset) : normalize(sum);
      now[i] = sum[0];
      now[i + 1] = sum[1];
      now[i + 2] = sum[2];
    }
    const { gl } = this, row = Math.floor(first / rowTexels), rows = Math.ceil((first + count) / rowTexels) - row, [, format, type] = texelFormat(gl, now, components);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, rowTexels, rows, format, type, now.subarray(row * rowTexels * components, (row + rows) * rowTexels * components));
  }
}

class Motion {
  constructor(page, data) {
    Object.assign(this, page.motion);
    this.rows = data.array('motion');
    if (this.keys) this.keyRows = data.array('keyMotion');
    if (this.lamps) this.lampRows = data.array('lampMotion');
  }

  // Rows of samples at a moment, between two of them.
  mixed(rows, seconds) {
    const length = rows.length / this.samples, place = Math.max(0, Math.min(1, (seconds - this.start) / (this.end - this.start))) * (this.samples - 1);
    const lower = Math.min(Math.floor(place), this.samples - 2), share = place - lower;
    return Float64Array.from({ length }, (_, i) => (1 - share) * rows[lower * length + i] + share * rows[(lower + 1) * length + i]);
  }

  // [range] twelve numbers: where it stands at a moment, from where it rests.
  ways(seconds) {
    const rows = seconds === null ? null : this.mixed(this.rows, seconds);
    return this.ranges.map((_, r) => rows ? [...rows.slice(12 * r, 12 * r + 12)] : [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]);
  }

  // The two keys around a moment, and the share of the second.
  keysAt(seconds) {
    const { times: all } = this.keys, last = all.findIndex(time => time > seconds), upper = last < 0 ? all.length - 1 : Math.max(last, 1) % all.length;
    const lower = Math.max(upper - 1, 0), span = all[upper] - all[lower];
    return { lower, upper, share: span > 0 ? Math.max(0, Math.min(1, (seconds - all[lower]) / span)) : 0 };
  }

  // [range] how it has turned since a key.
  turns(key, ways) {
    return this.ranges.map((_, r) => {
      const at = 12 * (key * this.ranges.length + r);
      return rotationOf(product(ways[r].slice(0, 9), inverse([...this.keyRows.slice(at, at + 9)])));
    });
  }

  // Lamps of the scene to where the animation has them; what was dragged stays where it moves none.
  moveLights(lights, seconds) {
    if (!this.lamps || seconds === null) return;
    const rows = this.mixed(this.lampRows, seconds);
    for (let i = 0; i < this.lamps; ++i) {
      lights.moveTo(lights.lamps[i], [...rows.slice(6 * i, 6 * i + 3)]);
      lights.aim(lights.lamps[i], [...rows.slice(6 * i + 3, 6 * i + 6)]);
    }
  }
}

// Whether what a shading shows of the bake moves along.
const follows = (motion, technique) => technique === 'phong' || (technique === 'sh' && Boolean(motion.keys));

// Vertices and triangles of a scene that moves.
class MovedGeometry {
  constructor(gl, data, motion, textures) {
    const moved = (name, components, texture) => data.has(name) ? new MovedTexels(gl, data.array(name), components, textures[texture]) : null;
    this.motion = motion;
    this.positions = moved('positions', 3, 'cornerPositions');
    this.normals = moved('normals', 3, 'vertexNormals');
    this.triangleNormals = moved('triangleNormals', 4, 'triangleNormals');
    this.tangents = moved('tangents', 4, 'cornerTangents');
    this.seconds = null;
  }

  stand(seconds) {
    if (seconds === this.seconds) return;
    this.seconds = seconds;
    this.motion.ways(seconds).forEach((way, r) => {
      const { firstVertex, vertexCount, firstTriangle, triangleCount } = this.motion.ranges[r], linear = way.slice(0, 9), around = cofactors(linear);
      this.positions.move(firstVertex, vertexCount, linear, way.slice(9, 12));
      this.normals.move(firstVertex, vertexCount, around);
      this.triangleNormals.move(firstTriangle, triangleCount, around);
      this.tangents?.move(3 * firstTriangle, 3 * triangleCount, linear);
    });
  }
}

// Transfer in SH at the keys of an animation, mixed at a moment; that of what turns is turned with it, by turning the light the other way.
class KeyedSeries {
  constructor(gl, shaders, scene) {
    Object.assign(this, { gl, shaders, scene, motion: scene.motion, captures: [null, null], shells: [] });
    this.series = this.motion.keys.arrays.map(() => null);
  }

  at(key) {
    const { order, channels, arrays } = this.motion.keys;
    return this.series[key] ??= new Series(this.gl, this.shaders, this.scene, { rows: this.scene.data.array(arrays[key]), channels, count: order ** 2, order });
  }

  // Parts of the vertices, each with its turns since both keys: none where nothing moves.
  parts(turns, turnsNext = turns) {
    const { ranges } = this.motion, parts = [];
    let next = 0;
    ranges.forEach(({ firstVertex, vertexCount }, r) => {
      if (firstVertex > next) parts.push({ first: next, count: firstVertex - next });
      parts.push({ first: firstVertex, count: vertexCount, turn: transposed(turns[r]), turnNext: transposed(turnsNext[r]) });
      next = firstVertex + vertexCount;
    });
    if (next < this.scene.vertices) parts.push({ first: next, count: this.scene.vertices - next });
    return parts;
  }

  // The shells of near lamps at a moment, for NearLamps.run().
  poseOfShells(nearLamps, seconds) {
    const { lower, upper, share } = this.motion.keysAt(seconds), ways = this.motion.ways(seconds);
    const [texels, texelsNext] = [lower, upper].map(key => this.shells[key] ??= nearLamps.textureOf(this.scene.data.array(this.motion.keys.nearLamps[key])));
    return { key: seconds, texels, texelsNext, share, parts: this.parts(this.motion.turns(lower, ways), this.motion.turns(upper, ways)) };
  }

  // What vertices take of a light.
  run(numbers, smooth, near, seconds) {
    const { lower, upper, share } = this.motion.keysAt(seconds), ways = this.motion.ways(seconds);
    const [light, lightNext] = [lower, upper].map(key => {
      const series = this.at(key);
      series.result = this.captures[key % 2];
      series.run(numbers, smooth, near, this.parts(this.motion.turns(key, ways)));
      this.captures[key % 2] = series.result;
      return series.result.texture;
    });
    return { light, lightNext, lightShare: share, stride: 1, knowsThrough: false };
  }
}
