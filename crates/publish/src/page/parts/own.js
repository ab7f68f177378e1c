// A law of the reader's own: fields for a scene, its stability at once, its run as it is computed.

/** Milliseconds after the last change before a run begins. */
const PATIENCE = 400;
/** The scene that stands there at first. */
const FIRST = '(two phases)';
const ADVICE = 'The address of the page holds what you changed: copy it to share the scene. On the command line: '
  + '“cargo xtask simulate scene.toml --out my-run” gives the same bits.';

class OwnLaw {
  constructor(host) {
    this.host = host;
    this.scenes = index.presets.flatMap((group) => group.scenes);
    const reason = hindrance();
    if (reason) { host.append(make('p', {}, reason)); return; }
    this.build();
    const first = this.scenes.find(({ name }) => name.includes(FIRST)) || this.scenes[0];
    const given = SceneState.fromHash(location.hash);
    if (!given) this.preset.value = this.scenes.indexOf(first);
    this.state = given || new SceneState(first);
    this.fields.show(this.state);
    whenSeen(host, () => this.begin(), () => this.flow.draw());
    addEventListener('hashchange', () => this.goTo(SceneState.fromHash(location.hash)));
    if (given) host.closest('section').scrollIntoView();
  }

  build() {
    const options = index.presets.map(({ name, scenes }) => make('optgroup', { label: name },
      ...scenes.map((scene) => make('option', { value: this.scenes.indexOf(scene) }, scene.name))));
    this.preset = make('select', { id: 'own-preset', onchange: () => this.pick(this.scenes[this.preset.value]) },
      make('option', { value: '' }, 'choose a scene …'), ...options);
    this.file = make('code', {});
    const [editor, flow, run] = ['editor', 'flow', 'run'].map((name) => make('div', { class: name }));
    this.fields = new Fields(editor, () => this.changed());
    editor.append(
      make('div', { class: 'controls' }, make('button', { type: 'button', id: 'own-save', onclick: () => this.save() }, 'Save as scene.toml')),
      make('p', { class: 'hint' }, ADVICE),
      make('details', {}, make('summary', {}, 'The scene file'), make('pre', { tabindex: 0, 'aria-label': 'The scene file' }, this.file)));
    this.host.append(
      make('div', { class: 'controls' }, make('label', { for: 'own-preset' }, 'Start from'), this.preset),
      make('div', { class: 'own-stage' }, editor, flow), run);
    this.flow = new FlowView(flow);
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
    this.fields.show(this.state);
    this.changed();
  }

  goTo(state) {
    if (!state || state.toHash() === this.state.toHash()) return;
    this.state = state;
    this.fields.show(state);
    this.changed(false);
    this.host.closest('section').scrollIntoView();
  }

  /** At once the waves, then, when nothing changes any more, the run. `kept`: whether the address changes. */
  changed(kept = true) {
    if (!this.engine) return;
    const { text, keys } = this.state.text();
    this.file.textContent = text;
    if (kept) history.replaceState(null, '', this.state.toHash());
    clearTimeout(this.timer);
    this.fields.clear();
    const problem = Motion.tooLarge(this.state);
    if (problem) { this.complain(problem, keys); return; }
    const started = performance.now();
    let told;
    try {
      told = this.engine.about(text, 'stability', WAVE_NUMBERS);
    } catch (error) {
      this.complain(this.complaint(error), keys);
      return;
    }
    this.flow.show(told, this.state.get('ring', 'pedestrians'));
    Object.assign(this.host.dataset, {
      milliseconds: performance.now() - started,
      flow: JSON.stringify({ speed: told.speed, flow: told.uniform_flow, error: told.error }),
    });
    this.view.stop('The run begins when you stop editing.');
    this.timer = setTimeout(() => this.view.start(this.state, this.fast(told)), PATIENCE);
  }

  /** The speed that the palest dots have. */
  fast({ speed }) {
    return this.state.get('law', 'v0') || this.state.get('law', 'scale') || Math.abs(speed) || 1;
  }

  /** What the module complains of; a trap has nothing to tell and leaves it in no state to go on with. */
  complaint(error) {
    if (error.message.startsWith('{')) return JSON.parse(error.message);
    this.engine = new Engine(this.module);
    return { problem: error.message };
  }

  complain(complaint, keys) {
    this.view.stop('');
    this.flow.clear();
    this.fields.complain(complaint, keys);
  }

  save() {
    const address = URL.createObjectURL(new Blob([this.state.text().text], { type: 'application/toml' }));
    make('a', { href: address, download: 'scene.toml' }).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  }
}
