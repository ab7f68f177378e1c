// The ring of figure 11 in time: a circle of dots, and the strip of all positions with a line at the time shown.

const PACES = [10, 50, 200];

class Ring {
  constructor(host) {
    this.host = host;
    this.t = 0;
    this.pace = PACES[1];
    this.followed = 0;
    this.build();
    whenSeen(host, () => this.load(), () => { this.drawStrip(); this.draw(); });
  }

  build() {
    const { last, pedestrians } = index.ring;
    this.circle = make('canvas', { class: 'circle', role: 'img', 'aria-label': 'The ring of pedestrians' });
    this.strip = make('canvas', {
      class: 'strip', role: 'img', onpointerdown: (event) => this.jump(event),
      'aria-label': 'All positions against time, coloured by speed: dark bands are jams that travel backwards. A line stands at the time shown.',
    });
    this.button = make('button', { type: 'button', 'aria-pressed': 'false', onclick: () => this.toggle() }, 'Play');
    this.slider = make('input', {
      type: 'range', min: 0, max: last, step: 1, value: 0, 'aria-label': 'Time',
      oninput: () => { this.pause(); this.set(Number(this.slider.value)); },
    });
    this.speed = make('select', { onchange: () => { this.pace = Number(this.speed.value); } },
      ...PACES.map((pace) => make('option', { value: pace, selected: pace === this.pace }, `${pace} time units a second`)));
    this.number = make('input', {
      type: 'number', min: 0, max: pedestrians - 1, value: 0, inputmode: 'numeric',
      oninput: () => { this.followed = Math.min(Math.max(Math.trunc(Number(this.number.value)) || 0, 0), pedestrians - 1); this.draw(); },
    });
    this.readout = make('output', {});
    this.host.append(
      make('div', { class: 'ring-stage' }, this.circle, this.strip),
      make('div', { class: 'scale', 'aria-hidden': 'true' }, 'standing', this.bar(), 'at the desired speed'),
      this.slider,
      make('div', { class: 'controls' }, this.button, make('label', {}, 'Pace', this.speed),
        make('label', {}, 'Follow pedestrian', this.number)),
      this.readout,
      make('p', { class: 'hint' }, `In the strip time runs to the right, the position on the ring upwards; a click goes to that time. Positions and speeds are rounded to ${words(index.ring.unit)}; between two samples, one time unit apart, they are joined by straight lines. Nothing moves until Play is pressed.`));
  }

  bar() {
    const bar = make('i', {});
    bar.style.background = `linear-gradient(to right, ${index.sequential.map(css).join(', ')})`;
    return bar;
  }

  /** Sums the steps up to positions. */
  load() {
    const { pedestrians, samples, start } = index.ring;
    const steps = shorts('ring-steps');
    this.speeds = shorts('ring-speeds');
    this.positions = new Int32Array(pedestrians * samples);
    this.positions.set(start);
    for (let i = pedestrians; i < this.positions.length; i += 1) {
      this.positions[i] = this.positions[i - pedestrians] + steps[i - pedestrians];
    }
    this.palette = Array.from({ length: 64 }, (_, i) => css(along(index.sequential, i / 63)));
  }

  /** Position (unwrapped) and speed of a pedestrian at the time shown. */
  state(n) {
    const { pedestrians, samples, unit } = index.ring;
    const before = Math.min(Math.floor(this.t), samples - 2);
    const share = this.t - before;
    const between = (values) => {
      const [a, b] = [values[before * pedestrians + n], values[(before + 1) * pedestrians + n]];
      return (a + share * (b - a)) * unit;
    };
    return [between(this.positions), between(this.speeds)];
  }

  colour(speed) {
    return this.palette[Math.min(Math.max(Math.round(speed * 63), 0), 63)];
  }

