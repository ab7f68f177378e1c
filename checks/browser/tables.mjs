// The project's tables and files, read by other code than the page's.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';

export class Tables {
  constructor(root) {
    this.root = root;
    this.read = new Map();
  }

  text(name) {
    return readFileSync(join(this.root, name), 'utf8');
  }

  json(name) {
    return JSON.parse(this.text(name));
  }

  /** Columns by name, of a table such as `data/fig03/left.csv`. */
  table(name) {
    if (!this.read.has(name)) {
      const [header, ...lines] = this.text(name).trimEnd().split('\n');
      const rows = lines.map((line) => line.split(',').map(Number));
      const columns = {};
      header.split(',').forEach((column, i) => { columns[column] = rows.map((row) => row[i]); });
      this.read.set(name, columns);
    }
    return this.read.get(name);
  }
}

/** Numbers of a sentence, with a real minus and powers of ten as the page writes them. */
export function numbers(text) {
  const digits = '⁻⁰¹²³⁴⁵⁶⁷⁸⁹';
  const plain = text.replaceAll('−', '-').replace(/ × 10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/g, (_, power) =>
    `e${[...power].map((letter) => '-0123456789'[digits.indexOf(letter)]).join('')}`);
  return [...plain.matchAll(/= (-?\d[\d.]*(?:e-?\d+)?)/g)].map((match) => Number(match[1]));
}
