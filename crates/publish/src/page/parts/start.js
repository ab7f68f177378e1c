// Puts everything in its place.

const SCHEMES = ['automatic', 'light', 'dark'];

/** The button that goes through the colour schemes; the choice is kept where the browser allows. */
function startColours() {
  const button = document.getElementById('theme');
  const changed = () => document.dispatchEvent(new Event('colours'));
  const apply = (scheme) => {
    if (scheme === SCHEMES[0]) delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = scheme;
    button.lastChild.textContent = scheme;
    changed();
  };
  let scheme = SCHEMES[0];
  try { scheme = SCHEMES.find((name) => name === localStorage.getItem('colours')) || scheme; } catch { /* not allowed */ }
  button.addEventListener('click', () => {
    scheme = SCHEMES[(SCHEMES.indexOf(scheme) + 1) % SCHEMES.length];
    try { localStorage.setItem('colours', scheme); } catch { /* not allowed */ }
    apply(scheme);
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', changed);
  apply(scheme);
}

/** Everything that needs the script; where its numbers cannot be unpacked, the page stays what it is without. */
async function start() {
  await unpackNumbers();
  document.documentElement.classList.remove('plain');
  for (const element of document.querySelectorAll('.scripted')) element.hidden = false;
  startColours();
  new Ring(document.getElementById('ring'), {
    ...index.ring,
    hint: `In the strip time runs to the right, the position on the ring upwards; a click goes to that time. Positions and speeds are rounded to ${words(index.ring.unit)}; between two samples, one time unit apart, they are joined by straight lines. Nothing moves until Play is pressed.`,
  }, publishedMotion);
  for (const host of document.querySelectorAll('[data-maps]')) {
    new MapView(host, index.maps.filter((map) => map.figure === host.dataset.maps));
  }
  for (const host of document.querySelectorAll('[data-curves]')) {
    new CurveView(host, index.curves.filter((curve) => curve.figure === host.dataset.curves));
  }
  new Comparison(document.getElementById('compare'));
  new Filter(document.getElementById('filter'));
  new Verification(document.getElementById('bits'), document.getElementById('bits-short'));
  new OwnLaw(document.getElementById('own-law'));
  document.documentElement.dataset.ready = '';
}

start();
