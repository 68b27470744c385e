// The lateral analysis of API 617 by its clauses: verdict, unbalance, critical speeds with their margins, vibration, stability.

const CLAUSES = [
  { title: 'Critical speeds: amplification factors and separation margins', of: ['amplification factor', 'separation margin'] },
  { title: 'Vibration at the probes and at close clearances', of: ['probe vibration A_max', 'scale factor S_cc', 'scaled response at clearance'] },
  { title: 'Stability, level I', clause: '6.8.5' },
  { title: 'Stability, level II', clause: '6.8.6' },
];

// Units as people write them.
const symbols = (words) => words.replace(/\bum\b/g, 'µm').replace(/\^3/g, '³');

function lateral(own, name, tables, lines) {
  const rows = (file) => tables.get(`${name}${file}`)?.rows || [];
  const [all, readings, decrements, unbalance] = ['.csv', '.response.csv', '.stability.csv', '.unbalance.csv'].map(rows);
  if (!all.length) return false;
  const range = lines.find((line) => line.startsWith('API 617')) || '';
  const speeds = Object.fromEntries([...range.matchAll(/(N_ma|N_mc|trip) (\S+) rpm/g)].map((found) => [found[1], Number(found[2])]));
  const verdict = lines.find((line) => /^(PASSES|DOES NOT PASS)/.test(line)) || '';
  const box = add(own, 'div', undefined, { class: verdict.startsWith('PASSES') ? 'verdict' : 'verdict bad', id: `verdict-${slug(name)}` });
  const [said, ...rest] = verdict.split(':');
  add(box, 'strong', said === 'PASSES' ? 'Passes' : 'Does not pass');
  add(box, 'p', `${rest.join(':').trim()}. ${range}.`);
  const fails = lines.slice(lines.indexOf(verdict) + 1).filter((line) => line.startsWith('  '));
  if (fails.length) { const list = add(box, 'ul'); for (const line of fails) add(list, 'li', symbols(line.trim())); }
  const given = lines.filter((line) => line.startsWith('given: '));
  if (given.length) { const list = add(own, 'ul', undefined, { class: 'plain' }); for (const line of given) add(list, 'li', symbols(line.replace('given: ', ''))); }
  const variants = [...new Set(all.map((row) => row.variant))];
  const several = variants.length > 1;
  const lead = (row) => (several ? [row.variant] : []);
  const heads = [...(several ? ['variant'] : []), 'unbalance', 'clause', 'quantity', 'at', ['speed', 'rpm'], 'value', 'limit', 'unit', 'passes'];
  const words = heads.map((_, k) => k).filter((k) => k < heads.length - 5 || k >= heads.length - 2);
  const judged = (host, some) => {
    const made = (row) => {
      const [unit, more] = row.unit === 'um pk-pk' ? ['µm', ' pk-pk'] : [row.unit === 1 ? '1' : String(row.unit), ''];
      const cell = (value) => (typeof value !== 'number' ? '' : more ? [value, unit] : shown(value, 5));
      const named = unit === '1' ? '' : () => `${Units.of(unit)[0]}${more}`;
      return [...lead(row), row.unbalance, row.clause, row.quantity, row.place, typeof row.speed_rpm === 'number' ? shown(row.speed_rpm, 6) : '', cell(row.value), cell(row.limit), named, row.pass];
    };
    table(host, heads, some.map(made), words, (cell) => { if (cell.textContent === 'NO') cell.className = 'words fails'; if (cell.textContent === 'yes') cell.className = 'words passes'; });
  };
  add(own, 'h3', `Unbalance (${all[0].clause.replace(/\.\d+$/, '.7')})`);
  const loads = lines.filter((line) => line.includes('static loads: '));
  const list = add(own, 'ul', undefined, { class: 'plain' });
  for (const line of loads) add(list, 'li', `${line[0].toUpperCase()}${line.slice(1)}`);
  table(own, [...(several ? ['variant'] : []), 'unbalance', 'z (mm)', 'W (kg)', 'U_a (g·mm)', 'phase (°)'], unbalance.map((row) => [...lead(row), row.unbalance, ...['z_mm', 'load_kg', 'unbalance_g_mm', 'phase_deg'].map((key) => shown(row[key], 5))]), several ? [0, 1] : [0]);
  CLAUSES.forEach(({ title, of, clause }, place) => {
    const some = all.filter((row) => (of ? of.some((quantity) => row.quantity.startsWith(quantity)) : row.clause.endsWith(clause.slice(1))));
    if (!some.length) return;
    add(own, 'h3', `${title} (${[...new Set(some.map((row) => row.clause))].join(', ')})`);
    judged(own, some);
    const grid = add(own, 'div', undefined, { class: 'grid' });
    if (place === 0) bodes(grid, name, { all, readings, speeds, several });
    if (place === 1) clearances(grid, name, { some, readings, speeds, several });
    if (place === 2 && decrements.length) decrement(grid, name, { some, decrements });
    if (place === 2) regions(grid, name, { some, density: Number(lines.map((line) => /average density of the gas (\S+) kg/.exec(line)?.[1]).find(Boolean)) });
  });
  const other = ['map', 'modes'].filter((kind) => !analyses.analyses.some((one) => one.kind === kind));
  const notes = [...new Set(lines.filter((line) => /^(note: |left out: )/.test(line)))];
  if (notes.length) {
    add(own, 'h3', 'What limits these numbers');
    const list_ = add(own, 'ul', undefined, { class: 'plain' });
    for (const line of notes) add(list_, 'li', line.replace(/^note: /, ''));
  }
  if (other.length) add(own, 'p', `${other.map((kind) => ({ map: 'Undamped critical speeds over the stiffness of the bearings', modes: 'mode shapes in space' })[kind]).join(' and ')} are not on this page: ${other.map((kind) => `whirl ${kind}`).join(' and ')} with the same folder ${other.length > 1 ? 'add' : 'adds'} them.`, { class: 'soft screen' });
  return true;
}

