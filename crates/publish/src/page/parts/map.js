// Maps of the figures: colours, zero contour, a crosshair that pointer and arrow keys move, zoom.

const SHADES = 255;
const LARGEST_ZOOM = 40;

/** One map with its numbers; `values[column * rows + row]` lies at the centre of its cell. */
class Field {
  constructor(map) {
    Object.assign(this, map);
    this.columns = map.x.cells;
    this.rows = map.y.cells;
    this.values = singles(map.id);
    this.image = this.paint();
    this.contour = this.trace();
  }

  at(column, row) {
    return this.values[column * this.rows + row];
  }

  /** The value that an axis has at the centre of a cell. */
  centre(axis, cell) {
    return axis.from + ((cell + 0.5) * (axis.to - axis.from)) / axis.cells;
  }

  /** An image with a pixel for each cell, clipped at both ends of the scale. */
  paint() {
    const canvas = make('canvas', { width: this.columns, height: this.rows });
    const context = canvas.getContext('2d');
    const image = context.createImageData(this.columns, this.rows);
    const palette = Array.from({ length: SHADES }, (_, i) => along(index.diverging, i / (SHADES - 1)));
    for (let row = 0; row < this.rows; row += 1) {
      for (let column = 0; column < this.columns; column += 1) {
        const place = ((this.at(column, row) + this.clip) / (2 * this.clip)) * SHADES;
        const colour = palette[Math.min(Math.max(Math.floor(place), 0), SHADES - 1)];
        image.data.set([...colour, 255], 4 * ((this.rows - 1 - row) * this.columns + column));
      }
    }
    context.putImageData(image, 0, 0);
    return canvas;
  }

  /** Straight pieces of the line of zeros, in cells: between four neighbouring centres values are taken as linear. */
  trace() {
    const pieces = [];
    for (let i = 0; i + 1 < this.columns; i += 1) {
      for (let j = 0; j + 1 < this.rows; j += 1) {
        const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        const values = corners.map(([column, row]) => this.at(column, row));
        const cuts = [];
        for (let side = 0; side < 4; side += 1) {
          const next = (side + 1) % 4;
          const [a, b] = [values[side], values[next]];
          if ((a < 0) === (b < 0)) continue;
          const share = a / (a - b);
          cuts.push(corners[side].map((start, k) => start + share * (corners[next][k] - start) + 0.5));
        }
        for (let k = 0; k + 1 < cuts.length; k += 2) pieces.push([...cuts[k], ...cuts[k + 1]]);
      }
    }
    return pieces;
  }
}

class MapView {
  constructor(host, maps) {
    this.host = host;
    this.maps = maps;
    this.fields = new Map();
    this.chosen = 0;
    this.pointers = new Map();
    this.build();
    whenSeen(host, () => this.pick(0), () => this.draw());
  }

  build() {
    const hint = `${this.maps[0].figure}-hint`;
    this.canvas = make('canvas', {
      class: 'plot', tabindex: 0, role: 'application', 'aria-roledescription': 'map', 'aria-describedby': hint,
      onkeydown: (event) => this.key(event), onpointerdown: (event) => this.down(event),
      onpointermove: (event) => this.move(event), onpointerup: (event) => this.up(event),
      onpointercancel: (event) => this.up(event), onpointerleave: (event) => this.up(event),
    });
    this.canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    this.readout = make('output', {});
    const button = (text, name, act) => make('button', { type: 'button', 'aria-label': name, onclick: act }, text);
    const names = this.maps.map((map) => (map.difference ? `${map.panel}: ${map.difference}` : map.panel));
    const panels = this.maps.length > 1 ? [choice('Panel', `${this.maps[0].figure}-panel`, names, (i) => this.pick(i))] : [];
    this.scale = make('div', { class: 'scale', 'aria-hidden': 'true' });
    this.host.append(
      make('h4', {}, 'Read the map'), make('div', { class: 'controls' }, ...panels), this.canvas, this.scale, this.readout,
      make('div', { class: 'controls' }, button('+', 'Zoom in', () => this.zoom(2)),
        button('−', 'Zoom out', () => this.zoom(0.5)), button('All', 'All of the map', () => this.whole())),
      make('p', { class: 'hint', id: hint }, 'Arrow keys move the crosshair by a cell, with Shift by ten; plus and minus '
        + 'zoom, 0 shows all. By pointer: click, then turn the wheel, or pinch; drag to move.'));
    this.host.hidden = false;
  }

