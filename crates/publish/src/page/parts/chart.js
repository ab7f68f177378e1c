// Curves and points over two axes, read by pointer and arrow keys.

class Chart {
  /** `spec`: name, x and y symbols, series of { name, x, y, points, hidden } (a hidden one is only read out), optional band, range and log. */
  constructor(host, spec) {
    this.host = host;
    this.canvas = make('canvas', {
      class: 'plot', tabindex: 0, role: 'application', 'aria-roledescription': 'chart',
      onkeydown: (event) => this.key(event), onpointermove: (event) => this.hover(event),
      onpointerdown: (event) => { this.canvas.focus({ preventScroll: true }); this.hover(event); },
    });
    this.readout = make('output', {});
    host.append(this.canvas, this.readout);
    this.place = 0;
    this.show(spec);
  }

  show(spec) {
    this.spec = spec;
    this.canvas.setAttribute('aria-label', `${spec.name}. Arrow keys walk through the points.`);
    this.place = Math.min(this.place, spec.series[0].x.length - 1);
    this.range = spec.range || Chart.rangeOf(spec);
    this.draw();
  }

  /** The ends of both axes: all that is drawn, with a little room above and below. */
  static rangeOf(spec) {
    const ends = (arrays) => {
      let [low, high] = [Infinity, -Infinity];
      for (const array of arrays) for (const value of array) { low = Math.min(low, value); high = Math.max(high, value); }
      return [low, high];
    };
    const [left, right] = ends(spec.series.map((one) => one.x));
    const heights = spec.series.map((one) => (spec.log ? one.y.filter((value) => value > 0).map(Math.log10) : one.y));
    const [low, high] = ends([...heights, spec.band ? [-spec.band, spec.band] : []]);
    const room = 0.06 * (high - low || 1);
    return { left, right, bottom: low - room, top: high + room };
  }

  key(event) {
    const step = event.shiftKey ? 10 : 1;
    const moves = { ArrowLeft: -step, ArrowRight: step, Home: -Infinity, End: Infinity };
    if (!(event.key in moves) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    this.readout.setAttribute('aria-live', 'polite');
    this.go(this.place + moves[event.key]);
  }

  go(place) {
    this.place = Math.min(Math.max(place, 0), this.spec.series[0].x.length - 1);
    this.draw();
  }

  hover(event) {
    const frame = this.canvas.getBoundingClientRect();
    const share = (event.clientX - frame.left - this.box.left) / this.box.width;
    const x = this.range.left + share * (this.range.right - this.range.left);
    const [first] = this.spec.series;
    let nearest = 0;
    first.x.forEach((value, i) => { if (Math.abs(value - x) < Math.abs(first.x[nearest] - x)) nearest = i; });
    this.readout.setAttribute('aria-live', 'off');
    this.go(nearest);
  }

  draw() {
    const width = this.canvas.clientWidth;
    if (width === 0) return;
    const height = Math.min(Math.round(width * 0.66), 340);
    const context = sharpen(this.canvas, width, height);
    const colours = coloursOf(this.canvas);
    this.box = { left: 58, top: 24, width: width - 78, height: height - 68 };
    const { box, range, spec } = this;
    const at = {
      x: (value) => box.left + ((value - range.left) / (range.right - range.left)) * box.width,
      y: (value) => box.top + ((range.top - value) / (range.top - range.bottom)) * box.height,
    };
    const height10 = (value) => (spec.log ? Math.log10(value) : value);
    const powers = (value) => (Number.isInteger(value) ? powerOfTen(value) : '');
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.width, box.height);
    context.clip();
    if (spec.band) this.drawBand(context, at, colours);
    spec.series.forEach((series, i) => {
      if (!series.hidden) this.drawSeries(context, series, at, height10, i === 0 ? colours.accent : colours.second);
    });
    this.drawMark(context, at, height10, colours);
    context.restore();
    drawAxes(context, box, range, at, { x: spec.x, y: spec.y }, colours, spec.log ? powers : undefined);
    this.tell();
  }

  drawBand(context, at, colours) {
    context.strokeStyle = colours.ink;
    context.setLineDash([6, 4]);
    for (const value of [-this.spec.band, this.spec.band]) {
      context.beginPath();
      context.moveTo(this.box.left, at.y(value));
      context.lineTo(this.box.left + this.box.width, at.y(value));
      context.stroke();
    }
    context.setLineDash([]);
  }

  drawSeries(context, series, at, height10, colour) {
    context.strokeStyle = colour;
    context.lineWidth = 1.8;
    context.beginPath();
    let pen = false;
    series.x.forEach((x, i) => {
      const y = height10(series.y[i]);
      if (!Number.isFinite(y)) { pen = false; return; }
      if (series.points) {
        context.moveTo(at.x(x) + 3, at.y(y));
        context.arc(at.x(x), at.y(y), 3, 0, 2 * Math.PI);
      } else if (pen) context.lineTo(at.x(x), at.y(y));
      else context.moveTo(at.x(x), at.y(y));
      pen = true;
    });
    context.stroke();
  }

  drawMark(context, at, height10, colours) {
    const [first] = this.spec.series;
    const y = height10(first.y[this.place]);
    context.fillStyle = colours.ink;
    context.globalAlpha = 0.35;
    context.fillRect(at.x(first.x[this.place]) - 0.5, this.box.top, 1, this.box.height);
    context.globalAlpha = 1;
    if (!Number.isFinite(y)) return;
    context.beginPath();
    context.arc(at.x(first.x[this.place]), at.y(y), 5, 0, 2 * Math.PI);
    context.fill();
  }

  tell() {
    const { spec, place } = this;
    const [first] = spec.series;
    const parts = spec.series.filter((series) => series.x.length === first.x.length)
      .map((series) => `${series.name ? `${series.name} ` : ''}${spec.y} = ${words(series.y[place])}`);
    this.readout.textContent = `${spec.x} = ${words(first.x[place])}: ${parts.join(', ')}`;
    Object.assign(this.canvas.dataset, { place, x: first.x[place], y: first.y[place] });
  }
}

/** The curves of a figure, one at a time, on linear or logarithmic axes. */
class CurveView {
  constructor(host, curves) {
    this.curves = curves;
    this.chosen = 0;
    this.log = false;
    const names = curves.map((curve) => (curve.difference ? `${curve.panel}: ${curve.difference}` : curve.panel));
    const controls = make('div', { class: 'controls' });
    if (curves.length > 1) controls.append(choice('Curve', `${curves[0].figure}-curve`, names, (i) => { this.chosen = i; this.show(); }));
    if (curves[0].y.symbol.startsWith('std')) {
      controls.append(make('label', {}, make('input', {
        type: 'checkbox', onchange: (event) => { this.log = event.target.checked; this.show(); },
      }), 'logarithmic'));
    }
    this.frame = make('div', {});
    host.append(make('h4', {}, 'Read the curve'), controls, this.frame);
    host.hidden = false;
    whenSeen(host, () => this.show(), () => this.chart.draw());
  }

  show() {
    const curve = this.curves[this.chosen];
    const numbers = singles(curve.id);
    const spec = {
      name: `${curve.y.words || curve.y.symbol} against ${curve.x.symbol}, ${curve.difference || curve.panel}`,
      x: curve.x.symbol, y: curve.y.symbol, log: this.log,
      series: [{ name: '', x: numbers.subarray(0, curve.rows), y: numbers.subarray(curve.rows) }],
    };
    if (this.chart) this.chart.show(spec);
    else this.chart = new Chart(this.frame, spec);
    this.chart.canvas.dataset.table = curve.table;
  }
}
