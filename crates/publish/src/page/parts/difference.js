// Where a recomputed table differs from what the page carries, and by how much.

/** The numbers of a table that the page carries: columns by name, and how they were rounded. */
function carried(name) {
  const map = index.maps.find((one) => one.table === name);
  if (map) return { columns: { 2: singles(map.id) }, round: Math.fround, digits: 'seven digits' };
  const curve = index.curves.find((one) => one.table === name);
  if (curve) {
    const numbers = singles(curve.id);
    return { columns: { 0: numbers.subarray(0, curve.rows), [-1]: numbers.subarray(curve.rows) }, round: Math.fround, digits: 'seven digits' };
  }
  const { pedestrians, unit, start } = index.ring;
  const steps = shorts('ring-steps');
  const positions = Float64Array.from({ length: pedestrians + steps.length });
  for (let i = 0; i < positions.length; i += 1) {
    positions[i] = i < pedestrians ? start[i] : positions[i - pedestrians] + steps[i - pedestrians];
  }
  return { columns: { 2: positions, 3: shorts('ring-speeds') }, round: (value) => Math.round(value / unit), unit, digits: 'three decimals' };
}

/** In words: the first row that differs, and the largest difference. */
function differenceOf(name, csv) {
  const { columns, round, unit = 1, digits } = carried(name);
  const [header, ...lines] = csv.trimEnd().split('\n');
  const names = header.split(',');
  let [first, largest] = [undefined, 0];
  const lengths = Object.values(columns).map((column) => column.length);
  lines.forEach((line, row) => {
    const cells = line.split(',').map(Number);
    for (const [place, column] of Object.entries(columns)) {
      const cell = Number(place) < 0 ? cells.length + Number(place) : Number(place);
      const [mine, theirs] = [round(cells[cell]), column[row]];
      if (Object.is(mine, theirs) || mine === theirs) continue;
      const gap = Math.abs(cells[cell] - theirs * unit);
      first ||= { row, column: names[cell], mine: cells[cell], theirs: theirs * unit, gap };
      if (!(gap <= largest)) largest = gap;
    }
  });
  if (first) {
    return `differs first in line ${first.row + 2}, ${first.column}: ${words(first.mine)} here, ${words(first.theirs)} on the page, `
      + `${words(first.gap, 2)} apart; at most ${words(largest, 2)} apart`;
  }
  if (lines.length !== lengths[0]) return `has ${lines.length} rows instead of ${lengths[0]}`;
  return `has another sum, but the numbers agree in the ${digits} that the page contains`;
}
