// Spherical harmonics, real, index l (l + 1) + m about z, and what they are in "cpherical" ones (docs/notes/bases.md).

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

// The same by a rotation, three columns, as turns about +Z, +Y and +Z.
function turnedBy(numbers, rotation, upright, order) {
  const at = (row, column) => rotation[3 * column + row], rise = Math.hypot(at(0, 2), at(1, 2));
  const tilt = Math.atan2(rise, at(2, 2)), side = Math.sign(at(2, 2));
  const last = rise > 1e-9 ? Math.atan2(at(1, 2), at(0, 2)) : Math.atan2(side * at(1, 0), side * at(0, 0));
  const first = rise > 1e-9 ? Math.atan2(at(2, 1), -at(2, 0)) : 0;
  return turnedAboutZ(turnedAboutY(turnedAboutZ(numbers, first), tilt, upright, order), last);
}

// Numbers of a function turned about +Y, [i] RGB. `upright`: [band], the matrix that takes what is about z to what is about +Y.
function turnedAboutY(numbers, angle, upright, order) {
  const result = numbers.slice(0, order * order).map(() => [0, 0, 0]);
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
