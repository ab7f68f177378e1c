'use strict';
// What the other parts share: the numbers of the page, elements, words for numbers, colours, axes.

const index = JSON.parse(document.getElementById('index').textContent);

/** An element with attributes (`on…` are listeners) and children. */
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

/** A group of radio buttons; `chosen` hears the index of the one that is picked. */
function choice(legend, name, labels, chosen) {
  const boxes = labels.map((label, i) => make('label', {},
    make('input', { type: 'radio', name, value: i, checked: i === 0, onchange: () => chosen(i) }), label));
  return make('fieldset', {}, make('legend', {}, legend), ...boxes);
}

/** `10⁻⁶`. */
const powerOfTen = (power) => `10${[...String(power)].map((letter) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(letter)]).join('')}`;

/** A number in words: so many digits, a real minus, powers of ten as such. */
function words(value, digits = 5) {
  if (value === 0) return '0';
  const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
  const power = Number(exponent);
  const plain = power >= -4 && power < 7;
  const text = plain ? String(Number(value.toPrecision(digits))) : `${Number(mantissa)} × ${powerOfTen(power)}`;
  return text.replaceAll('-', '−');
}

/** The colours of the scheme in force, read from an element of the page. */
function coloursOf(canvas) {
  const style = getComputedStyle(canvas);
  return {
    ink: style.color, paper: style.backgroundColor, line: style.borderTopColor, accent: style.caretColor,
    second: style.textDecorationColor,
  };
}

/** The colour at `share` (0 to 1) of the way along stops. */
function along(stops, share) {
  const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const below = Math.min(Math.floor(place), stops.length - 2);
  return stops[below].map((start, i) => Math.round(start + (place - below) * (stops[below + 1][i] - start)));
}

const css = (colour) => `rgb(${colour.join(' ')})`;

/** Makes a canvas as sharp as the screen; its context, with lengths in CSS pixels. */
function sharpen(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  canvas.style.height = `${height}px`;
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  context.font = '13px system-ui, sans-serif';
  return context;
}

/** Round numbers between two ends, about `count` of them. */
function ticks(from, to, count) {
  const rough = (to - from) / count;
  const unit = 10 ** Math.floor(Math.log10(rough));
  const step = unit * [1, 2, 5, 10].find((factor) => factor * unit >= rough);
  const found = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + step * 1e-9; i += 1) found.push(i * step);
  return found;
}

/** Axes round a box: `range` has the ends, `place` maps to pixels, `names` stand beside them. */
function drawAxes(context, box, range, place, names, colours, yNumber) {
  const most = Math.max(Math.abs(range.bottom), Math.abs(range.top));
  // small numbers leave their power of ten to the axis
  const power = yNumber || most >= 1e-3 ? 0 : Math.floor(Math.log10(most));
  const text = yNumber || ((value) => words(value / 10 ** power, 3));
  const name = power ? `${names.y} / ${powerOfTen(power)}` : names.y;
  context.strokeStyle = colours.ink;
  context.fillStyle = colours.ink;
  context.lineWidth = 1;
  context.strokeRect(box.left, box.top, box.width, box.height);
  const bottom = box.top + box.height;
  context.textAlign = 'center';
  context.textBaseline = 'top';
  for (const value of ticks(range.left, range.right, Math.min(6, box.width / 60))) {
    const x = place.x(value);
    context.fillRect(x - 0.5, bottom, 1, 5);
    context.fillText(words(value, 4), x, bottom + 8);
  }
  context.fillText(names.x, box.left + box.width / 2, bottom + 25);
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  for (const value of ticks(range.bottom, range.top, Math.min(6, box.height / 40))) {
    const y = place.y(value);
    context.fillRect(box.left - 5, y - 0.5, 5, 1);
    context.fillText(text(value), box.left - 8, y);
  }
  context.textAlign = 'left';
  context.textBaseline = 'bottom';
  context.fillText(name, 2, box.top - 5);
}

/** Calls `draw` when the element first comes near the screen, and again whenever its width or the colours change. */
function whenSeen(element, prepare, draw) {
  let ready = false;
  const redraw = () => { if (ready) draw(); };
  new IntersectionObserver((entries, observer) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    ready = true;
    prepare();
    draw();
    new ResizeObserver(redraw).observe(element);
  }, { rootMargin: '300px' }).observe(element);
  document.addEventListener('colours', redraw);
}
