// Shadows of lamps within the scene, by shells of distance: viewer/techniques/near_lamps/near_lamp_pass.cpp.
const lampsAStream = 4, mostStreams = 4;
const noTurn = [1, 0, 0, 0, 1, 0, 0, 0, 1];

class NearLamps {
  // `rows`: [vertex][shell][i], halves; `streams`: of four lamps each, as many as there may be.
  constructor(gl, shaders, scene, { rows, order, shells, nearest, farthest, lag }, streams = mostStreams) {
    Object.assign(this, { gl, scene, rowLength: order ** 2 });
    this.program = new Program(gl, shaders.of('near_lamps.vert'), emptyFragment, ['lampVisibility']);
    this.capture = new Capture(gl, this.program, scene.vertices, streams);
    this.texels = this.textureOf(rows);
    this.shape = { shellShape: [order, shells, 0, 0], shellRange: [nearest, shells / Math.log(farthest / nearest), lag, 0] };
    this.by = null;
  }

  textureOf(rows) { return texelTexture(this.gl, paddedRows(rows, this.rowLength), 4); }

  // [shadow] places that light leaves from: of samples of surfaces that share one the mean.
  places(lights) {
    const shadows = [], sums = [];
    for (const light of lights.filter(({ shadow }) => shadow >= 0)) {
      const { shadow, area } = light;
      if (light.isSample) sums[shadow] = (sums[shadow] ?? [0, 0, 0, 0]).map((sum, i) => sum + area * (i < 3 ? light.position[i] : 1));
      else if (light.kind !== kinds.area) shadows[shadow] = [{ place: [...light.position, 0], normal: [0, 0, 0] }];
      else shadows[shadow] = light.shadowPlaces.map(part => ({ place: [...part.position, light.twoSided ? 2 : 1], normal: part.direction }));
    }
    sums.forEach((sum, shadow) => { shadows[shadow] = [{ place: [...scale(sum, 1 / sum[3]), 0], normal: [0, 0, 0] }]; });
    return Array.from(shadows, places => places ?? []);
  }

  // `pose`: what else the visibilities depend on: {key, parts: [{first, count, turn, turnNext}], texels, texelsNext, share}, where the
  // vertices do not rest.
  run(lights, pose = null) {
    const shadows = this.places(lights), by = JSON.stringify([shadows, pose?.key]);
    this.streams = Math.ceil(shadows.length / lampsAStream);
    if (by === this.by) return;
    this.by = by;
    const { texels = this.texels, texelsNext = this.texels, share = 0, parts = [{ first: 0, count: this.scene.vertices }] } = pose ?? {};
    this.program.use();
    this.program.set({ ...this.shape, nextShare: share });
    this.program.bind(this.scene.nothing, { ...this.scene.textures, texels, texelsNext });
    const all = Array.from({ length: this.streams }, (_, stream) => shadows.slice(lampsAStream * stream, lampsAStream * (stream + 1)))
      .flatMap(four => parts.map(part => ({ ...part, four })));
    this.capture.run(all, part => {
      this.setPlaces(part.four);
      this.program.set({ lightTurn: part.turn ?? noTurn, lightTurnNext: part.turnNext ?? noTurn });
    });
  }

  delete() {
    this.gl.deleteTexture(this.texels);
    this.capture.delete();
    this.program.delete();
  }

  setPlaces(four) {
    const all = four.flat(), ends = [0, 0, 0, 0];
    four.forEach((places, k) => { ends[k] = (ends[k - 1] ?? 0) + places.length; });
    this.program.set({ 'places[0]': all.flatMap(({ place }) => place), 'placeNormals[0]': all.flatMap(({ normal }) => normal), placesEnd: ends, lampCount: four.length });
  }
}
