// The numbers that the page carries, unpacked once: the reverse of what its writer does.

/** The bytes that an element of the page holds as base64. */
function bytesOf(id) {
  const text = atob(document.getElementById(id).textContent);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i += 1) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

/** What is compressed in an element, a promise of its bytes. */
async function unpacked(id) {
  const stream = new Blob([bytesOf(id)]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const arrays = new Map();
/** Seven digits each. */
const singles = (id) => arrays.get(id);
/** Whole numbers. */
const shorts = (id) => arrays.get(id);

/** Numbers from the differences to what their neighbours before let expect; `planes` are their bytes, the lowest first. */
function restored(planes, count, row) {
  const words = new Uint32Array(count);
  for (let i = 0; i < count; i += 1) {
    let folded = 0;
    for (let plane = 0; plane * count < planes.length; plane += 1) folded |= planes[plane * count + i] << (8 * plane);
    const difference = (folded >>> 1) ^ -(folded & 1);
    const [beside, below] = [i % row > 0, i >= row];
    let expected = (beside ? words[i - 1] : 0) + (below ? words[i - row] : 0);
    if (beside && below) expected -= words[i - row - 1];
    words[i] = expected + difference;
  }
  return words;
}

/** Unpacks all numbers. */
async function unpackNumbers() {
  const bytes = await unpacked('numbers');
  let at = 0;
  for (const { id, kind, count, row, planes } of index.numbers) {
    const words = restored(bytes.subarray(at, at + planes * count), count, row);
    at += planes * count;
    if (kind === 'short') arrays.set(id, Int16Array.from(words));
    else {
      // back from the order of numbers to their bits
      for (let i = 0; i < count; i += 1) words[i] = words[i] >>> 31 ? words[i] ^ 0x80000000 : ~words[i];
      arrays.set(id, new Float32Array(words.buffer));
    }
  }
  document.getElementById('numbers').textContent = '';
}
