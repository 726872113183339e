// WebGL: programs, texels of numbers, and vertex shaders that are run for what they compute.
const rowTexels = 2048;  // FETCH of core/dialect.h
const flag = value => value ? 1 : 0;

// Takes a context that is new, or there again.
function prepared(gl) {
  if (!gl.getExtension('EXT_color_buffer_float') && !gl.getExtension('EXT_color_buffer_half_float'))
    throw new Error('WebGL draws no pictures of more than 8 bits a channel here, which is needed.');
  gl.getExtension('OES_texture_float_linear');
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  return gl;
}

// The binding of a uniform block: the last two, as three.js counts its own from the first on.
const bindingOf = (gl, block) => gl.getParameter(gl.MAX_UNIFORM_BUFFER_BINDINGS) - { Frame: 2, Lights: 1 }[block];

class Program {
  constructor(gl, vertexText, fragmentText, captured = null) {
    this.gl = gl;
    this.program = gl.createProgram();
    gl.attachShader(this.program, compiled(gl, gl.VERTEX_SHADER, vertexText));
    gl.attachShader(this.program, compiled(gl, gl.FRAGMENT_SHADER, fragmentText));
    if (captured) gl.transformFeedbackVaryings(this.program, captured, gl.INTERLEAVED_ATTRIBS);
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS)) throw new Error(`A shader does not link: ${gl.getProgramInfoLog(this.program)}`);
    this.findUniforms();
    for (const block of ['Frame', 'Lights']) {
      const index = gl.getUniformBlockIndex(this.program, block);
      if (index !== gl.INVALID_INDEX) gl.uniformBlockBinding(this.program, index, bindingOf(gl, block));
    }
  }

  findUniforms() {
    const { gl, program } = this;
    const samplers = { [gl.SAMPLER_2D]: gl.TEXTURE_2D, [gl.UNSIGNED_INT_SAMPLER_2D]: gl.TEXTURE_2D,
      [gl.INT_SAMPLER_2D]: gl.TEXTURE_2D, [gl.SAMPLER_2D_ARRAY]: gl.TEXTURE_2D_ARRAY };
    this.uniforms = new Map();
    this.samplers = [];
    gl.useProgram(program);
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
      const { name, type } = gl.getActiveUniform(program, i);
      const location = gl.getUniformLocation(program, name);
      if (location === null) continue;  // of a block
      this.uniforms.set(name, { location, type });
      if (!(type in samplers)) continue;
      gl.uniform1i(location, this.samplers.length);
      this.samplers.push({ name, target: samplers[type], whole: type === gl.UNSIGNED_INT_SAMPLER_2D || type === gl.INT_SAMPLER_2D });
    }
  }

  // Numbers and arrays of them by the names of uniforms; those that the program has not are passed over.
  set(values) {
    const { gl } = this;
    for (const name in values) {
      const uniform = this.uniforms.get(name);
      if (uniform === undefined) continue;
      const { location, type } = uniform, value = values[name];
      if (type === gl.INT || type === gl.BOOL) gl.uniform1i(location, value);
      else if (type === gl.FLOAT) gl.uniform1fv(location, value.length === undefined ? [value] : value);
      else if (type === gl.FLOAT_VEC2) gl.uniform2fv(location, value);
      else if (type === gl.FLOAT_VEC3) gl.uniform3fv(location, value);
      else if (type === gl.FLOAT_VEC4) gl.uniform4fv(location, value);
      else if (type === gl.FLOAT_MAT3) gl.uniformMatrix3fv(location, false, value);
      else if (type === gl.INT_VEC4) gl.uniform4iv(location, value);
    }
  }

  // Textures by the names of samplers, the last of several tables first; others read nothing.
  bind(nothing, ...tables) {
    const { gl } = this;
    this.samplers.forEach(({ name, target, whole }, unit) => {
      const found = tables.findLast(table => table[name]);
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(target, found ? found[name] : target === gl.TEXTURE_2D_ARRAY ? nothing.array : whole ? nothing.whole : nothing.plain);
    });
  }

  use() { this.gl.useProgram(this.program); }

  delete() { this.gl.deleteProgram(this.program); }
}

function compiled(gl, stage, text) {
  const shader = gl.createShader(stage);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  if (gl.getShaderParameter(shader, gl.COMPILE_STATUS)) return shader;
  const log = gl.getShaderInfoLog(shader) ?? '';
  const line = Number(/ERROR: \d+:(\d+)/.exec(log)?.[1] ?? 0);
  throw new Error(`A shader does not compile: ${log}\n${text.split('\n').slice(Math.max(line - 2, 0), line + 1).join('\n')}`);
}

