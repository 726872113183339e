// Draws a picture of the scene as viewer/frame/renderer.cpp does.
const knowsLightAlone = ambient => ['transferred_ambient.glsl', 'light_map_ambient.glsl'].includes(ambient);

class Renderer {
  constructor(gl, page, data, shaders, textures) {
    Object.assign(this, { gl, page, data, shaders, programs: new Map(), target: null });
    this.vertices = page.vertices;
    this.triangles = page.triangles;
    this.nothing = emptyTextures(gl);
    this.materials = textures;
    this.textures = this.sceneTextures();
    this.motion = page.motion ? new Motion(page, data) : null;
    this.geometry = this.motion ? new MovedGeometry(gl, data, this.motion, this.textures) : null;
    this.frame = this.uniformBuffer('Frame', 384);
    this.lightBuffer = this.uniformBuffer('Lights', 64 * mostLights);
    this.skies = new Skies(gl, page, data);
    this.techniques = [...page.techniques, page.before].map(description =>
      new DrawnTechnique(description, () => (techniqueMakers[description.name] ?? makeOfNumbers)(gl, shaders, this, description.transfer)));
    this.present = new Program(gl, shaders.of('fullscreen.vert'), shaders.of('present.frag'));
    gl.bindVertexArray(gl.createVertexArray());
  }

  uniformBuffer(block, size) {
    const { gl } = this, buffer = gl.createBuffer();
    gl.bindBufferBase(gl.UNIFORM_BUFFER, bindingOf(gl, block), buffer);
    gl.bufferData(gl.UNIFORM_BUFFER, size, gl.DYNAMIC_DRAW);
    return buffer;
  }

  sceneTextures() {
    const { gl, data } = this;
    const texels = (name, components) => data.has(name) ? texelTexture(gl, data.array(name), components) : null;
    return {
      triangleCorners: texels('triangles', 3), cornerPositions: texels('positions', 3), vertexNormals: texels('normals', 3),
      vertexTexCoords: texels('texCoords', 4), vertexColors: texels('colors', 4), triangleNormals: texels('triangleNormals', 4),
      cornerTangents: texels('tangents', 4), albedos: texels('albedos', 4), lampTables: texels('lampTables', 4),
      vertexOpen: openTexture(gl, null, new Float32Array(this.vertices).fill(1)),
      vertexUnknown: openTexture(gl, null, new Float32Array(this.vertices).fill(-1)),  // stands for what shaders find from the light that arrives
    };
  }

  // The sky that vertices see by ambient occlusion, where the page has that: viewer/techniques/ambient_occlusion/open_sky_pass.cpp.
  openSky() {
    const array = this.technique('ao')?.description.transfer.array;
    if (array && !this.textures.openSky) this.textures.openSky = texelTexture(this.gl, this.data.numbers(array), 4);
    return this.textures.openSky;
  }

  technique(name) { return this.techniques.find(technique => technique.description.name === name); }

