// The transfer that a baked .glb holds, as three.js' GLTFLoader has read it: docs/file-format.md.
const transferName = 'PRELIGHT_transfer';
const shellLag = 0.5;  // of host/techniques/near_lamps/lamp_shells.h

// Numbers of bytes that stand for halves, or for parts of ranges or exponents of their bands: SH as it was before its compression.
function decompressedRows({ method, order, channels }, { halves, bytes, exponents, ranges }) {
  if (method === 'half') return Float32Array.from(halves, numberOfHalf);
  const length = order ** 2, bandOf = i => Math.floor(Math.sqrt(i));
  return Float32Array.from(bytes, (byte, at) => {
    const i = at % length, channel = Math.floor(at / length) % channels, l = bandOf(i);
    if (method === 'band8') return ranges[2 * (channel * order + l)] + ranges[2 * (channel * order + l) + 1] * byte;
    const exponent = exponents[Math.floor(at / (length * channels)) * order + l];
    return exponent === 0 ? 0 : (byte - 128) / 128 * 2 ** (exponent - 128);
  });
}

// Clusters whose weights are bytes: their ranges move into means and components, so that weights are whole numbers.
function withRanges({ order, channels, clusterCount, componentCount }, means, basis, ranges) {
  const length = channels * order ** 2, movedMeans = Float32Array.from(means), components = Float32Array.from(basis ?? []);
  if (!ranges) return { means: movedMeans, components };
  for (let row = 0; row < clusterCount * componentCount; ++row)
    for (let i = 0; i < length; ++i) {
      movedMeans[Math.floor(row / componentCount) * length + i] += ranges[2 * row] * basis[row * length + i];
      components[row * length + i] *= ranges[2 * row + 1];
    }
  return { means: movedMeans, components };
}

// The numbers of a column: bytes in groups that have a scale each, or all the same.
function dequantized({ square, scale = 1 }, codes, scales) {
  const greatest = codes instanceof Int8Array ? 127 : 255, group = scales ? codes.length / scales.length : codes.length;
  const factors = scales ? Array.from(scales, numberOfHalf) : [scale];
  return Float32Array.from(codes, (code, i) => {
    const t = Math.max(-1, code / greatest);
    return factors[Math.floor(i / group)] * (square ? t * Math.abs(t) : t);
  });
}

// Reads the numbers of accessors and columns.
class BakedFile {
  constructor(parser) {
    this.parser = parser;
    this.root = parser.json.extensions?.[transferName];
    if (!this.root) throw new Error('This model holds no PRELIGHT_transfer: bake it with prelight, and export it with --target three.');
  }

  // The values of an accessor or of a column that is stored as bytes; undefined for what is not there. A file's accessors are packed.
  async values(column) {
    if (column === undefined) return undefined;
    if (typeof column === 'object') return dequantized(column, await this.values(column.bytes), await this.values(column.scales));
    return (await this.parser.getDependency('accessor', column)).array;
  }

  // [primitive] of a node: entries of the extension, with columns in place of accessors where numbers are stored as bytes.
  entriesOf(node) {
    const entries = this.parser.json.nodes[node]?.extensions?.[transferName]?.primitives ?? [];
    return entries.map(entry => ({ ...entry, ...entry.quantized }));
  }

  // Rows of SH as they are, compressed or not: {order, channels, rows} or what ClusterSeries takes.
  async harmonics({ sh, shCompressed }) {
    if (sh) return { order: sh.order, channels: sh.channels, rows: await this.values(sh.coefficients) };
    const shared = this.root.shCompressed, { order, channels, method, clusterCount, componentCount } = shared;
    const [halves, bytes, exponents, ranges] = await Promise.all([shCompressed.halves, shCompressed.bytes, shCompressed.exponents, shared.ranges].map(i => this.values(i)));
    if (clusterCount === undefined) return { order, channels, rows: decompressedRows({ method, order, channels }, { halves, bytes, exponents, ranges }) };
    const [means, basis, weightRanges, weights, clusters] = await Promise.all(
      [shared.means, shared.basis, shared.weightStorage === 'byte' ? shared.weightRanges : undefined, shCompressed.weights, shCompressed.clusters].map(i => this.values(i)));
    const values = shared.weightStorage === 'half' ? Float32Array.from(weights, numberOfHalf) : weights ?? [];  // means alone: no weights
    const clusterOf = clusters ?? new Uint16Array(values.length / componentCount);
    return { order, channels, clusterCount, componentCount, clusterOf, weights: values, ...withRanges(shared, means, basis, weightRanges) };
  }

  async nearLamps({ order, shells, nearest, farthest, halves }) {
    return { order, shells, nearest, farthest, lag: shellLag, rows: await this.values(halves) };
  }
}

// Whether a primitive's entry holds a technique's transfer.
const holds = {
  sh: entry => Boolean(entry.sh ?? entry.shCompressed),
  ch: entry => Boolean(entry.ch),
  lights: entry => Boolean(entry.lightGroups),
};

// Names of the data on primitives that this module does not light by.
const otherData = { through: 'light through the other side of surfaces', texels: 'transfer at texels', keys: 'transfer at keys of an animation', haar: 'haar',
  glossy: 'glossy', vo: 'vector occluders', horizons: 'horizons', lightmap: 'light map' };
const leftOutOf = entries => Object.keys(otherData).filter(name => entries.some(entry => entry[name])).map(name => otherData[name]);
