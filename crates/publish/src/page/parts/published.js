// Published against regenerated numbers: side by side, on top of each other, or their difference.

const VIEWS = ['side by side', 'on top of each other', 'difference'];

class Comparison {
  constructor(host) {
    this.host = host;
    this.set = index.published[0];
    this.view = 0;
    this.frame = make('div', {});
    this.charts = [];
    host.className = 'explorer';
    host.append(
      make('div', { class: 'controls' },
        choice('Quantity', 'quantity', index.published.map((set) => set.title), (i) => { this.set = index.published[i]; this.show(); }),
        choice('View', 'view', VIEWS, (i) => { this.view = i; this.show(); })),
      this.frame);
    whenSeen(host, () => this.show(), () => this.charts.forEach((chart) => chart.draw()));
  }

  /** All regenerated numbers, as the figure draws them. */
  curve() {
    const { rows, id } = index.curves.find((curve) => curve.id === this.set.curve);
    const numbers = singles(id);
    return { name: 'regenerated', x: numbers.subarray(0, rows), y: numbers.subarray(rows) };
  }

  show() {
    this.frame.replaceChildren();
    this.charts = [];
    const [x, y] = this.set.symbols;
    const published = { name: 'published', x: this.set.x, y: this.set.published, points: true };
    const matched = { name: 'regenerated', x: this.set.x, y: this.set.regenerated };
    const range = Chart.rangeOf({ series: [published, this.curve()] });
    const views = [
      () => {
        this.frame.className = 'pair';
        this.add('Published', { x, y, range, series: [published] });
        this.add('Regenerated', { x, y, range, series: [this.curve()] });
      },
      () => {
        this.add('Published (circles) and regenerated (line)', { x, y, range, series: [published, { ...matched, hidden: true }, this.curve()] });
      },
      () => {
        const difference = { name: '', x: this.set.x, y: this.set.difference, points: true };
        this.add('Published minus regenerated; dashed: the reading error', {
          x, y: `difference of ${y}`, band: this.set.reading, series: [difference],
        });
      },
    ];
    this.frame.className = '';
    views[this.view]();
  }

  add(title, spec) {
    const host = make('div', {}, make('h3', {}, title));
    this.frame.append(host);
    const chart = new Chart(host, { ...spec, name: `${title}: ${this.set.words}` });
    chart.canvas.dataset.table = this.set.table;
    this.charts.push(chart);
  }
}
