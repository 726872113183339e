// Mouse, touch and keys. Pictures are turned by one pointer, moved and scaled by two.
const turnAStep = Math.PI / 24, zoomAStep = 1.1;

const help = [
  ['drag, or one finger', 'turns the view'], ['wheel, or two fingers', 'nearer and away; two fingers, Ctrl or the middle button move it'],
  ['Shift or the right button', 'turns the sky'], ['arrows', 'turn the view (Shift: move it)'], ['+ −', 'nearer, away'], ['A D', 'turn the sky'], ['S', 'next sky'], ['T', 'next shading'],
  ['[ ]', 'darker, brighter'], ['E', 'exposure from the picture'], ['B', 'before and after'], ['Space', 'plays the animation, if there is one'], ['R', 'first view'], ['H', 'this list'],
  ['Tab', 'to lamps: arrows move them, PageUp and PageDown nearer and away'],
];

class Controls {
  constructor(canvas, app) {
    Object.assign(this, { canvas, app, pointers: new Map() });
    canvas.addEventListener('pointerdown', event => {
      canvas.setPointerCapture(event.pointerId);
      canvas.focus({ preventScroll: true });
      this.pointers.set(event.pointerId, this.placeOf(event));
    });
    canvas.addEventListener('pointermove', event => this.move(event));
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, event => this.pointers.delete(event.pointerId));
    canvas.addEventListener('wheel', event => {
      event.preventDefault();
      this.act(camera => camera.approach(Math.exp(event.deltaY * (event.deltaMode === 0 ? 0.0015 : 0.05))));
    }, { passive: false });
    canvas.addEventListener('contextmenu', event => event.preventDefault());
    canvas.addEventListener('keydown', event => this.key(event));
  }

  placeOf(event) { return { x: event.clientX, y: event.clientY }; }

  act(change) {
    change(this.app.camera);
    this.app.changed();
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (before === undefined) return;
    const now = this.placeOf(event), x = now.x - before.x, y = now.y - before.y, height = this.canvas.clientHeight;
    if (this.pointers.size > 1) {
      this.pinch(event.pointerId, before, now);
    } else if (event.shiftKey || event.buttons === 2) {
      this.app.state.angle += 2 * Math.PI * x / this.canvas.clientWidth;
      this.app.changed();
    } else if (event.ctrlKey || event.buttons === 4) {
      this.act(camera => camera.pan(x / height, y / height));
    } else {
      this.act(camera => camera.turn(-3 * x / height, 3 * y / height));
    }
    this.pointers.set(event.pointerId, now);
  }

  pinch(id, before, now) {
    const [, other] = [...this.pointers].find(([key]) => key !== id);
    const apart = place => Math.hypot(place.x - other.x, place.y - other.y), height = this.canvas.clientHeight;
    this.act(camera => {
      camera.approach(apart(before) / Math.max(apart(now), 1));
      camera.pan(0.5 * (now.x - before.x) / height, 0.5 * (now.y - before.y) / height);
    });
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const { app } = this, step = event.shiftKey ? null : turnAStep;
    const view = (x, y) => this.act(camera => step ? camera.turn(x * step, y * step) : camera.pan(-x * 0.05, -y * 0.05));
    const actions = {
      ArrowLeft: () => view(-1, 0), ArrowRight: () => view(1, 0), ArrowUp: () => view(0, 1), ArrowDown: () => view(0, -1),
      '+': () => this.act(camera => camera.approach(1 / zoomAStep)), '=': () => this.act(camera => camera.approach(1 / zoomAStep)),
      '-': () => this.act(camera => camera.approach(zoomAStep)),
      a: () => app.set({ angle: app.state.angle - turnAStep }), d: () => app.set({ angle: app.state.angle + turnAStep }),
      s: () => app.set({ sky: (app.state.sky + 1) % Math.max(app.page.skies.length, 1) }), t: () => app.nextTechnique(),
      '[': () => app.set({ exposure: app.state.exposure / Math.SQRT2 }), ']': () => app.set({ exposure: app.state.exposure * Math.SQRT2 }),
      e: () => app.meter(), b: () => app.set({ split: app.state.split > 0 ? 0 : 0.5 }), ' ': () => app.play(), r: () => app.reset(), h: () => app.panel.showHelp(),
    };
    const action = actions[event.key] ?? actions[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    action();
  }
}

