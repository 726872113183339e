// Light through stored transfer that is a sum of products: SH, CH and groups of lights (techniques/series/transfer.glsl).
const formSeries = 0, formClusters = 1;
const emptyFragment = shaderHead + 'void main() {}\n';

// Rows of `count` numbers in whole texels of four.
function paddedRows(values, count) {
  const padded = Math.ceil(count / 4) * 4, rows = values.length / count;
  const result = new values.constructor(rows * padded);
  for (let row = 0; row < rows; ++row) result.set(values.subarray(row * count, (row + 1) * count), row * padded);
  return result;
}

// The pass over all vertices that transferred light has in common, in whatever form the transfer is stored.
class TransferPass {
  // `points`: rows of a vertex.
  constructor(gl, shaders, scene, { channels, order, basis = null, points = 1 }) {
    Object.assign(this, { gl, shaders, scene, channels, order, basis, points, programs: new Map(), lights: [], result: null });
    this.textures = { chBasis: basis ? texelTexture(gl, basis, 1) : null };
  }

  programFor(features) {
    const key = JSON.stringify(features);
    if (!this.programs.has(key))
      this.programs.set(key, new Program(this.gl, this.shaders.of('transfer.vert', features), emptyFragment, ['transferred']));
    return this.programs.get(key);
  }

  // `lightOf(part)`: [texel] RGB, what the rows of a part are multiplied by; `near`: lights that shine through the transfer.
  capture(uniforms, lightOf, near, parts) {
    const { gl, scene, points } = this, all = parts ?? [{ first: 0, count: scene.vertices * points }];
    this.lights = all.map((part, i) => texelTexture(gl, Float32Array.from(lightOf(part).flatMap(rgb => [...rgb, 0])), 4, this.lights[i]));
    const program = this.programFor(lightFeatures(near));
    if (!this.result) this.result = new Capture(gl, program, scene.vertices * points, 1, scene.keepsBuffers);
    scene.fillLights(near);
    program.use();
    program.set({ transferHasRanges: 0, weightScale: 1, pointsAVertex: points, lightCount: near.length, transferIsCh: flag(this.basis), ...uniforms });
    const { lampTables, cornerPositions, vertexNormals } = scene.textures;
    this.result.run(all, part => {
      program.set({ lightTurn: part.turn ?? noTurn });
      program.bind(scene.nothing, this.textures, { lampTables, cornerPositions, vertexNormals, transferLight: this.lights[all.indexOf(part)] });
    });
  }

  delete() {
    for (const texture of [...Object.values(this.textures), ...this.lights]) this.gl.deleteTexture(texture);
    for (const program of this.programs.values()) program.delete();
    this.result?.delete();
  }

  // Numbers of a light in SH as vertices see them that have turned the other way, in the basis of the rows.
  seen(numbers, turn) {
    const turned = turn && numbers.length ? turnedBy(numbers, turn, this.order) : numbers;
    return this.basis && numbers.length ? momentsOfLight(turned, this.basis, this.order) : turned;
  }
}

// Rows of numbers, each vertex' own.
class Series extends TransferPass {
  // `rows`: [vertex][point][channel][number]; `order`: of SH or CH, 0: numbers of something else.
  constructor(gl, shaders, scene, { rows, count, ...shape }) {
    super(gl, shaders, scene, shape);
    this.count = count;
    this.textures.transfer = texelTexture(gl, paddedRows(rows, count), 4);
  }

  // `numbers`: [i] RGB of a light that is alike everywhere; of a sky `smooth` as smoothed. `parts` of the vertices see all of it turned.
  run(numbers, smooth = [], near = [], parts = undefined) {
    this.capture({ transferForm: formSeries, transferShape: [this.count, this.channels, this.order, flag(smooth.length)] },
      ({ turn }) => [...this.seen(numbers, turn), ...this.seen(smooth, turn)], near, parts);
  }
}

// SH that is compressed by clustered principal components: vertices have weights, and what a light is to a cluster is found once.
class ClusterSeries extends TransferPass {
  // `means` [cluster][channel][i], `components` [cluster][component][channel][i], `clusterOf` [vertex], `weights` [vertex][component].
  constructor(gl, shaders, scene, { clusterCount, componentCount, means, components, clusterOf, weights, ...shape }) {
    super(gl, shaders, scene, shape);
    const length = this.channels * this.order ** 2;
    this.clusterCount = clusterCount;
    this.componentCount = componentCount;
    this.rows = Float32Array.from({ length: clusterCount * (1 + componentCount) * length }, (_, at) => {
      const row = Math.floor(at / length), cluster = Math.floor(row / (1 + componentCount)), j = row % (1 + componentCount), i = at % length;
      return j === 0 ? means[cluster * length + i] : components[(cluster * componentCount + j - 1) * length + i];
    });
    Object.assign(this.textures, { transfer: texelTexture(gl, Float32Array.from(weights), 1), clusters: texelTexture(gl, Uint32Array.from(clusterOf), 1),
      clusterRows: texelTexture(gl, paddedRows(this.rows, this.order ** 2), 4) });
  }

  // [cluster][1 + component] RGB, what a light is to each.
  terms(numbers) { return lightOfRows(this.rows, this.channels, numbers); }

  run(numbers, smooth, near = [], parts = undefined) {
    this.capture({ transferForm: formClusters, transferShape: [this.componentCount, this.channels, this.order, this.clusterCount] },
      ({ turn }) => [numbers, smooth].flatMap(some => this.terms(this.seen(some, turn))), near, parts);
  }
}

// Light of numbers [i] RGB through rows [row][channel][i]: [row] RGB.
function lightOfRows(rows, channels, numbers) {
  const count = numbers.length, result = [];
  for (let first = 0; first < rows.length; first += channels * count)
    result.push([0, 1, 2].map(c => {
      const from = first + Math.min(c, channels - 1) * count;
      let sum = 0;
      for (let i = 0; i < count; ++i) sum += rows[from + i] * numbers[i][c];
      return sum;
    }));
  return result;
}
