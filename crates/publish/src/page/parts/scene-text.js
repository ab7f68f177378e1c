// A reader's scene: what the fields hold, the text of its scene file, and the same in the address of the page.

const TABLES = ['law', 'ring', 'start', 'uniform', 'run'];
/** The mark of a state in the address. */
const MARK = '#own=';

/** A value as TOML has it. */
function toml(value) {
  if (typeof value === 'number') return Object.is(value, -0) ? '-0.0' : String(value);
  return `"${value.replaceAll('\\', '\\\\').replaceAll('"', '\\"').replace(/[\u0000-\u001f]/g, ' ')}"`;
}

class SceneState {
  /** Tables as lists of key and value. */
  constructor(given) {
    this.title = String(given.title || 'A law of my own');
    // figure and panel of the paper that the scene began from
    this.origin = given.origin ? String(given.origin) : undefined;
    for (const table of TABLES) this[table] = (given[table] || []).map(([key, value]) => [String(key), typeof value === 'number' ? value : String(value)]);
  }

  get(table, key) {
    return this[table].find(([name]) => name === key)?.[1];
  }

  set(table, key, value) {
    const entry = this[table].find(([name]) => name === key);
    if (entry) entry[1] = value;
    else this[table].push([key, value]);
  }

  remove(table, key) {
    this[table] = this[table].filter(([name]) => name !== key);
  }

  get isFormula() {
    return this.get('law', 'kind') === 'formula';
  }

  get headway() {
    return this.get('ring', 'length') / this.get('ring', 'pedestrians');
  }

  /** The text of the scene file; `keys[line]`, from 1, has the key of that line and the column where its value begins. */
  text() {
    const lines = [`title  = ${toml(this.title)}`, 'source = "an example"'];
    const keys = {};
    for (const table of TABLES) {
      if (!this[table].length) continue;
      lines.push('', `[${table}]`);
      for (const [key, value] of this[table]) {
        const before = `${key} = `;
        lines.push(before + toml(value));
        keys[lines.length] = { key: `${table}.${key}`, column: before.length + (typeof value === 'string' ? 2 : 1) };
      }
    }
    return { text: `${lines.join('\n')}\n`, keys };
  }

  toHash() {
    const { title, origin } = this;
    const tables = Object.fromEntries(TABLES.map((table) => [table, this[table]]));
    return MARK + encodeURIComponent(JSON.stringify({ title, origin, ...tables }));
  }

  /** The state that an address holds; undefined if it holds none. */
  static fromHash(hash) {
    if (!hash.startsWith(MARK)) return undefined;
    try {
      return new SceneState(JSON.parse(decodeURIComponent(hash.slice(MARK.length))));
    } catch { return undefined; }
  }
}
