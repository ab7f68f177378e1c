// A ring in time: a circle of dots, and the strip of all positions with a line at the time shown.

/** Figure 11, as the page carries it: what a ring shows. Positions (unwrapped) and speeds are whole multiples of `unit`. */
function publishedMotion() {
  const { pedestrians, samples, start, unit, length, last } = index.ring;
  const steps = shorts('ring-steps');
  const positions = new Int32Array(pedestrians * samples);
  positions.set(start);
  for (let i = pedestrians; i < positions.length; i += 1) positions[i] = positions[i - pedestrians] + steps[i - pedestrians];
  return { pedestrians, samples, unit, length, last, interval: 1, fast: 1, positions, speeds: shorts('ring-speeds') };
}

const PACES = [10, 50, 200];

class Ring {
  /** What is shown: pedestrians, last time, time between samples; `load` gives the motion once the ring is near the screen. */
  constructor(host, { hint, names = ['standing', 'at the desired speed'], ...shape }, load) {
    Object.assign(this, { host, hint, names });
    this.palette = Array.from({ length: 64 }, (_, i) => css(along(index.sequential, i / 63)));
    this.build();
    this.reshape(shape);
    whenSeen(host, () => { this.motion ||= load?.(); }, () => { this.drawStrip(); this.draw(); });
  }

  build() {
    this.circle = make('canvas', { class: 'circle', role: 'img', 'aria-label': 'The ring of pedestrians' });
    this.strip = make('canvas', {
      class: 'strip', role: 'img', onpointerdown: (event) => this.jump(event),
      'aria-label': 'All positions against time, coloured by speed: dark bands are jams that travel backwards. A line marks the time shown.',
    });
    this.button = make('button', { type: 'button', 'aria-pressed': 'false', onclick: () => this.toggle() }, 'Play');
    this.slider = make('input', {
      type: 'range', min: 0, value: 0, 'aria-label': 'Time',
      oninput: () => { this.pause(); this.set(Number(this.slider.value)); },
    });
    this.speed = make('select', { onchange: () => { this.pace = Number(this.speed.value); } });
    this.number = make('input', {
      type: 'number', min: 0, value: 0, inputmode: 'numeric',
      oninput: () => { this.followed = Math.min(Math.max(Math.trunc(Number(this.number.value)) || 0, 0), this.pedestrians - 1); this.draw(); },
    });
    this.readout = make('output', {});
    this.host.append(
      make('div', { class: 'ring-stage' }, this.circle, this.strip),
      make('div', { class: 'scale', 'aria-hidden': 'true' }, this.names[0], this.bar(), this.names[1]),
      this.slider,
      make('div', { class: 'controls' }, this.button, make('label', {}, 'Pace', this.speed),
        make('label', {}, 'Follow pedestrian', this.number)),
      this.readout,
      make('p', { class: 'hint' }, this.hint));
  }

  /** Another ring: pedestrians, last time, time between samples, paces in time units a second. */
  reshape({ pedestrians, last, interval = 1, paces = PACES }) {
    Object.assign(this, { pedestrians, last, interval, paces, t: 0, pace: paces[1], followed: 0, motion: undefined });
    Object.assign(this.slider, { max: last, step: interval, value: 0 });
    Object.assign(this.number, { max: pedestrians - 1, value: 0 });
    this.speed.replaceChildren(...paces.map((pace) => make('option', { value: pace, selected: pace === this.pace }, `${words(pace, 3)} time units a second`)));
  }

  bar() {
    const bar = make('i', {});
    bar.style.background = `linear-gradient(to right, ${index.sequential.map(css).join(', ')})`;
    return bar;
  }

  /** Shows another motion, or the same that has grown; a line stays at its time, or goes along with the end. */
  show(motion, t = this.t) {
    this.motion = motion;
    this.drawStrip();
    this.set(t);
  }

  /** Position (unwrapped) and speed of a pedestrian at the time shown. */
  state(n) {
    const { pedestrians, samples, unit, interval, positions, speeds } = this.motion;
    const place = Math.min(this.t / interval, samples - 1);
    const before = Math.min(Math.floor(place), Math.max(samples - 2, 0));
    const share = place - before;
    const between = (values) => {
      const a = values[before * pedestrians + n];
      return (share === 0 ? a : a + share * (values[(before + 1) * pedestrians + n] - a)) * unit;
    };
    return [between(positions), between(speeds)];
  }

