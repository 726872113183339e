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

// Gives it to all materials that the file says have a light map.
export function applyLightMap(root, texture) {
  forEachLightMap(root, (material, said) => setLightMap(material, texture.clone(), said.texCoord ?? 1, 1));
}

// Gives them the 8-bit map that is in the file itself, where no other file is at hand.
export async function applyOwnLightMap(gltf) {
  const waiting = [];
  forEachLightMap(gltf.scene, (material, said) => waiting.push(
    gltf.parser.getDependency('texture', said.index).then(
      texture => setLightMap(material, texture.clone(), said.texCoord ?? 1, said.intensity ?? 1))));
  await Promise.all(waiting);
}

function forEachLightMap(root, visit) {
  const met = new Set();
  root.traverse(object => {
    for (const material of [object.material ?? []].flat()) {
      const said = material.userData.gltfExtensions?.MOZ_lightmap;
      if (said === undefined || met.has(material)) continue;
      met.add(material);
      visit(material, said);
    }
  });
}

// Clones of a texture share its picture on the graphics card.
function setLightMap(material, texture, set, intensity) {
  texture.channel = set;
  texture.colorSpace = '';  // values are linear
  material.lightMap = texture;
  material.lightMapIntensity = intensity;
  material.needsUpdate = true;
}
