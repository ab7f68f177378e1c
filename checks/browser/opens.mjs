// The page opens, its pictures load, it is readable without scripts, in both schemes, on a phone.

import { readdirSync, existsSync } from 'node:fs';
import { join } from 'node:path';

async function pictures(harness, tables) {
  const opened = await harness.open();
  const { page } = opened;
  const slugs = readdirSync(join(tables.root, 'figures')).filter((slug) => existsSync(join(tables.root, 'figures', slug, 'scene.toml')));
  // one after the other: what all of them take at once is more than a browser gives to pictures out of sight
  const found = await page.evaluate(async () => {
    const all = [];
    for (const image of document.images) {
      const decoded = await image.decode().then(() => true, () => false);
      const { id } = image.closest('article');
      all.push({ id, decoded, width: image.naturalWidth, address: image.src.slice(0, 30), words: image.alt.length });
    }
    return all;
  });
  harness.equal('a picture for every figure', found.map((one) => one.id).sort().join(' '), slugs.map((slug) => slug.split('-')[0]).join(' '));
  for (const { id, decoded, width, address, words } of found) {
    harness.check(`the picture of ${id} loads`, decoded && width > 0, `naturalWidth ${width}`);
    harness.check(`the picture of ${id} is inline`, address.startsWith('data:image/'), address);
    harness.check(`the picture of ${id} has words`, words > 40, `${words} letters`);
  }
  const times = await page.evaluate(() => performance.getEntriesByType('navigation')[0].toJSON());
  console.log(`load event after ${Math.round(times.loadEventEnd)} ms, document parsed after ${Math.round(times.domInteractive)} ms`);
  await harness.close('pictures', opened);
}

async function withoutScripts(harness, tables) {
  const opened = await harness.open({ javaScriptEnabled: false });
  const { page } = opened;
  const claims = tables.json('data/ledger.json').claims.length;
  harness.equal('without scripts: all claims are shown', await page.locator('.claim:visible').count(), claims);
  harness.equal('without scripts: nothing that needs them is shown', await page.locator('.scripted:visible, .explorer:visible').count(), 0);
  harness.equal('without scripts: what stands in their place is', await page.locator('.unscripted:visible').count(), 4);
  await page.locator('#fig03 summary').last().click();
  harness.check('without scripts: details open', await page.locator('#fig03 table').first().isVisible());
  await harness.close('without scripts', opened);
}

async function schemes(harness) {
  const grounds = {};
  for (const colorScheme of ['light', 'dark']) {
    const opened = await harness.open({ colorScheme });
    const { page } = opened;
    const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    grounds[colorScheme] = await ground();
    const button = page.locator('#theme');
    await button.click();
    const light = await ground();
    await button.click();
    grounds[`${colorScheme} by button`] = `${light} ${await ground()} ${await button.textContent()}`;
    await harness.close(colorScheme, opened);
  }
  const bright = (colour) => colour.match(/\d+/g).slice(0, 3).reduce((sum, part) => sum + Number(part), 0);
  harness.check('the light scheme is light', bright(grounds.light) > 700, grounds.light);
  harness.check('the dark scheme is dark', bright(grounds.dark) < 150, grounds.dark);
  const expected = `${grounds.light} ${grounds.dark} Colours: dark`;
  harness.equal('the button overrides a light system', grounds['light by button'], expected);
  harness.equal('the button overrides a dark system', grounds['dark by button'], expected);
}

async function widths(harness) {
  for (const width of [320, 768, 1400]) {
    const opened = await harness.open({ viewport: { width, height: 800 } });
    const { page } = opened;
    // everything is laid out: folded parts open, drawings drawn
    await page.evaluate(() => document.querySelectorAll('details').forEach((one) => { one.open = true; }));
    for (const host of await page.locator('.explorer, #ring, #own-law').all()) await host.scrollIntoViewIfNeeded();
    const over = await page.evaluate(() => document.scrollingElement.scrollWidth - document.scrollingElement.clientWidth);
    harness.equal(`${width} pixels: the page does not scroll sideways`, over, 0);
    const drawn = await page.evaluate(() => [...document.querySelectorAll('canvas')].filter((one) => one.width < 100 || one.clientHeight < 100).length);
    harness.equal(`${width} pixels: every canvas has a size`, drawn, 0);
    await harness.close(`${width} pixels`, opened);
  }
}

async function keyboard(harness) {
  const opened = await harness.open();
  const { page } = opened;
  await page.keyboard.press('Tab');
  harness.equal('the first stop skips to the content', await page.evaluate(() => document.activeElement.className), 'skip');
  await page.keyboard.press('Enter');
  harness.equal('it goes there', await page.evaluate(() => document.activeElement.id), 'main');
  const levels = await page.evaluate(() => [...document.querySelectorAll('h1, h2, h3, h4, h5, h6')].filter((one) => one.offsetParent).map((one) => Number(one.tagName[1])));
  harness.check('headings go down by one', levels[0] === 1 && levels.every((level, i) => i === 0 || level <= levels[i - 1] + 1), levels.join(' '));
  const marks = await page.evaluate(() => ['header', 'nav', 'main', 'footer'].filter((name) => document.querySelectorAll(`body > ${name}`).length === 1).join(' '));
  harness.equal('landmarks', marks, 'header nav main footer');
  await harness.close('keyboard', opened);
}

/** Neither the page nor a worker of its can ask for anything; the browser says so on its console, which is not judged here. */
async function policy(harness) {
  const opened = await harness.open();
  const { page, heard } = opened;
  const request = "fetch('http://127.0.0.1:9/').then(() => 'sent', () => 'refused')";
  const asked = page.evaluate(() => new Promise((told) => { document.addEventListener('securitypolicyviolation', (event) => told(event.effectiveDirective)); }));
  harness.equal('the page cannot ask', await page.evaluate(request), 'refused');
  harness.equal('since its policy forbids it', await asked, 'connect-src');
  const answer = await page.evaluate((text) => new Promise((told) => {
    const worker = new Worker(URL.createObjectURL(new Blob([`${text}.then(postMessage)`])));
    worker.onmessage = ({ data }) => told(data);
  }), request);
  harness.equal('nor can a worker', answer, 'refused');
  harness.equal('nothing was sent', heard.requests.filter((url) => url.startsWith('http')).join(' '), '');
  await opened.context.close();
}

export default async function opens(harness, tables) {
  await policy(harness);
  await pictures(harness, tables);
  await withoutScripts(harness, tables);
  await schemes(harness);
  await widths(harness);
  await keyboard(harness);
}
