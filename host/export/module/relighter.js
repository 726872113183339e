// Relights the meshes of a baked model in three.js (0.162 or later, WebGLRenderer).
const mostShownLamps = 8;
const turnOfThree = -Math.PI / 2;  // the middle of a sky's picture is along +X in three.js, and along -Z in Prelight

// The picture of a sky's texture, rows from the top: textures of EXRLoader begin at the bottom, those of HDRLoader (RGBELoader until about
// r180) are turned when they are uploaded.
function pictureOf({ image: { width, height, data }, flipY }) {
  const valueOf = data instanceof Uint16Array ? numberOfHalf : value => value, components = data.length / (width * height);
  const colors = new Float32Array(3 * width * height);
  for (let row = 0; row < height; ++row)
    for (let column = 0; column < width; ++column)
      for (let c = 0; c < 3; ++c)
        colors[3 * (row * width + column) + c] = Math.max(0, valueOf(data[components * ((flipY ? row : height - 1 - row) * width + column) + c]));
  return { width, height, colors };
}

// Returns a light of three.js as pages have theirs.
function lampOf(THREE, light) {
  const place = light.getWorldPosition(new THREE.Vector3()), color = light.color.toArray().map(value => value * light.intensity);
  const way = light.target ? light.target.getWorldPosition(new THREE.Vector3()).sub(place).normalize() : new THREE.Vector3(0, -1, 0);
  const common = { position: place.toArray(), direction: way.toArray(), intensity: color, mean: color, range: light.distance ?? 0, cone: [0, 1], radius: 0,
    leastDistance: 1e-3, shadow: -1 };
  if (light.isDirectionalLight) return { ...common, kind: kinds.directional };
  if (!light.isSpotLight) return { ...common, kind: kinds.point };
  const outer = Math.cos(light.angle), inner = Math.cos(light.angle * (1 - light.penumbra)), slope = 1 / Math.max(inner - outer, 1e-3);
  return { ...common, kind: kinds.spot, cone: [slope, -outer * slope] };
}

// The triangles that a mesh of a glowing material emits light from, in the world; pictures of the glow are left out.
function glowingTriangles(THREE, mesh) {
  const { material: { emissive, emissiveIntensity, side }, geometry: { attributes: { position }, index } } = mesh, corner = new THREE.Vector3();
  const radiance = emissive.toArray().map(value => value * emissiveIntensity), count = index ? index.count : position.count;
  return Array.from({ length: Math.floor(count / 3) }, (_, t) => ({ radiance, twoSided: side === THREE.DoubleSide,
    corners: [0, 1, 2].map(k => corner.fromBufferAttribute(position, index ? index.getX(3 * t + k) : 3 * t + k).applyMatrix4(mesh.matrixWorld).toArray()) }));
}

const glows = ({ isMesh, material, visible }) => isMesh && visible && material.emissive && !material.emissiveMap && luminanceOf(material.emissive.toArray()) * material.emissiveIntensity > 0;

const isLamp = object => object.isDirectionalLight || object.isPointLight || object.isSpotLight;

// One mesh with the transfer of its vertices, which passes over vertices take for their scene.
class RelitMesh {
  constructor(relighter, mesh, baked) {
    const { gl, THREE } = relighter;
    Object.assign(this, { relighter, mesh, gl, baked, nothing: relighter.nothing, keepsBuffers: true, by: null });
    this.own = { geometry: mesh.geometry, material: mesh.material };
    this.geometry = this.copiedGeometry(mesh.geometry);
    this.vertices = this.geometry.attributes.position.count;
    this.bakedTurn = new THREE.Matrix4().copy(relighter.root.matrixWorld).invert().multiply(mesh.matrixWorld);
    this.textures = {};
    mesh.geometry = this.geometry;
    this.addPasses();
  }

  // Meshes that share a geometry stand in light of their own.
  copiedGeometry(geometry) {
    const copy = new this.relighter.THREE.BufferGeometry().setIndex(geometry.index);
    for (const name in geometry.attributes) copy.setAttribute(name, geometry.attributes[name]);
    Object.assign(copy, { morphAttributes: geometry.morphAttributes, morphTargetsRelative: geometry.morphTargetsRelative, groups: geometry.groups,
      boundingSphere: geometry.boundingSphere, boundingBox: geometry.boundingBox, userData: geometry.userData });
    return copy;
  }

