// Maps and curves show what the tables have.

import { numbers } from './tables.mjs';

/** Where the axes lie in the canvas of a map: left, top, and what is left out of width and height. */
const BOX = { left: 52, top: 24, width: 64, height: 68 };
/** Cells that the pointer visits, in parts of the map. */
const PLACES = [[0.03, 0.97], [0.26, 0.31], [0.5, 0.52], [0.71, 0.12], [0.96, 0.88]];
/** Five digits are shown. */
const SHOWN = 5.1e-5;

async function frame(canvas) {
  await canvas.evaluate((element) => element.scrollIntoView({ block: 'center', behavior: 'instant' }));
  await canvas.page().waitForFunction((element) => element.dataset.table || element.dataset.place, await canvas.elementHandle());
  const size = await canvas.boundingBox();
  return { left: size.x + BOX.left, top: size.y + BOX.top, width: size.width - BOX.width, height: size.height - BOX.height };
}

/** Compares what is said of a cell with the row of the table. */
async function compare(harness, tables, name, canvas, readout, [column, row]) {
  const data = await canvas.evaluate((element) => ({ ...element.dataset }));
  const table = tables.table(data.table);
  const [x, y, value] = Object.values(table);
  const rows = y.findIndex((_, i) => x[i] !== x[0]);
  const place = column * rows + row;
  harness.equal(`${name}: the cell`, `${data.column} ${data.row}`, `${column} ${row}`);
  harness.equal(`${name}: the value of ${data.table}`, Number(data.value), Math.fround(value[place]));
  const text = await readout.textContent();
  const said = numbers(text);
  [x[place], y[place], value[place]].forEach((expected, i) => harness.near(`${name}: what is said, ${text}`, said[i], expected, SHOWN * Math.abs(expected)));
  harness.check(`${name}: growth or decay`, text.includes(value[place] < 0 ? 'decays' : 'grows'), text);
  return { table, rows, x, y, value };
}

async function pixel(canvas, x, y) {
  return canvas.evaluate((element, [left, top]) => {
    const ratio = element.width / element.clientWidth;
    return [...element.getContext('2d').getImageData(Math.round(left * ratio), Math.round(top * ratio), 1, 1).data];
  }, [x, y]);
}

/** Signs show as colours, and the line of zeros is dark. */
async function colours(harness, name, canvas, { rows, value }) {
  const columns = value.length / rows;
  const size = await canvas.boundingBox();
  const width = size.width - BOX.width;
  const height = size.height - BOX.height;
  const at = (column, row) => [BOX.left + ((column + 0.5) / columns) * width, BOX.top + ((rows - row - 0.5) / rows) * height];
  for (const [column, row] of [[10, 180], [30, 60], [150, 40], [190, 190]]) {
    const clip = Math.abs(value[column * rows + row]);
    if (clip < 0.05) continue;
    const [red, , blue] = await pixel(canvas, ...at(column, row));
    harness.check(`${name}: the colour of cell ${column} ${row}`, value[column * rows + row] < 0 ? blue > red : red > blue, `red ${red}, blue ${blue}`);
  }
  for (const row of [50, 120]) {
    for (let column = 1; column < columns; column += 1) {
      const [a, b] = [value[(column - 1) * rows + row], value[column * rows + row]];
      if (a < 0 === b < 0) continue;
      const [x, y] = at(column - 1 + a / (a - b), row);
      const near = await Promise.all([-1, 0, 1].map((shift) => pixel(canvas, x + shift, y)));
      const darkest = Math.min(...near.map(([red, green, blue]) => red + green + blue));
      harness.check(`${name}: the zero line in row ${row}`, darkest < 200, `${darkest}`);
      break;
    }
  }
}

async function pointer(harness, tables, page) {
  for (const host of await page.locator('[data-maps]').all()) {
    const figure = await host.getAttribute('data-maps');
    const canvas = host.locator('canvas');
    const panels = Math.max(await host.locator('input[type=radio]').count(), 1);
    for (let panel = 0; panel < panels; panel += 1) {
      await frame(canvas);
      if (panels > 1) await host.locator('input[type=radio]').nth(panel).check();
      const box = await frame(canvas);
      const name = `${figure}, panel ${panel}`;
      let map;
      for (const [right, up] of PLACES) {
        const [column, row] = [Math.floor(right * 200), Math.floor(up * 200)];
        await page.mouse.move(box.left + ((column + 0.5) / 200) * box.width, box.top + (1 - (row + 0.5) / 200) * box.height);
        map = await compare(harness, tables, name, canvas, host.locator('output'), [column, row]);
      }
      await colours(harness, name, canvas, map);
    }
  }
}

async function keys(harness, tables, page) {
  const host = page.locator('[data-maps=fig03]');
  const canvas = host.locator('canvas');
  await host.locator('input[type=radio]').first().check();
  await frame(canvas);
  await canvas.focus();
  const start = await canvas.evaluate(({ dataset }) => [Number(dataset.column), Number(dataset.row)]);
  for (const key of ['ArrowLeft', 'ArrowLeft', 'ArrowDown', 'Shift+ArrowLeft']) await page.keyboard.press(key);
  const cell = [start[0] - 12, start[1] - 1];
  await compare(harness, tables, 'arrow keys', canvas, host.locator('output'), cell);
  harness.equal('arrow keys: the readout speaks', await host.locator('output').getAttribute('aria-live'), 'polite');
  for (let i = 0; i < 25; i += 1) await page.keyboard.press('Shift+ArrowRight');
  harness.equal('arrow keys stop at the edge', await canvas.getAttribute('data-column'), '199');
}

