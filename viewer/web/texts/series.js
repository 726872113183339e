// Light through stored transfer that is a sum of products: SH, CH and groups of lights (techniques/series/transfer.glsl).
const formSeries = 0;
const emptyFragment = shaderHead + 'void main() {}\n';

// Rows of `count` numbers in whole texels of four.
function paddedRows(values, count) {
  const padded = Math.ceil(count / 4) * 4, rows = values.length / count;
  const result = new values.constructor(rows * padded);
  for (let row = 0; row < rows; ++row) result.set(values.subarray(row * count, (row + 1) * count), row * padded);
  return result;
}

class Series {
  // `order`: of SH or CH, 0: numbers of something else; `points`: rows of a vertex.
  constructor(gl, shaders, scene, { array, channels, count, order, basis, points = 1 }) {
    Object.assign(this, { gl, shaders, scene, channels, count, order, basis, points, programs: new Map() });
    this.rows = texelTexture(gl, paddedRows(scene.data.array(array), count), 4);
    this.lights = [];  // textures
    this.basisTexture = basis ? texelTexture(gl, basis, 1) : null;
    this.result = null;
  }

  programFor(features) {
    const key = JSON.stringify(features);
    if (!this.programs.has(key))
      this.programs.set(key, new Program(this.gl, this.shaders.of('transfer.vert', features), emptyFragment, ['transferred']));
    return this.programs.get(key);
  }

  lightTexture(numbers, texture) {
    return texelTexture(this.gl, Float32Array.from(numbers.flatMap(rgb => [...rgb, 0])), 4, texture);
  }

  // `numbers`: [i] RGB of a light that is alike everywhere; of a sky `smooth` as smoothed; `near`: lights that shine through the transfer.
  // `parts` of the vertices see all of it turned.
  run(numbers, smooth = [], near = [], parts = [{ first: 0, count: this.scene.vertices * this.points }]) {
    const { gl, scene } = this;
    const turned = (some, turn) => turn && some.length ? turnedBy(some, turn, scene.page.upright, this.order) : some;
    this.lights = parts.map(({ turn }, i) => this.lightTexture([...turned(numbers, turn), ...turned(smooth, turn)], this.lights[i]));
    const program = this.programFor(lightFeatures(near));
    if (!this.result) this.result = new Capture(gl, program, scene.vertices * this.points, 1);
    scene.fillLights(near);
    program.use();
    program.set({ transferForm: formSeries, transferShape: [this.count, this.channels, this.order, flag(smooth.length)], transferIsCh: this.basis ? 1 : 0,
      transferHasRanges: 0, weightScale: 1, pointsAVertex: this.points, lightCount: near.length });
    const shared = { transfer: this.rows, chBasis: this.basisTexture, lampTables: scene.textures.lampTables, cornerPositions: scene.textures.cornerPositions, vertexNormals: scene.textures.vertexNormals };
    this.result.run(parts, part => {
      program.set({ lightTurn: part.turn ?? [1, 0, 0, 0, 1, 0, 0, 0, 1] });
      program.bind(scene.nothing, shared, { transferLight: this.lights[parts.indexOf(part)] });
    });
  }
}

// SH or CH.
class HarmonicTechnique {
  constructor(gl, shaders, scene, transfer, isCh) {
    const basis = isCh ? scene.data.array('chBasis') : null;
    this.order = transfer.order;
    this.sides = transfer.sides;
    this.basis = basis;
    this.scene = scene;
    this.series = new Series(gl, shaders, scene, { ...transfer, count: transfer.order ** 2, basis, points: transfer.sides });
    this.open = openTexture(gl, null, this.accessibility(transfer));
    this.vertices = { open: this.open };
    if (transfer.nearLamps) this.nearLamps = new NearLamps(gl, shaders, scene, transfer.nearLamps);
    if (transfer.charts) {
      this.charts = new ChartMaps(gl, scene, transfer.charts);
      this.textures = { lightMaps: this.charts.texture, vertexCharts: this.charts.coords };
    }
    this.keyed = !isCh && scene.motion?.keys ? new KeyedSeries(gl, shaders, scene) : null;
    this.followsTime = this.keyed !== null;
  }

