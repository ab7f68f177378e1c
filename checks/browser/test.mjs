// Tests of the page in a browser without a window: node test.mjs PAGE ROOT
//
// PAGE is the file, ROOT the checkout whose tables it must show. Says what failed; the last line counts.

import { resolve } from 'node:path';
import { Harness } from './harness.mjs';
import { Tables } from './tables.mjs';

const PARTS = ['opens', 'maps', 'ring', 'published', 'claims', 'recomputed', 'own', 'access'];

const [page, root, ...chosen] = process.argv.slice(2);
if (!page || !root) {
  console.error('usage: node test.mjs PAGE ROOT [PART..]');
  process.exit(2);
}
const harness = await Harness.start(resolve(page));
harness.root = resolve(root);
const tables = new Tables(resolve(root));
for (const part of chosen.length ? chosen : PARTS) {
  const { default: run } = await import(`./${part}.mjs`);
  const before = harness.passed;
  const started = performance.now();
  await run(harness, tables).catch((error) => harness.check(part, false, error.stack));
  console.log(`${part}: ${harness.passed - before} passed, ${Math.round((performance.now() - started) / 1000)} s`);
}
process.exit(await harness.end());
