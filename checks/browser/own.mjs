// A law of the reader's own: sliders, formulas, messages in place, the run, the file that the command line runs to the same bits.

import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const sha256 = (bytes) => createHash('sha256').update(bytes).digest('hex');
const flowOf = async (page) => JSON.parse(await page.locator('#own-law').getAttribute('data-flow'));

async function begin(page) {
  await page.locator('#own').evaluate((element) => element.scrollIntoView({ behavior: 'instant' }));
  await page.waitForFunction(() => document.getElementById('own-law').dataset.flow);
}

/** Chooses a scene by a part of its name. */
async function choose(page, name) {
  const value = await page.locator('#own-preset option').evaluateAll((options, part) => options.find((one) => one.textContent.includes(part)).value, name);
  await page.locator('#own-preset').selectOption(value);
}

/** The end of the run under way: what summary.json says, and the sums. */
async function ended(page) {
  await page.waitForFunction(() => document.querySelector('#own-law .run [data-outcome]'), null, { timeout: 240000 });
  return JSON.parse(await page.locator('#own-law .run [data-outcome]').getAttribute('data-outcome'));
}

const dial = (page, name) => page.getByLabel(`${name}, slider`);
const move = (locator, value) => locator.evaluate((slider, to) => { slider.value = to; slider.dispatchEvent(new Event('input', { bubbles: true })); }, value);

/** The optimal velocity model, of which the answer is known: V'(2) = 1, unstable below kappa = 2. */
async function sliders(harness, page) {
  await choose(page, '(two phases)');
  harness.near('the margin of kappa = 1', (await flowOf(page)).flow.margin, 1, 1e-12);
  for (const [kappa, stable] of [[1.9, false], [2.1, true]]) {
    await move(dial(page, 'kappa'), kappa);
    const { flow } = await flowOf(page);
    harness.equal(`kappa = ${kappa}: the verdict`, flow.stable, stable);
    harness.check(`kappa = ${kappa}: in words`, (await page.locator('#own-verdict').textContent()).includes(stable ? 'is stable' : 'is unstable'));
  }
  harness.check('a slider says value and unit', /^2\.1 .+/.test(await dial(page, 'kappa').getAttribute('aria-valuetext')), await dial(page, 'kappa').getAttribute('aria-valuetext'));
  const silent = await page.locator('#own-law input[type=range]').evaluateAll((all) => all.filter((one) => !one.getAttribute('aria-valuetext') && !one.closest('.run')).length);
  harness.equal('every slider has a value in words', silent, 0);
  const times = [];
  for (let i = 0; i < 15; i += 1) {
    await move(dial(page, 'kappa'), 1 + i / 20);
    times.push(Number(await page.locator('#own-law').getAttribute('data-milliseconds')));
  }
  const median = times.sort((a, b) => a - b)[7];
  console.log(`growth rates and verdict after ${median.toFixed(1)} ms (median of 15)`);
  // on a machine that does other things as well
  harness.check('the verdict comes at once', median < 100, `${median} ms`);
  await dial(page, 'kappa').focus();
  const before = await page.locator('#own-law').getAttribute('data-flow');
  await page.keyboard.press('ArrowRight');
  harness.check('arrow keys move a slider', (await page.locator('#own-law').getAttribute('data-flow')) !== before);
  await move(dial(page, 'headway'), 3);
  harness.check('the headway is kept in the length', (await page.locator('#own-law pre').textContent()).match(/length = (299|300|301)/) !== null);
}

async function formulas(harness, page) {
  await choose(page, '(two phases)');
  const field = page.locator('#own-V');
  await field.fill('tanh(s - 2) + tann(2)');
  const wrong = page.locator('#own-law .place', { has: field }).locator('.wrong');
  const told = await wrong.textContent();
  harness.check('the message stands at the field, with the column in it', /^column 15: .*tann/.test(told), told);
  harness.check('and says what would be valid', told.includes('valid:'), told);
  harness.equal('the field is marked', await field.getAttribute('aria-invalid'), 'true');
  harness.equal('and described by the message', await field.getAttribute('aria-describedby'), await wrong.getAttribute('id'));
  await field.fill('1.5*(tanh(s - 2) + tanh(2))');
  harness.equal('a good formula clears it', await wrong.isVisible(), false);
  harness.near('and its flow is another', (await flowOf(page)).flow.margin, 2, 1e-9);
  await page.locator('#own-name').fill('spare');
  await page.locator('#own-value').fill('1.5');
  await page.getByRole('button', { name: 'Add', exact: true }).click();
  harness.check('an unused name is told', (await page.locator('#own-law .wrong:visible').textContent()).includes('spare'));
  await page.getByRole('button', { name: 'Remove spare' }).click();
  harness.equal('and can be removed', await page.locator('#own-law .wrong:visible').count(), 0);
  await page.getByText('Time, method, tolerance').click();
  await page.locator('#own-method').selectOption('taylor');
  const method = page.locator('#own-law .place', { has: page.locator('#own-method') }).locator('.wrong');
  harness.check('a method that does not fit is told at its place, or runs', (await method.isVisible()) === ((await method.textContent()) !== '' && (await method.isVisible())));
}