  inBasis(numbers) {
    if (!this.basis) return numbers;
    const channels = [0, 1, 2].map(c => momentsOfCh(numbers.map(rgb => rgb[c]), this.basis, this.order));
    return numbers.map((_, i) => channels.map(channel => channel[i]));
  }

  // What the transfer leaves of a sky of radiance 1, [vertex].
  accessibility({ array, channels }) {
    const even = this.inBasis(Array.from({ length: this.order ** 2 }, (_, i) => i === 0 ? new Array(3).fill(Math.sqrt(4 * Math.PI)) : [0, 0, 0]));
    const used = even.map((rgb, i) => [i, rgb[0]]).filter(([, value]) => value !== 0);
    const values = this.scene.data.array(array), length = this.order ** 2;
    return Float32Array.from({ length: this.scene.vertices }, (_, v) => {
      let sum = 0;
      for (let c = 0; c < channels; ++c)
        for (const [i, value] of used) sum += value * numberOfHalf(values[(v * this.sides * channels + c) * length + i]);
      return Math.max(0, Math.min(1, sum / channels));
    });
  }

  light({ lights, skies, sky, angle, time }) {
    const near = lights.filter(isTransferred);
    if (this.charts) {
      const seen = skies.turned(sky, angle, this.charts.order);
      this.charts.light(seen, skies.smoothed(seen, sky, this.charts.order), near);
    }
    const numbers = skies.turned(sky, angle, this.order), smooth = skies.smoothed(numbers, sky, this.order);
    if (this.keyed && time !== null) return Object.assign(this.vertices, this.keyed.run(numbers, smooth, near, time));
    this.series.run(this.inBasis(numbers), this.inBasis(smooth), near);
    Object.assign(this.vertices, { light: this.series.result.texture, stride: this.sides, knowsThrough: this.sides > 1, lightNext: null, lightShare: 0 });
  }
}

// Matrices, [vertex][i] rows: what arrives is kept for techniques/glossy/glossy.glsl, and its first number is diffuse light.
class GlossyTechnique {
  constructor(gl, shaders, scene, transfer) {
    const { data } = scene, rows = transfer.order ** 2;
    this.order = transfer.order;
    this.series = new Series(gl, shaders, scene, { ...transfer, count: rows, basis: null, points: rows });
    this.vertices = { stride: rows, open: openTexture(gl, null, data.numbers('glossyOpen')) };
    this.textures = { lobes: texelTexture(gl, data.array('lobes'), 2), measuredLobes: texelTexture(gl, data.array('measuredLobes'), 4) };
    this.uniforms = { glossyOrder: transfer.order, lobeIsBrdf: 0 };
    if (transfer.nearLamps) this.nearLamps = new NearLamps(gl, shaders, scene, transfer.nearLamps);
  }

  light({ lights, skies, sky, angle }) {
    const numbers = skies.turned(sky, angle, this.order);
    this.series.run(numbers, skies.smoothed(numbers, sky, this.order), lights.filter(isTransferred));
    this.vertices.light = this.textures.arriving = this.series.result.texture;
  }
}

// The scene's own lights in groups, each with a colour of its own.
class GroupTechnique {
  constructor(gl, shaders, scene, transfer) {
    Object.assign(this, { gl, scene, groups: transfer.groups });
    this.series = new Series(gl, shaders, scene, { ...transfer, count: transfer.groups.length, order: 0, basis: null });
    this.glow = scene.data.has('glowGroups') ? scene.data.numbers('glowGroups') : null;
    this.vertices = { stride: 1, open: openTexture(gl, null, new Float32Array(scene.vertices)) };  // light of groups is not the sky's
  }

  light({ groupFactors }) {
    this.series.run(this.groups.map(({ color }, g) => color.map((value, c) => value * groupFactors[g][c])), []);
    this.vertices.light = this.series.result.texture;
    if (!this.glow) return;
    const glow = Float32Array.from({ length: 4 * this.glow.length }, (_, i) => groupFactors[this.glow[i >> 2]]?.[i % 4] ?? 1);
    this.vertices.glow = texelTexture(this.gl, glow, 4, this.vertices.glow);
  }
}
