// The page verifies itself: each figure, once in view, is computed again in a worker, and its tables' sums are set beside
// the committed ones.

class Verification {
  constructor(host, short) {
    this.short = short;
    this.states = index.recomputed.map((one) => ({ ...one, found: {}, state: 'waits' }));
    this.wanted = new Set();
    this.receipt = new Receipt(host, this.states);
    const reason = hindrance();
    for (const state of this.states) {
      const article = document.getElementById(state.figure);
      state.line = make('p', { class: 'bits' }, reason || 'Recomputed in your browser once it is in view.');
      article.querySelector('figure').after(state.line);
    }
    this.receipt.show(reason);
    if (reason) { this.short.textContent = reason; return; }
    this.tell();
    for (const state of this.states) this.watch(document.getElementById(state.figure), [state]);
    // who looks at the receipt wants all of it
    this.watch(host, this.states);
  }

  /** Wants figures once an element is in view. */
  watch(element, states) {
    new IntersectionObserver((entries, observer) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      observer.disconnect();
      for (const state of states) if (state.state === 'waits') this.wanted.add(state);
      this.next();
    }).observe(element);
  }

  /** Starts the cheapest figure that is wanted: they are listed so. */
  async next() {
    if (this.busy) return;
    const state = this.states.find((one) => this.wanted.has(one));
    if (!state) return;
    this.busy = true;
    this.wanted.delete(state);
    state.state = 'computed';
    state.line.textContent = 'Recomputing in your browser …';
    try {
      await this.judge(state);
    } catch (error) {
      this.failed(state, error.message);
    }
    this.busy = false;
    this.tell();
    if (this.states.every((one) => one.state !== 'waits')) this.end();
    this.next();
  }

  /** The worker's answer to one piece of work. */
  async ask(work, given) {
    this.worker ||= startWorker((answer) => this.hear?.(answer));
    const worker = await this.worker;
    return new Promise((resolve, reject) => {
      this.hear = (answer) => {
        if (answer.failure) {
          // the module is not used again after a trap
          if (answer.trapped) this.end();
          reject(new Error(answer.failure));
        } else if (answer.done) resolve(answer);
      };
      worker.postMessage({ work, given });
    });
  }

  async judge(state) {
    const number = Number(state.figure.replace(/\D/g, '')) - 1;
    const answer = await this.ask('sums', number);
    state.seconds = answer.seconds;
    for (const line of answer.lines.trim().split('\n')) {
      const [sum, name] = line.split(/\s+/);
      state.found[name] = sum;
    }
    const names = Object.keys(state.sums);
    const others = names.filter((name) => state.found[name] !== state.sums[name]);
    state.state = others.length ? 'differs' : 'same';
    state.line.dataset.state = state.state;
    if (!others.length) {
      state.line.textContent = `Same bits, in your browser: ${several(names.length, 'table')}, ${seconds(state.seconds)}.`;
      return;
    }
    const told = [];
    for (const name of others) {
      const { csv } = await this.ask('table', [number, names.indexOf(name)]);
      told.push(`${name} ${differenceOf(name, csv)}`);
    }
    state.differences = told;
    state.line.textContent = `Other bits, in your browser: ${told.join('; ')}.`;
  }

  failed(state, reason) {
    state.state = 'failed';
    state.line.dataset.state = 'failed';
    state.line.textContent = `Not recomputed: ${reason}.`;
  }

  tell() {
    const count = (name) => this.states.filter((one) => one.state === name).length;
    const [same, differs, failed] = ['same', 'differs', 'failed'].map(count);
    const bad = `${differs ? `; ${differs} differ` : ''}${failed ? `; ${failed} could not be computed` : ''}`;
    this.short.textContent = same + differs + failed === 0
      ? 'Figures are recomputed in your browser as you come to them.'
      : `Recomputed in your browser so far: ${same} of ${this.states.length} figures with tables, same bits${bad}.`;
    this.receipt.show();
  }

  /** All is computed: the worker and its memory go. */
  async end() {
    const worker = this.worker;
    this.worker = undefined;
    (await worker)?.terminate();
  }
}
