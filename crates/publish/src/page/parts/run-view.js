// A run of a reader's scene as it is computed: ring, space-time picture, standard deviation, events, and at the end the outcome.

/** Milliseconds between two drawings of a run under way. */
const BREATH = 250;
const EVENTS = {
  overlap: 'overlap', negative_speed: 'a pedestrian walks backwards', exchange: 'two pedestrians exchange places', undefined: 'the formula has no value',
  blow_up: 'a speed grows without bound',
};
const CLASSES = {
  closed: 'two pedestrians touch at the start', no_uniform_flow: 'no uniform flow', undefined: 'the formula has no value any more', blow_up: 'blow-up',
  contact: 'contact', decays: 'back to the uniform flow', waves_backwards: 'lasting waves, in which a pedestrian walks backwards',
  waves: 'lasting waves', undecided: 'undecided',
};
const OWN_HINT = 'In the strip time runs to the right, the position on the ring upwards; a click goes to that time. Colours show speeds '
  + 'from standing (or backwards) to the fastest.';

class RunView {
  constructor(host) {
    this.host = host;
    this.status = make('output', { 'aria-live': 'polite' });
    this.bar = make('progress', { max: 1, value: 0, 'aria-label': 'Progress of the run' });
    this.stage = make('div', {});
    this.note = make('p', { class: 'hint', hidden: true }, 'This scene records the standard deviation alone; with record = trajectories the ring is shown.');
    this.button = make('button', { type: 'button', hidden: true, onclick: () => { this.stop('Stopped.'); this.host.classList.remove('stale'); } }, 'Stop the run');
    this.log = false;
    this.deviation = make('div', {});
    this.events = make('ul', { class: 'events' });
    this.sums = make('div', {});
    host.append(make('h3', {}, 'The run'), this.status, this.bar, this.button, this.events, this.note, this.stage,
      make('h4', {}, 'Standard deviation of the speeds'),
      make('div', { class: 'controls' }, make('label', {}, make('input', {
        type: 'checkbox', onchange: (event) => { this.log = event.target.checked; this.drawDeviation(); },
      }), 'logarithmic')), this.deviation);
    this.rejudged = new Rejudged(host);
    host.append(this.sums);
    this.still = matchMedia('(prefers-reduced-motion: reduce)');
  }

  /** Starts a run; the one before ends where it is. */
  async start(state, fast) {
    this.stop('Computing …');
    const { turn } = this;
    this.motion = new Motion(state, fast);
    this.found = [];
    this.shapeRing();
    this.bar.hidden = this.button.hidden = false;
    this.bar.value = 0;
    this.started = performance.now();
    const worker = await startWorker((answer) => { if (turn === this.turn) this.hear(answer); }).catch((error) => {
      this.status.textContent = error.message;
    });
    // who was overtaken while starting ends at once
    if (turn !== this.turn) { worker?.terminate(); return; }
    this.worker = worker;
    worker?.postMessage({ work: 'run', given: { scene: state.text().text, origin: state.origin, claims: index.rejudged } });
  }

  /** Ends the run under way; what is shown belongs to another scene from here on. */
  stop(reason) {
    this.worker?.terminate();
    this.worker = undefined;
    if (this.ring?.playing) this.ring.pause();
    this.turn = (this.turn || 0) + 1;
    delete this.stage.dataset.outcome;
    this.status.setAttribute('aria-live', 'off');
    this.status.textContent = reason;
    this.host.classList.add('stale');
    this.bar.hidden = this.button.hidden = true;
    this.events.replaceChildren();
    this.rejudged.clear();
    this.sums.replaceChildren();
  }

  /** One ring serves all runs. */
  shapeRing() {
    const { last, interval, pedestrians, keeps } = this.motion;
    this.stage.hidden = !keeps;
    this.note.hidden = keeps;
    if (!keeps) return;
    const paces = [60, 15, 5].map((time) => Number((last / time).toPrecision(1)));
    const shape = { pedestrians, last, interval, paces };
    if (this.ring) this.ring.reshape(shape);
    else this.ring = new Ring(this.stage, { ...shape, hint: OWN_HINT, names: ['standing', 'fastest'] });
  }

  hear(answer) {
    if (answer.samples) answer.samples.forEach((sample) => this.motion.add([...sample]));
    if (answer.event) this.event(answer.event);
    if (answer.checking) {
      this.status.textContent = 'The run has ended; a second one estimates its errors …';
      this.bar.value = 1;
    }
    if (answer.failure) this.fail(answer.failure);
    if (answer.done === 'run' && answer.summary) this.end(answer.summary, answer.claims);
    else if (answer.samples) this.drawSoon();
  }

