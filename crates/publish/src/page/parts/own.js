// A law of the reader's own: fields and sliders for a scene, its stability at once, its run as it is computed.

/** Milliseconds after the last change before a run begins. */
const PATIENCE = 400;
/** Wave numbers of the curve of growth rates. */
const WAVE_NUMBERS = 200;
/** The scene that stands there at first. */
const FIRST = '(two phases)';
const RECORDS = ['trajectories', 'std'];
const METHODS = ['dop853', 'taylor', 'verner98', 'verner87', 'dopri54', 'extrapolation'];

class OwnLaw {
  constructor(host) {
    this.host = host;
    this.scenes = index.presets.flatMap((group) => group.scenes);
    const reason = hindrance();
    if (reason) { host.append(make('p', {}, reason)); return; }
    this.build();
    const given = SceneState.fromHash(location.hash);
    const first = this.scenes.find(({ name }) => name.includes(FIRST)) || this.scenes[0];
    if (!given) this.preset.value = this.scenes.indexOf(first);
    this.state = given || new SceneState(first);
    this.showFields();
    whenSeen(host, () => this.begin(), () => this.chart?.draw());
    addEventListener('hashchange', () => this.goTo(SceneState.fromHash(location.hash)));
    if (given) host.closest('section').scrollIntoView();
  }

  build() {
    const options = index.presets.map(({ name, scenes }) => make('optgroup', { label: name },
      ...scenes.map((scene) => make('option', { value: this.scenes.indexOf(scene) }, scene.name))));
    this.preset = make('select', { id: 'own-preset', onchange: () => this.pick(this.scenes[this.preset.value]) },
      make('option', { value: '' }, 'choose a scene …'), ...options);
    this.fields = make('div', { class: 'fields' });
    this.wrong = make('p', { class: 'wrong', role: 'alert', hidden: true });
    this.verdict = make('output', { id: 'own-verdict', 'aria-live': 'polite' });
    this.rates = make('div', {});
    const flow = make('div', { class: 'flow' }, make('h3', {}, 'Small waves on the uniform flow'), this.verdict, this.rates);
    const run = make('div', { class: 'run' });
    this.file = make('code', {});
    this.host.append(
      make('div', { class: 'controls' }, make('label', { for: 'own-preset' }, 'Start from'), this.preset),
      make('div', { class: 'own-stage' }, make('div', { class: 'editor' }, this.fields, this.wrong,
        make('div', { class: 'controls' }, make('button', { type: 'button', id: 'own-save', onclick: () => this.save() }, 'Save as scene.toml')),
        make('p', { class: 'hint' }, 'The address of the page holds what you changed: copy it to share the scene. On the command line: “cargo xtask simulate scene.toml --out my-run” gives the same bits.'),
        make('details', {}, make('summary', {}, 'The scene file'), make('pre', { tabindex: 0, 'aria-label': 'The scene file' }, this.file))), flow),
      run);
    this.view = new RunView(run);
  }

  async begin() {
    try {
      this.module = await theModule();
      this.engine = new Engine(this.module);
      this.changed(false);
    } catch (error) {
      this.complain({ problem: error.message });
    }
  }

  pick(scene) {
    if (!scene) return;
    this.state = new SceneState(scene);
    this.showFields();
    this.changed();
  }

  goTo(state) {
    if (!state || state.toHash() === this.state.toHash()) return;
    this.state = state;
    this.showFields();
    this.changed(false);
    this.host.closest('section').scrollIntoView();
  }

