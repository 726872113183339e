// How light is drawn: what each shading gives to vertices.

// Bent normals and accessibility, [vertex]; without bent normals those of the surface are taken.
function openTexture(gl, bentNormals, accessibility) {
  const open = new Float32Array(4 * accessibility.length);
  accessibility.forEach((value, v) => {
    if (bentNormals) open.set(bentNormals.subarray(3 * v, 3 * v + 3), 4 * v);
    open[4 * v + 3] = value;
  });
  return texelTexture(gl, open, 4);
}

// Baked numbers of vertices that stay as they are in any light.
class VertexTechnique {
  constructor(gl, shaders, scene, { array }) {
    this.vertices = { stride: 1, light: texelTexture(gl, scene.data.numbers(array), 3) };
  }
  light() {}
}

class LightMapTechnique {
  constructor(gl, shaders, scene, { width, height, layers, walled }) {
    this.vertices = { stride: 0 };
    this.textures = { lightMaps: lightMapTexture(gl, width, height, layers, scene.data.array('lightMap')),
      lightMapCorners: texelTexture(gl, scene.data.array('lightMapCorners'), 2),
      lightMapWalls: texelTexture(gl, walled ? scene.data.array('lightMapWalls') : new Float32Array(2), 2) };
    this.uniforms = { frontFaces: scene.triangles, lightMapWalled: flag(walled) };
  }
  light() {}
}

// `apertures`: of cones about the bent normals; `beyond`: how open other sides are.
class AoTechnique {
  constructor(gl, shaders, scene, { array, apertures, beyond }) {
    const numbers = name => name ? scene.data.numbers(name) : null, wide = numbers(apertures), behind = numbers(beyond);
    const more = Float32Array.from({ length: 8 * scene.vertices }, (_, i) => i % 8 === 7 ? wide?.[i >> 3] ?? 0 : i % 8 > 3 ? behind?.[i >> 3] ?? 0 : i % 8 === 3 ? 1 : 0);
    this.vertices = { stride: 2, light: texelTexture(gl, more, 4), open: texelTexture(gl, scene.data.numbers(array), 4), hasBentNormals: true,
      knowsThrough: Boolean(beyond) };
  }
  light() {}
}

// Nothing baked: what is shown before.
class OpenTechnique {
  constructor() { this.vertices = { stride: 0 }; }
  light() {}
}

const techniqueMakers = {
  sh: (gl, shaders, scene, transfer) => new HarmonicTechnique(gl, shaders, scene, transfer, false),
  ch: (gl, shaders, scene, transfer) => new HarmonicTechnique(gl, shaders, scene, transfer, true),
  glossy: (...parts) => new GlossyTechnique(...parts),
  haar: (...parts) => new HaarTechnique(...parts),
  lights: (...parts) => new GroupTechnique(...parts),
  lightmap: (...parts) => new LightMapTechnique(...parts),
  vo: (...parts) => new OccluderTechnique(...parts),
  cones: (...parts) => new AoTechnique(...parts),
  ao: (...parts) => new AoTechnique(...parts),
  phong: () => new OpenTechnique(),
};

// Shadings without a maker of their own are drawn from three numbers of each vertex.
const makeOfNumbers = (...parts) => new VertexTechnique(...parts);

// A technique that is made when it is first drawn, and lit when its light has changed.
class DrawnTechnique {
  constructor(description, make) {
    Object.assign(this, { description, make, made: null, litBy: null });
  }

  lit(light) {
    if (!this.made) this.made = this.make();
    const { made } = this;
    const lights = light.lightsOf(made.asSamples), { skies, sky, angle } = light;
    const lampsApart = this.description.rules.takesLamps && Boolean(sky.apart);
    const by = JSON.stringify([lights, light.sky.name, light.angle, light.groupFactors, made.shines ? light.camera.position : 0, made.followsTime ? light.time : 0]);
    if (by !== this.litBy) made.light(lampsApart ? { ...light, sky: skies.withoutLamps(sky), lights: withLampsOfSky(lights, skies.lampsOf(sky, angle)) } : { ...light, lights });
    this.litBy = by;
    const moves = light.time !== null && made.followsTime;  // other shells know the pose that was baked
    made.shadows = moves && !made.keyed.motion.keys.nearLamps ? null : made.nearLamps;
    made.poseOfShells = moves && made.shadows ? made.keyed.poseOfShells(made.nearLamps, light.time) : { key: light.time };
    return made;
  }
}