  /** Draws now and then; who wants no motion sees the end alone. */
  drawSoon() {
    const t = this.motion.t.at(-1);
    this.bar.value = t / this.motion.last;
    this.status.textContent = `Computing: t = ${words(t)} of ${words(this.motion.last)} …`;
    if (this.still.matches || (this.drawn && performance.now() - this.drawn < BREATH)) return;
    this.draw();
    this.drawn = performance.now();
  }

  draw() {
    this.host.classList.remove('stale');
    if (this.motion.keeps && !this.ring.playing && this.motion.samples) this.ring.show(this.motion, this.motion.t.at(-1));
    this.drawDeviation();
  }

  drawDeviation() {
    const { t, std } = this.motion || { t: [] };
    if (!t.length) return;
    const spec = {
      name: 'Standard deviation of the speeds against time', x: 't', y: 'std of v', log: this.log && std.some((value) => value > 0),
      series: [{ name: '', x: [...t], y: [...std] }],
    };
    if (t.length < 2) return;
    if (this.chart) this.chart.show(spec);
    else this.chart = new Chart(this.deviation, spec);
  }

  event(event) {
    if (!this.found.some((one) => one.event === event.event)) this.found.push(event);
    this.tellEvents();
  }

  tellEvents() {
    this.events.replaceChildren(...this.found.map(({ event, t, n, error }) => make('li', {},
      `${EVENTS[event] || event} at t = ${words(t, 8)}${error ? ` ± ${words(error, 1)}` : ''}, pedestrian ${n}`)));
  }

  fail(failure) {
    let problem = failure;
    try { problem = JSON.parse(failure).problem; } catch { /* a plain text */ }
    this.stop(`The run could not be computed: ${problem}`);
    this.status.setAttribute('aria-live', 'polite');
  }

  end(summary, claims) {
    const time = (performance.now() - this.started) / 1000;
    this.worker?.terminate();
    this.worker = undefined;
    this.bar.hidden = this.button.hidden = true;
    this.found = [];
    for (const { event, t, n, error } of summary.events) if (!this.found.some((one) => one.event === event)) this.found.push({ event, t, n, error });
    this.tellEvents();
    this.status.setAttribute('aria-live', 'polite');
    this.status.textContent = `${this.outcome(summary)} ${this.errors(summary)} ${summary.steps} steps, ${seconds(time)} in your browser.`;
    // a run that ended early fills the strip
    const last = this.motion.t.at(-1) || this.motion.interval;
    if (last < this.motion.last) {
      this.motion.last = last;
      this.shapeRing();
    }
    this.draw();
    this.rejudged.show(claims);
    this.tellSums(summary);
    this.stage.dataset.outcome = JSON.stringify(summary);
  }

  outcome({ outcome, stop, reason }) {
    if (reason) return `The run failed: ${reason}.`;
    if (!outcome) return `The run ended (${stop}).`;
    if (outcome.class === 'undecided') return `Outcome: undecided; needs ${outcome.missing}.`;
    const wave = outcome.wave_speed === null ? '' : `, travelling at ${words(outcome.wave_speed)}`;
    return `Outcome: ${CLASSES[outcome.class] || outcome.class}${wave} (${outcome.decided_by}, at t = ${words(outcome.t)}).`;
  }

  errors({ error }) {
    const number = (value) => (value === null ? 'unknown' : words(value, 1));
    return `Estimated errors: standard deviation ${number(error.std)}; at the end positions ${number(error.x)}, speeds ${number(error.v)}.`;
  }

  /** What the command line writes for the same scene has these sums. */
  tellSums({ sums }) {
    const rows = Object.entries(sums).map(([name, sum]) => make('tr', {}, make('th', { scope: 'row' }, make('code', {}, name)),
      make('td', {}, make('code', {}, sum))));
    this.sums.replaceChildren(make('details', {}, make('summary', {}, 'Sums of this run’s tables'),
      make('p', { class: 'hint' }, 'The command “cargo xtask simulate scene.toml --out my-run” writes tables with these SHA-256.'),
      make('div', { class: 'wide', role: 'group', tabindex: 0, 'aria-label': 'Sums of this run’s tables' }, make('table', {}, make('tbody', {}, ...rows)))));
  }
}
