// The numbers of the page: views of one block of bytes.
const numberTypes = { f32: Float32Array, f16: Uint16Array, u32: Uint32Array, u16: Uint16Array, u8: Uint8Array, e5: Uint32Array };

function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
  return bytes;
}

class PageData {
  constructor(arrays, bytes) {
    this.arrays = arrays;
    this.bytes = bytes;
  }

  has(name) { return name in this.arrays; }

  array(name) {
    const { type, offset, count } = this.arrays[name];
    return new numberTypes[type](this.bytes.buffer, this.bytes.byteOffset + offset, count);
  }

  // Halves as numbers.
  numbers(name) { return Float32Array.from(this.array(name), numberOfHalf); }
}

// RGB of colours with a shared exponent.
function colorsOfShared(packed) {
  const colors = new Float32Array(3 * packed.length);
  packed.forEach((value, i) => {
    const step = 2 ** ((value >>> 27) - 24);
    colors[3 * i] = (value & 511) * step;
    colors[3 * i + 1] = (value >>> 9 & 511) * step;
    colors[3 * i + 2] = (value >>> 18 & 511) * step;
  });
  return colors;
}
