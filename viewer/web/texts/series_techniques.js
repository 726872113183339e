// Light through stored transfer that is a sum of products, for each shading.
const nearLampsOf = (gl, shaders, scene, transfer) => new NearLamps(gl, shaders, scene, { ...transfer, rows: scene.data.array(transfer.array) });

// SH or CH.
class HarmonicTechnique {
  constructor(gl, shaders, scene, transfer, isCh) {
    const basis = isCh ? scene.data.array('chBasis') : null;
    this.order = transfer.order;
    this.sides = transfer.sides;
    this.scene = scene;
    this.series = new Series(gl, shaders, scene, { ...transfer, rows: scene.data.array(transfer.array), count: transfer.order ** 2, basis, points: transfer.sides });
    this.open = openTexture(gl, null, this.accessibility(transfer));
    this.vertices = { open: this.open };
    if (transfer.nearLamps) this.nearLamps = nearLampsOf(gl, shaders, scene, transfer.nearLamps);
    if (transfer.charts) {
      this.charts = new ChartMaps(gl, scene, transfer.charts);
      this.textures = { lightMaps: this.charts.texture, vertexCharts: this.charts.coords };
    }
    this.keyed = !isCh && scene.motion?.keys ? new KeyedSeries(gl, shaders, scene) : null;
    this.followsTime = this.keyed !== null;
  }

  // What the transfer leaves of a sky of radiance 1, [vertex].
  accessibility({ array, channels }) {
    const even = this.series.seen(evenLight(this.order)), each = accessibilityOf(this.scene.data.numbers(array), channels, even);
    return Float32Array.from({ length: this.scene.vertices }, (_, v) => each[v * this.sides]);
  }

  light({ lights, skies, sky, angle, time }) {
    const near = lights.filter(isTransferred);
    if (this.charts) {
      const seen = skies.turned(sky, angle, this.charts.order);
      this.charts.light(seen, skies.smoothed(seen, sky, this.charts.order), near);
    }
    const numbers = skies.turned(sky, angle, this.order), smooth = skies.smoothed(numbers, sky, this.order);
    if (this.keyed && time !== null) return Object.assign(this.vertices, this.keyed.run(numbers, smooth, near, time));
    this.series.run(numbers, smooth, near);
    Object.assign(this.vertices, { light: this.series.result.texture, stride: this.sides, knowsThrough: this.sides > 1, lightNext: null, lightShare: 0 });
  }
}

// Matrices, [vertex][i] rows: what arrives is kept for techniques/glossy/glossy.glsl, and its first number is diffuse light.
class GlossyTechnique {
  constructor(gl, shaders, scene, transfer) {
    const { data } = scene, rows = transfer.order ** 2;
    this.order = transfer.order;
    this.series = new Series(gl, shaders, scene, { ...transfer, rows: data.array(transfer.array), count: rows, points: rows });
    this.vertices = { stride: rows, open: openTexture(gl, null, data.numbers('glossyOpen')) };
    this.textures = { lobes: texelTexture(gl, data.array('lobes'), 2), measuredLobes: texelTexture(gl, data.array('measuredLobes'), 4) };
    this.uniforms = { glossyOrder: transfer.order, lobeIsBrdf: 0 };
    if (transfer.nearLamps) this.nearLamps = nearLampsOf(gl, shaders, scene, transfer.nearLamps);
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
    this.series = new Series(gl, shaders, scene, { ...transfer, rows: scene.data.array(transfer.array), count: transfer.groups.length, order: 0 });
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
