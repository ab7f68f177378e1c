// What a run of a reader's scene has given so far: positions, speeds, deviations.

/** More rows than this would fill the memory of a phone. */
const MOST_ROWS = 2e6;
/** More pedestrians than this would keep the page waiting for their waves. */
const MOST_PEDESTRIANS = 2e4;

class Motion {
  constructor(state, fast) {
    this.pedestrians = state.get('ring', 'pedestrians');
    this.length = state.get('ring', 'length');
    this.interval = state.get('run', 'sample');
    this.last = state.get('run', 't_end');
    this.unit = 1;
    this.fast = fast;
    this.samples = 0;
    this.keeps = state.get('run', 'record') !== 'std';
    const rows = (Math.floor(this.last / this.interval + 1e-9) + 2) * (this.keeps ? this.pedestrians : 0);
    this.positions = new Float32Array(rows);
    this.speeds = new Float32Array(rows);
    this.t = [];
    this.std = [];
  }

  /** What is too large to be shown, and why; undefined if nothing is. */
  static tooLarge(state) {
    if (state.get('ring', 'pedestrians') > MOST_PEDESTRIANS) {
      return { key: 'ring.pedestrians', problem: `too many for the page, whose limit is ${words(MOST_PEDESTRIANS)}; the command line accepts more` };
    }
    const rows = (state.get('run', 't_end') / state.get('run', 'sample')) * state.get('ring', 'pedestrians');
    return rows > MOST_ROWS ? { key: 'run.sample', problem: `gives ${words(rows, 3)} rows, more than the page's limit of ${words(MOST_ROWS)}; sample less often` } : undefined;
  }

  add([t, std, ...numbers]) {
    this.t.push(t);
    this.std.push(std);
    if (!this.keeps) return;
    const at = this.samples * this.pedestrians;
    this.positions.set(numbers.slice(0, this.pedestrians), at);
    this.speeds.set(numbers.slice(this.pedestrians), at);
    for (const speed of numbers.slice(this.pedestrians)) if (speed > this.fast) this.fast = speed;
    this.samples += 1;
  }
}
