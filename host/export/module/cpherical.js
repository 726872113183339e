// "Cpherical" harmonics, which transfer in CH is stored in: docs/notes/bases.md.

// Values of all functions of CH in a unit direction: host/basis/ch.h.
function evaluateCh([x, y, z], order) {
  const values = new Float64Array(order * order), norms = chNorms(order);
  let real = 1, imaginary = 0;
  for (let m = 0; m < order; ++m) {
    if (m > 0) [real, imaginary] = [real * x - imaginary * y, imaginary * x + real * y];
    const chebyshev = chebyshevDerivatives(m, z, order);
    for (let l = m; l < order; ++l) {
      values[l * (l + 1) + m] = norms[l * order + m] * chebyshev[l] * real;
      if (m > 0) values[l * (l + 1) - m] = norms[l * order + m] * chebyshev[l] * imaginary;
    }
  }
  return values;
}

// [l] the m-th derivative of the Chebyshev polynomial of degree l.
function chebyshevDerivatives(m, z, order) {
  // T(l) = 2 z T(l - 1) - T(l - 2), derived once more each time.
  let lower = new Array(order).fill(0), values = lower;
  for (let d = 0; d <= m; ++d) {
    values = new Array(order).fill(0);
    for (let l = 0; l < order; ++l)
      values[l] = l < 2 ? (d === 0 ? (l === 0 ? 1 : z) : d === 1 && l === 1 ? 1 : 0)
        : 2 * z * values[l - 1] + (d > 0 ? 2 * d * lower[l - 1] : 0) - values[l - 2];
    lower = values;
  }
  return values;
}

// [l][m] factors that make the norm over the sphere 1.
const chNormsOfOrders = {};
function chNorms(order) {
  if (chNormsOfOrders[order]) return chNormsOfOrders[order];
  const squares = new Float64Array(order * order);
  for (const { node: z, weight } of gaussLegendre(order))
    for (let m = 0; m < order; ++m) {
      const chebyshev = chebyshevDerivatives(m, z, order);
      for (let l = m; l < order; ++l)
        squares[l * order + m] += weight * Math.PI * (m === 0 ? 2 : 1) * (1 - z * z) ** m * chebyshev[l] ** 2;
    }
  return chNormsOfOrders[order] = squares.map(square => square > 0 ? 1 / Math.sqrt(square) : 0);
}

// [m][l][k] the share of SH of band k in CH of band l.
function chBasisOf(order) {
  const basis = new Float32Array(order ** 3);
  for (const { node: z, weight } of gaussLegendre(order)) {
    const w = [Math.sqrt(1 - z * z), 0, z], ch = evaluateCh(w, order), sh = evaluateSh(w, order);
    for (let m = 0; m < order; ++m)
      for (let l = m; l < order; ++l)
        for (let k = l; k >= m; k -= 2) basis[(m * order + l) * order + k] += weight * Math.PI * (m === 0 ? 2 : 1) * ch[l * (l + 1) + m] * sh[k * (k + 1) + m];
  }
  return basis;
}

// Moments of CH of a function given in SH, [i] of numbers; `basis`: [m][l][k].
function momentsOfCh(numbers, basis, order) {
  const moments = new Float64Array(numbers.length);
  for (let m = 0; m < order; ++m)
    for (let l = m; l < order; ++l)
      for (let k = l; k >= m; k -= 2) {
        const b = basis[(m * order + l) * order + k];
        moments[l * (l + 1) + m] += b * numbers[k * (k + 1) + m];
        if (m > 0) moments[l * (l + 1) - m] += b * numbers[k * (k + 1) - m];
      }
  return moments;
}

// Moments of CH of a light given in SH, [i] RGB.
function momentsOfLight(numbers, basis, order) {
  const channels = [0, 1, 2].map(c => momentsOfCh(numbers.map(rgb => rgb[c]), basis, order));
  return numbers.map((_, i) => channels.map(channel => channel[i]));
}
