// The page recomputes its tables: every sum, a receipt that the command line accepts, a table that differs, no module.

import { readFileSync, writeFileSync } from 'node:fs';
import { gunzipSync, gzipSync } from 'node:zlib';
import { join } from 'node:path';
import { Harness } from './harness.mjs';

/** As much as the page and its worker may take, in bytes. */
const MEMORY = 500e6;
const MODULE = /(<script type="text\/plain" id="module">)([^<]*)(<\/script>)/;

/** All figures are recomputed once the section about it is in view. */
async function all(page) {
  await page.locator('#here').evaluate((element) => element.scrollIntoView({ behavior: 'instant' }));
  await page.waitForFunction(() => [...document.querySelectorAll('.bits')].every((line) => line.dataset.state), null, { timeout: 240000 });
}

const receiptOf = (page) => page.locator('#bits textarea').inputValue();

async function sums(harness, tables) {
  const opened = await harness.open();
  const { page } = opened;
  harness.check('at first nothing is recomputed that is not in view', (await page.locator('.bits[data-state]').count()) < 3);
  await page.locator('#fig08').evaluate((element) => element.scrollIntoView({ behavior: 'instant' }));
  await page.waitForFunction(() => document.querySelector('#fig08 .bits').dataset.state, null, { timeout: 60000 });
  harness.check('a figure in view is recomputed', (await page.locator('#fig08 .bits').textContent()).includes('Same bits'));
  await all(page);
  const receipt = JSON.parse(await receiptOf(page));
  const lines = tables.text('data/SHA256SUMS').trimEnd().split('\n').map((line) => line.split(/\s+/)).filter(([, name]) => name.endsWith('.csv'));
  harness.check('there are tables to compare', lines.length > 30, lines.length);
  harness.equal('the receipt has every table', Object.keys(receipt.sums).sort().join(' '), lines.map(([, name]) => name).sort().join(' '));
  for (const [sum, name] of lines) harness.equal(`the sum of ${name}, computed in the browser`, receipt.sums[name], sum);
  harness.equal('the verdict', receipt.verdict, 'same bits');
  console.log(`all tables after ${receipt.seconds} s in the worker`);
  for (const line of await page.locator('.bits').allTextContents()) harness.check(`"${line}"`, /^Same bits, in your browser: \d tables?, [<\d. ]+ s\.$/.test(line));
  harness.check('the summary at the top says so', (await page.locator('#bits-short').textContent()).includes(`${await page.locator('.bits').count()} of`));
  await page.locator('#bits button').click();
  // the browser may take a moment to allow or refuse the clipboard
  const answers = page.waitForFunction(() => document.querySelector('#bits output').textContent.length > 5, null, { timeout: 10000 });
  harness.check('the button answers', await answers.then(() => true, () => false));
  const memory = await harness.memory();
  console.log(`${Math.round(memory / 1e6)} MB in the page's process`);
  harness.check('memory', memory < MEMORY, `${memory} bytes`);
  writeFileSync(join(harness.folder, 'receipt.json'), await receiptOf(page));
  await harness.close('recomputed', opened);
}

/** A copy of the page with something changed, opened by a harness of its own. */
async function altered(harness, name, change, look) {
  const file = join(harness.folder, `${name}.html`);
  writeFileSync(file, change(readFileSync(harness.file, 'utf8')));
  const other = await Harness.start(file);
  const opened = await other.open();
  await look(opened.page);
  await other.close(name, opened);
  harness.passed += other.passed;
  harness.failed += other.failed;
  await other.stop();
}

/** The module with one digit of a scene changed computes another table. */
function corrupted(html) {
  return html.replace(MODULE, (_, open, packed, close) => {
    const bytes = gunzipSync(Buffer.from(packed, 'base64'));
    const scene = bytes.indexOf('fig:jams_vel'); // figure 12 has the run of figure 11
    const place = bytes.indexOf('shift = 0.1', scene) + 'shift = 0.'.length;
    bytes[place] = '2'.charCodeAt(0);
    return open + gzipSync(bytes).toString('base64') + close;
  });
}

async function differs(harness) {
  await altered(harness, 'corrupted', corrupted, async (page) => {
    await all(page);
    const line = await page.locator('#fig12 .bits').textContent();
    harness.equal('a table that differs is told', await page.locator('#fig12 .bits').getAttribute('data-state'), 'differs');
    harness.check('where first, and by how much', /t300\.csv differs first in line \d+, v: .* here, .* on the page, .* apart; at most .* apart/.test(line), line);
    harness.check('the others are the same', (await page.locator('#fig03 .bits').textContent()).startsWith('Same bits'));
    const receipt = JSON.parse(await receiptOf(page));
    harness.equal('the verdict of the receipt', receipt.verdict, 'differs');
    harness.check('the receipt has the sum that was computed', /^[0-9a-f]{64}$/.test(receipt.sums['data/fig12/t300.csv']));
    writeFileSync(join(harness.folder, 'receipt-differs.json'), JSON.stringify(receipt));
  });
}

async function receipts(harness) {
  const good = harness.xtask(['verify', '--receipt', join(harness.folder, 'receipt.json')]);
  harness.equal('the command line accepts the receipt', good.status, 0);
  harness.check('and counts its tables', good.out.includes('tables with the committed sums'), good.out + good.err);
  const bad = harness.xtask(['verify', '--receipt', join(harness.folder, 'receipt-differs.json')]);
  harness.equal('it refuses one that differs', bad.status, 1);
  harness.check('and names the table', bad.err.includes('data/fig12/t300.csv'), bad.err);
}

async function without(harness) {
  await altered(harness, 'without-module', (html) => html.replace(MODULE, '$1$3'), async (page) => {
    const line = await page.locator('#fig03 .bits').textContent();
    harness.check('without its module the page says how to get it', line.includes('rustup target add wasm32-unknown-unknown'), line);
    harness.check('and has its maps', await page.locator('#fig03 canvas').first().isVisible());
  });
  if (harness.hasModule) await altered(harness, 'without-wasm', (html) => html.replace('<script>\n', '<script>\ndelete window.WebAssembly;\n'), async (page) => {
    const line = await page.locator('#own-law').textContent();
    harness.check('without WebAssembly the page says so', line.includes('WebAssembly is off'), line);
  });
}

export default async function recomputed(harness, tables) {
  if (!harness.hasModule) { console.log('not tried: the page carries no module here'); return without(harness); }
  await sums(harness, tables);
  await differs(harness);
  await receipts(harness);
  await without(harness);
}