  /** One field for each value; they are built anew only when there are others. */
  showFields() {
    const { state } = this;
    this.places = new Map();
    const group = (title, ...rows) => make('fieldset', {}, make('legend', {}, title), ...rows);
    const place = (key, element) => {
      const wrong = make('p', { class: 'wrong', role: 'alert', hidden: true, id: `wrong-${key.replace(/\W/g, '-')}` });
      this.places.set(key, { element, wrong });
      return make('div', { class: 'place' }, element, wrong);
    };
    const changed = (table, key) => (value) => { state.set(table, key, value); this.changed(); };
    const law = state.law.map(([key, value]) => {
      if (key === 'kind' || key === 'preset') return make('p', { class: 'fixed' }, make('code', {}, `${key} = ${toml(value)}`));
      return place(`law.${key}`, typeof value === 'number'
        ? this.withRemoval(key, this.dial(key, value, this.unit(key), changed('law', key)))
        : this.withRemoval(key, this.formula(key, value, changed('law', key))));
    });
    const headway = this.dial('headway', state.headway, this.unit('headway'), (value) => {
      state.set('ring', 'length', value * state.get('ring', 'pedestrians'));
      this.changed();
    }, { least: 0 });
    const count = this.dial('pedestrians', state.get('ring', 'pedestrians'), 'people', (value) => {
      const gap = state.headway;
      state.set('ring', 'pedestrians', value);
      state.set('ring', 'length', gap * value);
      this.changed();
    }, { whole: true, least: 2 });
    const ring = [place('ring.pedestrians', count), place('ring.length', headway),
      place('start.shift', this.dial('shift', state.get('start', 'shift'), this.unit('shift'), changed('start', 'shift')))];
    const run = ['t_end', 'sample', 'tolerance', 'dt'].filter((key) => state.get('run', key) !== undefined)
      .map((key) => place(`run.${key}`, this.dial(key, state.get('run', key), this.unit(key), changed('run', key))));
    run.push(place('run.method', this.choice('method', METHODS, changed('run', 'method'))));
    run.push(place('run.record', this.choice('record', RECORDS, changed('run', 'record'))));
    const uniform = state.uniform.map(([key, value]) => place(`uniform.${key}`, this.dial(key, value, this.unit(key), changed('uniform', key))));
    this.fields.replaceChildren(group('The law', ...law, ...(state.isFormula ? [this.addition()] : [])), group('The ring', ...ring, ...uniform),
      make('details', {}, make('summary', {}, 'Time, method, tolerance'), group('The run', ...run)));
  }

  dial(name, value, unit, changed, more = {}) {
    return new Dial({ name, value, unit, changed, ...more }).element;
  }

  formula(key, value, changed) {
    const id = `own-${key}`;
    const field = make('input', {
      type: 'text', id, value, spellcheck: 'false', autocomplete: 'off', autocapitalize: 'off', oninput: () => changed(field.value),
    });
    return make('div', { class: 'formula' }, make('label', { for: id }, make('code', {}, key)), field);
  }

  /** A law may lose any line but those that it must have. */
  withRemoval(key, element) {
    if (!this.state.isFormula || ['acceleration', 'body'].includes(key)) return element;
    element.append(make('button', {
      type: 'button', class: 'small', 'aria-label': `Remove ${key}`, onclick: () => { this.state.remove('law', key); this.showFields(); this.changed(); },
    }, '×'));
    return element;
  }

  addition() {
    const name = make('input', { type: 'text', id: 'own-name', autocomplete: 'off', size: 8 });
    const value = make('input', { type: 'text', id: 'own-value', autocomplete: 'off', size: 12 });
    const add = () => {
      const key = name.value.trim();
      if (!/^[A-Za-z_]\w*$/.test(key)) { this.complain({ problem: `${key || 'a name'}: must be letters, digits and _, and begin with a letter` }); return; }
      const number = Number(value.value);
      this.state.set('law', key, value.value.trim() !== '' && Number.isFinite(number) ? number : value.value);
      this.showFields();
      this.changed();
    };
    return make('div', { class: 'addition' }, make('label', { for: 'own-name' }, 'Another name'), name, make('label', { for: 'own-value' }, 'number or formula'), value,
      make('button', { type: 'button', onclick: add }, 'Add'));
  }

  choice(key, values, changed) {
    const now = this.state.get('run', key) ?? values[0];
    const id = `own-${key}`;
    const select = make('select', { id, onchange: () => changed(select.value) },
      ...[...new Set([now, ...values])].map((value) => make('option', { selected: value === now }, value)));
    return make('div', { class: 'dial' }, make('label', { for: id }, make('code', {}, key)), select);
  }

  /** In which unit a number is; a law as formulas is in units of its own. */
  unit(key) {
    const [length, time] = this.state.isFormula ? ['lengths', 'times'] : ['a₀', 'τ'];
    const units = { headway: length, shift: length, body: length, t_end: time, sample: time, dt: time, tolerance: 'of the perturbation', speed: `${length}/${time}` };
    const ofPaper = { v0: 'a₀/τ', a_v: 'τ', epsilon: 'a₀', a: 'a₀/τ²', b: 'a₀' };
    return units[key] || (this.state.isFormula ? 'law’s units' : ofPaper[key] || '(no unit)');
  }

