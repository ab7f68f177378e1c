// A browser without a window, a page that is watched, and checks that are counted.

import { chromium } from 'playwright-core';
import { spawnSync } from 'node:child_process';
import { accessSync, constants, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
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
    this.file = file;
    this.url = pathToFileURL(file).href;
    this.hasModule = /id="module">[^<]/.test(readFileSync(file, 'utf8'));
    this.folder = mkdtempSync(join(tmpdir(), 'page-'));
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
  async open({ hash = '', ...options } = {}) {
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
    await page.goto(this.url + hash, { waitUntil: 'load' });
    // its numbers are unpacked after that
    if (options.javaScriptEnabled !== false) await page.waitForFunction(() => 'ready' in document.documentElement.dataset);
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

  /** Runs a verb of the runner. */
  xtask(words) {
    const { status, stdout, stderr } = spawnSync(process.env.XTASK, words, { encoding: 'utf8', cwd: this.root });
    return { status, out: stdout, err: stderr };
  }

  /** Resident memory of the largest process that shows a page: where there is no /proc, none. */
  async memory() {
    const session = await this.browser.newBrowserCDPSession();
    const { processInfo } = await session.send('SystemInfo.getProcessInfo');
    await session.detach();
    const resident = ({ id }) => {
      try { return 1024 * Number(readFileSync(`/proc/${id}/status`, 'utf8').match(/^VmRSS:\s+(\d+)/m)[1]); } catch { return 0; }
    };
    return Math.max(...processInfo.filter((one) => one.type === 'renderer').map(resident));
  }

  async stop() {
    await this.browser.close();
    rmSync(this.folder, { recursive: true });
  }

  async end() {
    await this.stop();
    console.log(`${this.passed} passed, ${this.failed} failed`);
    return this.failed === 0 ? 0 : 1;
  }
}
