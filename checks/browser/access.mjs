// Rules of accessibility, by axe-core.

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

export default async function access(harness) {
  for (const [name, options] of [
    ['light', { colorScheme: 'light' }], ['dark', { colorScheme: 'dark' }],
    ['narrow', { colorScheme: 'light', viewport: { width: 320, height: 700 } }],
    ['narrow and dark', { colorScheme: 'dark', viewport: { width: 320, height: 700 } }],
  ]) {
    const opened = await harness.open(options);
    const { page } = opened;
    await page.evaluate(() => document.querySelectorAll('details').forEach((one) => { one.open = true; }));
    for (const host of await page.locator('.explorer, #own-law, #bits').all()) await host.scrollIntoViewIfNeeded();
    // with what a run leaves there
    if (harness.hasModule) {
      await page.locator('#own-preset').selectOption({ index: 2 });
      await page.waitForFunction(() => document.querySelector('#own-law [data-outcome]') && document.querySelector('.rejudged table'), null, { timeout: 120000 });
    }
    await page.evaluate(AXE);
    const { violations, passes } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
    const told = violations.map((one) => `${one.id} (${one.nodes.length}): ${one.nodes[0].html.slice(0, 160)} ${one.nodes[0].failureSummary}`);
    harness.check(`axe-core, ${name}: it looked`, passes.length > 20, `${passes.length} rules passed`);
    harness.equal(`axe-core, ${name}: no violation`, told.join('\n'), '');
    await harness.close(`axe-core, ${name}`, opened);
  }
}
