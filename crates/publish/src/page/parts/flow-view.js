// Small waves on the uniform flow of a reader's scene: the verdict in words, growth rates over the wave number.

/** Wave numbers of the curve of growth rates. */
const WAVE_NUMBERS = 200;

class FlowView {
  constructor(host) {
    this.verdict = make('output', { id: 'own-verdict', 'aria-live': 'polite' });
    this.rates = make('div', {});
    host.append(make('h3', {}, 'Small waves on the uniform flow'), this.verdict, this.rates);
  }

  clear() {
    this.verdict.textContent = '';
    this.rates.hidden = true;
  }

  draw() {
    this.chart?.draw();
  }

  /** What the module tells of a flow, on a ring of so many pedestrians. */
  show({ speed, uniform_flow: flow, k, rate, waves, error }, pedestrians) {
    this.rates.hidden = !flow || !k;
    if (this.rates.hidden) {
      this.verdict.textContent = speed === null ? 'There is no uniform flow; the run is integrated in spacings.'
        : `The uniform flow (speed ${words(speed)}) lies on a kink of the law, where it has no linear response.`;
      return;
    }
    this.verdict.textContent = `By the exact criterion the uniform flow at speed ${words(speed, 6)} is ${FlowView.all(flow)}; `
      + `${FlowView.onRing(flow, pedestrians)}. The error of the rates is at most ${words(error, 1)}.`;
    const series = [{ name: 'all waves', x: k, y: rate }];
    if (waves.k.length) series.push({ name: 'waves of the ring', x: waves.k, y: waves.rate, points: true });
    const spec = { name: 'Growth rate against wave number', x: 'k', y: 'Re z⁺', series };
    if (this.chart) this.chart.show(spec);
    else this.chart = new Chart(this.rates, spec);
  }

  static all({ growing_bands: bands, margin }) {
    if (bands.length) {
      const range = ([least, largest]) => `${least === 0 ? '' : `${words(least, 4)} < `}k < ${words(largest, 4)}`;
      return `unstable (margin ${words(margin, 4)}): waves with ${bands.map(range).join(' or ')} grow`;
    }
    if (margin === 0) return 'neutral (margin 0): no wave grows, but not all decay';
    return `stable (margin ${words(margin, 4)}): waves of all lengths decay`;
  }

  static onRing({ margin_on_ring: margin, waves, growth_rate: rate }, pedestrians) {
    const wave = `the wave with ${waves} period${waves === 1 ? '' : 's'}`;
    if (margin > 0) return `on this ring of ${pedestrians} ${wave} grows fastest, at rate ${words(rate, 4)}`;
    if (margin === 0) return `on this ring of ${pedestrians} no wave grows, but not all decay`;
    return `on this ring of ${pedestrians} every wave decays, ${wave} most slowly, at rate ${words(rate, 4)}`;
  }
}