  addPasses() {
    const { relighter: { THREE, shaders }, gl, baked: { harmonics, isCh, nearLamps, groups } } = this;
    let open = null;
    if (harmonics) {
      const { order, channels } = harmonics, basis = isCh ? chBasisOf(order) : null;
      this.pass = harmonics.rows ? new Series(gl, shaders, this, { ...harmonics, basis, count: order ** 2 }) : new ClusterSeries(gl, shaders, this, harmonics);
      open = this.accessibility(order, channels, basis);
    }
    this.geometry.setAttribute('prelightOpen', new THREE.BufferAttribute(open ?? new Float32Array(this.vertices), 1));
    if (nearLamps) this.shadows = new NearLamps(gl, shaders, this, nearLamps, 1);
    if (groups) this.groups = new Series(gl, shaders, this, { ...groups, order: 0 });
  }

  accessibility(order, channels, basis) {
    const even = evenLight(order), { harmonics } = this.baked;
    if (harmonics.rows) return accessibilityOf(harmonics.rows, channels, basis ? momentsOfLight(even, basis, order) : even);
    const terms = this.pass.terms(even).map(([r, g, b]) => (r + g + b) / 3), count = harmonics.componentCount;
    return Float32Array.from(harmonics.clusterOf, (cluster, v) => {
      let sum = terms[cluster * (1 + count)];
      for (let j = 0; j < count; ++j) sum += harmonics.weights[v * count + j] * terms[cluster * (1 + count) + 1 + j];
      return Math.max(0, Math.min(1, sum));
    });
  }

  fillLights(lights) { this.relighter.fillLights(lights); }

  // Finds where the mesh stands, if it has moved: how it has turned since its bake, and its vertices' places where lamps need them.
  stand(needsPlaces) {
    const at = this.mesh.matrixWorld.elements.join();
    if (at !== this.turnedAt) this.turn = this.turnSinceBake();
    if (needsPlaces && at !== this.placedAt) {
      this.place();
      this.placedAt = at;
    }
    this.turnedAt = at;
  }

  turnSinceBake() {
    const { THREE } = this.relighter, since = new THREE.Matrix4().copy(this.mesh.matrixWorld).multiply(new THREE.Matrix4().copy(this.bakedTurn).invert());
    const turn = transposed(rotationOf(new THREE.Matrix3().setFromMatrix4(since).elements));
    return turn.every((value, i) => Math.abs(value - noTurn[i]) < 1e-6) ? undefined : turn;
  }

  // Places and normals of the vertices in the world.
  place() {
    const { THREE } = this.relighter, { matrixWorld } = this.mesh, { position } = this.geometry.attributes;
    let { normal } = this.geometry.attributes;
    if (!normal) {
      const plain = this.copiedGeometry(this.geometry);
      plain.computeVertexNormals();
      normal = plain.attributes.normal;
    }
    const places = new Float32Array(3 * this.vertices), normals = new Float32Array(3 * this.vertices), v = new THREE.Vector3(), around = new THREE.Matrix3().getNormalMatrix(matrixWorld);
    for (let i = 0; i < this.vertices; ++i) {
      v.fromBufferAttribute(position, i).applyMatrix4(matrixWorld).toArray(places, 3 * i);
      v.fromBufferAttribute(normal, i).applyMatrix3(around).normalize().toArray(normals, 3 * i);
    }
    this.textures.cornerPositions = texelTexture(this.gl, places, 3, this.textures.cornerPositions);
    this.textures.vertexNormals = texelTexture(this.gl, normals, 3, this.textures.vertexNormals);
  }

  // `light`: {numbers, smooth, far, near, groups} of the relighter.
  run(light) {
    const takesShadows = this.shadows && light.near.length > 0;
    this.stand(takesShadows || (this.pass && light.far.length > 0));
    const parts = [{ first: 0, count: this.vertices, turn: this.turn }];
    if (this.pass) {
      const { numbers, smooth } = light.ofOrder(this.baked.harmonics.order);
      this.pass.run(numbers, smooth, light.far, parts);
    }
    if (takesShadows) this.shadows.run(light.near, { key: this.mesh.matrixWorld.elements, parts });
    if (this.groups) this.groups.run(light.groups(this.baked.groups.count));
    this.attach('prelightLight', this.pass?.result);
    this.attach('prelightShadows', this.shadows?.capture);
    this.attach('prelightGroups', this.groups?.result);
  }

  // Gives the mesh its own geometry and material again.
  dispose() {
    const { mesh, geometry, own } = this;
    Object.assign(mesh, own);
    for (const name in own.geometry.attributes) geometry.deleteAttribute(name);  // the model goes on with these
    geometry.morphAttributes = {};
    geometry.setIndex(null).dispose();
    for (const pass of [this.pass, this.shadows, this.groups]) pass?.delete();
    for (const texture of Object.values(this.textures)) this.gl.deleteTexture(texture);
  }