  set(t) {
    this.t = Math.min(Math.max(t, 0), index.ring.last);
    this.slider.value = Math.round(this.t);
    this.slider.setAttribute('aria-valuetext', `t = ${words(Math.round(this.t), 5)}`);
    this.draw();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  play() {
    if (this.t >= index.ring.last) this.t = 0;
    this.playing = true;
    this.button.textContent = 'Pause';
    this.button.setAttribute('aria-pressed', 'true');
    // a moving number is not read out; it is when it stops
    this.readout.setAttribute('aria-live', 'off');
    this.then = undefined;
    requestAnimationFrame((now) => this.step(now));
  }

  pause() {
    this.playing = false;
    this.button.textContent = 'Play';
    this.button.setAttribute('aria-pressed', 'false');
    this.readout.setAttribute('aria-live', 'polite');
    this.draw();
  }

  step(now) {
    if (!this.playing) return;
    // a tab that slept goes on where it was
    if (this.then !== undefined) this.set(this.t + Math.min(now - this.then, 100) / 1000 * this.pace);
    this.then = now;
    if (this.t >= index.ring.last) this.pause();
    else requestAnimationFrame((later) => this.step(later));
  }

  jump(event) {
    const frame = this.strip.getBoundingClientRect();
    this.pause();
    this.set(Math.round(((event.clientX - frame.left - 1) / (frame.width - 2)) * index.ring.last));
  }

  draw() {
    if (!this.positions) return;
    const size = this.circle.clientWidth;
    if (size === 0) return;
    const context = sharpen(this.circle, size, size);
    const colours = coloursOf(this.circle);
    const { pedestrians, length } = index.ring;
    const [middle, radius] = [size / 2, size / 2 - 14];
    const dot = Math.max(2.2, (radius * Math.PI) / pedestrians * 0.82);
    context.strokeStyle = colours.line;
    context.beginPath();
    context.arc(middle, middle, radius, 0, 2 * Math.PI);
    context.stroke();
    let [sum, squares] = [0, 0];
    const put = (n, grow) => {
      const [x, speed] = this.state(n);
      const angle = (2 * Math.PI * x) / length - Math.PI / 2;
      context.beginPath();
      context.arc(middle + radius * Math.cos(angle), middle + radius * Math.sin(angle), dot * grow, 0, 2 * Math.PI);
      return speed;
    };
    for (let n = 0; n < pedestrians; n += 1) {
      const speed = put(n, 1);
      sum += speed;
      squares += speed * speed;
      context.fillStyle = this.colour(speed);
      context.fill();
    }
    put(this.followed, 2);
    context.strokeStyle = colours.second;
    context.lineWidth = 2.5;
    context.stroke();
    const mean = sum / pedestrians;
    this.drawCentre(context, middle, colours, mean);
    this.tell(mean, Math.sqrt(Math.max(squares / pedestrians - mean * mean, 0)));
    this.drawLine();
  }

  drawCentre(context, middle, colours, mean) {
    context.fillStyle = colours.ink;
    context.textAlign = 'center';
    context.font = '600 22px system-ui, sans-serif';
    context.fillText(`t = ${Math.round(this.t)}`, middle, middle - 2);
    context.font = '14px system-ui, sans-serif';
    context.fillText(`mean speed ${mean.toFixed(3)}`, middle, middle + 22);
  }

  tell(mean, deviation) {
    const [x, speed] = this.state(this.followed);
    const t = words(Math.round(this.t), 5);
    this.readout.textContent = `t = ${t}: mean speed ${mean.toFixed(3)}, standard deviation ${deviation.toFixed(3)}; `
      + `pedestrian ${this.followed}: x = ${x.toFixed(3)}, v = ${speed.toFixed(3)}`;
    this.circle.setAttribute('aria-label', `The ring of ${index.ring.pedestrians} pedestrians at t = ${t}`);
    Object.assign(this.host.dataset, { t: this.t, x, v: speed });
  }

  /** All positions once, as an image; the line at the time shown goes over it. */
  drawStrip() {
    const width = this.strip.clientWidth;
    if (width === 0) return;
    const { pedestrians, samples, length, unit } = index.ring;
    this.image = make('canvas', {});
    const [columns, rows] = [Math.min(samples, Math.round(width)), 400];
    this.image.width = columns;
    this.image.height = rows;
    const context = this.image.getContext('2d');
    const tall = (rows / pedestrians) * 1.3;
    for (let column = 0; column < columns; column += 1) {
      const sample = Math.round((column * (samples - 1)) / (columns - 1));
      for (let n = 0; n < pedestrians; n += 1) {
        const place = sample * pedestrians + n;
        const x = (this.positions[place] * unit) % length;
        context.fillStyle = this.colour(this.speeds[place] * unit);
        const top = rows - (x / length) * rows - tall / 2;
        // who stands at the seam shows at both ends
        for (const turn of [-rows, 0, rows]) context.fillRect(column, top + turn, 1, tall);
      }
    }
  }

  drawLine() {
    const width = this.strip.clientWidth;
    if (!this.image || width === 0) return;
    const height = Math.round(Math.min(width * 0.85, 420));
    const context = sharpen(this.strip, width, height);
    context.drawImage(this.image, 1, 0, width - 2, height);
    const x = 1 + (this.t / index.ring.last) * (width - 2);
    context.fillStyle = '#fff';
    context.fillRect(x - 2, 0, 4, height);
    context.fillStyle = '#b00';
    context.fillRect(x - 1, 0, 2, height);
  }
}
