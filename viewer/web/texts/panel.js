// Choices and sliders beside the picture; all have labels, so that screen readers name them.
const factorText = factor => factor < 0.01 && factor > 0 ? factor.toExponential(1) : factor.toFixed(2);

class Panel {
  constructor(element, app) {
    Object.assign(this, { element, app, updates: [] });
    const details = document.createElement('details');
    details.open = !window.matchMedia('(max-width: 700px), (max-height: 450px)').matches;  // page.css
    details.append(this.text('summary', app.page.title));
    element.append(details);
    this.body = details;
    this.choice('Shading', app.shadings.map(({ name, label }) => [name, `${name}: ${label}`]), () => app.state.technique, technique => app.set({ technique }));
    this.addLeftOut();
    this.addSky();
    this.slider('Exposure', [-12, 12, 0.05], () => Math.log2(app.state.exposure), x => app.set({ exposure: 2 ** x }), x => factorText(2 ** x));
    this.slider('Before / after', [0, 1, 0.01], () => app.state.split, split => app.set({ split }), x => x > 0 ? `${Math.round(100 * x)} %` : 'baked');
    this.addMotion();
    this.addLights();
    this.addGroups();
    this.addButtons();
    this.help = this.helpList();
  }

  text(tag, content) {
    const element = document.createElement(tag);
    element.textContent = content;
    return element;
  }

  labelled(name, control, output) {
    const label = document.createElement('label'), row = this.text('span', '');
    row.append(this.text('b', name), ...(output ? [output] : []));
    control.id = `control${this.body.children.length}`;
    label.htmlFor = control.id;
    label.append(row, control);
    this.body.append(label);
    return label;
  }

  choice(name, options, read, write) {
    const select = document.createElement('select');
    for (const [value, label] of options) select.append(Object.assign(document.createElement('option'), { value, textContent: label }));
    select.addEventListener('change', () => write(select.value));
    this.updates.push(() => { select.value = read(); });
    this.labelled(name, select);
  }

  // `applies`: whether it changes the picture in the shading that is shown.
  slider(name, [min, max, step], read, write, show, applies = () => true) {
    const input = Object.assign(document.createElement('input'), { type: 'range', min, max, step }), output = this.text('i', '');
    input.addEventListener('input', () => write(Number(input.value)));
    this.updates.push(() => {
      input.value = read();
      output.textContent = show(read());
      input.setAttribute('aria-valuetext', output.textContent);
    });
    output.setAttribute('aria-hidden', 'true');
    const label = this.labelled(name, input, output);
    this.updates.push(() => { label.hidden = !applies(); });
  }

  addSky() {
    const { app } = this;
    if (app.page.skies.length === 0) return;
    this.choice('Sky', [...app.page.skies.map((sky, i) => [String(i), sky.name]), ['-1', 'none']], () => String(app.state.sky),
      sky => app.set({ sky: Number(sky) }));
    this.slider('Sky turned', [0, 360, 1], () => ((app.state.angle * 180 / Math.PI) % 360 + 360) % 360, x => app.set({ angle: x * Math.PI / 180 }),
      x => `${Math.round(x)}°`);
  }

  addLeftOut() {
    const { leftOut } = this.app.page;
    if (leftOut.length > 0) this.body.append(this.text('p', `Left out: ${leftOut.map(({ what, why }) => `${what} (${why})`).join('; ')}`));
  }

  addMotion() {
    const { app } = this, { motion } = app.page;
    if (!motion) return;
    this.slider('Time', [motion.start, motion.end, 1 / 24], () => app.state.time ?? motion.start, time => {
      app.play(false);
      app.set({ time });
    }, x => `${x.toFixed(2)} s`);
    const button = this.button('Play', () => app.play());
    const note = this.text('p', '');
    this.body.append(note);
    this.updates.push(() => {
      button.textContent = app.plays ? 'Pause' : 'Play';
      const { technique, time } = app.state, stays = time !== null && !follows(motion, technique) ? [`${technique} shading stays as it was baked`] : [];
      note.textContent = [...stays, ...motion.notes].join('; ');
    });
  }

  addLights() {
    const { app } = this, { lights } = app;
    const factor = (name, read, write) => this.slider(name, [0, 4, 0.01], read, x => {
      write(x);
      app.changed();
    }, factorText, () => app.lampsShine());
    for (const lamp of lights.lamps) factor(lamp.label, () => lamp.factor, x => { lamp.factor = x; });
    if (lights.own.length > lights.lamps.length) factor('Emissive surfaces', () => lights.emission, x => { lights.emission = x; });
  }

  addGroups() {
    const { app } = this;
    (app.groups ?? []).forEach(({ name }, g) => this.slider(`Group ${name}`, [0, 4, 0.01], () => app.state.groupFactors[g][0], x => {
      app.state.groupFactors[g] = [x, x, x];
      app.changed();
    }, factorText, () => app.state.technique === 'lights'));
  }

  button(name, act) {
    const element = Object.assign(this.text('button', name), { type: 'button' });
    element.addEventListener('click', act);
    this.body.append(element);
    return element;
  }

  addButtons() {
    this.button('Meter', () => this.app.meter());
    this.button('First view', () => this.app.reset());
    this.helpButton = this.button('Help', () => this.showHelp());
  }

  helpList() {
    const list = Object.assign(this.text('ul', ''), { className: 'help', id: 'help', hidden: true });
    for (const [key, what] of help) list.append(this.text('li', `${key}: ${what}`));
    this.body.append(list);
    this.helpButton.setAttribute('aria-controls', list.id);
    this.helpButton.setAttribute('aria-expanded', 'false');
    return list;
  }

  showHelp() {
    this.body.open = true;
    this.help.hidden = !this.help.hidden;
    this.helpButton.setAttribute('aria-expanded', String(!this.help.hidden));
  }

  update() { for (const update of this.updates) update(); }
}
