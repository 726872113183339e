// The page's WebGL context and the picture that it draws into.
function openContext(canvas) {
  const gl = canvas.getContext('webgl2', { antialias: false, alpha: false, depth: false, powerPreference: 'high-performance' });
  if (!gl) throw new Error('This browser shows no WebGL 2, which the page needs.');
  return gl;
}

// A picture of samples with depths.
class Target {
  constructor(gl, width, height) {
    Object.assign(this, { gl, width, height });
    this.color = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.color);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA16F, width, height);
    setPlainFilter(gl, gl.TEXTURE_2D);
    this.depth = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    this.framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.color, 0);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, this.depth);
  }

  delete() {
    this.gl.deleteFramebuffer(this.framebuffer);
    this.gl.deleteTexture(this.color);
    this.gl.deleteRenderbuffer(this.depth);
  }
}