const titled = (several, row, what) => `${what}, unbalance ${row.unbalance}${several ? `, ${row.variant}` : ''}`;
const bounds = (speeds) => Object.entries(speeds).sort((a, b) => a[1] - b[1]).map(([called, x]) => ({ x, name: called }));

// What probes read over speed, with peaks, and from each critical speed as far as its margin has to reach.
function bodes(grid, name, { all, readings, speeds, several }) {
  for (const [key, own] of grouped(readings.filter((row) => row.place.endsWith(' deg')), 'variant', 'unbalance')) {
    const of = (quantity) => all.filter((row) => row.variant === own[0].variant && row.unbalance === own[0].unbalance && row.quantity === quantity);
    const probes = [...grouped(own, 'place')];
    const height = (place, speed) => { const rows = probes.find(([probe]) => probe === place)?.[1] || own; return rows.reduce((best, row) => (Math.abs(row.speed_rpm - speed) < Math.abs(best.speed_rpm - speed) ? row : best)).unscaled_um_pkpk; };
    const margins = of('separation margin').map((row, k) => {
      const below = row.speed_rpm < speeds.N_ma;
      const end = row.speed_rpm / (below ? 1 - 0.01 * row.limit : 1 + 0.01 * row.limit);
      const y = height(row.place, row.speed_rpm);
      return { name: 'required separation margin', x: [row.speed_rpm, end].sort((a, b) => a - b), y: [y, y], style: 1, dash: '4 2', silent: k > 0 };
    });
    new Chart(grid, {
      id: `probes-${slug(`${name} ${key}`)}`, title: titled(several, own[0], 'Probes'), zero: true, sync: `speed ${name}`, x: { label: 'speed', unit: 'rpm' }, y: { label: 'probe, pk-pk', unit: 'µm' }, marks: bounds(speeds),
      series: [...probes.map(([probe, rows], k) => line(rows, 'speed_rpm', 'unscaled_um_pkpk', probe.replace(' deg', '°'), { style: [0, 2, 3, 4, 5, 6][k % 6] })), ...margins],
      dots: of('amplification factor').map((row) => ({ x: row.speed_rpm, y: height(row.place, row.speed_rpm), style: 1, name: 'peaks' })),
    });
    if (own.some((row) => typeof row.phase_deg === 'number')) new Chart(grid, {
      id: `probes-phase-${slug(`${name} ${key}`)}`, title: titled(several, own[0], 'Phase at the probes'), sync: `speed ${name}`, x: { label: 'speed', unit: 'rpm' }, y: { label: 'phase', unit: '°' }, marks: bounds(speeds), note: 'φ of A cos(θ + φ): the lag grows downwards',
      series: probes.map(([probe, rows], k) => { const one = line(rows, 'speed_rpm', 'phase_deg', probe.replace(' deg', '°'), { style: [0, 2, 3, 4, 5, 6][k % 6] }); return { ...one, y: unwrapped(one.y) }; }),
    });
  }
}