// Lamps as buttons over the picture: dragged across the view, or moved by keys. Suns turn about the scene.
class LampHandles {
  constructor(holder, app) {
    Object.assign(this, { holder, app });
    this.handles = app.lights.lamps.map(lamp => this.handle(lamp));
  }

  handle(lamp) {
    const button = document.createElement('button');
    button.type = 'button';
    button.title = `${lamp.label}: drag it, or use arrow keys, PageUp and PageDown`;
    button.setAttribute('aria-label', button.title);
    let last = null;
    button.addEventListener('pointerdown', event => {
      button.setPointerCapture(event.pointerId);
      last = event;
    });
    button.addEventListener('pointermove', event => {
      if (!last) return;
      this.shift(lamp, event.clientX - last.clientX, event.clientY - last.clientY, 0);
      last = event;
    });
    for (const end of ['pointerup', 'pointercancel']) button.addEventListener(end, () => { last = null; });
    button.addEventListener('keydown', event => {
      const moves = { ArrowLeft: [-12, 0, 0], ArrowRight: [12, 0, 0], ArrowUp: [0, -12, 0], ArrowDown: [0, 12, 0], PageUp: [0, 0, -12], PageDown: [0, 0, 12] };
      if (!(event.key in moves)) return;
      event.preventDefault();
      this.shift(lamp, ...moves[event.key]);
    });
    this.holder.append(button);
    return { lamp, button };
  }

  placeOf(lamp) {
    const { sphere } = this.app.page;
    return lamp.kind === kinds.directional ? subtract(sphere.centre, scale(lamp.direction, 0.8 * sphere.radius)) : lamp.position;
  }

  // Pixels across, down and away.
  shift(lamp, x, y, away) {
    const { camera, lights, canvas } = this.app;
    if (lamp.kind === kinds.directional) {
      const angle = 3 / canvas.clientHeight;
      lights.aim(lamp, turned(turned(lamp.direction, [0, 1, 0], (x + away) * angle), camera.right, y * angle));
    } else {
      const depth = Math.max(-dot(subtract(lamp.position, camera.position), camera.back), 1e-3);
      const metre = camera.heightAt(depth) / canvas.clientHeight;
      const by = add(add(scale(camera.right, x * metre), scale(camera.up, -y * metre)), scale(camera.back, -away * metre));
      lights.moveTo(lamp, add(lamp.position, by));
    }
    this.app.changed();
  }

  place() {
    const { camera, canvas } = this.app, width = canvas.clientWidth, height = canvas.clientHeight;
    const { clipFromScene } = camera.matrices(width / height);
    for (const { lamp, button } of this.handles) {
      const clip = transformed(clipFromScene, this.placeOf(lamp));
      button.hidden = !this.app.lampsShine() || clip[3] <= 0 || Math.abs(clip[0]) > clip[3] || Math.abs(clip[1]) > clip[3];
      button.style.left = `${(0.5 + 0.5 * clip[0] / clip[3]) * width}px`;
      button.style.top = `${(0.5 - 0.5 * clip[1] / clip[3]) * height}px`;
    }
  }
}

// The edge between what was not baked, on its left, and what was.
class Divider {
  constructor(element, app) {
    Object.assign(this, { element, app });
    const moveTo = x => app.set({ split: Math.max(0.02, Math.min(0.98, x)) });
    element.addEventListener('pointerdown', event => {
      element.setPointerCapture(event.pointerId);
      this.held = true;
    });
    element.addEventListener('pointermove', event => { if (this.held) moveTo((event.clientX - app.canvas.getBoundingClientRect().left) / app.canvas.clientWidth); });
    for (const end of ['pointerup', 'pointercancel']) element.addEventListener(end, () => { this.held = false; });
    element.addEventListener('keydown', event => {
      const steps = { ArrowLeft: -0.02, ArrowRight: 0.02 };
      if (!(event.key in steps)) return;
      event.preventDefault();
      moveTo(app.state.split + steps[event.key]);
    });
  }

  place() {
    const { split } = this.app.state;
    this.element.hidden = split <= 0;
    this.element.style.left = `${100 * split}%`;
    this.element.setAttribute('aria-valuenow', Math.round(100 * split));
  }
}
