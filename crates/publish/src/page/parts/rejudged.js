// What the paper says of the figure that a scene began from, judged on the reader's run.

const NOW_ERRORS = 'The errors of positions and speeds are those estimated at the end of the run, used for every sample; that of the standard deviation '
  + 'is the largest over all samples. Both verdicts follow from the tests in the ledger.';

class Rejudged {
  constructor(host) {
    this.status = make('output', { 'aria-live': 'polite' });
    this.list = make('div', {});
    this.host = make('div', { class: 'rejudged', hidden: true }, make('h4', {}, 'What the paper says of this figure, with your numbers'), this.status, this.list);
    host.append(this.host);
  }

  clear() {
    this.host.hidden = true;
    this.status.textContent = '';
    this.list.replaceChildren();
    delete this.host.dataset.claims;
  }

  /** `claims` as the module tells them; a text is why there are none; undefined: the scene is none of the paper. */
  show(claims) {
    this.clear();
    if (claims === undefined) return;
    this.host.hidden = false;
    if (typeof claims === 'string') { this.status.textContent = `The claims could not be judged: ${claims}`; return; }
    this.host.dataset.claims = JSON.stringify(claims);
    const changed = claims.filter(({ before, now }) => before !== now).length;
    this.status.textContent = claims.length
      ? `Claims that depend on this run alone: ${claims.length}. Verdicts that differ from those for the paper’s numbers: ${changed}.`
      : 'No claim depends on this run alone.';
    this.list.replaceChildren(...claims.map((claim) => this.claim(claim)));
    if (claims.length) this.list.append(make('p', { class: 'hint' }, NOW_ERRORS));
  }

  claim({ says, before, now, tests }) {
    const head = make('tr', {}, ...['Test', 'Must be', 'With your numbers', 'Outcome'].map((text) => make('th', { scope: 'col' }, text)));
    return make('div', { class: 'rejudged-claim' }, make('p', {}, says),
      make('p', {}, 'For the paper’s numbers: ', make('b', {}, before), '. For yours: ', make('b', {}, now), '.'),
      make('div', { class: 'wide', role: 'group', tabindex: 0, 'aria-label': `Tests: ${says}` },
        make('table', { 'aria-label': `Tests: ${says}` }, make('thead', {}, head), make('tbody', {}, ...tests.map((test) => this.test(test))))));
  }

  test({ words: measure, under, is, value, error, problem, outcome }) {
    const size = error === null ? ' (error unknown)' : error ? ` ± ${words(error, 1)}` : '';
    const found = problem === undefined ? `${value === null ? 'no number' : words(value)}${size}` : `no value in this run (${problem})`;
    return make('tr', {}, make('th', { scope: 'row' }, under ? `under the condition: ${measure}` : measure),
      make('td', {}, is || '–'), make('td', {}, found), make('td', {}, outcome || '–'));
  }
}
