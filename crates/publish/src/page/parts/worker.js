// What a worker does: tables of figures, or one run of a reader's scene, told as it goes.

const PAUSE = 60;

/** Samples are handed over in bundles: times and deviations, then places and speeds of everybody. */
class Bundles {
  constructor() {
    this.samples = [];
    this.sent = performance.now();
  }

  sample(numbers) {
    this.samples.push(numbers.slice());
    if (performance.now() - this.sent > PAUSE) this.send();
  }

  event(text) {
    this.send();
    postMessage({ event: JSON.parse(text) });
  }

  checking() {
    this.send();
    postMessage({ checking: true });
  }

  send() {
    if (this.samples.length) postMessage({ samples: this.samples });
    this.samples = [];
    this.sent = performance.now();
  }
}

let engine;

const works = {
  sums: (figure) => ({ lines: engine.text('sums', figure) }),
  table: ([figure, table]) => ({ csv: engine.text('table', figure, table) }),
  run: ({ scene, origin, claims }) => {
    const summary = engine.about(scene, 'run');
    return { summary, claims: origin && judged(`${origin}\n${claims}`) };
  },
};

/** Claims on the run before; a text when they cannot be judged, which does not spoil the run. */
function judged(text) {
  try {
    return engine.about(text, 'judge');
  } catch (error) {
    return error.message;
  }
}

onmessage = ({ data: { module, work, given } }) => {
  const started = performance.now();
  try {
    if (module) engine = new Engine(module, new Bundles());
    const answer = work ? works[work](given) : {};
    postMessage({ done: work, given, seconds: (performance.now() - started) / 1000, ...answer });
  } catch (error) {
    // after a trap the module is unusable
    postMessage({ done: work, given, failure: error.message, trapped: error instanceof WebAssembly.RuntimeError });
  }
};