// Formats of texels by their numbers' type and how many a texel has.
function texelFormat(gl, values, components) {
  const place = components - 1;
  const float = [gl.RED, gl.RG, gl.RGB, gl.RGBA][place], whole = [gl.RED_INTEGER, gl.RG_INTEGER, gl.RGB_INTEGER, gl.RGBA_INTEGER][place];
  if (values instanceof Float32Array) return [[gl.R32F, gl.RG32F, gl.RGB32F, gl.RGBA32F][place], float, gl.FLOAT];
  if (values instanceof Uint16Array) return [[gl.R16F, gl.RG16F, gl.RGB16F, gl.RGBA16F][place], float, gl.HALF_FLOAT];
  if (values instanceof Uint32Array) return [[gl.R32UI, gl.RG32UI, gl.RGB32UI, gl.RGBA32UI][place], whole, gl.UNSIGNED_INT];
  return [[gl.R32I, gl.RG32I, gl.RGB32I, gl.RGBA32I][place], whole, gl.INT];
}

const rowsOf = texels => Math.max(1, Math.ceil(texels / rowTexels));

function setPlainFilter(gl, target) {
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(target, name, gl.NEAREST);
  for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(target, name, gl.CLAMP_TO_EDGE);
}

// What stands for a texture of a buffer; `texture`: one that is filled anew.
function texelTexture(gl, values, components, texture = gl.createTexture()) {
  const rows = rowsOf(values.length / components), most = gl.getParameter(gl.MAX_TEXTURE_SIZE);
  if (rows > most) throw new Error(`The scene has ${rows} rows of numbers; WebGL here takes ${most}.`);
  const padded = new values.constructor(rows * rowTexels * components);
  padded.set(values);
  const [stored, format, type] = texelFormat(gl, values, components);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, stored, rowTexels, rows, 0, format, type, padded);
  setPlainFilter(gl, gl.TEXTURE_2D);
  return texture;
}

// White for what has no texture, and nothing for what is not read.
function emptyTextures(gl) {
  const plain = gl.createTexture(), array = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, plain);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array([255, 255, 255, 255]));
  setPlainFilter(gl, gl.TEXTURE_2D);
  gl.bindTexture(gl.TEXTURE_2D_ARRAY, array);
  gl.texImage3D(gl.TEXTURE_2D_ARRAY, 0, gl.RGBA8, 1, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  setPlainFilter(gl, gl.TEXTURE_2D_ARRAY);
  return { plain, array, whole: texelTexture(gl, new Uint32Array(4), 4) };
}

// Runs a vertex shader for each of a number of points and keeps the texels, four floats each, that it writes.
class Capture {
  // `keepsBuffer`: the texels are wanted in the buffer, as an attribute of vertices, and in no texture.
  constructor(gl, program, points, texelsAPoint, keepsBuffer = false) {
    Object.assign(this, { gl, program, points, keepsBuffer });
    this.rows = rowsOf(points * texelsAPoint);
    this.buffer = gl.createBuffer();
    gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, this.buffer);
    gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, this.rows * rowTexels * 16, gl.DYNAMIC_COPY);
    gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, null);
    this.texture = keepsBuffer ? null : texelTexture(gl, new Float32Array(this.rows * rowTexels * 4), 4);
  }

  // `parts`: draws of some of the points each, as drivers end what runs for seconds; `begin(part)` is called before each.
  run(parts = [{ first: 0, count: this.points }], begin = () => {}) {
    const { gl } = this;
    gl.enable(gl.RASTERIZER_DISCARD);
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, this.buffer);
    gl.beginTransformFeedback(gl.POINTS);
    for (const part of parts) {
      begin(part);
      gl.drawArrays(gl.POINTS, part.first, part.count);
    }
    gl.endTransformFeedback();
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
    gl.disable(gl.RASTERIZER_DISCARD);
    if (this.keepsBuffer) return;
    gl.bindBuffer(gl.PIXEL_UNPACK_BUFFER, this.buffer);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, rowTexels, this.rows, gl.RGBA, gl.FLOAT, 0);
    gl.bindBuffer(gl.PIXEL_UNPACK_BUFFER, null);
  }

  delete() {
    this.gl.deleteBuffer(this.buffer);
    this.gl.deleteTexture(this.texture);
  }
}