  /** At once the waves, then, when nothing changes any more, the run. `kept`: whether the address changes. */
  changed(kept = true) {
    if (!this.engine) return;
    const { text, keys } = this.state.text();
    this.file.textContent = text;
    if (kept) history.replaceState(null, '', this.state.toHash());
    clearTimeout(this.timer);
    for (const { element, wrong } of this.places.values()) {
      wrong.hidden = true;
      for (const input of element.querySelectorAll('input, select')) { input.removeAttribute('aria-invalid'); input.removeAttribute('aria-describedby'); }
    }
    this.wrong.hidden = true;
    const problem = Motion.tooLarge(this.state);
    if (problem) { this.view.stop(''); this.complain(problem, keys); return; }
    const started = performance.now();
    let told;
    try {
      told = this.engine.about(text, 'stability', WAVE_NUMBERS);
    } catch (error) {
      // a trap, which has no complaint to tell, leaves the module in no state to go on with
      if (!error.message.startsWith('{')) this.engine = new Engine(this.module);
      this.view.stop('');
      this.complain(this.complaint(error), keys);
      return;
    }
    this.showFlow(told);
    this.host.dataset.milliseconds = performance.now() - started;
    this.view.stop('The run begins when nothing changes any more.');
    this.timer = setTimeout(() => this.view.start(this.state, this.fast(told)), PATIENCE);
  }

  /** The speed that the palest dots have. */
  fast({ speed }) {
    return this.state.get('law', 'v0') || this.state.get('law', 'scale') || Math.abs(speed) || 1;
  }

  complaint(error) {
    try { return JSON.parse(error.message); } catch { return { problem: error.message }; }
  }

  /** Says what is wrong below the field that it is about. */
  complain({ problem, key, line }, keys = {}) {
    const about = key || keys[line]?.key;
    const place = this.places.get(about) || (about?.startsWith('law.') && this.places.get('law.acceleration'));
    const begin = Object.values(keys).find((one) => one.key === about)?.column ?? 1;
    // columns of the field in place of those of the file
    const words = problem.replace(/^column (\d+)/, (_, column) => `column ${Number(column) - begin + 1}`);
    this.verdict.textContent = '';
    this.rates.hidden = true;
    const wrong = place ? place.wrong : this.wrong;
    wrong.textContent = words;
    wrong.hidden = false;
    for (const input of place ? place.element.querySelectorAll('input, select') : []) {
      input.setAttribute('aria-invalid', 'true');
      input.setAttribute('aria-describedby', wrong.id);
    }
  }

  showFlow({ speed, uniform_flow: flow, k, rate, waves, error }) {
    this.host.dataset.flow = JSON.stringify({ speed, flow, error });
    if (!flow || !k) {
      this.verdict.textContent = speed === null ? 'There is no uniform flow; the run goes on in spacings.'
        : `The uniform flow (speed ${words(speed)}) answers to small waves with no derivative: it lies on a kink of the law.`;
      this.rates.hidden = true;
      return;
    }
    this.rates.hidden = false;
    const many = this.state.get('ring', 'pedestrians');
    const growing = flow.growing_k && (flow.growing_k[0] === 0 ? 'from long ones' : `from k = ${words(flow.growing_k[0], 4)}`);
    const all = flow.growing_k ? `unstable (margin ${words(flow.margin, 4)}): waves ${growing} to k = ${words(flow.growing_k[1], 4)} grow`
      : flow.margin === 0 ? 'neutral (margin 0): no wave grows, but not all decay' : `stable (margin ${words(flow.margin, 4)}) for waves of all lengths`;
    const onRing = flow.margin_on_ring > 0 ? 'grow fastest' : 'slowest';
    const found = flow.margin_on_ring > 0 ? 'of the waves on this ring' : 'on this ring all decay;';
    this.verdict.textContent = `By the exact criterion the uniform flow at speed ${words(speed, 6)} is ${all}; ${found} ${flow.waves} in ${many} ${onRing}, at rate ${words(flow.growth_rate, 4)}. `
      + `Rates are off by at most ${words(error, 1)}.`;
    const series = [{ name: 'all waves', x: k, y: rate }];
    if (waves.k.length) series.push({ name: 'waves of the ring', x: waves.k, y: waves.rate, points: true });
    const spec = { name: 'Growth rate against wave number', x: 'k', y: 'Re z⁺', series };
    if (this.chart) this.chart.show(spec);
    else this.chart = new Chart(this.rates, spec);
  }

  save() {
    const address = URL.createObjectURL(new Blob([this.state.text().text], { type: 'application/toml' }));
    make('a', { href: address, download: 'scene.toml' }).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  }
}
