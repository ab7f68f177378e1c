// The claims of the ledger are all there, and the filter finds them.

const shown = (page) => page.locator('.claim:visible').count();

export default async function claims(harness, tables) {
  const ledger = tables.json('data/ledger.json');
  const opened = await harness.open();
  const { page } = opened;
  const all = ledger.claims;
  harness.equal('all claims are shown', await shown(page), all.length);
  harness.equal('all errata are shown', await page.locator('.erratum').count(), ledger.errata.length);
  harness.equal('all parameters are shown', await page.locator('#parameters > .wide > table > tbody > tr').count(), ledger.parameters.length);
  const boxes = page.locator('#filter input[name=verdict]');
  for (let i = 0; i < await boxes.count(); i += 1) {
    for (let k = 0; k < await boxes.count(); k += 1) await boxes.nth(k).setChecked(k === i);
    const verdict = await boxes.nth(i).getAttribute('value');
    const expected = all.filter((claim) => claim.verdict === verdict).length;
    harness.equal(`verdict ${verdict}`, await shown(page), expected);
    harness.equal(`verdict ${verdict}: the count is said`, await page.locator('#shown').textContent(), `${expected} of ${all.length} claims shown`);
    harness.equal(`verdict ${verdict}: at a glance`, await page.locator(`.verdicts a[data-verdict="${verdict}"] b`).textContent(), String(expected));
  }
  await page.locator('#filter button[type=reset]').click();
  await page.waitForTimeout(50);
  harness.equal('the button shows all again', await shown(page), all.length);
  for (const label of new Set(all.map((claim) => claim.label))) {
    await page.locator('#filter select').selectOption(label);
    harness.equal(`label ${label}`, await shown(page), all.filter((claim) => claim.label === label).length);
  }
  await page.locator('#filter button[type=reset]').click();
  await page.waitForTimeout(50);
  for (const word of ['overlap', 'Wave', 'v_0', 'zzzz']) {
    await page.locator('#filter input[type=search]').fill(word);
    const texts = await page.locator('.claim').evaluateAll((list) => list.map((one) => `${one.textContent} ${one.dataset.words}`));
    harness.equal(`word ${word}`, await shown(page), texts.filter((text) => text.toLowerCase().includes(word.toLowerCase())).length);
    const said = all.filter((claim) => `${claim.says} ${claim.finding}`.toLowerCase().includes(word.toLowerCase())).length;
    harness.check(`word ${word}: no claim that says it is missing`, await shown(page) >= said, `${said}`);
  }
  harness.equal('a word that nobody says leaves nothing', await shown(page), 0);
  const [verdict] = all.map((claim) => claim.verdict);
  await page.locator(`.verdicts a[data-verdict="${verdict}"]`).click();
  await page.waitForTimeout(50);
  harness.equal('a count at a glance leads to its claims', await shown(page), all.filter((claim) => claim.verdict === verdict).length);
  for (const claim of all) {
    const element = page.locator(`[id="claim-${claim.id}"]`);
    harness.equal(`${claim.id}: its numbers`, await element.locator('tbody tr').count(), claim.tests.length);
  }
  await harness.close('claims', opened);
}
