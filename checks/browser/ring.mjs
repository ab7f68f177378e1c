// The ring moves, and stands where the table says.

/** Positions and speeds are rounded to thousandths. */
const ROUNDED = 5.001e-4;

const shown = (page) => page.locator('#ring').evaluate(({ dataset }) => ({ t: Number(dataset.t), x: Number(dataset.x), v: Number(dataset.v) }));

async function goTo(page, t) {
  await page.locator('#ring input[type=range]').evaluate((slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }, t);
}

async function positions(harness, tables, page) {
  const { t: times, n, x, v } = tables.table('data/fig11/trajectories.csv');
  const count = Math.max(...n.slice(0, 1000)) + 1;
  harness.equal('the slider ends with the table', await page.locator('#ring input[type=range]').getAttribute('max'), String(times.at(-1)));
  for (const t of [0, 1, 300, 777, 2000, times.at(-1)]) {
    await goTo(page, t);
    for (const pedestrian of [0, 66, count - 1]) {
      await page.locator('#ring input[type=number]').fill(String(pedestrian));
      const found = await shown(page);
      const row = t * count + pedestrian;
      harness.equal(`t = ${t}: the time`, found.t, t);
      harness.near(`t = ${t}, pedestrian ${pedestrian}: x`, found.x, x[row], ROUNDED);
      harness.near(`t = ${t}, pedestrian ${pedestrian}: v`, found.v, v[row], ROUNDED);
    }
    await dots(harness, page, t, x.slice(t * count, (t + 1) * count));
  }
  const text = await page.locator('#ring output').textContent();
  const mean = v.slice(-count).reduce((sum, speed) => sum + speed, 0) / count;
  harness.near('the mean speed', Number(text.match(/mean speed ([\d.]+)/)[1]), mean, 1e-3);
}

/** There is a dot where each pedestrian is, by its place on the circle. */
async function dots(harness, page, t, x) {
  const missing = await page.locator('#ring canvas.circle').evaluate((canvas, places) => {
    const ratio = canvas.width / canvas.clientWidth;
    const [middle, radius] = [canvas.width / 2, canvas.width / 2 - 14 * ratio];
    const image = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.width);
    return places.filter((place) => {
      const angle = (2 * Math.PI * place) / 200 - Math.PI / 2;
      const [left, top] = [Math.round(middle + radius * Math.cos(angle)), Math.round(middle + radius * Math.sin(angle))];
      const [red, green, blue, alpha] = image.data.slice(4 * (top * canvas.width + left), 4 * (top * canvas.width + left) + 4);
      // dots have a colour; the circle under them is grey or bare
      return alpha < 255 || Math.max(red, green, blue) - Math.min(red, green, blue) < 30;
    }).length;
  }, x);
  harness.equal(`t = ${t}: every pedestrian has a dot`, missing, 0);
}

async function motion(harness, page) {
  await goTo(page, 0);
  await page.waitForTimeout(400);
  harness.equal('nothing moves by itself', (await shown(page)).t, 0);
  const button = page.locator('#ring button');
  await button.focus();
  await page.keyboard.press('Enter');
  await page.waitForTimeout(900);
  const first = await shown(page);
  await page.waitForTimeout(400);
  const second = await shown(page);
  harness.check('Play moves the time', first.t > 5 && second.t > first.t, `${first.t}, ${second.t}`);
  await page.keyboard.press('Enter');
  const third = await shown(page);
  await page.waitForTimeout(400);
  harness.equal('Pause stops it', (await shown(page)).t, third.t);
  harness.equal('the button says what it does', await button.textContent(), 'Play');
  await page.locator('#ring select').selectOption('200');
  await goTo(page, 2900);
  await button.click();
  await page.waitForFunction(() => document.querySelector('#ring button').textContent === 'Play', null, { timeout: 15000 });
  harness.equal('it stops at the end', (await shown(page)).t, 3000);
  const slider = page.locator('#ring input[type=range]');
  await slider.focus();
  await page.keyboard.press('ArrowLeft');
  harness.equal('the slider listens to keys', (await shown(page)).t, 2999);
  await page.locator('#ring canvas.strip').click();
  harness.near('a click on the strip goes there', (await shown(page)).t, 1500, 10);
}

export default async function ring(harness, tables) {
  for (const reducedMotion of ['no-preference', 'reduce']) {
    const opened = await harness.open({ reducedMotion });
    const { page } = opened;
    await page.locator('#ring').evaluate((element) => element.scrollIntoView({ behavior: 'instant' }));
    await page.waitForFunction(() => document.getElementById('ring').dataset.t !== undefined);
    await page.waitForTimeout(300);
    harness.equal(`motion ${reducedMotion}: it stands at first`, (await shown(page)).t, 0);
    if (reducedMotion === 'no-preference') {
      await positions(harness, tables, page);
      await motion(harness, page);
    }
    await harness.close(`ring, motion ${reducedMotion}`, opened);
  }
}
