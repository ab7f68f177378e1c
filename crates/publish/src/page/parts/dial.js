// A number to change: a slider and a field that hold the same, with name and unit.

/** A round number not below `value`. */
function above(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= value * (1 - 1e-9));
}

/** Digits that a field has room for; the scene has all. */
const DIGITS = 8;

let dials = 0;

class Dial {
  /** `name`, `value`, `unit` in words, `whole`, `least` and `most` where they are; `changed` hears values. */
  constructor({ name, value, unit, whole = false, least, most, changed }) {
    Object.assign(this, { name, unit, whole, changed });
    const size = Math.abs(value) || 1;
    this.from = least ?? (value < 0 ? -above(2.5 * size) : 0);
    this.to = most ?? above(value === 0 ? 1 : 2.5 * size);
    dials += 1;
    const id = `dial-${dials}`;
    this.slider = make('input', {
      type: 'range', min: this.from, max: this.to, step: whole ? 1 : 'any', 'aria-label': `${name}, slider`,
      oninput: () => this.slid(),
    });
    this.field = make('input', {
      type: 'number', id, step: whole ? 1 : 'any', inputmode: 'decimal', oninput: () => this.typed(),
    });
    this.element = make('div', { class: 'dial' }, make('label', { for: id }, make('code', {}, name)), this.slider, this.field,
      make('span', { class: 'unit' }, unit));
    this.put(value);
  }

  put(value) {
    // a typed number may lie beyond the slider
    if (value > this.to) this.slider.max = this.to = above(value);
    if (value < this.from) this.slider.min = this.from = -above(-value || 1);
    this.slider.value = value;
    // what is being typed is left as it is
    if (document.activeElement !== this.field) this.field.value = Number(value.toPrecision(DIGITS));
    this.slider.setAttribute('aria-valuetext', `${words(value)} ${this.unit}`);
  }

  /** A slider has no more digits than a hand. */
  slid() {
    const step = 10 ** (Math.floor(Math.log10(this.to - this.from)) - 3);
    const value = Number((Math.round(Number(this.slider.value) / step) * step).toPrecision(6));
    const put = this.whole ? Math.round(value) : value;
    this.put(put);
    this.changed(put);
  }

  typed() {
    const value = this.field.valueAsNumber;
    if (!Number.isFinite(value)) return;
    this.put(value);
    this.changed(value);
  }
}