  get field() {
    return this.fields.get(this.chosen);
  }

  pick(i) {
    this.chosen = i;
    if (!this.fields.has(i)) this.fields.set(i, new Field(this.maps[i]));
    const { x, y, value, clip, panel, difference } = this.field;
    this.canvas.setAttribute('aria-label', `Map of ${value.symbol} over ${x.symbol} and ${y.symbol}, ${difference || panel}`);
    this.scale.replaceChildren(`≤ ${words(-clip, 3)}`, make('i', {}), `≥ ${words(clip, 3)}`);
    const stops = index.diverging.map(css).join(', ');
    this.scale.children[0].style.background = `linear-gradient(to right, ${stops})`;
    this.cell = this.cell || [Math.floor(this.field.columns / 2), Math.floor(this.field.rows / 2)];
    this.whole();
  }

  whole() {
    const { columns, rows } = this.field;
    this.view = { left: 0, right: columns, bottom: 0, top: rows };
    this.draw();
  }

  /** Zooms by a factor about a place in cells; without one about the crosshair. */
  zoom(factor, about = [this.cell[0] + 0.5, this.cell[1] + 0.5]) {
    const { columns, rows } = this.field;
    const before = columns / (this.view.right - this.view.left);
    const after = Math.min(Math.max(before * factor, 1), LARGEST_ZOOM);
    const part = before / after;
    this.slideTo(about[0] - (about[0] - this.view.left) * part, about[1] - (about[1] - this.view.bottom) * part,
      columns / after, rows / after);
    this.draw();
  }

  /** Shows a window of this size whose lower left corner lies as near to this place as the map allows. */
  slideTo(left, bottom, width, height) {
    const { columns, rows } = this.field;
    const x = Math.min(Math.max(left, 0), columns - width);
    const y = Math.min(Math.max(bottom, 0), rows - height);
    this.view = { left: x, right: x + width, bottom: y, top: y + height };
  }

  /** Moves the crosshair to a cell, and the window with it where it would leave. */
  go(column, row) {
    const { columns, rows } = this.field;
    this.cell = [Math.min(Math.max(column, 0), columns - 1), Math.min(Math.max(row, 0), rows - 1)];
    const { left, right, bottom, top } = this.view;
    const follow = (cell, low, high) => Math.min(low, cell) + Math.max(0, cell + 1 - high);
    this.slideTo(follow(this.cell[0], left, right), follow(this.cell[1], bottom, top), right - left, top - bottom);
    this.draw();
  }

