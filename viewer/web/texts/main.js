// The page: its state, and when pictures of it are drawn, and how finely.
const settleTime = 200;         // ms without a change until a picture gets all its samples
const stillSamples = 2;         // along each axis of a pixel
const movingTime = 40;          // ms that a picture may take while something moves: slower ones are drawn with fewer pixels
const parts = [1, 0.71, 0.5, 0.35, 0.25];  // of the pixels along an axis that are drawn then
const longestStep = 100;        // ms that an animation goes on by in a frame
const mostRatio = 2;            // pixels of a picture a CSS pixel
const mostTexels = 1 << 24;     // samples of a picture

class Page {
  constructor(page, renderer, canvas) {
    Object.assign(this, { page, renderer, canvas, lights: new SceneLights(page), camera: new Camera(page) });
    this.shadings = [...page.techniques, { name: page.before.name, label: 'the same light, nothing baked' }];
    this.groups = page.techniques.find(({ name }) => name === 'lights')?.transfer.groups;
    this.state = { technique: page.techniques[0].name, sky: page.skies.length > 0 ? 0 : -1, angle: 0, time: null, exposure: page.exposure, split: 0,
      groupFactors: (this.groups ?? []).map(() => [1, 1, 1]) };
    this.pixelTime = 0;  // ms a pixel of pictures that move
    this.status = document.getElementById('status');
    this.announcer = new Announcer(document.getElementById('announcer'), this);
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
    if (values.time !== undefined) this.renderer?.motion?.moveLights(this.lights, values.time);
    this.changed();
  }

  // On from where the animation stands, or from its start.
  play(plays = !this.plays) {
    this.plays = plays && Boolean(this.page.motion);
    if (this.plays) requestAnimationFrame(now => this.playOn(now, now));
    this.changed();
  }

  // Slower frames play slower, and skip nothing.
  playOn(before, now) {
    if (!this.plays) return;
    const { start, end } = this.page.motion, passed = Math.min(now - before, longestStep) / 1000, time = (this.state.time ?? start) + passed;
    this.set({ time: time > end ? start : time });
    requestAnimationFrame(next => this.playOn(now, next));
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

  // Width and height of the picture; the sharpest that is quick enough.
  size(samples) {
    const { gl } = this.renderer, { clientWidth, clientHeight } = this.canvas;
    const most = gl.getParameter(gl.MAX_TEXTURE_SIZE) / samples / Math.max(clientWidth, clientHeight, 1);
    const ratio = Math.min(window.devicePixelRatio, mostRatio, most, Math.sqrt(mostTexels / Math.max(clientWidth * clientHeight, 1)) / samples);
    const time = this.pixelTime * clientWidth * clientHeight * ratio * ratio;
    const part = this.isStill ? 1 : parts.find(share => time * share * share <= movingTime) ?? parts.at(-1);
    return [clientWidth, clientHeight].map(length => Math.max(1, Math.round(length * ratio * part)));
  }

  draw() {
    const { renderer, canvas } = this;
    if (!renderer || renderer.gl.isContextLost()) return;
    const { gl } = renderer, samples = this.isStill ? stillSamples : 1, [width, height] = this.size(samples);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    this.camera.aspect = width / height;
    const start = performance.now();
    this.renderer.draw(this.view(), width, height, samples);
    this.renderer.show(this.state.exposure, samples);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // so that the time is the picture's
    const time = performance.now() - start;
    if (!this.isStill) this.pixelTime = time / (width * height);
    this.report(time, width, height);
  }

  report(time, width, height) {
    this.firstPicture ??= performance.now();
    this.handles.place();
    this.divider.place();
    this.panel.update();
    if (this.isStill && !this.plays) this.announcer.tell();
    this.status.className = '';
    this.status.textContent = `${time.toFixed(1)} ms a picture of ${width} × ${height}, ${this.state.technique}`;
  }

  // 98 % of what is lit becomes less than white.
  meter() {
    const { renderer } = this;
    if (!renderer) return;
    const width = 160, height = Math.max(1, Math.round(width * this.canvas.clientHeight / this.canvas.clientWidth));
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

// What keys have changed, for screen readers: controls tell of themselves.
class Announcer {
  constructor(element, app) {
    Object.assign(this, { element, app, told: this.facts(app) });
  }

  facts(app) {
    const { page, state, shadings } = app, sky = page.skies[state.sky]?.name ?? 'none', degrees = Math.round(state.angle * 180 / Math.PI);
    return [`shading ${shadings.find(({ name }) => name === state.technique).label}`, `sky ${sky}`, `sky turned by ${degrees} degrees`,
      `exposure ${factorText(state.exposure)}`, state.split > 0 ? 'before and after' : 'what was baked',
      page.motion ? `${app.plays ? 'plays' : 'stands'} at ${(state.time ?? page.motion.start).toFixed(1)} seconds` : ''];
  }

  tell() {
    const facts = this.facts(this.app), changed = facts.filter((fact, i) => fact !== this.told[i]);
    this.told = facts;
    if (document.activeElement === this.app.canvas && changed.length > 0) this.element.textContent = changed.join(', ');
  }
}

function fail(error) {
  const status = document.getElementById('status');
  status.className = 'failed';
  status.textContent = error.message;
  status.setAttribute('role', 'alert');
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
  const gl = openContext(canvas), shaders = new ShaderTexts({ ...relightShaders, ...json('shaders') });
  const makeRenderer = async () => new Renderer(prepared(gl), description, data, shaders, await materialTextures(gl, description, data));
  const page = new Page(description, await makeRenderer(), canvas);
  canvas.addEventListener('webglcontextlost', event => {
    event.preventDefault();  // so that it may come back
    page.renderer = null;
    page.status.textContent = 'The graphics card was taken away from this page. It goes on when it is there again; else load the page again.';
  });
  canvas.addEventListener('webglcontextrestored', () => makeRenderer().then(renderer => {
    page.renderer = renderer;
    page.changed();
  }).catch(fail));
  window.prelight = page;
  page.changed();
}

open().catch(fail);
