// SH transfer at the texels of charts, beside that of vertices: lit texel by texel, once a light.
class ChartMaps {
  constructor(gl, scene, { order, channels, border, side, layers, maps }) {
    Object.assign(this, { gl, order, channels, border, coords: texelTexture(gl, scene.data.array('chartCoords'), 4) });
    this.maps = maps.map(map => ({ ...map, numbers: scene.data.numbers(map.array), places: scene.data.numbers(map.places) }));
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.texture);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RGBA16F, side, side, layers);
    setPlainFilter(gl, gl.TEXTURE_2D_ARRAY);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D_ARRAY, name, gl.LINEAR);
  }

  // `numbers`: of a sky, [i] RGB, `smooth`: as smoothed; `lamps`: lights that shine through the transfer.
  light(numbers, smooth, lamps) {
    const { gl, border } = this;
    for (const map of this.maps) {
      const width = map.width + 2 * border, height = map.height + 2 * border, texels = new Float32Array(4 * width * height).fill(1);
      for (let y = 0; y < height; ++y)
        for (let x = 0; x < width; ++x) {
          const row = Math.max(0, Math.min(map.height - 1, y - border)), column = Math.max(0, Math.min(map.width - 1, x - border));
          this.lightTexel(map, row * map.width + column, numbers, smooth, lamps, texels, 4 * (y * width + x));
        }
      gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.texture);
      gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, ...map.place, width, height, 1, gl.RGBA, gl.FLOAT, texels);
    }
  }

  // Numbers of a texel times those of a light, by the channel.
  sums(map, texel, numberOf) {
    const length = this.order ** 2;
    return [0, 1, 2].map(c => {
      const from = (texel * this.channels + Math.min(c, this.channels - 1)) * length;
      let sum = 0;
      for (let i = 0; i < length; ++i) sum += map.numbers[from + i] * numberOf(i, c);
      return sum;
    });
  }

  lightTexel(map, texel, numbers, smooth, lamps, texels, to) {
    const least = this.sums(map, texel, (i, c) => smooth[i][c]);
    let sum = this.sums(map, texel, (i, c) => numbers[i][c]).map((value, c) => Math.max(value, 0.25 * least[c]));
    const place = map.places.subarray(6 * texel, 6 * texel + 6), point = [...place.subarray(0, 3)], normal = [...place.subarray(3, 6)];
    for (const lamp of lamps)
      sum = add(sum, lampThrough(lamp, point, normal, this.channels === 1 && !map.bumped, (toLamp, cosine) => {
        const values = evaluateSh(toLamp, this.order);
        return [this.sums(map, texel, i => values[i]), openTowards(cosine, this.order)];
      }));
    sum.forEach((value, c) => { texels[to + c] = Math.max(value, 0); });
  }
}
