// Vectors are arrays of three, matrices of sixteen numbers, column by column.
const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = a => Math.hypot(...a);
const normalize = a => scale(a, 1 / Math.max(length(a), 1e-30));

// A vector turned about a unit axis.
function turned(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return add(add(scale(v, c), scale(cross(axis, v), s)), scale(axis, dot(axis, v) * (1 - c)));
}

function multiply(a, b) {
  const result = new Array(16).fill(0);
  for (let column = 0; column < 4; ++column)
    for (let row = 0; row < 4; ++row)
      for (let k = 0; k < 4; ++k) result[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return result;
}

function transformed(m, v) {
  return [0, 1, 2, 3].map(row => m[row] * v[0] + m[4 + row] * v[1] + m[8 + row] * v[2] + m[12 + row]);
}

// Matrices of three columns: nine numbers.
const cofactors = ([a, b, c, d, e, f, g, h, i]) =>
  [e * i - f * h, f * g - d * i, d * h - e * g, c * h - b * i, a * i - c * g, b * g - a * h, b * f - c * e, c * d - a * f, a * e - b * d];
const times = (m, [x, y, z]) => [0, 1, 2].map(row => m[row] * x + m[3 + row] * y + m[6 + row] * z);
const transposed = ([a, b, c, d, e, f, g, h, i]) => [a, d, g, b, e, h, c, f, i];
const product = (m, n) => [0, 3, 6].flatMap(k => times(m, n.slice(k, k + 3)));
const determinant = m => dot(m.slice(0, 3), cofactors(m).slice(0, 3));
const inverse = m => transposed(cofactors(m)).map(x => x / determinant(m));

// The rotation nearest to a linear map (host/techniques/sh/vertex_turns.cpp); the identity where that flattens or mirrors.
function rotationOf(map) {
  const identity = [1, 0, 0, 0, 1, 0, 0, 0, 1];
  let rotation = map;
  for (let step = 0; step < 32; ++step) {
    if (!(determinant(rotation) > 0)) return identity;
    const other = transposed(inverse(rotation));
    rotation = rotation.map((x, i) => 0.5 * (x + other[i]));
  }
  return rotation;
}