// The scaled response over speed as a part of what is allowed at each clearance.
function clearances(grid, name, { some, readings, speeds, several }) {
  for (const [key, own] of grouped(readings.filter((row) => !row.place.endsWith(' deg')), 'variant', 'unbalance')) {
    const limit = (place) => some.find((row) => row.quantity.startsWith('scaled response') && row.variant === own[0].variant && row.unbalance === own[0].unbalance && row.place === place)?.limit;
    // The largest one lies between the speeds of the table.
    const peak = (place) => some.filter((row) => row.quantity.startsWith('scaled response') && row.variant === own[0].variant && row.unbalance === own[0].unbalance && row.place === place && typeof row.speed_rpm === 'number').map((row) => [row.speed_rpm, row.value / row.limit]);
    const places = [...grouped(own, 'place')].filter(([place]) => limit(place) > 0);
    if (!places.length) continue;
    new Chart(grid, {
      id: `clearances-${slug(`${name} ${key}`)}`, title: titled(several, own[0], 'Scaled response at clearances'), zero: true, sync: `speed ${name}`, x: { label: 'speed', unit: 'rpm' }, y: { label: 'share of what is allowed', unit: '1' }, marks: bounds(speeds), levels: [{ y: 1, name: '75 % of the clearance' }],
      series: places.map(([place, rows], k) => { const all_ = [...rows.map((row) => [row.speed_rpm, row.scaled_um_pkpk / limit(place)]), ...peak(place)].sort((a, b) => a[0] - b[0]); return { name: place, x: all_.map((one) => one[0]), y: all_.map((one) => one[1]), style: k % 7 }; }),
      dots: places.flatMap(([place]) => peak(place).map(([x, y]) => ({ x, y, style: 1, name: 'largest' }))),
    });
  }
}

// The least logarithmic decrement of forward modes over cross-coupled stiffness.
function decrement(grid, name, { some, decrements }) {
  const expected = some.find((row) => row.quantity.endsWith('Q_A') && row.unit === 'N/m');
  const [most] = [Math.max(...decrements.map((row) => row.cross_coupling_N_m))];
  const kilo = most >= 1e6 ? ['MN/m', 1e-6] : ['kN/m', 1e-3];
  // Where it is decided: to twice Q_A, and as far as the decrement reaches zero.
  const zero = [...grouped(decrements, 'variant')].flatMap(([, rows]) => rows.filter((row) => row.log_decrement < 0).slice(0, 1)).map((row) => row.cross_coupling_N_m);
  const end = Math.max(2 * (expected?.value || 0), 1.3 * Math.max(...zero, 0)) || most;
  new Chart(grid, {
    range: [0, Math.min(end, most) * kilo[1]], id: `decrement-${slug(name)}`, title: 'Least damped forward mode at N_mc', x: { label: 'cross-coupled stiffness Q', unit: kilo[0] }, y: { label: 'log decrement', unit: '1' }, levels: [{ y: 0.1, name: 'least: 0.1', framed: true }],
    marks: expected ? [{ x: expected.value * kilo[1], name: 'Q_A' }] : [],
    series: [...grouped(decrements, 'variant')].map(([variant, rows], k) => ({ name: variant, x: rows.map((row) => row.cross_coupling_N_m * kilo[1]), y: rows.map((row) => row.log_decrement), style: k % 7 })),
  });
}

// Region A, below the line, and B of the critical speed ratio over the density of the gas.
function regions(grid, name, { some, density }) {
  const found = some.filter((row) => String(row.quantity).startsWith('level I critical speed ratio'));
  if (!found.length || !(density > 0)) return;
  const x = [0, 16.53, 60, 60.001, Math.max(80, 1.3 * density)];
  new Chart(grid, {
    id: `regions-${slug(name)}`, title: 'Regions of the critical speed ratio', zero: true, x: { label: 'average density of the gas', unit: 'kg/m³' }, y: { label: 'critical speed ratio', unit: '1' },
    top: 1.15 * Math.max(2.5, ...found.map((row) => row.value)), note: 'region A below the line, region B above it and beyond 60 kg/m³',
    series: [{ name: 'boundary of regions A and B', x, y: [2.5, 2.5, 2, 0, 0], style: 6, dash: '' }], dots: found.map((row) => ({ x: density, y: row.value, style: 1, name: 'this machine', label: row.variant })),
  });
}