  attach(name, capture) {
    if (!capture || this.geometry.attributes[name]) return;
    this.geometry.setAttribute(name, new this.relighter.THREE.GLBufferAttribute(capture.buffer, this.gl.FLOAT, 4, 4, this.vertices));
  }
}

class Relighter {
  // Use Relighter.load().
  constructor(THREE, renderer, root) {
    const gl = prepared(renderer.getContext());
    Object.assign(this, { THREE, renderer, root, gl, meshes: [], materials: new Map(), unread: [], angle: 0, lights: [], groupNames: [], groupFactors: null, sky: null, skies: 0, scene: null });
    this.shaders = new ShaderTexts({ ...relightShaders, 'variant.glsl': variantOfLights });
    this.frame = gl.createBuffer();
    this.lightBuffer = gl.createBuffer();
    this.vertexArray = gl.createVertexArray();
    this.begin();
    this.nothing = emptyTextures(gl);
    this.end();
    const each = make => ({ value: Array.from({ length: mostShownLamps }, make) });
    this.uniforms = { prelightLamps: { value: 0 }, prelightLampPlaces: each(() => new THREE.Vector4()), prelightLampWays: each(() => new THREE.Vector4()),
      prelightLampCones: each(() => new THREE.Vector4()), prelightLampColors: each(() => new THREE.Vector3()),
      prelightEmitters: { value: 0 }, ...Object.fromEntries(['Places', 'Ways', 'Colors'].map(name => [`prelightEmitter${name}`,
        { value: Array.from({ length: emitterSamples }, () => new THREE.Vector4()) }])) };
  }

  // Takes the transfer of a model that GLTFLoader has loaded, and gives its meshes materials that show it. `technique`: sh, ch or lights;
  // the first of these that the model holds. The lights of the model become the relighter's.
  static async load(THREE, renderer, gltf, { technique } = {}) {
    const relighter = new Relighter(THREE, renderer, gltf.scene), file = new BakedFile(gltf.parser);
    await relighter.readMeshes(file, gltf, technique);
    const own = [];
    gltf.scene.traverse(object => { if (isLamp(object)) own.push(object); });
    relighter.setLights(own);
    return relighter;
  }

  async readMeshes(file, { parser, scene }, technique) {
    const drawn = [];
    scene.updateMatrixWorld(true);
    scene.traverse(object => {
      const { nodes = parser.associations.get(object.parent)?.nodes, primitives = 0 } = parser.associations.get(object) ?? {};
      const entry = object.isMesh ? file.entriesOf(nodes)[primitives] : undefined;
      if (entry && object.isInstancedMesh) this.unread.push('instances');
      else if (entry) drawn.push({ mesh: object, entry });
    });
    const entries = drawn.map(({ entry }) => entry);
    this.technique = technique ?? ['sh', 'ch', 'lights'].find(name => entries.some(holds[name]));
    if (!this.technique || !entries.some(holds[this.technique])) throw new Error(`The model holds no transfer in ${technique ?? 'SH, CH or light groups'}.`);
    if (drawn.some(({ mesh: { material } }) => material.emissiveMap)) this.unread.push('light of pictures that glow');
    this.unread = [...new Set([...this.unread, ...leftOutOf(entries)])];
    this.groupNames = (file.root.lightGroups ?? []).map(({ name }) => name);
    this.groupColors = (file.root.lightGroups ?? []).map(({ color }) => color);
    if (this.technique === 'lights') this.groupFactors = this.groupColors.map(() => [1, 1, 1]);
    const read = drawn.filter(({ entry }) => holds[this.technique](entry)), baked = [];
    for (const { entry } of read) baked.push(await this.bakedOf(file, entry));
    this.begin();  // three.js may draw while numbers are awaited, but not from here on
    read.forEach(({ mesh, entry }, i) => {
      this.meshes.push(new RelitMesh(this, mesh, baked[i]));
      mesh.material = Array.isArray(mesh.material) ? mesh.material.map(each => this.materialOf(each, entry)) : this.materialOf(mesh.material, entry);
    });
    this.end();
  }

  // Names of what the model and its lights hold and this does not show.
  get leftOut() { return [...this.unread, ...(this.lights.length > mostShownLamps && !this.groupFactors ? ['lights after the eighth'] : [])]; }

