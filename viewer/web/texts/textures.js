// Pictures of materials and skies.
function mipmapped(gl, wrapS, wrapT) {
  gl.generateMipmap(gl.TEXTURE_2D);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, wrapS);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, wrapT);
}

async function decodedImages(page, data) {
  const options = { premultiplyAlpha: 'none', colorSpaceConversion: 'none' };
  return Promise.all(page.images.map(({ array, type }) => createImageBitmap(new Blob([data.array(array)], { type }), options)));
}

async function materialTextures(gl, page, data) {
  const images = await decodedImages(page, data);
  const wraps = [gl.REPEAT, gl.CLAMP_TO_EDGE, gl.MIRRORED_REPEAT];
  const textures = page.textures.map(({ image, srgb, wrap, nearest }) => {
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, srgb ? gl.SRGB8_ALPHA8 : gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, images[image]);
    mipmapped(gl, wraps[wrap[0]], wraps[wrap[1]]);
    if (nearest) gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return texture;
  });
  for (const image of images) image.close();
  return textures;
}

function skyTexture(gl, width, height, colors) {
  const texels = new Float32Array(4 * width * height);
  for (let i = 0; i < width * height; ++i) texels.set([...colors.subarray(3 * i, 3 * i + 3), 1], 4 * i);
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16F, width, height, 0, gl.RGBA, gl.FLOAT, texels);
  mipmapped(gl, gl.REPEAT, gl.CLAMP_TO_EDGE);
  return texture;
}

// Levels of half the width each, all behind one another: LobeMap of viewer/lights/lobe_map.h.
function lobeTexture(gl, width, colors) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  let level = 0;
  for (let side = width, first = 0; 3 * first < colors.length; first += side * side, side /= 2, ++level) {
    const texels = new Float32Array(4 * side * side);
    for (let i = 0; i < side * side; ++i) texels.set([...colors.subarray(3 * (first + i), 3 * (first + i) + 3), 1], 4 * i);
    gl.texImage2D(gl.TEXTURE_2D, level, gl.RGBA16F, side, side, 0, gl.RGBA, gl.FLOAT, texels);
  }
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAX_LEVEL, level - 1);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.REPEAT);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  return texture;
}

// Several layers, which tell of directions, may be negative.
function lightMapTexture(gl, width, height, layers, numbers) {
  const texture = gl.createTexture(), [stored, type] = layers > 1 ? [gl.RGB16F, gl.HALF_FLOAT] : [gl.RGB9_E5, gl.UNSIGNED_INT_5_9_9_9_REV];
  gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
  gl.texImage3D(gl.TEXTURE_2D_ARRAY, 0, stored, width, height, layers, 0, gl.RGB, type, numbers);
  setPlainFilter(gl, gl.TEXTURE_2D_ARRAY);
  return texture;
}
