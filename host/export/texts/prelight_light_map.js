// Shows a light map that Prelight exported in three.js (0.151 or later).

// Reads a .ktx2 of RGBA halves: one level, uncompressed. Returns a texture of irradiance, W/m2.
export async function loadLightMap(THREE, url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  return lightMapTexture(THREE, await response.arrayBuffer(), url);
}

export function lightMapTexture(THREE, buffer, name = 'light map') {
  const rgbaHalf = 97, offsetOfLevel = 80;
  const view = new DataView(buffer);
  if (view.byteLength < 104 || view.getUint32(0, true) !== 0x58544bab || view.getUint32(12, true) !== rgbaHalf)
    throw new Error(`${name}: expected a .ktx2 of RGBA halves, as Prelight exports it`);
  const width = view.getUint32(20, true), height = view.getUint32(24, true);
  const offset = Number(view.getBigUint64(offsetOfLevel, true));
  const texture = new THREE.DataTexture(
    new Uint16Array(buffer, offset, 4 * width * height), width, height, THREE.RGBAFormat, THREE.HalfFloatType);
  texture.name = name;
  texture.magFilter = texture.minFilter = THREE.LinearFilter;  // no mipmaps: charts lie closely packed
  texture.needsUpdate = true;
  return texture;
}

// Gives it to all materials that the file says have a light map, in place of the 8-bit one of the file.
export function applyLightMap(root, texture) {
  const ofSet = new Map();
  root.traverse(object => {
    for (const material of [object.material ?? []].flat()) {
      const said = material.userData.gltfExtensions?.MOZ_lightmap;
      if (said === undefined) continue;
      const set = said.texCoord ?? 1;
      if (!ofSet.has(set)) {
        ofSet.set(set, texture.clone());
        ofSet.get(set).channel = set;
      }
      material.lightMap = ofSet.get(set);
      material.lightMapIntensity = 1;
      material.needsUpdate = true;
    }
  });
}
