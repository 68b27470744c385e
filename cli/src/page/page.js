// The report: its parts in the order of their weight, each only if there is something to say.

function files() {
  if (!data.files.length && !about.columns.length) return;
  const own = part('files', data.files.length ? 'Files' : 'Columns');
  if (data.files.length) beside(own);
  if (about.columns.length) {
    const more = add(own, 'details');
    add(more, 'summary', `The ${about.columns.length} columns of ${data.files.length ? 'history.csv' : 'the history'}`);
    table(more, ['column', 'unit', 'what it is'], about.columns.map((column) => [column.name, kindOf(column.unit), column.meaning]), [1, 2]);
  }
}

function beside(own) {
  add(own, 'p', 'Beside this report.', { class: 'soft' });
  const body = table(own, ['file', 'size', 'what it is'], data.files.map((file) => [file.name, size(file.bytes), file.what]), [2]);
  for (const cell of body.querySelectorAll('tbody td:first-child')) { const name = cell.textContent; cell.textContent = ''; add(cell, 'a', name, { href: encodeURI(name) }); }
  redraw.pop();
}

page.replaceChildren();
// Of a run-up what goes over the speed comes first: no cycle of it is like another one.
const speeds = [tracked, reversed, envelopes, waterfalls];
const cycles = [results, histories, orbits, overAngle, filmMaps, spectra];
const ofRun = run?.tracked.length ? [...speeds, ...cycles] : [...cycles, ...speeds];
for (const make of [head, theCase, machine, ...ofRun, swept, analysed, energy, drawings, files]) make();
add(page, 'footer', `whirl ${about.version}`);

// Words of the program keep their units.
const kept = document.createElement('p');
kept.className = 'soft';
document.querySelector('h1').after(kept);
const sayKept = () => { kept.textContent = Units.system === 'si' && Amplitudes.factor === 1 ? '' : 'Charts, tiles and tables follow the switches above; sentences and what stands in typewriter type keep µm and N, and amplitudes from 0 to the peak.'; };
sayKept();
redraw.push(sayKept);

const redrawScenes = () => scenes.forEach((own) => own.draw());
function again() { for (const fill of [...redraw]) fill(); Chart.renderAll(); redrawScenes(); }
document.getElementById('units').addEventListener('change', (event) => { Units.system = event.target.value; again(); });
document.getElementById('amplitudes').addEventListener('change', (event) => { Amplitudes.factor = Number(event.target.value); again(); });
document.getElementById('theme').addEventListener('change', (event) => { document.documentElement.dataset.theme = event.target.value; redrawScenes(); });
document.getElementById('print').addEventListener('click', () => window.print());
let width = window.innerWidth;
window.addEventListener('resize', () => { if (window.innerWidth !== width) { width = window.innerWidth; Chart.renderAll(); redrawScenes(); } });
const printing = (on) => {
  Chart.printing = on;
  for (const details of document.querySelectorAll('details.words-of')) {
    if (on) details.dataset.was = details.open ? 'open' : '';
    details.open = on || details.dataset.was === 'open';
  }
  Chart.renderAll();
};
window.addEventListener('beforeprint', () => printing(true));
window.addEventListener('afterprint', () => printing(false));
// For tests: what is shown, read back.
window.whirl = { data, charts: Chart.all, scene, scenes, Scene, numbers, Units, Amplitudes };