  colour(speed) {
    return this.palette[Math.min(Math.max(Math.round((speed / this.motion.fast) * 63), 0), 63)];
  }

  set(t) {
    this.t = Math.min(Math.max(t, 0), this.last);
    this.slider.value = this.t;
    this.slider.setAttribute('aria-valuetext', `t = ${this.time()}`);
    this.draw();
  }

  /** The time shown: whole where samples are a time unit apart. */
  time() {
    const digits = Math.max(0, Math.ceil(-Math.log10(this.motion?.interval ?? 1)));
    return this.t.toFixed(digits);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  play() {
    if (this.t >= this.last) this.t = 0;
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
    if (this.t >= this.last) this.pause();
    else requestAnimationFrame((later) => this.step(later));
  }

  jump(event) {
    const frame = this.strip.getBoundingClientRect();
    this.pause();
    const share = (event.clientX - frame.left - 1) / (frame.width - 2);
    this.set(Math.round((share * this.last) / this.interval) * this.interval);
  }

  draw() {
    if (!this.motion) return;
    const size = this.circle.clientWidth;
    if (size === 0) return;
    const context = sharpen(this.circle, size, size);
    const colours = coloursOf(this.circle);
    const { pedestrians, length } = this.motion;
    const [middle, radius] = [size / 2, size / 2 - 14];
    const dot = Math.min(Math.max(2.2, (radius * Math.PI) / pedestrians * 0.82), 11);
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
    put(this.followed, Math.min(2, 13 / dot));
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
    context.fillText(`t = ${this.time()}`, middle, middle - 2);
    context.font = '14px system-ui, sans-serif';
    context.fillText(`mean speed ${mean.toFixed(3)}`, middle, middle + 22);
  }

  tell(mean, deviation) {
    const [x, speed] = this.state(this.followed);
    const t = this.time();
    this.readout.textContent = `t = ${t}: mean speed ${mean.toFixed(3)}, standard deviation ${deviation.toFixed(3)}; `
      + `pedestrian ${this.followed}: x = ${x.toFixed(3)}, v = ${speed.toFixed(3)}`;
    this.circle.setAttribute('aria-label', `The ring of ${this.pedestrians} pedestrians at t = ${t}`);
    Object.assign(this.host.dataset, { t: this.t, x, v: speed });
  }

  /** All positions once, as an image; the line at the time shown goes over it. */
  drawStrip() {
    const width = this.strip.clientWidth;
    if (width === 0 || !this.motion) return;
    const { pedestrians, samples, length, unit, interval, positions, speeds } = this.motion;
    this.image = make('canvas', {});
    // as wide as the whole run, of which a part may be there
    const all = Math.round(this.last / interval) + 1;
    const [columns, rows] = [Math.min(all, Math.round(width)), 400];
    this.image.width = columns;
    this.image.height = rows;
    const context = this.image.getContext('2d');
    const tall = (rows / pedestrians) * 1.3;
    for (let column = 0; column < columns; column += 1) {
      const sample = Math.round((column * (all - 1)) / Math.max(columns - 1, 1));
      if (sample >= samples) break;
      for (let n = 0; n < pedestrians; n += 1) {
        const place = sample * pedestrians + n;
        const x = (positions[place] * unit) % length;
        context.fillStyle = this.colour(speeds[place] * unit);
        const top = rows - (x / length) * rows - tall / 2;
        // who stands at the seam shows at both ends
        for (const turn of [-rows, 0, rows]) context.fillRect(column, top + turn, 1, tall);
      }
    }
  }

  drawLine() {
    const width = this.strip.clientWidth;
    if (!this.image || width === 0 || this.image.width === 0) return;
    const height = Math.round(Math.min(width * 0.85, 420));
    const context = sharpen(this.strip, width, height);
    context.drawImage(this.image, 1, 0, width - 2, height);
    const x = 1 + (this.t / this.last) * (width - 2);
    context.fillStyle = '#fff';
    context.fillRect(x - 2, 0, 4, height);
    context.fillStyle = '#b00';
    context.fillRect(x - 1, 0, 2, height);
  }
}