const zoomOf = (canvas) => canvas.evaluate(({ dataset }) => Number(dataset.zoom));

async function zoom(harness, tables, page) {
  const host = page.locator('[data-maps=fig05]');
  const canvas = host.locator('canvas');
  const box = await frame(canvas);
  await host.getByRole('button', { name: 'Zoom in' }).click();
  harness.near('the button zooms in', await zoomOf(canvas), 2, 1e-9);
  await host.getByRole('button', { name: 'Zoom out' }).click();
  harness.near('the button zooms out', await zoomOf(canvas), 1, 1e-9);
  await canvas.focus();
  await page.keyboard.press('+');
  await page.keyboard.press('+');
  harness.near('plus zooms in', await zoomOf(canvas), 4, 1e-9);
  await page.keyboard.press('0');
  harness.near('0 shows all', await zoomOf(canvas), 1, 1e-9);
  // the cell under the pointer stays there when the wheel zooms about it
  const [column, row] = [60, 120];
  const [x, y] = [box.left + ((column + 0.5) / 200) * box.width, box.top + (1 - (row + 0.5) / 200) * box.height];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.up();
  for (let i = 0; i < 5; i += 1) await page.mouse.wheel(0, -100);
  await page.waitForFunction((element) => Number(element.dataset.zoom) > 2.4, await canvas.elementHandle());
  harness.near('the wheel zooms', await zoomOf(canvas), 1.2 ** 5, 1e-6);
  await page.mouse.move(x + 1, y);
  await compare(harness, tables, 'zoomed by the wheel', canvas, host.locator('output'), [column, row]);
  await page.mouse.down();
  await page.mouse.move(x + 40, y, { steps: 4 });
  await page.mouse.up();
  await compare(harness, tables, 'dragged with the pointer', canvas, host.locator('output'), [column, row]);
}

/** The wheel belongs to the page until a map was clicked. */
async function wheelScrolls(harness) {
  const opened = await harness.open();
  const { page } = opened;
  const canvas = page.locator('[data-maps=fig10] canvas');
  const box = await frame(canvas);
  const before = await page.evaluate(() => window.scrollY);
  await page.mouse.move(box.left + 50, box.top + 50);
  await page.mouse.wheel(0, 300);
  await page.waitForTimeout(500);
  harness.check('a wheel over a map scrolls the page', await page.evaluate(() => window.scrollY) > before);
  harness.near('and does not zoom', await zoomOf(canvas), 1, 1e-9);
  await harness.close('wheel', opened);
}

async function pinch(harness) {
  const opened = await harness.open({ hasTouch: true, isMobile: true, viewport: { width: 390, height: 800 } });
  const { page, context } = opened;
  const canvas = page.locator('[data-maps=fig14] canvas');
  const box = await frame(canvas);
  const session = await context.newCDPSession(page);
  const fingers = (apart) => [-1, 1].map((side, id) => ({ x: box.left + box.width / 2 + side * apart, y: box.top + box.height / 2, id }));
  await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: fingers(20) });
  for (const apart of [30, 40, 50, 60]) await session.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: fingers(apart) });
  await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  harness.near('two fingers zoom', await zoomOf(canvas), 3, 0.1);
  await harness.close('pinch', opened);
}

async function curves(harness, tables, page) {
  for (const host of await page.locator('[data-curves]').all()) {
    const figure = await host.getAttribute('data-curves');
    const canvas = host.locator('canvas');
    await host.evaluate((element) => element.scrollIntoView({ block: 'center', behavior: 'instant' }));
    await canvas.waitFor();
    const count = Math.max(await host.locator('input[type=radio]').count(), 1);
    for (let curve = 0; curve < count; curve += 1) {
      if (count > 1) await host.locator('input[type=radio]').nth(curve).check();
      await canvas.focus();
      const columns = Object.values(tables.table(await canvas.getAttribute('data-table')));
      const [x, y] = [columns[0], columns.at(-1)];
      for (const [key, place] of [['Home', 0], ['End', x.length - 1], ['ArrowLeft', x.length - 2]]) {
        await page.keyboard.press(key);
        const data = await canvas.evaluate(({ dataset }) => ({ ...dataset }));
        harness.equal(`${figure}, curve ${curve}, ${key}: x`, Number(data.x), Math.fround(x[place]));
        harness.equal(`${figure}, curve ${curve}, ${key}: y`, Number(data.y), Math.fround(y[place]));
        const said = numbers(await host.locator('output').textContent());
        harness.near(`${figure}, curve ${curve}, ${key}: what is said`, said.at(-1), y[place], SHOWN * Math.abs(y[place]));
      }
    }
  }
}

export default async function maps(harness, tables) {
  const opened = await harness.open();
  await pointer(harness, tables, opened.page);
  await keys(harness, tables, opened.page);
  await zoom(harness, tables, opened.page);
  await curves(harness, tables, opened.page);
  await harness.close('maps and curves', opened);
  await wheelScrolls(harness);
  await pinch(harness);
}
