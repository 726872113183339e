// Spherical harmonics are real, with the index l (l + 1) + m about z.

// Values of all functions in a unit direction.
function evaluateSh([x, y, z], order) {
  const values = new Float64Array(order * order);
  let real = 1, imaginary = 0, sectoral = Math.sqrt(1 / (4 * Math.PI));
  for (let m = 0; m < order; ++m) {
    if (m > 0) {
      [real, imaginary] = [real * x - imaginary * y, imaginary * x + real * y];
      sectoral *= Math.sqrt((2 * m + 1) / (2 * m));
    }
    let before = 0, p = m > 0 ? Math.SQRT2 * sectoral : sectoral;
    for (let l = m; l < order; ++l) {
      if (l > m) {
        const a = Math.sqrt((4 * l * l - 1) / (l * l - m * m));
        const b = l > 1 ? Math.sqrt(((l - 1) ** 2 - m * m) / (4 * (l - 1) ** 2 - 1)) : 0;
        [before, p] = [p, a * (z * p - b * before)];
      }
      values[l * (l + 1) + m] = p * real;
      if (m > 0) values[l * (l + 1) - m] = p * imaginary;
    }
  }
  return values;
}

// A band of a function turned about +Z.
function turnBandAboutZ(band, l, angle) {
  for (let m = 1; m <= l; ++m) {
    const cosine = Math.cos(m * angle), sine = Math.sin(m * angle), even = band[l + m], odd = band[l - m];
    band[l + m] = cosine * even - sine * odd;
    band[l - m] = sine * even + cosine * odd;
  }
}

// Numbers of a function turned about +Z, [i] RGB.
function turnedAboutZ(numbers, angle) {
  const result = numbers.map(rgb => [...rgb]);
  for (let l = 0; l * l < numbers.length; ++l)
    for (let c = 0; c < 3; ++c) {
      const band = Float64Array.from({ length: 2 * l + 1 }, (_, i) => numbers[l * l + i][c]);
      turnBandAboutZ(band, l, angle);
      band.forEach((value, i) => { result[l * l + i][c] = value; });
    }
  return result;
}

// Numbers of a function turned by a rotation, three columns, as turns about +Z, +Y and +Z.
function turnedBy(numbers, rotation, order) {
  const at = (row, column) => rotation[3 * column + row], rise = Math.hypot(at(0, 2), at(1, 2));
  const tilt = Math.atan2(rise, at(2, 2)), side = Math.sign(at(2, 2));
  const last = rise > 1e-9 ? Math.atan2(at(1, 2), at(0, 2)) : Math.atan2(side * at(1, 0), side * at(0, 0));
  const first = rise > 1e-9 ? Math.atan2(at(2, 1), -at(2, 0)) : 0;
  return turnedAboutZ(turnedAboutY(turnedAboutZ(numbers, first), tilt, order), last);
}

// Numbers of a function turned about +Y, [i] RGB.
function turnedAboutY(numbers, angle, order) {
  const upright = uprightBands(order), result = numbers.slice(0, order * order).map(() => [0, 0, 0]);
  for (let l = 0; l < order && l * l < numbers.length; ++l) {
    const size = 2 * l + 1, first = l * l, matrix = upright[l];
    for (let c = 0; c < 3; ++c) {
      const about = new Float64Array(size);
      for (let k = 0; k < size; ++k)
        for (let j = 0; j < size; ++j) about[k] += matrix[j * size + k] * numbers[first + j][c];
      turnBandAboutZ(about, l, angle);
      for (let j = 0; j < size; ++j)
        for (let k = 0; k < size; ++k) result[first + j][c] += matrix[j * size + k] * about[k];
    }
  }
  return result;
}

// Nodes and weights of Gauss and Legendre on -1..1: sums are exact for polynomials below a degree of twice their count.
function gaussLegendre(count) {
  return Array.from({ length: count }, (_, i) => {
    let node = Math.cos(Math.PI * (i + 0.75) / (count + 0.5)), slope = 1;
    for (let step = 0; step < 100; ++step) {
      let before = 1, p = node;
      for (let l = 2; l <= count; ++l) [before, p] = [p, ((2 * l - 1) * node * p - (l - 1) * before) / l];
      slope = count * (node * p - before) / (node * node - 1);
      node -= p / slope;
      if (Math.abs(p / slope) < 1e-15) break;
    }
    return { node, weight: 2 / ((1 - node * node) * slope * slope) };
  });
}

// [band] matrices, row by row, that take the numbers of a function about z to those of the same function about +Y: its x, y and z
// become z, x and y.
let uprightMatrices = [];
function uprightBands(order) {
  if (uprightMatrices.length >= order) return uprightMatrices;
  const matrices = Array.from({ length: order }, (_, l) => new Float64Array((2 * l + 1) ** 2)), columns = 2 * order;
  for (const { node: z, weight } of gaussLegendre(order))
    for (let column = 0; column < columns; ++column) {
      const angle = 2 * Math.PI * (column + 0.5) / columns, side = Math.sqrt(1 - z * z), x = side * Math.cos(angle), y = side * Math.sin(angle);
      const from = evaluateSh([x, y, z], order), to = evaluateSh([y, z, x], order), area = weight * 2 * Math.PI / columns;
      matrices.forEach((matrix, l) => {
        const size = 2 * l + 1;
        for (let j = 0; j < size; ++j)
          for (let k = 0; k < size; ++k) matrix[j * size + k] += area * to[l * l + j] * from[l * l + k];
      });
    }
  return uprightMatrices = matrices;
}

// Numbers of a function about z, [i] RGB, as those of the same function about +Y.
function madeUpright(about, order) {
  return about.map((_, i) => {
    const l = Math.floor(Math.sqrt(i)), size = 2 * l + 1, matrix = uprightBands(order)[l], row = i - l * l;
    return [0, 1, 2].map(c => {
      let sum = 0;
      for (let k = 0; k < size; ++k) sum += matrix[row * size + k] * about[l * l + k][c];
      return sum;
    });
  });
}

// Numbers of a sky of radiance 1.
const evenLight = order => Array.from({ length: order ** 2 }, (_, i) => new Array(3).fill(i === 0 ? Math.sqrt(4 * Math.PI) : 0));

// [vertex] the share of a sky of radiance 1 that rows [vertex][channel][i] leave; `even`: its numbers in their basis.
function accessibilityOf(rows, channels, even) {
  const used = even.map((rgb, i) => [i, rgb[0]]).filter(([, value]) => value !== 0), length = even.length;
  return Float32Array.from({ length: rows.length / (channels * length) }, (_, v) => {
    let sum = 0;
    for (let c = 0; c < channels; ++c)
      for (const [i, value] of used) sum += value * rows[(v * channels + c) * length + i];
    return Math.max(0, Math.min(1, sum / channels));
  });
}
