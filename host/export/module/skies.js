// The light of a sky comes from a picture, equirectangular, whose centre looks along -Z, whose u grows towards +X and whose row 0 is at +Y.

// Integrals of a picture's radiance times the functions of SH, [i] RGB: exact in azimuth, and by nodes in each row's height.
function projectedSky({ width, height, colors }, order) {
  const about = Array.from({ length: order ** 2 }, () => [0, 0, 0]), nodes = gaussLegendre(4);
  const waves = Array.from({ length: order }, (_, m) => Float64Array.from({ length: 2 * width }, (_, i) => {
    const angle = -2 * Math.PI * ((i >> 1) + 0.5) / width, chord = m === 0 ? 2 * Math.PI / width : 2 * Math.sin(m * Math.PI / width) / m;
    return chord * (i % 2 === 0 ? Math.cos(m * angle) : Math.sin(m * angle));
  }));
  for (let row = 0; row < height; ++row) {
    const polar = new Float64Array(order ** 2), upper = Math.cos(Math.PI * row / height), lower = Math.cos(Math.PI * (row + 1) / height);
    for (const { node, weight } of nodes) {
      const z = 0.5 * (upper + lower + node * (upper - lower)), values = evaluateSh([Math.sqrt(Math.max(1 - z * z, 0)), 0, z], order);
      for (let i = 0; i < values.length; ++i) polar[i] += 0.5 * (upper - lower) * weight * values[i];
    }
    for (let m = 0; m < order; ++m) {
      const even = [0, 0, 0], odd = [0, 0, 0];
      for (let column = 0, at = 3 * row * width; column < width; ++column)
        for (let c = 0; c < 3; ++c, ++at) {
          even[c] += waves[m][2 * column] * colors[at];
          odd[c] += waves[m][2 * column + 1] * colors[at];
        }
      for (let l = m; l < order; ++l)
        for (let c = 0; c < 3; ++c) {
          const zonal = l * (l + 1), p = polar[zonal + m];
          about[zonal + m][c] += p * even[c];
          if (m > 0) about[zonal - m][c] += p * odd[c];
        }
    }
  }
  return madeUpright(about, order);
}

// Numbers of a sky smoothed by a strength.
function smoothedBy(numbers, strength) {
  return numbers.map((rgb, i) => {
    const l = Math.floor(Math.sqrt(i));
    return scale(rgb, 1 / (1 + strength * (l * (l + 1)) ** 2));
  });
}

// The weakest smoothing with which a sky is negative nowhere: sh::minimalWindow() of host/basis/sh_zonal.h, on a grid.
function smoothingOf(numbers, order) {
  const sums = [];  // [direction and channel][band]
  const columns = 8 * order, cells = gaussLegendre(4 * order);
  for (const { node: z } of cells)
    for (let column = 0; column < columns; ++column) {
      const angle = 2 * Math.PI * column / columns, side = Math.sqrt(1 - z * z), values = evaluateSh([side * Math.cos(angle), side * Math.sin(angle), z], order);
      for (let c = 0; c < 3; ++c) {
        const bands = new Float64Array(order);
        for (let l = 0; l < order; ++l)
          for (let i = l * l; i < (l + 1) ** 2; ++i) bands[l] += values[i] * numbers[i][c];
        sums.push(bands);
      }
    }
  const isPositive = strength => {
    const factors = Array.from({ length: order }, (_, l) => 1 / (1 + strength * (l * (l + 1)) ** 2));
    return sums.every(bands => factors.reduce((sum, factor, l) => sum + factor * bands[l], 0) >= -1e-9 * bands[0]);
  };
  if (isPositive(0)) return 0;
  let low = 0, high = 1e-6;
  while (!isPositive(high) && high < 1e6) high *= 4;
  for (let step = 0; step < 40 && high - low > 0.02 * high; ++step) {
    const middle = 0.5 * (low + high);
    if (isPositive(middle)) high = middle;
    else low = middle;
  }
  return high;
}

// The light of a picture of the sky, {width, height, colors}: numbers of any order, and its lamps apart.
class SkyLight {
  constructor(picture) {
    const { lamps, rest } = withoutItsLamps(picture);
    this.lamps = lamps;
    this.picture = rest;
    this.orders = {};
  }

  // {numbers [i] RGB, smoothing}, without the lamps.
  ofOrder(order) {
    if (!this.orders[order]) {
      const numbers = projectedSky(this.picture, order);
      this.orders[order] = { numbers, smoothing: smoothingOf(numbers, order) };
    }
    return this.orders[order];
  }
}
