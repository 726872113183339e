// Vector occluders: light of every vertex through its records (docs/notes/occluders.md, viewer/techniques/vector_occluders/occluder_pass.cpp).
const mostPairs = 1 << 22;  // records x lights of a draw

// Parts of so many points, `most` each.
const pieces = (points, most) => Array.from({ length: Math.ceil(points / most) }, (_, i) => ({ first: i * most, count: Math.min(most, points - i * most) }));

class OccluderTechnique {
  constructor(gl, shaders, scene, transfer) {
    Object.assign(this, { gl, scene, shines: transfer.shines, terms: transfer.terms, asSamples: true });
    this.offsets = scene.data.array('occluderOffsets');
    this.longest = this.offsets.reduce((most, end, v) => v > 0 ? Math.max(most, end - this.offsets[v - 1]) : 0, 0);
    this.textures = this.makeTextures(transfer);
    this.prepare(shaders);
    this.lit = new Capture(gl, new Program(gl, shaders.of('occluders.vert'), emptyFragment, ['litDiffuse', 'litSpecular', 'litReflected']),
      scene.vertices, 3);
    this.vertices = { stride: 3, light: this.lit.texture, open: openTexture(gl, null, scene.data.numbers('occluderOpen')) };
  }

  makeTextures({ length }) {
    const { gl, scene, offsets } = this, { data } = scene, count = offsets[offsets.length - 1];
    const records = new Float32Array(4 * length * count), places = data.array('occluderPlaces'), vectors = data.numbers('occluderVectors');
    const owners = new Int32Array(count), rest = 4 * (length - 1);
    for (let r = 0; r < count; ++r) {
      records.set(places.subarray(4 * r, 4 * r + 4), 4 * length * r);
      records.set(vectors.subarray(rest * r, rest * (r + 1)), 4 * length * r + 4);
    }
    for (let v = 0; v + 1 < offsets.length; ++v) owners.fill(v, offsets[v], offsets[v + 1]);
    return { records: texelTexture(gl, records, 4), owners: texelTexture(gl, owners, 1), offsets: texelTexture(gl, offsets, 1),
      receivers: texelTexture(gl, this.receivers(), 4) };
  }

  // OccluderReceiverPoint of every vertex.
  receivers() {
    const { data, vertices } = this.scene, positions = data.array('positions'), normals = data.array('normals');
    const gloss = data.has('occluderGloss') ? data.array('occluderGloss') : null;
    const points = new Float32Array(12 * vertices);
    for (let v = 0; v < vertices; ++v) {
      points.set(positions.subarray(3 * v, 3 * v + 3), 12 * v);
      points[12 * v + 3] = gloss ? gloss[4 * v + 3] : 1;
      points.set(normals.subarray(3 * v, 3 * v + 3), 12 * v + 4);
      if (gloss) points.set(gloss.subarray(4 * v, 4 * v + 3), 12 * v + 8);
    }
    return points;
  }

  setTerms(program, more) {
    const terms = { thesisFormula: 0, thesisMirrors: 0, orenNayar: 0, waves: 0, waveNumber: 1, moment: 0, fire: 0, normalWaves: 0, ...this.terms, ...more };
    program.set(Object.fromEntries(Object.entries(terms).map(([name, value]) => [`terms.${name}`, value])));
  }

  // What does not depend on the light, once.
  prepare(shaders) {
    const stored = this.terms.stored, through = 1, caustic = 2, specular = 4;
    const names = ['prepared0', 'prepared1', 'prepared2', 'prepared3', 'prepared4'];
    if (stored & (through | caustic)) names.push('opacity', 'caustic', 'carried');
    if (stored & specular) names.push('mirrored', 'mirrorNormal', 'mirrorColor');
    const program = new Program(this.gl, shaders.of('occluder_records.vert'), emptyFragment, names);
    const prepared = new Capture(this.gl, program, this.offsets[this.offsets.length - 1], this.terms.stride);
    program.use();
    this.setTerms(program, { lightCount: 0 });
    program.bind(this.scene.nothing, this.textures);
    prepared.run();
    this.gl.deleteBuffer(prepared.buffer);
    this.textures.prepared = prepared.texture;
  }

  light({ lights, skies, sky, angle, camera }) {
    const all = [...lights.map(occluderLight), ...skies.occluderLights(sky, angle)];
    this.textures.lights = texelTexture(this.gl, Float32Array.from(all.flat()), 4, this.textures.lights);
    const eye = camera.perspective ? camera.position : camera.back;
    this.lit.program.use();
    this.setTerms(this.lit.program, { lightCount: all.length, eyeIsPoint: camera.perspective ? 1 : 0, eyeX: eye[0], eyeY: eye[1], eyeZ: eye[2] });
    this.lit.program.bind(this.scene.nothing, this.textures);
    this.lit.run(pieces(this.scene.vertices, Math.max(Math.floor(mostPairs / ((this.longest + 1) * Math.max(all.length, 1))), 256)));
  }
}