  fillLights(lights) {
    const { gl } = this;
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.lightBuffer);
    gl.bufferSubData(gl.UNIFORM_BUFFER, 0, lightBlock(lights));
  }

  // Those that shaders look at: not what the transfer holds where nothing else reflects it.
  shownLights(lights, rules) {
    const throughNone = 0, throughAll = 2, everywhere = 0, throughTransfer = 2;
    const someHas = feature => this.page.surfaces.some(surface => surface.features.includes(feature));
    const reflects = rules.reflectionRule === everywhere || someHas('hasGloss') || (rules.reflectionRule === throughTransfer && someHas('hasLayer'));
    return lights.filter(light => reflects || rules.throughRule === throughNone || !(rules.throughRule === throughAll || light.throughTransfer));
  }

  fillFrame(view, aspect, height, lights, lampsApart) {
    const { gl } = this, { sky, angle, camera } = view, m = camera.matrices(aspect);
    const c = Math.cos(angle), s = Math.sin(angle);
    const texel = 2 * Math.PI / sky.width, pixel = camera.perspective ? 2 * camera.halfHeight(aspect) / height : texel;
    const frame = new Float32Array(96);
    frame.set([...m.clipFromScene, c, 0, s, 0, 0, 1, 0, 0, -s, 0, c, 0, 0, 0, 0, 1, ...m.eye, ...m.forward, ...m.pixelRight, ...m.pixelUp, 1, 1, 0, 0,
      ...this.skies.ambient(lampsApart ? this.skies.withoutLamps(sky) : sky, angle), Math.log2(texel), Math.max(0, Math.log2(pixel / texel)), flag(lampsApart), 0]);
    new Int32Array(frame.buffer).set([lights.length, lights.filter(light => !light.isSample).length, 1, 0], 92);
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.frame);
    gl.bufferSubData(gl.UNIFORM_BUFFER, 0, frame);
  }

  program(vertex, fragment, variant) {
    const key = fragment + JSON.stringify(variant);
    if (!this.programs.has(key)) this.programs.set(key, new Program(this.gl, this.shaders.of(vertex, variant), this.shaders.of(fragment, variant)));
    return this.programs.get(key);
  }

  // Of the sky and the lights.
  lightVariant(view, lights, rules) {
    return { ...rules, ...lightFeatures(lights), hasVertexColors: this.data.has('colors'), hasSkyLight: !view.sky.isDark,
      hasSkyMap: view.sky.width > 1 || view.sky.height > 1 };
  }

  drawBatches(batches, variant, drawn, sky, blendedChannel = -1) {
    const { gl } = this, { vertices } = drawn;
    const { shadows } = drawn;
    const shared = { ...this.textures, ...drawn.textures, lampVisibilities: shadows?.capture.texture, vertexLight: vertices.light, vertexLightNext: vertices.lightNext ?? vertices.light, vertexGlow: vertices.glow, skyMap: sky.texture, skyLobes: sky.lobes };
    const lightAlone = knowsLightAlone(variant.ambient), openSky = lightAlone ? this.openSky() : null;
    const open = openSky ?? vertices.open ?? (lightAlone ? this.textures.vertexUnknown : null);
    if (open) shared.vertexOpen = open;
    const uniforms = { ...drawn.uniforms, blendedChannel, lightStride: vertices.stride, lightShare: vertices.lightShare ?? 0, knowsThrough: flag(vertices.knowsThrough), causticCorner: [0, 0, 0, 0], vertexHasCharts: flag(drawn.charts), lampStreams: [shadows?.streams ?? 0, this.vertices, 0, 0],
      vertexHas: [this.data.has('texCoords'), this.data.has('colors'), openSky ?? vertices.hasBentNormals, vertices.glow].map(flag) };
    let used = null;
    for (const batch of batches) {
      const surface = this.page.surfaces[batch.surface];
      const features = Object.fromEntries(surface.features.map(name => [name, true]));
      const program = this.program('surface.vert', 'surface.frag', { ...variant, ...features });
      if (program !== used) {
        program.use();
        program.set(uniforms);
        used = program;
      }
      program.set(surface.uniforms);
      program.bind(this.nothing, shared, Object.fromEntries(surface.textures.map(({ name, texture }) => [name, this.materials[texture]])));
      (surface.doubleSided ? gl.disable : gl.enable).call(gl, gl.CULL_FACE);
      gl.drawArrays(gl.TRIANGLES, 3 * batch.firstTriangle, 3 * batch.triangleCount);
    }
  }

  drawBackground(view, variant) {
    const { gl } = this;
    if (!variant.hasSkyMap || view.sky.isDark) return;
    const program = this.program('fullscreen.vert', 'background.frag', { hasSkyLight: true, hasSkyMap: true });
    program.use();
    program.set({ emitted: 1 });
    program.bind(this.nothing, { skyMap: view.sky.texture });
    gl.disable(gl.CULL_FACE);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // One shading into the part of the target that is open.
  drawShading(name, view, width, height, samples) {
    const { gl } = this, technique = this.technique(name), { rules } = technique.description;
    const drawn = technique.lit(view);
    const own = this.shownLights(view.lightsOf(drawn.asSamples), rules).map(light => drawn.shadows && !light.throughTransfer ? light : { ...light, shadow: -1 });
    const lampsApart = rules.takesLamps && Boolean(view.sky.apart);
    const lights = lampsApart ? withLampsOfSky(own, this.skies.lampsOf(view.sky, view.angle)) : own;
    drawn.shadows?.run(lights, drawn.poseOfShells);
    const variant = { ...this.lightVariant(view, lights, rules), hasCharts: Boolean(drawn.charts), hasNearLamps: lights.some(({ shadow }) => shadow >= 0) };
    this.fillFrame(view, width / height, height, lights, lampsApart);
    this.fillLights(lights);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target.framebuffer);
    gl.viewport(0, 0, width * samples, height * samples);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
    const even = view.sky.isDark || variant.hasSkyMap ? [0, 0, 0] : view.sky.coefficients[0].map(c => c * 0.282094792);
    gl.clearColor(...even, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.drawBatches(this.page.batches.filter(batch => !this.page.surfaces[batch.surface].blended), variant, drawn, view.sky);
    gl.depthMask(false);
    this.drawBackground(view, variant);
    this.drawBlended(view, variant, drawn);
    gl.depthMask(true);
  }

  // A channel at a time, as there is no second source of blending; so surfaces of one batch that lie behind one another are blended in turn.
  drawBlended(view, variant, drawn) {
    const { gl } = this;
    const distance = batch => length(subtract(batch.center, view.camera.position));
    const batches = this.page.batches.filter(batch => this.page.surfaces[batch.surface].blended).sort((a, b) => distance(b) - distance(a));
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.SRC_ALPHA);
    for (const batch of batches) {
      for (let channel = 0; channel < 3; ++channel) {
        gl.colorMask(channel === 0, channel === 1, channel === 2, false);
        this.drawBatches([batch], variant, drawn, view.sky, channel);
      }
    }
    gl.colorMask(true, true, true, true);
    gl.disable(gl.BLEND);
  }

  makeTarget(width, height) {
    if (this.target && this.target.width === width && this.target.height === height) return;
    this.target?.delete();
    this.target = new Target(this.gl, width, height);
  }

  // `view`: {technique, split, sky, angle, time, camera, lightsOf, groupFactors, exposure}. Left of `split`, a part of the width, the same
  // light without what was baked.
  draw(view, width, height, samples) {
    const { gl } = this, full = { ...view, skies: this.skies };
    this.makeTarget(width * samples, height * samples);
    this.geometry?.stand(view.time);
    const edge = Math.round(view.split * width) * samples;
    gl.enable(gl.SCISSOR_TEST);
    for (const [name, x, end] of [[this.page.before.name, 0, edge], [view.technique, edge, width * samples]]) {
      if (end <= x) continue;
      gl.scissor(x, 0, end - x, height * samples);
      this.drawShading(name, full, width, height, samples);
    }
    gl.disable(gl.SCISSOR_TEST);
  }

  // The picture with the viewer's tone mapping.
  show(exposure, samples) {
    const { gl, target } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, target.width / samples, target.height / samples);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.disable(gl.BLEND);
    this.present.use();
    this.present.set({ samplesPerAxis: samples, exposure });
    this.present.bind(this.nothing, { picture: target.color });
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // Linear radiance of the target, rows from the top, RGB.
  radiance(samples) {
    const { gl, target } = this, { width, height } = target;
    const texels = new Float32Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, texels);
    const columns = width / samples, rows = height / samples, result = new Float32Array(3 * columns * rows);
    for (let y = 0; y < height; ++y)
      for (let x = 0; x < width; ++x) {
        const to = 3 * ((rows - 1 - Math.floor(y / samples)) * columns + Math.floor(x / samples)), from = 4 * (y * width + x);
        for (let c = 0; c < 3; ++c) result[to + c] += texels[from + c] / samples ** 2;
      }
    return result;
  }
}
