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

// What takes the scene to a camera of these axes and this place.
function viewMatrix(right, up, back, position) {
  const axes = [right, up, back];
  const m = new Array(16).fill(0);
  for (let row = 0; row < 3; ++row) {
    for (let column = 0; column < 3; ++column) m[4 * column + row] = axes[row][column];
    m[12 + row] = -dot(axes[row], position);
  }
  m[15] = 1;
  return m;
}

function perspectiveMatrix(halfHeight, aspect, near, far) {
  const f = 1 / halfHeight;
  const m = new Array(16).fill(0);
  m[0] = f / aspect;
  m[5] = f;
  m[10] = (far + near) / (near - far);
  m[11] = -1;
  m[14] = 2 * far * near / (near - far);
  return m;
}

function orthographicMatrix(halfWidth, halfHeight, near, far) {
  const m = new Array(16).fill(0);
  m[0] = 1 / halfWidth;
  m[5] = 1 / halfHeight;
  m[10] = 2 / (near - far);
  m[14] = (far + near) / (near - far);
  m[15] = 1;
  return m;
}