  async bakedOf(file, entry) {
    const isCh = this.technique === 'ch', { lightGroups, nearLamps, ch } = entry, baked = { isCh };
    if (isCh) baked.harmonics = { order: ch.order, channels: ch.channels, rows: await file.values(ch.coefficients) };
    if (this.technique === 'sh') baked.harmonics = await file.harmonics(entry);
    if (nearLamps && this.technique !== 'lights') baked.nearLamps = await file.nearLamps(nearLamps);
    if (lightGroups) baked.groups = { channels: lightGroups.channels, count: this.groupNames.length, rows: await file.values(lightGroups.coefficients) };
    return baked;
  }

  materialOf(material, { nearLamps, lightGroups }) {
    const known = this.materials;
    if (material.isMeshBasicMaterial) return material;
    if (!known.has(material)) {
      const defines = {};
      if (nearLamps && this.technique !== 'lights') defines.PRELIGHT_SHADOWS = '';
      if (lightGroups) defines.PRELIGHT_GROUPS = '';
      known.set(material, relitMaterial(material, this.uniforms, defines));
    }
    return known.get(material);
  }

  // The sky: an equirectangular texture of floats or halves, as EXRLoader and HDRLoader make it; null: none. `angle`: radians about +Y, from
  // where three.js has it.
  // Where `scene` is given, reflections and the background are the sky's, too, and turn with it.
  setSky(texture, { angle = 0, scene = null } = {}) {
    this.sky = texture ? new SkyLight(pictureOf(texture)) : null;
    ++this.skies;
    this.scene = scene;
    if (texture) texture.mapping = this.THREE.EquirectangularReflectionMapping;
    if (scene) scene.environment = scene.background = texture;
    this.turnSky(angle);
  }

  turnSky(angle) {
    this.angle = angle;
    this.scene?.environmentRotation.set(0, angle, 0);
    this.scene?.backgroundRotation.set(0, angle, 0);
  }

  // Lights of three.js (directional, point, spot) that shine through the transfer: the first eight are made invisible to three.js, so that
  // they count once, and may be moved, dimmed and coloured. Those after the eighth stay lights of three.js, without shadows.
  setLights(lights) {
    for (const light of lights)
      if (!isLamp(light)) throw new Error(`Expected directional, point or spot lights, got ${light.type}.`);
    for (const light of this.lights) light.visible = false;
    this.lights = [...lights];
    this.hideLights();
  }

  // Hides lights that shine through the transfer, and all whose light groups hold.
  hideLights() {
    const most = this.groupFactors ? this.lights.length : mostShownLamps;
    this.lights.forEach((light, k) => { light.visible = k >= most; });
  }

  // The model's own lights as baked in groups, {name: factor or [r, g, b]}, in place of the lights given; null: those again, where
  // there is transfer for them.
  setGroups(factors) {
    if (!factors && this.technique === 'lights') throw new Error('The technique is lights, which has transfer for light groups alone: load sh or ch for other lights.');
    const rgb = value => Array.isArray(value) ? value : [value, value, value];
    this.groupFactors = factors && this.groupNames.map(name => rgb(factors[name] ?? 1));
    this.hideLights();
  }

  // Call it before each picture. Where nothing has changed, nothing is done.
  update() {
    this.root.updateMatrixWorld();
    const lamps = this.groupFactors ? [] : this.lamps(), emitters = this.groupFactors ? [] : this.emitters();
    shareShadows(emitters, lamps.filter(({ shadow }) => shadow >= 0).length, lampsAStream);
    lamps.push(...emitters);
    this.showLamps(lamps.filter(({ isSample }) => !isSample));
    this.showEmitters(emitters);
    const by = JSON.stringify([this.skies, this.angle, lamps, this.groupFactors]);
    const changed = this.meshes.filter(mesh => mesh.by !== this.stateOf(mesh, by));
    if (changed.length === 0) return;
    const light = this.lightOf(lamps);
    this.begin();
    for (const mesh of changed) {
      mesh.run(light);
      mesh.by = this.stateOf(mesh, by);
    }
    this.end();
  }

  stateOf({ mesh }, by) { return `${by} ${mesh.matrixWorld.elements}`; }

  // The lights, first those within the scene whose shadows are known.
  lamps() {
    const box = new this.THREE.Box3().setFromObject(this.root), all = this.lights.slice(0, mostShownLamps).map(light => lampOf(this.THREE, light));
    for (const lamp of all) lamp.throughTransfer = lamp.kind === kinds.directional || !box.containsPoint(new this.THREE.Vector3(...lamp.position));
    const near = all.filter(lamp => !lamp.throughTransfer);
    near.forEach((lamp, k) => { lamp.shadow = k < lampsAStream ? k : -1; });
    return [...near, ...all.filter(lamp => lamp.throughTransfer)];
  }

