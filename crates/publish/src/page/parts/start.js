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

document.documentElement.classList.remove('plain');
for (const element of document.querySelectorAll('.scripted')) element.hidden = false;
startColours();
new Ring(document.getElementById('ring'));
for (const host of document.querySelectorAll('[data-maps]')) {
  new MapView(host, index.maps.filter((map) => map.figure === host.dataset.maps));
}
for (const host of document.querySelectorAll('[data-curves]')) {
  new CurveView(host, index.curves.filter((curve) => curve.figure === host.dataset.curves));
}
new Comparison(document.getElementById('compare'));
new Filter(document.getElementById('filter'));
