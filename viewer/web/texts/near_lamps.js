// Shadows of lamps within the scene, by shells of distance: viewer/techniques/near_lamps/near_lamp_pass.cpp.
const lampsAStream = 4;

class NearLamps {
  constructor(gl, shaders, scene, { array, order, shells, nearest, farthest, lag }) {
    Object.assign(this, { gl, scene });
    this.program = new Program(gl, shaders.of('near_lamps.vert'), emptyFragment, ['lampVisibility']);
    this.capture = new Capture(gl, this.program, scene.vertices, lampsAStream);
    this.textures = { texels: texelTexture(gl, paddedRows(scene.data.array(array), order ** 2), 4), ...scene.textures };
    this.shape = { shellShape: [order, shells, 0, 0], shellRange: [nearest, shells / Math.log(farthest / nearest), lag, 0] };
    this.by = null;
  }

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

  // `seconds`: of an animation, which moves vertices.
  run(lights, seconds) {
    const shadows = this.places(lights), by = JSON.stringify([shadows, seconds]);
    this.streams = Math.ceil(shadows.length / lampsAStream);
    if (by === this.by) return;
    this.by = by;
    this.program.use();
    this.program.set(this.shape);
    this.program.bind(this.scene.nothing, this.textures);
    const parts = Array.from({ length: this.streams }, (_, stream) => ({ first: 0, count: this.scene.vertices, four: shadows.slice(lampsAStream * stream, lampsAStream * (stream + 1)) }));
    this.capture.run(parts, ({ four }) => this.setPlaces(four));
  }

  setPlaces(four) {
    const all = four.flat(), ends = [0, 0, 0, 0];
    four.forEach((places, k) => { ends[k] = (ends[k - 1] ?? 0) + places.length; });
    this.program.set({ 'places[0]': all.flatMap(({ place }) => place), 'placeNormals[0]': all.flatMap(({ normal }) => normal), placesEnd: ends, lampCount: four.length });
  }
}