/** Saves the scene and runs it on the command line: same tables, same summary. */
async function saved(harness, page, name, change) {
  await choose(page, name);
  await change();
  const here = await ended(page);
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('#own-save').click()]);
  harness.equal(`${name}: the name of the file`, download.suggestedFilename(), 'scene.toml');
  const file = join(harness.folder, 'scene.toml');
  await download.saveAs(file);
  const folder = join(harness.folder, 'run');
  const run = harness.xtask(['simulate', file, '--out', folder, '--tables-only']);
  harness.equal(`${name}: the command line runs it`, run.status, 0);
  for (const [table, sum] of Object.entries(here.sums)) harness.equal(`${name}: the bits of ${table}`, sum, sha256(readFileSync(join(folder, table))));
  const there = JSON.parse(readFileSync(join(folder, 'summary.json'), 'utf8'));
  delete there.seconds;
  delete here.sums;
  const sorted = (value) => JSON.stringify(value, (_, one) => (one && typeof one === 'object' && !Array.isArray(one) ? Object.fromEntries(Object.entries(one).sort()) : one));
  harness.equal(`${name}: the entries of the summary`, Object.keys(here).sort().join(' '), Object.keys(there).sort().join(' '));
  for (const key of Object.keys(there)) harness.equal(`${name}: ${key} of the summary`, sorted(here[key]), sorted(there[key]));
  return here;
}

/** The ring moves while a run is computed, unless its reader wants no motion; a run can be stopped. */
async function underway(harness) {
  for (const reducedMotion of ['no-preference', 'reduce']) {
    const opened = await harness.open({ reducedMotion });
    const { page } = opened;
    await begin(page);
    await choose(page, 'Figure 11');
    await page.waitForFunction(() => document.querySelector('#own-law .run progress').value > 0.2, null, { timeout: 60000, polling: 20 });
    const seen = await page.locator('#own-law .ring-stage').evaluate((stage) => ({ ...stage.parentElement.dataset }));
    if (reducedMotion === 'reduce') harness.equal('without motion nothing is drawn on the way', seen.t, undefined);
    else harness.check('the ring moves while it is computed', Number(seen.t) > 0 && !seen.outcome, JSON.stringify(seen).slice(0, 100));
    await page.getByRole('button', { name: 'Stop the run' }).click();
    harness.equal('a run can be stopped', await page.locator('#own-law .run > output').textContent(), 'Stopped.');
    harness.equal('and has no outcome', await page.locator('#own-law [data-outcome]').count(), 0);
    await harness.close(`a run under way, motion ${reducedMotion}`, opened);
  }
}

/** Claims of the paper on the reader's run: as in the ledger with the paper's numbers; without growth that of growth fails. */
async function rejudged(harness, page) {
  const told = async (name, change = async () => {}) => {
    await choose(page, name);
    await change();
    await ended(page);
    return JSON.parse((await page.locator('#own-law .rejudged').getAttribute('data-claims')) || '[]');
  };
  for (const [name, least] of [['Figure 4: ', 1], ['(unstable)', 1], ['Figure 7: ', 1], ['Figure 11: ', 2]]) {
    const claims = await told(name);
    harness.check(`${name}: there are claims`, claims.length >= least, claims.length);
    for (const { id, before, now, tests } of claims) harness.equal(`${name}: ${id} with the paper's numbers`, now, before, JSON.stringify(tests));
  }
  const memory = await harness.memory();
  harness.check('claims on trajectories keep to the memory', memory < 500e6, memory);
  const claims = await told('(unstable)', async () => move(dial(page, 'mu'), 0.4));
  const growth = claims.find(({ id }) => id === 'algebraic-perturbation-grows');
  harness.equal('mu = 0.4: the claim of growth held', growth?.before, 'holds');
  harness.equal('mu = 0.4: it does not hold', growth?.now, 'does not hold');
  const table = page.locator('#own-law .rejudged-claim', { hasText: growth?.says });
  harness.check('both verdicts are said', (await table.textContent()).includes('holds. For yours: does not hold.'));
  harness.equal('its tests have headers', await table.locator('tbody th[scope=row]').count(), growth?.tests.length);
  await choose(page, '(two phases)');
  await ended(page);
  harness.equal('a scene of the gallery has no claims', await page.locator('#own-law .rejudged').isVisible(), false);
}

async function address(harness, page) {
  await choose(page, '(two phases)');
  await move(dial(page, 'kappa'), 1.7);
  const hash = await page.evaluate(() => location.hash);
  harness.check('the address holds the state', hash.startsWith('#own='), hash.slice(0, 20));
  const opened = await harness.open({ hash });
  await begin(opened.page);
  harness.near('another page opens it', (await flowOf(opened.page)).flow.margin, (await flowOf(page)).flow.margin, 0);
  harness.near('with its slider', Number(await dial(opened.page, 'kappa').inputValue()), 1.7, 1e-3);
  await harness.close('an address', opened);
}

export default async function own(harness) {
  if (!harness.hasModule) { console.log('not tried: the page carries no module here'); return; }
  const opened = await harness.open({ acceptDownloads: true });
  const { page } = opened;
  await begin(page);
  await sliders(harness, page);
  await formulas(harness, page);
  const contact = await saved(harness, page, 'Social force', async () => move(dial(page, 'shift'), 0.05));
  harness.check('events have a time and an error', contact.events.some((event) => event.t > 0 && event.error > 0));
  harness.check('events are listed', (await page.locator('#own-law .events li').count()) > 0);
  await saved(harness, page, 'Figure 7: ', async () => move(dial(page, 'a'), 1.2));
  await saved(harness, page, '(two phases)', async () => { await move(dial(page, 'pedestrians'), 30); await move(dial(page, 'kappa'), 1.23); });
  harness.check('the ring shows the last sample', Number(await page.locator('#own-law .run [data-outcome]').getAttribute('data-t')) > 0);
  await rejudged(harness, page);
  await address(harness, page);
  await underway(harness);
  await harness.close('a law of one\'s own', opened);
}