  key(event) {
    const step = event.shiftKey ? 10 : 1;
    const [column, row] = this.cell;
    const acts = {
      ArrowLeft: () => this.go(column - step, row), ArrowRight: () => this.go(column + step, row),
      ArrowUp: () => this.go(column, row + step), ArrowDown: () => this.go(column, row - step),
      '+': () => this.zoom(2), '=': () => this.zoom(2), '-': () => this.zoom(0.5), 0: () => this.whole(),
    };
    if (!acts[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    this.readout.setAttribute('aria-live', 'polite');
    acts[event.key]();
  }

  /** A place of the screen in cells. */
  inCells(event) {
    const frame = this.canvas.getBoundingClientRect();
    const { box, view } = this;
    return [
      view.left + ((event.clientX - frame.left - box.left) / box.width) * (view.right - view.left),
      view.top - ((event.clientY - frame.top - box.top) / box.height) * (view.top - view.bottom),
    ];
  }

  down(event) {
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, event);
    this.hover(event);
  }

  up(event) {
    this.pointers.delete(event.pointerId);
  }

  move(event) {
    const last = this.pointers.get(event.pointerId);
    if (last && this.pointers.size === 2) this.pinch(event, last);
    else if (last) this.drag(event, last);
    if (last) this.pointers.set(event.pointerId, event);
    if (this.pointers.size < 2) this.hover(event);
  }

  /** The crosshair follows the pointer; nothing is read out for it. */
  hover(event) {
    const [x, y] = this.inCells(event).map(Math.floor);
    const { columns, rows } = this.field;
    if (x < 0 || y < 0 || x >= columns || y >= rows) return;
    this.readout.setAttribute('aria-live', 'off');
    this.go(x, y);
  }

  drag(event, last) {
    const [from, to] = [this.inCells(last), this.inCells(event)];
    const { left, right, bottom, top } = this.view;
    this.slideTo(left + from[0] - to[0], bottom + from[1] - to[1], right - left, top - bottom);
  }

  pinch(event, last) {
    const [other] = [...this.pointers.values()].filter((one) => one.pointerId !== event.pointerId);
    const apart = (one) => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
    const middle = { clientX: (event.clientX + other.clientX) / 2, clientY: (event.clientY + other.clientY) / 2 };
    if (apart(last) > 0) this.zoom(apart(event) / apart(last), this.inCells(middle));
  }

  /** The wheel scrolls the page unless the map was clicked; a trackpad's pinch comes as a wheel with Ctrl. */
  wheel(event) {
    if (document.activeElement !== this.canvas && !event.ctrlKey) return;
    event.preventDefault();
    this.zoom(event.deltaY < 0 ? 1.2 : 1 / 1.2, this.inCells(event));
  }

  draw() {
    const width = this.canvas.clientWidth;
    if (!this.field || width === 0) return;
    const height = Math.min(Math.round(width * 0.8), 480);
    const context = sharpen(this.canvas, width, height);
    this.box = { left: 52, top: 24, width: width - 64, height: height - 68 };
    const { box, view, field } = this;
    const place = {
      x: (cell) => box.left + ((cell - view.left) / (view.right - view.left)) * box.width,
      y: (cell) => box.top + ((view.top - cell) / (view.top - view.bottom)) * box.height,
    };
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.width, box.height);
    context.clip();
    context.imageSmoothingEnabled = false;
    context.drawImage(field.image, place.x(0), place.y(field.rows), place.x(field.columns) - place.x(0),
      place.y(0) - place.y(field.rows));
    this.drawContour(context, place);
    this.drawCrosshair(context, place);
    context.restore();
    this.drawFrame(context);
    this.tell();
  }

  drawContour(context, place) {
    context.beginPath();
    for (const [x, y, toX, toY] of this.field.contour) {
      context.moveTo(place.x(x), place.y(y));
      context.lineTo(place.x(toX), place.y(toY));
    }
    context.strokeStyle = '#000';
    context.lineWidth = 1.8;
    context.stroke();
  }

  /** White under black, so that it shows on every colour. */
  drawCrosshair(context, place) {
    const [x, y] = [place.x(this.cell[0] + 0.5), place.y(this.cell[1] + 0.5)];
    for (const [colour, width] of [['#fff', 3], ['#000', 1]]) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.beginPath();
      for (const sign of [-1, 1]) {
        context.moveTo(x + sign * 5, y);
        context.lineTo(x + sign * 16, y);
        context.moveTo(x, y + sign * 5);
        context.lineTo(x, y + sign * 16);
      }
      context.stroke();
    }
  }

  drawFrame(context) {
    const { box, view, field } = this;
    const data = (axis, cell) => axis.from + (cell * (axis.to - axis.from)) / axis.cells;
    const range = {
      left: data(field.x, view.left), right: data(field.x, view.right),
      bottom: data(field.y, view.bottom), top: data(field.y, view.top),
    };
    const place = {
      x: (value) => box.left + ((value - range.left) / (range.right - range.left)) * box.width,
      y: (value) => box.top + ((range.top - value) / (range.top - range.bottom)) * box.height,
    };
    drawAxes(context, box, range, place, { x: field.x.symbol, y: field.y.symbol }, coloursOf(this.canvas));
  }

  /** Says what the crosshair is on. */
  tell() {
    const [column, row] = this.cell;
    const { field } = this;
    const [x, y, value] = [field.centre(field.x, column), field.centre(field.y, row), field.at(column, row)];
    this.readout.textContent = `${field.x.symbol} = ${words(x)}, ${field.y.symbol} = ${words(y)}: `
      + `${field.value.symbol} = ${words(value)} (a perturbation ${value < 0 ? 'decays' : 'grows'})`;
    Object.assign(this.canvas.dataset, {
      column, row, value, table: field.table, zoom: field.columns / (this.view.right - this.view.left),
    });
    this.canvas.classList.toggle('zoomed', this.canvas.dataset.zoom > 1);
  }
}
