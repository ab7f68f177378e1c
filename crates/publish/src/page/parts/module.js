// The module that the page carries: unpacked and compiled once, where the browser can.

const WITHOUT = 'This copy of the page was written without its WebAssembly module, so it computes nothing here: '
  + '“rustup target add wasm32-unknown-unknown”, then “cargo xtask report”, writes one that does.';

/** What keeps the page from computing, in words; undefined if nothing does. */
function hindrance() {
  if (!document.getElementById('module').textContent) return WITHOUT;
  if (typeof WebAssembly !== 'object') return 'WebAssembly is off in this browser, so nothing is computed here; the page shows results computed elsewhere.';
  if (typeof DecompressionStream !== 'function') return 'This browser cannot unpack the module (DecompressionStream), so nothing is computed here.';
  return undefined;
}

let compiled;

/** The compiled module, a promise. */
function theModule() {
  compiled ||= (async () => {
    const reason = hindrance();
    if (reason) throw new Error(reason);
    return WebAssembly.compile(await unpacked('module'));
  })();
  return compiled;
}

/** A worker that has the module; `hear` hears its messages. */
async function startWorker(hear) {
  const module = await theModule();
  const address = URL.createObjectURL(new Blob([document.getElementById('worker').textContent], { type: 'text/javascript' }));
  const worker = new Worker(address);
  URL.revokeObjectURL(address);
  worker.onmessage = ({ data }) => hear(data);
  worker.onerror = (event) => hear({ failure: event.message || 'the worker did not start' });
  worker.postMessage({ module });
  return worker;
}
