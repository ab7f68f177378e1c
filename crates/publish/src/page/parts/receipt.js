// What was computed in this browser and with what verdict, to look at and to copy.

const SAME = 'same bits';
/** How many digits of a sum are shown. */
const SHOWN = 8;

const seconds = (value) => `${value < 0.1 ? '< 0.1' : value.toFixed(1)} s`;
const several = (count, word) => `${count} ${word}${count === 1 ? '' : 's'}`;

class Receipt {
  constructor(host, states) {
    this.states = states;
    this.body = make('tbody', {});
    this.text = make('textarea', { readonly: true, rows: 8, spellcheck: 'false', 'aria-label': 'Receipt' });
    this.said = make('output', {});
    this.note = make('p', {});
    const head = ['table', 'committed', 'in your browser', 'time'].map((name) => make('th', { scope: 'col' }, name));
    host.append(this.note,
      make('div', { class: 'wide', role: 'group', tabindex: 0, 'aria-label': 'Sums of the tables' },
        make('table', {}, make('thead', {}, make('tr', {}, ...head)), this.body)),
      make('h3', {}, 'Receipt'), this.text,
      make('div', { class: 'controls' }, make('button', { type: 'button', onclick: () => this.copy() }, 'Copy the receipt')), this.said);
  }

  async copy() {
    this.text.select();
    let copied = false;
    try {
      await navigator.clipboard.writeText(this.text.value);
      copied = true;
    } catch { copied = document.execCommand('copy'); }
    this.said.textContent = copied ? 'Copied.' : 'Selected; copy it by Ctrl+C.';
  }

  /** The sums, verdict and browser, as JSON. */
  value() {
    const computed = this.states.filter((one) => Object.keys(one.found).length);
    const sums = Object.assign({}, ...computed.map((one) => one.found));
    const isSame = computed.length > 0 && this.states.every((one) => ['same', 'waits', 'computed'].includes(one.state));
    const verdict = computed.length === 0 ? 'nothing computed' : isSame ? SAME : 'differs';
    const time = computed.reduce((sum, one) => sum + one.seconds, 0);
    return { schema_version: 1, page: document.title, browser: navigator.userAgent, seconds: Number(time.toFixed(2)), verdict, sums };
  }

  show(reason) {
    const value = this.value();
    const made = Object.keys(value.sums).length;
    const all = this.states.reduce((sum, one) => sum + Object.keys(one.sums).length, 0);
    this.note.textContent = reason || `${made} of ${all} tables computed in your browser, ${seconds(value.seconds)} in all: ${value.verdict}.`;
    this.text.value = JSON.stringify(value, null, 1);
    this.body.replaceChildren(...this.states.flatMap((state) => Object.entries(state.sums).map(([name, sum], i) => {
      const found = state.found[name];
      const short = (text) => make('code', { title: text }, `${text.slice(0, SHOWN)}…`);
      const mine = found ? [short(found), found === sum ? ' same' : ' other'] : [state.state === 'failed' ? 'failed' : '–'];
      const time = i === 0 && state.seconds !== undefined ? seconds(state.seconds) : '';
      return make('tr', {}, make('th', { scope: 'row' }, make('code', {}, name)), make('td', {}, short(sum)),
        make('td', {}, ...mine), make('td', {}, time));
    })));
  }
}
