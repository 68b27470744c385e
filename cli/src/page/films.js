// Oil films on their bores: pressure, gap and fill at the nodes, frame by frame and over all of them.

const FILM_KINDS = [
  ['largest_pressure_mpa', 'largest pressure', 'MPa', false], ['smallest_gap_um', 'smallest gap', 'µm', false],
  ['pressure_mpa', 'pressure', 'MPa', true], ['gap_um', 'gap', 'µm', true], ['fill', 'fill', '1', true],
];

function filmMaps() {
  const films = data.films?.films || [];
  if (!films.length) return;
  const own = part('films', 'Oil films on their bores');
  add(own, 'p', `At the nodes of each film: the angle counts from x to y in the frame of the bore, z from the middle of the film. The largest pressure and the smallest gap are of each node over all frames, from ${shown(films[0].time[0], 5)} to ${shown(films[0].time[films[0].time.length - 1], 5)} s; the others are of one instant.`, { class: 'soft' });
  const choose = add(own, 'div', undefined, { class: 'choose screen' });
  const grid = add(own, 'div', undefined, { class: 'grid' });
  const kinds = FILM_KINDS.filter(([key]) => films.some((film) => film[key]));
  const pick = (words, options) => { const box = add(add(choose, 'label', `${words} `), 'select'); options.forEach(([value, name]) => add(box, 'option', name, { value })); box.addEventListener('change', () => show()); return box; };
  const kind = pick('show', kinds.map(([key, name]) => [key, name]));
  const { time } = films.reduce((best, film) => (film.time.length > best.time.length ? film : best));
  const when = pick('at', time.map((at, k) => [String(k), `${shown(at, 7)} s`]));
  when.value = String(time.length - 1);
  const charts = [];
  const show = () => {
    const [key, words, unit, instants] = kinds.find(([own_]) => own_ === kind.value);
    when.disabled = !instants;
    films.forEach((film, place) => {
      const levels = film[key];
      if (!levels) { if (charts[place]) charts[place].figure.hidden = true; return; }
      const frame = instants ? film.time.reduce((best, at, k) => (Math.abs(at - time[when.value]) < Math.abs(film.time[best] - time[when.value]) ? k : best), 0) : 0;
      const spec = filmSpec(film, levels, { frame, words: instants ? `${words} at ${shown(film.time[frame], 7)} s` : words, unit });
      if (!charts[place]) { charts[place] = new Chart(grid, spec); return; }
      const chart = charts[place];
      spec.id = chart.spec.id;
      Object.assign(chart, { spec, cursor: null });
      chart.figure.hidden = false;
      chart.figure.querySelector('figcaption').textContent = spec.title;
      if (chart.over) chart.render();
    });
  };
  show();
}

// The chart of a film: a cell a node.
function filmSpec(film, levels, { frame, words, unit }) {
  const [angles, rows] = [film.angle_deg, film.z_mm];
  const [around, nodes] = [angles.length, angles.length * rows.length];
  const parts = numbers(levels.parts);
  const value = (row, column) => levels.least + (parts[frame * nodes + row * around + column] / 65535) * (levels.most - levels.least);
  const half = (all) => (all.length > 1 ? 0.5 * (all[1] - all[0]) : 0.5);
  const [across, along] = [half(angles), half(rows)];
  const view = { x0: angles[0] - across, x1: angles[around - 1] + across, y0: rows[0], y1: rows[rows.length - 1] };
  const row = (z) => Math.min(Math.max(Math.round((z - rows[0]) / (2 * along)), 0), rows.length - 1);
  const at = (x, z) => {
    const column = Math.min(Math.max(Math.round((x - angles[0]) / (2 * across)), 0), around - 1);
    return { x: angles[column], y: rows[row(z)], value: value(row(z), column) };
  };
  // The place that is looked for first: of a gap the narrowest.
  let best = 0;
  const narrow = unit === 'µm';
  // Of places that are alike the nearest to the middle.
  const off = (k) => Math.abs(rows[Math.floor(k / around)]);
  for (let k = 0; k < nodes; k++) {
    const apart = (narrow ? -1 : 1) * (parts[frame * nodes + k] - parts[frame * nodes + best]);
    if (apart > 0 || (apart === 0 && off(k) < off(best))) best = k;
  }
  const place = { x: angles[best % around], y: rows[Math.floor(best / around)] };
  return {
    id: `film-${slug(film.name)}`, title: `${film.name}: ${words}`, height: 150, series: [],
    map: { view, columns: around, least: levels.least, largest: levels.most, row, value, at },
    x: { label: 'angle', unit: '°' }, y: { label: 'z', unit: 'mm' }, z: { label: words.split(' at ')[0], unit },
    dots: [{ ...place, style: 1, get name() { return `${narrow ? 'smallest' : 'largest'}: ${shown(value(Math.floor(best / around), best % around) * Units.of(unit)[1], 4)} ${kindOf(Units.of(unit)[0])} at ${shown(place.x, 4)}°, z = ${shown(place.y, 3)} mm`; } }],
  };
}
