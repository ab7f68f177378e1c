// Published against regenerated numbers, in three views.

import { numbers } from './tables.mjs';

const SETS = [
  { reference: 'data/reference/published_speed_t300.csv', ours: 'data/fig12/t300.csv', x: 'n', y: 'v' },
  { reference: 'data/reference/published_std_log.csv', ours: 'data/fig13/std.csv', x: 't', y: 'std' },
];

/** Walks through the first points of a chart by its keys; what it says of each. */
async function walk(canvas, count, visit) {
  const found = await canvas.evaluate((element, steps) => {
    const press = (key) => element.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true }));
    press('Home');
    return Array.from({ length: steps }, () => {
      const point = { x: Number(element.dataset.x), y: Number(element.dataset.y) };
      press('ArrowRight');
      return point;
    });
  }, count);
  found.forEach((point, i) => visit(i, point));
}

async function one(harness, tables, page, set, which) {
  const theirs = tables.table(set.reference);
  const ours = tables.table(set.ours);
  const places = theirs[set.x].map(Math.round);
  const regenerated = places.map((place) => ours[set.y][ours[set.x].indexOf(place)]);
  const name = set.reference.split('/').at(-1);
  await page.locator('input[name=quantity]').nth(which).check();
  await page.locator('input[name=view]').nth(0).check();
  const canvases = page.locator('#compare canvas');
  harness.equal(`${name}: two charts side by side`, await canvases.count(), 2);
  const [left, right] = [await canvases.nth(0).boundingBox(), await canvases.nth(1).boundingBox()];
  harness.check(`${name}: beside each other`, left.y === right.y && left.x + left.width < right.x, JSON.stringify([left, right]));
  await walk(canvases.nth(0), places.length, (i, { x, y }) => {
    harness.check(`${name}: published point ${i}`, x === places[i] && y === theirs[set.y][i], `${x}, ${y}`);
  });
  await walk(canvases.nth(1), 5, (i, { x, y }) => {
    harness.check(`${name}: regenerated point ${i}`, x === Math.fround(ours[set.x][i]) && y === Math.fround(ours[set.y][i]), `${x}, ${y}`);
  });
  await page.locator('input[name=view]').nth(1).check();
  harness.equal(`${name}: one chart for both`, await canvases.count(), 1);
  const said = numbers(await page.locator('#compare output').textContent());
  harness.equal(`${name}: both numbers are said`, said.length, 3);
  harness.near(`${name}: the regenerated one`, said[2], regenerated[0], 5.1e-5 * regenerated[0]);
  await page.locator('input[name=view]').nth(2).check();
  harness.equal(`${name}: one chart of differences`, await canvases.count(), 1);
  await walk(canvases.nth(0), places.length, (i, { x, y }) => {
    harness.check(`${name}: difference ${i}`, x === places[i] && Math.abs(y - (theirs[set.y][i] - regenerated[i])) < 1e-15, `${x}, ${y}`);
  });
}

/** The table of largest differences. */
async function largest(harness, tables, page) {
  for (const [which, set] of SETS.entries()) {
    const theirs = tables.table(set.reference);
    const ours = tables.table(set.ours);
    const differences = theirs[set.x].map((x, i) => Math.abs(theirs[set.y][i] - ours[set.y][ours[set.x].indexOf(Math.round(x))]));
    const cells = await page.locator('#published tbody tr').nth(which).locator('td').allInnerTexts();
    harness.equal(`${set.reference}: points`, cells[1], String(differences.length));
    const digits = cells[2].replaceAll('−', '-').replace(/ × 10/, 'e');
    const expected = Math.max(...differences);
    harness.near(`${set.reference}: the largest difference`, Number(digits), expected, 0.05 * expected);
  }
}

export default async function published(harness, tables) {
  const opened = await harness.open();
  const { page } = opened;
  await page.locator('#compare').evaluate((element) => element.scrollIntoView({ block: 'center', behavior: 'instant' }));
  await page.locator('#compare canvas').first().waitFor();
  for (const [which, set] of SETS.entries()) await one(harness, tables, page, set, which);
  await largest(harness, tables, page);
  await harness.close('published', opened);
}
