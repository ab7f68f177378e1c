// A browser without a window, a page that is watched, and checks that are counted.

import { chromium } from 'playwright-core';
import { accessSync, constants } from 'node:fs';
import { delimiter, join } from 'node:path';
import { pathToFileURL } from 'node:url';

const NAMES = ['chromium', 'chromium-browser', 'google-chrome', 'chrome'];
/** What a page that is one file may ask for. */
const INSIDE = ['file:', 'data:', 'blob:'];

/** The first browser on PATH. */
function browserPath() {
  for (const folder of (process.env.PATH || '').split(delimiter)) {
    for (const name of NAMES) {
      const path = join(folder, name);
      try { accessSync(path, constants.X_OK); return path; } catch { /* not here */ }
    }
  }
  throw new Error(`no browser on PATH: ${NAMES.join(', ')}`);
}

export class Harness {
  constructor(file, browser) {
    this.url = pathToFileURL(file).href;
    this.browser = browser;
    this.passed = 0;
    this.failed = 0;
  }

  static async start(file) {
    const isRoot = process.getuid?.() === 0;
    const args = isRoot ? ['--no-sandbox'] : [];
    return new Harness(file, await chromium.launch({ executablePath: browserPath(), args }));
  }

  /** Counts one check; says what failed. */
  check(name, holds, detail = '') {
    if (holds) this.passed += 1;
    else {
      this.failed += 1;
      console.log(`FAILED ${name}${detail === '' ? '' : `: ${detail}`}`);
    }
  }

  equal(name, found, expected) {
    this.check(name, Object.is(found, expected), `${JSON.stringify(found)} in place of ${JSON.stringify(expected)}`);
  }

  near(name, found, expected, within) {
    this.check(name, Math.abs(found - expected) <= within, `${found} in place of ${expected}, more than ${within} off`);
  }

  /** Opens the page in a context of its own, with an ear for errors and requests. */
  async open(options = {}) {
    const context = await this.browser.newContext({ viewport: { width: 1400, height: 900 }, ...options });
    const page = await context.newPage();
    const heard = { errors: [], requests: [] };
    page.on('console', (message) => {
      // the tests read pixels back, the page does not
      const isOurs = message.text().includes('Multiple readback operations using getImageData');
      if (['error', 'warning'].includes(message.type()) && !isOurs) heard.errors.push(message.text());
    });
    page.on('pageerror', (error) => heard.errors.push(String(error)));
    page.on('request', (request) => heard.requests.push(request.url()));
    await context.route((url) => !INSIDE.includes(url.protocol), (route) => route.abort());
    await page.goto(this.url, { waitUntil: 'load' });
    return { context, page, heard };
  }

  /** Judges what was heard, and closes the page. */
  async close(name, { context, heard }) {
    const outside = heard.requests.filter((url) => !INSIDE.includes(new URL(url).protocol));
    const files = heard.requests.filter((url) => url.startsWith('file:'));
    this.equal(`${name}: no console error`, heard.errors.join(' | '), '');
    this.equal(`${name}: no request leaves the page`, outside.join(' | '), '');
    this.equal(`${name}: no file beside the page is read`, files.map((url) => url.split('#')[0]).join(' | '), this.url);
    await context.close();
  }

  async end() {
    await this.browser.close();
    console.log(`${this.passed} passed, ${this.failed} failed`);
    return this.failed === 0 ? 0 : 1;
  }
}