  // Samples of the glowing surfaces of the model.
  emitters() {
    const glowing = [];
    this.root.traverse(object => { if (glows(object)) glowing.push(object); });
    const by = JSON.stringify(glowing.map(({ id, matrixWorld, material }) => [id, matrixWorld.elements, material.emissive, material.emissiveIntensity]));
    if (by !== this.emittersBy) this.samples = sampledEmitters(glowing.flatMap(mesh => glowingTriangles(this.THREE, mesh)));
    this.emittersBy = by;
    return this.samples.map(sample => ({ ...sample }));
  }

  showEmitters(emitters) {
    const { prelightEmitters, prelightEmitterPlaces, prelightEmitterWays, prelightEmitterColors } = this.uniforms;
    prelightEmitters.value = emitters.length;
    emitters.forEach(({ position, area, direction, twoSided, intensity, shadow }, k) => {
      prelightEmitterPlaces.value[k].set(...position, area);
      prelightEmitterWays.value[k].set(...direction, flag(twoSided));
      prelightEmitterColors.value[k].set(...intensity, shadow);
    });
  }

  showLamps(lamps) {
    const { prelightLamps, prelightLampPlaces, prelightLampWays, prelightLampCones, prelightLampColors } = this.uniforms;
    prelightLamps.value = lamps.length;
    lamps.forEach((lamp, k) => {
      prelightLampPlaces.value[k].set(...lamp.position, lamp.kind === kinds.directional ? 0 : 1);
      prelightLampWays.value[k].set(...lamp.direction, flag(lamp.throughTransfer));
      prelightLampCones.value[k].set(...lamp.cone, lamp.range, 0);
      prelightLampColors.value[k].set(...lamp.intensity);
    });
  }

  // The light of a moment, as RelitMesh.run() takes it.
  lightOf(lamps) {
    const { sky } = this, angle = this.angle + turnOfThree, far = lamps.filter(isTransferred), orders = {};
    for (const lamp of sky?.lamps ?? []) far.push(lightOfLamp(lamp, angle));
    const ofOrder = order => {
      const { numbers, smoothing } = sky?.ofOrder(order) ?? { numbers: Array.from({ length: order ** 2 }, () => [0, 0, 0]), smoothing: 0 };
      const turned = turnedAboutY(numbers, angle, order);
      return { numbers: turned, smooth: smoothedBy(turned, smoothing) };
    };
    return { far, near: lamps.filter(lamp => lamp.shadow >= 0), ofOrder: order => orders[order] ??= ofOrder(order),
      groups: count => Array.from({ length: count }, (_, g) => this.groupColors[g].map((value, c) => this.groupFactors ? value * this.groupFactors[g][c] : 0)) };
  }

  // three.js' state of WebGL makes room for that of passes over vertices.
  begin() {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.bindBuffer(gl.ARRAY_BUFFER, null);  // WebGL writes no buffer that is bound elsewhere
    gl.bindVertexArray(this.vertexArray);
    for (const [name, value] of [[gl.UNPACK_FLIP_Y_WEBGL, false], [gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false], [gl.UNPACK_ALIGNMENT, 1]]) gl.pixelStorei(name, value);
    for (const [block, buffer, size] of [['Frame', this.frame, 384], ['Lights', this.lightBuffer, 64 * mostLights]]) {
      gl.bindBufferBase(gl.UNIFORM_BUFFER, bindingOf(gl, block), buffer);
      gl.bufferData(gl.UNIFORM_BUFFER, size, gl.DYNAMIC_DRAW);
    }
  }

  end() {
    this.gl.bindVertexArray(null);
    this.renderer.resetState();
  }

  // Gives meshes, materials and lights back what they had, and frees what is on the graphics card. A scene's sky stays.
  dispose() {
    const { gl } = this;
    for (const mesh of this.meshes) mesh.dispose();
    for (const material of this.materials.values()) material.dispose();
    for (const light of this.lights) light.visible = true;
    for (const texture of Object.values(this.nothing)) gl.deleteTexture(texture);
    for (const buffer of [this.frame, this.lightBuffer]) gl.deleteBuffer(buffer);
    gl.deleteVertexArray(this.vertexArray);
    Object.assign(this, { meshes: [], materials: new Map(), lights: [] });
    this.renderer.resetState();
  }

  fillLights(lights) {
    const { gl } = this;
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.lightBuffer);
    gl.bufferSubData(gl.UNIFORM_BUFFER, 0, lightBlock(lights));
  }
}
