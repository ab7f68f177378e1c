// The fields of a reader's scene: formulas, sliders, choices; what is wrong stands below the field that it is about.

const RECORDS = ['trajectories', 'std'];
const METHODS = ['dop853', 'taylor', 'verner98', 'verner87', 'dopri54', 'extrapolation'];
const NAME = /^[A-Za-z_]\w*$/;
const NO_NAME = 'must be letters, digits and _, and begin with a letter';

class Fields {
  /** `changed` is called after the state has changed. */
  constructor(host, changed) {
    this.changed = changed;
    this.host = make('div', { class: 'fields' });
    this.wrong = make('p', { class: 'wrong', role: 'alert', hidden: true });
    host.append(this.host, this.wrong);
  }

  /** Builds the fields of a state. */
  show(state) {
    this.state = state;
    this.places = new Map();
    const group = (title, ...rows) => make('fieldset', {}, make('legend', {}, title), ...rows);
    const numbers = (table, keys) => keys.filter((key) => state.get(table, key) !== undefined)
      .map((key) => this.place(`${table}.${key}`, this.dial(key, state.get(table, key), this.setter(table, key))));
    const run = [...numbers('run', ['t_end', 'sample', 'tolerance', 'dt']), this.choice('method', METHODS), this.choice('record', RECORDS)];
    this.host.replaceChildren(
      group('The law', ...this.law(), ...(state.isFormula ? [this.addition()] : [])),
      group('The ring', ...this.ring(), ...numbers('start', ['shift']), ...numbers('uniform', ['speed'])),
      make('details', {}, make('summary', {}, 'Time, method, tolerance'), group('The run', ...run)));
  }

  setter(table, key) {
    return (value) => { this.state.set(table, key, value); this.changed(); };
  }

  /** A field with room for what is wrong with it. */
  place(key, element) {
    const wrong = make('p', { class: 'wrong', role: 'alert', hidden: true, id: `wrong-${key.replace(/\W/g, '-')}` });
    this.places.set(key, { element, wrong });
    return make('div', { class: 'place' }, element, wrong);
  }

  law() {
    return this.state.law.map(([key, value]) => {
      if (key === 'kind' || key === 'preset') return make('p', { class: 'fixed' }, make('code', {}, `${key} = ${toml(value)}`));
      const change = this.setter('law', key);
      const field = typeof value === 'number' ? this.dial(key, value, change) : this.formula(key, value, change);
      return this.place(`law.${key}`, this.removable(key, field));
    });
  }

  /** Headway and number are the two that a reader thinks in; the scene has the length. */
  ring() {
    const { state } = this;
    const count = this.dial('pedestrians', state.get('ring', 'pedestrians'), (value) => {
      const gap = state.headway;
      state.set('ring', 'pedestrians', value);
      state.set('ring', 'length', gap * value);
      this.changed();
    }, { whole: true, least: 2 });
    const headway = this.dial('headway', state.headway, (value) => {
      state.set('ring', 'length', value * state.get('ring', 'pedestrians'));
      this.changed();
    }, { least: 0 });
    return [this.place('ring.pedestrians', count), this.place('ring.length', headway)];
  }

  dial(name, value, changed, more = {}) {
    return new Dial({ name, value, unit: this.unit(name), changed, ...more }).element;
  }

  /** In which unit a number is; a law as formulas is in units of its own. */
  unit(key) {
    const [length, time] = this.state.isFormula ? ['lengths', 'times'] : ['a₀', 'τ'];
    const units = {
      pedestrians: 'people', headway: length, shift: length, body: length, t_end: time, sample: time, dt: time,
      tolerance: 'of the perturbation', speed: `${length}/${time}`,
    };
    const ofPaper = { v0: 'a₀/τ', a_v: 'τ', epsilon: 'a₀', a: 'a₀/τ²', b: 'a₀' };
    return units[key] || (this.state.isFormula ? 'law’s units' : ofPaper[key] || '(no unit)');
  }

  formula(key, value, changed) {
    const id = `own-${key}`;
    const field = make('input', {
      type: 'text', id, value, spellcheck: 'false', autocomplete: 'off', autocapitalize: 'off', oninput: () => changed(field.value),
    });
    return make('div', { class: 'formula' }, make('label', { for: id }, make('code', {}, key)), field);
  }

  /** A law of formulas may lose any line but those that it must have. */
  removable(key, element) {
    if (!this.state.isFormula || ['acceleration', 'body'].includes(key)) return element;
    const remove = () => { this.state.remove('law', key); this.show(this.state); this.changed(); };
    element.append(make('button', { type: 'button', class: 'small', 'aria-label': `Remove ${key}`, onclick: remove }, '×'));
    return element;
  }

  addition() {
    const name = make('input', { type: 'text', id: 'own-name', autocomplete: 'off', size: 8 });
    const value = make('input', { type: 'text', id: 'own-value', autocomplete: 'off', size: 12 });
    const add = () => {
      const key = name.value.trim();
      if (!NAME.test(key)) { this.complain({ problem: `${key || 'a name'}: ${NO_NAME}` }); return; }
      const number = Number(value.value);
      this.state.set('law', key, value.value.trim() !== '' && Number.isFinite(number) ? number : value.value);
      this.show(this.state);
      this.changed();
    };
    return make('div', { class: 'addition' }, make('label', { for: 'own-name' }, 'Another name'), name,
      make('label', { for: 'own-value' }, 'number or formula'), value, make('button', { type: 'button', onclick: add }, 'Add'));
  }

  choice(key, values) {
    const now = this.state.get('run', key) ?? values[0];
    const id = `own-${key}`;
    const select = make('select', { id, onchange: () => this.setter('run', key)(select.value) },
      ...[...new Set([now, ...values])].map((value) => make('option', { selected: value === now }, value)));
    return this.place(`run.${key}`, make('div', { class: 'dial' }, make('label', { for: id }, make('code', {}, key)), select));
  }

  /** Takes all complaints back. */
  clear() {
    this.wrong.hidden = true;
    for (const { element, wrong } of this.places.values()) {
      wrong.hidden = true;
      for (const input of element.querySelectorAll('input, select')) {
        input.removeAttribute('aria-invalid');
        input.removeAttribute('aria-describedby');
      }
    }
  }

  /** Says what is wrong below the field that it is about; `keys` has the key of each line of the scene file. */
  complain({ problem, key, line }, keys = {}) {
    const about = key || keys[line]?.key;
    const place = this.places.get(about) || (about?.startsWith('law.') && this.places.get('law.acceleration'));
    const begin = Object.values(keys).find((one) => one.key === about)?.column ?? 1;
    const wrong = place ? place.wrong : this.wrong;
    // columns of the field in place of those of the file
    wrong.textContent = problem.replace(/^column (\d+)/, (_, column) => `column ${Number(column) - begin + 1}`);
    wrong.hidden = false;
    for (const input of place ? place.element.querySelectorAll('input, select') : []) {
      input.setAttribute('aria-invalid', 'true');
      input.setAttribute('aria-describedby', wrong.id);
    }
  }
}
