// The page: its state, and when pictures of it are drawn.
const settleTime = 200;         // ms without a change until a picture gets all its samples
const stillSamples = 2;         // along each axis of a pixel
const slowFrame = 60;           // ms; slower pictures are drawn with fewer pixels while something moves

class Page {
  constructor(page, renderer, canvas) {
    Object.assign(this, { page, renderer, canvas, lights: new SceneLights(page), camera: new Camera(page) });
    this.shadings = [...page.techniques, { name: page.before.name, label: 'the same light, nothing baked' }];
    this.groups = page.techniques.find(({ name }) => name === 'lights')?.transfer.groups;
    this.state = { technique: page.techniques[0].name, sky: page.skies.length > 0 ? 0 : -1, angle: 0, exposure: page.exposure, split: 0,
      groupFactors: (this.groups ?? []).map(() => [1, 1, 1]) };
    this.frameTime = 0;
    this.status = document.getElementById('status');
    this.panel = new Panel(document.getElementById('panel'), this);
    this.handles = new LampHandles(document.getElementById('lamps'), this);
    this.divider = new Divider(document.getElementById('divider'), this);
    this.controls = new Controls(canvas, this);
    new ResizeObserver(() => this.changed()).observe(canvas);
  }

  // What renderers draw.
  view() {
    const { state } = this;
    return { ...state, camera: this.camera, sky: this.renderer.skies.at(state.sky), lightsOf: asSamples => this.lights.shining(asSamples) };
  }

  set(values) {
    Object.assign(this.state, values);
    this.changed();
  }

  changed() {
    clearTimeout(this.settling);
    this.settling = setTimeout(() => this.request(true), settleTime);
    this.request(false);
  }

  request(isStill) {
    this.isStill = isStill;
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame(() => {
      this.requested = false;
      guarded(() => this.draw());
    });
  }

  draw() {
    const { gl } = this.renderer, ratio = Math.min(window.devicePixelRatio, 2);
    const part = this.isStill ? 1 : this.frameTime > 2 * slowFrame ? 0.5 : 1, samples = this.isStill ? stillSamples : 1;
    const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio * part)), height = Math.max(1, Math.round(this.canvas.clientHeight * ratio * part));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    const start = performance.now();
    this.renderer.draw(this.view(), width, height, samples);
    this.renderer.show(this.state.exposure, samples);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // so that the time is the picture's
    const time = performance.now() - start;
    if (!this.isStill) this.frameTime = time;
    this.report(time, width, height);
  }

  report(time, width, height) {
    this.firstPicture ??= performance.now();
    this.handles.place();
    this.divider.place();
    this.panel.update();
    this.status.textContent = `${time.toFixed(1)} ms a picture of ${width} × ${height}, ${this.state.technique}`;
  }

  // 98 % of what is lit becomes less than white.
  meter() {
    const { renderer } = this, width = 160, height = Math.max(1, Math.round(width * this.canvas.clientHeight / this.canvas.clientWidth));
    renderer.draw(this.view(), width, height, 1);
    const pixels = renderer.radiance(1), values = [];
    for (let i = 0; i < pixels.length; i += 3) values.push(Math.max(pixels[i], pixels[i + 1], pixels[i + 2]));
    const lit = values.filter(value => value > 0).sort((a, b) => a - b);
    if (lit.length > 0) this.set({ exposure: Math.max(2 ** -12, Math.min(2 ** 12, 0.8 / lit[Math.floor(0.98 * (lit.length - 1))])) });
  }

  // Whether lamps can be moved and dimmed: not where their light is as it was baked.
  lampsShine() { return !['lights', 'lightmap', 'radiosity'].includes(this.state.technique) || this.state.split > 0; }

  nextTechnique() {
    const names = this.shadings.map(({ name }) => name);
    this.set({ technique: names[(names.indexOf(this.state.technique) + 1) % names.length] });
  }

  reset() {
    this.camera.reset(this.camera.index);
    this.changed();
  }

  // For scripts: linear radiance of a picture, rows from the top, RGB.
  picture(width, height, samples = stillSamples) {
    this.renderer.draw(this.view(), width, height, samples);
    return this.renderer.radiance(samples);
  }
}

function fail(error) {
  const status = document.getElementById('status');
  status.className = 'failed';
  status.textContent = error.message;
  console.error(error);
}

function guarded(act) {
  try {
    act();
  } catch (error) {
    fail(error);
  }
}

async function open() {
  const json = id => JSON.parse(document.getElementById(id).textContent);
  const description = json('scene'), bytes = document.getElementById('data');
  const data = new PageData(description.arrays, bytesOfBase64(bytes.textContent));
  bytes.remove();
  const canvas = document.getElementById('picture');
  const gl = openContext(canvas);
  canvas.addEventListener('webglcontextlost', event => {
    event.preventDefault();
    fail(new Error('The graphics card was taken away from this page: load it again.'));
  });
  const textures = await materialTextures(gl, description, data);
  const page = new Page(description, new Renderer(gl, description, data, new ShaderTexts(json('shaders')), textures), canvas);
  window.prelight = page;
  page.changed();
}

open().catch(fail);
