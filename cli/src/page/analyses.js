// Charts, figures and words of analyses and of sweeps.

// Figures of files, as they are.
function drawn(parent, figures) {
  if (!figures.length) return;
  const grid = add(parent, 'div', undefined, { class: 'grid' });
  for (const figure of figures) {
    figure.shown = true;
    const frame = add(grid, 'figure', undefined, { class: 'drawing' });
    add(frame, 'img', undefined, { src: `data:image/svg+xml;base64,${figure.base64}`, alt: figure.title });
    add(frame, 'figcaption', figure.title.startsWith(`${about.name}: `) ? `${figure.title.slice(about.name.length + 2)} (${figure.name})` : figure.name, { class: 'soft' });
  }
}

function drawings() {
  const rest = data.figures.filter((figure) => !figure.shown);
  if (rest.length) drawn(part('figures', 'Figures'), rest);
}

// The rows of a CSV by the names of its columns; what is a number is one.
function parsed(csv) {
  const cells = (line) => [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map((own) => own[1]).slice(0, -1).map((own) => (own.startsWith('"') ? own.slice(1, -1).replaceAll('""', '"') : own));
  const [head, ...lines] = csv.trimEnd().split('\n');
  const names = cells(`${head},`);
  return { names, rows: lines.map((line) => { const own = cells(`${line},`); return Object.fromEntries(names.map((name, k) => [name, own[k] !== '' && Number.isFinite(Number(own[k])) ? Number(own[k]) : own[k]])); }) };
}

// Rows by what some of their columns say.
function grouped(rows, ...by) {
  const all = new Map();
  for (const row of rows) { const key = by.map((name) => row[name]).join(' · '); if (!all.has(key)) all.set(key, []); all.get(key).push(row); }
  return all;
}

// Phases without jumps of a whole turn.
function unwrapped(values) {
  const all = Float64Array.from(values);
  let before = NaN;
  for (let k = 0; k < all.length; k++) {
    if (!Number.isFinite(all[k])) continue;
    if (Number.isFinite(before)) all[k] -= 360 * Math.round((all[k] - before) / 360);
    before = all[k];
  }
  // As near to zero as they can be.
  const known = all.filter(Number.isFinite);
  const turns = known.length ? Math.round((Math.min(...known) + Math.max(...known)) / 720) : 0;
  return turns ? all.map((own) => own - 360 * turns) : all;
}

const line = (rows, x, y, name, more) => ({ name, x: rows.map((row) => row[x]), y: rows.map((row) => (typeof row[y] === 'number' ? row[y] : NaN)), ...more });

// A mode over the speed, in pieces by how it whirls.
function whirled(rows, y, name, style) {
  const pieces = [];
  rows.forEach((row, k) => {
    const before = pieces[pieces.length - 1];
    if (before && before.whirl === row.whirl) before.rows.push(row);
    else pieces.push({ whirl: row.whirl, rows: k ? [rows[k - 1], row] : [row] });
  });
  const dashes = { forward: '', backward: '7 3', '-': '1.5 2.5' };
  const words = rows.map((row) => (row.whirl === '-' ? '' : row.whirl));
  return line(rows, 'speed_rpm', y, name, { style, dash: '', words, pieces: pieces.map((own) => ({ ...line(own.rows, 'speed_rpm', y), dash: dashes[own.whirl] })) });
}

// Modes without those so far above the rest that they would squeeze it: the two lowest and what is below three times the highest
// order are always there.
function withRoom(all, rpm) {
  const top = ([, own]) => Math.max(...own.map((row) => row.frequency_hz));
  const tops = all.map(top).sort((a, b) => a - b);
  const ceiling = Math.max(tops[1] ?? Infinity, (3 * rpm) / 60);
  if (0.5 * tops[tops.length - 1] <= ceiling) return { modes: all, above: 0 };
  const modes = all.filter((own) => top(own) <= ceiling);
  return { modes, above: all.length - modes.length };
}

// A logarithmic decrement beyond which a motion is gone within a cycle.
const MUCH = 3;

// The body whose speed an analysis is over, where several turn.
const whose = (name) => { const of = (analyses?.analyses || []).find((own) => own.name === name)?.of; return of ? ` of ${of}` : ''; };
const speedOf = (name) => ({ label: `speed${whose(name)}`, unit: 'rpm' });

// Between which speeds the run of the case goes.
function runMarks(name) {
  const own_ = (analyses?.analyses || []).find((own) => own.name === name);
  const ends = own_?.run_rpm?.length ? own_.run_rpm : ranAt(own_?.of);
  return ends.filter((rpm) => rpm > 0).map((rpm) => ({ x: rpm, name: ends.length === 1 ? `run at ${shown(rpm, 5)}` : rpm === ends[0] ? `run from ${shown(rpm, 5)}` : `run to ${shown(rpm, 5)}` }));
}

// Speeds (rpm) at which the run of a body that turns freely begins and ends; one where that is the same.
function ranAt(body) {
  const column = run && about.groups.find((own) => own.title === 'Speed of rotation')?.lines.find(([, own]) => own === body)?.[0];
  const own = columns.get(column);
  if (!own) return [];
  const all = numbers(own.values || own.most);
  const [first, last] = [all[0], all[all.length - 1]].map((value) => Math.abs(value) * (30 / Math.PI));
  return Math.abs(last - first) < 0.01 * Math.max(last, first) ? [last] : [first, last];
}

// Charts of an analysis beside its figures, which they replace: names of those.
const CHARTED = {
  campbell(host, name, tables) {
    const rows = tables.get(`${name}.csv`)?.rows;
    if (!rows?.length) return [];
    const critical = (tables.get(`${name}.critical.csv`)?.rows || []).filter((row) => row.what === 'critical speed');
    const speeds = [...new Set(rows.map((row) => row.speed_rpm))];
    if (speeds.length < 2) return [];
    const ends = [Math.min(...speeds), Math.max(...speeds)];
    const orders = [...new Set(critical.map((row) => row.order).concat(1))].sort((a, b) => a - b);
    const others = new Map(critical.filter((row) => row.once_a_turn_of && row.order !== 1).map((row) => [row.order, String(row.once_a_turn_of).replaceAll(' ', ', ')]));
    const called = (order) => (others.has(order) ? `1X of ${others.get(order)}` : `${shown(order, 6)}X`);
    const all = [...grouped(rows, 'branch')].filter(([, own]) => own.length > 1);
    const { modes, above } = withRoom(all, Math.max(...orders) * Math.max(...speeds.map(Math.abs)));
    const top = 1.1 * Math.max(...modes.flatMap(([, own]) => own.map((row) => row.frequency_hz)));
    const across = orders.map((order) => { const x = [ends[0], Math.min(ends[1], (60 * top) / order)]; return { name: called(order), tag: called(order), x, y: x.map((rpm) => (order * rpm) / 60), style: 6, dash: { 0.5: '6 2 1 2', 1: '2 3', 2: '1 4' }[order] || '4 4' }; }).filter((own) => own.x[1] > own.x[0]);
    const x = speedOf(name);
    const kinds = [...new Set(modes.flatMap(([, own]) => own.map((row) => row.whirl)))];
    const letter = (row) => ({ axial: 'A', torsional: 'T' })[row.motion] || { forward: 'F', backward: 'B' }[row.whirl] || '';
    const letters = [['F', 'forward'], ['B', 'backward'], ['T', 'torsional'], ['A', 'axial']].filter(([one]) => critical.some((row) => letter(row) === one)).map((one) => one.join(' ')).join(', ');
    const thresholds = (tables.get(`${name}.critical.csv`)?.rows || []).filter((row) => row.what !== 'critical speed').map((row) => ({ x: row.speed_rpm, name: `${row.what} ${shown(row.speed_rpm, 5)}` }));
    const grows = (rpm) => rows.some((row) => row.speed_rpm === rpm && row.log_decrement < -1e-6);
    const always = speeds.every(grows) ? 'UNSTABLE at all these speeds; ' : '';
    const note = `${always}${[['forward', 'solid: forward whirl'], ['backward', 'dashed: backward'], ['-', 'dotted: neither']].filter(([kind]) => kinds.includes(kind)).map(([, words]) => words).join(', ')}${letters ? `; ${letters}` : ''}${above ? `; ${above} more ${above === 1 ? 'mode' : 'modes'} above` : ''}; lines are numbered by their frequencies at ${shown(ends[0], 5)} rpm, over all bodies and directions`;
    new Chart(host, {
      id: `campbell-${slug(name)}`, title: 'Natural frequencies', zero: true, sync: `speed ${name}`, x, y: { label: 'frequency', unit: 'Hz' },
      series: [...modes.map(([branch, own], k) => ({ ...whirled(own, 'frequency_hz', `line ${branch}`, k % 6), tag: branch })), ...across], note,
      dots: critical.filter((row) => row.frequency_hz <= top).sort((a, b) => (b.whirl === 'forward') - (a.whirl === 'forward')).map((row) => ({ x: row.speed_rpm, y: row.frequency_hz, style: row.damping_ratio > 0.2 ? 6 : 1, name: critical.some((one) => one.damping_ratio > 0.2) ? 'critical speed (black: amplification 1/(2ζ) below 2.5)' : 'critical speed', label: `${shown(row.speed_rpm, 5)} ${letter(row)}`.trim() })),
      marks: [...thresholds, ...runMarks(name)],
    });
    // Decrements that nobody waits for would squeeze those near zero.
    const damps = modes.flatMap(([, own]) => own.map((row) => row.log_decrement));
    const squeezed = damps.some((own) => own > MUCH) && damps.some((own) => own <= MUCH);
    const near = (own) => (squeezed ? own.map((row) => (row.log_decrement > MUCH ? { ...row, log_decrement: NaN } : row)) : own);
    new Chart(host, {
      id: `decrement-${slug(name)}`, title: 'Damping: unstable below zero', sync: `speed ${name}`, x, y: { label: 'log decrement', unit: '1' }, levels: [{ y: 0, name: '', framed: true }], marks: [...thresholds, ...runMarks(name)],
      series: modes.map(([branch, own], k) => ({ ...whirled(near(own), 'log_decrement', `line ${branch}`, k % 6), tag: branch })).filter((one) => Array.from(one.y).some(Number.isFinite)), note: [always.replace('; ', ''), squeezed ? `decrements above ${MUCH}, of motions that are gone within a cycle, are left out` : ''].filter(Boolean).join('; '),
    });
    return [`${name}.svg`];
  },
  stability(host, name, tables) {
    const rows = tables.get(`${name}.csv`)?.rows;
    if (!rows || rows.length < 2) return [];
    const marks = [...(tables.get(`${name}.thresholds.csv`)?.rows || []).map((row) => ({ x: row.speed_rpm, name: `${row.what} ${shown(row.speed_rpm, 5)}` })), ...runMarks(name)];
    const least = (column) => rows.reduce((best, row) => (typeof row[column] === 'number' && !(best?.[column] <= row[column]) ? row : best), undefined);
    const told = (column) => {
      const low = least(column);
      if (!low) return '';
      const values = rows.map((row) => row[column]).filter((value) => typeof value === 'number');
      const hertz = column === 'body_log_decrement' ? low.body_frequency_hz : low.frequency_hz;
      const kind = column === 'least_log_decrement' && low.whirl && low.whirl !== '-' ? `, ${low.whirl}` : '';
      // Where it is the same all along, or nothing lies beyond, the end of the range says nothing.
      const ends = rows.length > 1 && Math.max(...values) - low[column] > 0.01 * Math.abs(low[column]) && ((low === rows[0] && low.speed_rpm !== 0) || low === rows[rows.length - 1]);
      return `least: ${shown(low[column], 4)} at ${shown(low.speed_rpm, 5)} rpm${typeof hertz === 'number' ? `, of a motion at ${shown(hertz, 4)} Hz${kind}` : ''}${ends ? '; at this end of the range it may fall further beyond' : ''}`;
    };
    const chart = (id, title, column) => new Chart(host, {
      id: `${id}-${slug(name)}`, title: `${title}: unstable below zero`, sync: `speed ${name}`, x: speedOf(name), y: { label: 'log decrement', unit: '1' }, marks, levels: [{ y: 0, name: '', framed: true }],
      series: [line(rows, 'speed_rpm', column, 'log decrement')], note: told(column),
    });
    // Pads and rings may be ten times less damped than the rotor, or more.
    const apart = rows.some((row) => row.body_log_decrement !== row.least_log_decrement);
    if (apart) chart('stability-body', 'The least stable mode that moves the body whose speed it is', 'body_log_decrement');
    chart('stability', apart ? 'The least stable mode of all bodies' : 'The least stable mode', 'least_log_decrement');
    return [`${name}.svg`];
  },
};

// The same with what is not of speeds.
Object.assign(CHARTED, {
  coefficients(host, name, tables) {
    const rows = tables.get(`${name}.csv`)?.rows;
    if (!rows?.length) return [];
    const all = [...grouped(rows, 'joint')].filter(([, own]) => own.length > 1).slice(0, 12);
    const x = speedOf(name);
    const pair = (id, title, own) => {
      for (const [quantity, letter, of, unit] of [['stiffness', 'K', 'N_m', 'N/m'], ['damping', 'C', 'Ns_m', 'N·s/m']]) {
        const series = ['xx', 'xy', 'yx', 'yy'].map((way, k) => line(own, 'speed_rpm', `${letter.toLowerCase()}_${way}_${of}`, `${letter}${way}`, { style: k }));
        new Chart(host, { id: `${quantity}-${id}`, title: `${title}: ${quantity}`, sync: `speed ${name}`, x, y: { label: quantity, unit }, levels: [{ y: 0, name: '' }], series });
      }
    };
    for (const [joint, own] of all) pair(slug(`${name} ${joint}`), /^\d+$/.test(joint) ? `Bearing ${joint}` : joint, own);
    for (const [, own] of grouped(tables.get(`${name}.through.csv`)?.rows || [], 'bearing', 'order')) {
      const [{ bearing, order }] = own;
      const at = order === 1 ? '' : ` at ${shown(order, 6)}X`;
      if (own.length > 1) pair(`through-${slug(`${name} ${bearing} ${order}`)}`, `${bearing.replaceAll('+', ', ')}${at}, as seen by the shaft`, own);
    }
    return all.length ? [`${name}.svg`] : [];
  },
  map(host, name, tables) {
    const rows = tables.get(`${name}.csv`)?.rows;
    if (!rows?.length || new Set(rows.map((row) => row.stiffness_N_m)).size < 2) return [];
    const kinds = [['forward', 'forward whirl', 0, ''], ['backward', 'backward whirl', 1, '7 3'], ['axial', 'axial', 2, '3 2'], ['torsional', 'torsional', 3, '9 3 2 3'], ['-', 'along a line', 4, '1.5 2.5']];
    const kind = (row) => (row.motion === 'lateral' ? row.whirl : row.motion);
    const series = [];
    const had = new Set();
    for (const [, own] of grouped(rows, 'branch')) {
      let piece = [];
      own.forEach((row, k) => {
        piece.push(row);
        if (own[k + 1] && kind(own[k + 1]) === kind(row)) return;
        const [, words, style, dash] = kinds.find(([one]) => one === kind(row));
        if (piece.length > 1) series.push({ name: words, x: piece.map((one) => Math.log10(one.stiffness_N_m)), y: piece.map((one) => one.speed_rpm), style, dash, silent: had.has(words) });
        if (piece.length > 1) had.add(words);
        // The next piece begins where this one ends.
        piece = [row];
      });
    }
    new Chart(host, { id: `map-${slug(name)}`, title: 'Undamped critical speeds over the stiffness of the joints', zero: true, x: { label: 'stiffness of every joint', unit: 'N/m', log: true }, y: { label: 'speed', unit: 'rpm' }, series });
    return [`${name}.svg`];
  },
  torsion(host, name, tables) {
    const rows = tables.get(`${name}.csv`)?.rows;
    const met = tables.get(`${name}.interference.csv`)?.rows;
    if (!rows?.length || !met || new Set(rows.map((row) => row.speed_rpm)).size < 2) return [];
    const speeds = rows.map((row) => row.speed_rpm);
    const ends = [Math.min(...speeds), Math.max(...speeds)];
    const excited = [...grouped(met, 'excitation')].map(([called, [{ order }]]) => ({ called, order }));
    const reach = 1.05 * Math.max(0, ...excited.map(({ order }) => (order * ends[1]) / 60));
    const all = [...grouped(rows, 'mode')];
    const modes = all.filter(([, own], k) => k < 3 || Math.min(...own.map((row) => row.frequency_hz)) <= reach);
    const top = 1.1 * Math.max(...modes.flatMap(([, own]) => own.map((row) => row.frequency_hz)));
    const across = excited.map(({ called, order }, k) => { const x = [ends[0], Math.min(ends[1], (60 * top) / order)]; return { name: called, x, y: x.map((rpm) => (order * Math.abs(rpm)) / 60), style: 6, dash: ['2 3', '7 3', '9 3 2 3', '1 4', '12 4'][k % 5] }; }).filter((own) => own.x[1] > own.x[0]);
    const critical = met.filter((row) => row.what === 'critical speed');
    // The speeds of operation, as the words have them.
    const said = (analyses.analyses.find((own) => own.name === name)?.text || '').match(/in operation ([\d.]+)(?: to ([\d.]+))? rpm/);
    const band = said ? [...new Set([said[1], said[2] ?? said[1]].map(Number))].map((x) => ({ x, name: 'operation' })) : [];
    new Chart(host, {
      id: `torsion-${slug(name)}`, title: 'Interference diagram', zero: true, x: speedOf(name), y: { label: 'frequency', unit: 'Hz' },
      series: [...modes.map(([mode, own], k) => line(own, 'speed_rpm', 'frequency_hz', `mode ${mode}`, { style: k % 6, dash: '', tag: mode })), ...across], marks: band, note: all.length > modes.length ? `${all.length - modes.length} more ${all.length - modes.length === 1 ? 'mode' : 'modes'} above all excitations` : '',
      dots: critical.map((row) => ({ x: row.speed_rpm, y: row.frequency_hz, style: 1, name: 'critical speeds of torsion', label: shown(row.speed_rpm, 4) })),
    });
    const shapes = [...grouped(tables.get(`${name}.modes.csv`)?.rows || [], 'mode')].map(([mode, own]) => [mode, own.filter((row) => typeof row.twist === 'number')]).filter(([, own]) => own.length > 1).slice(0, 6);
    if (shapes.length) {
      const names = shapes[0][1].map((row) => row.body);
      new Chart(host, {
        id: `twists-${slug(name)}`, title: 'Shapes: turns in the speed of the first body', x: { label: 'body', unit: '1', names }, y: { label: 'turn', unit: '1' }, levels: [{ y: 0, name: '' }],
        series: shapes.map(([mode, own], k) => ({ name: `mode ${mode}, ${shown(own[0].frequency_hz, 4)} Hz`, x: own.map((row) => 1 + names.indexOf(row.body)), y: own.map((row) => row.twist), style: k })),
      });
    }
    return [`${name}.svg`];
  },
});

function swept() {
  if (!sweep) return;
  const own = part('sweep', 'The sweep');
  for (const words of sweep.remarks) add(add(own, 'div', undefined, { class: 'verdict bad' }), 'p', words);
  const list = add(own, 'ul', undefined, { class: 'plain' });
  for (const words of sweep.lines) add(list, 'li', words);
  const file = data.tables.find((one) => one.name === 'table.csv');
  if (!file) { add(own, 'p', 'table.csv is too large to be shown here.', { class: 'soft' }); drawn(own, data.figures); return; }
  const { names, rows } = parsed(file.csv);
  const numeric = names.filter((name) => rows.some((row) => typeof row[name] === 'number'));
  const across = [...sweep.varied.filter((name) => numeric.includes(name)), 'point'].filter((name) => numeric.includes(name));
  // What is the same everywhere comes last.
  const constant = (name) => new Set(rows.map((row) => row[name])).size < 2;
  const up = numeric.filter((name) => !across.includes(name)).sort((a, b) => constant(a) - constant(b));
  if (across.length && up.length) {
    add(own, 'h3', 'Any number of the table over what varies');
    const choose = add(own, 'div', undefined, { class: 'choose screen' });
    const host = add(own, 'div', undefined, { class: 'grid' });
    const pick = (words, options) => { const box = add(add(choose, 'label', `${words} `), 'select'); for (const name of options) add(box, 'option', name, { value: name }); box.addEventListener('change', () => show()); return box; };
    const [y, x] = [pick('show', up), pick('over', across)];
    // At first one of a run's results, not of its steps.
    y.value = up.find((name) => /_[^_.]+\.(max|1X)/.test(name) && !constant(name)) || up[0];
    const by = pick('a line for each', ['–', ...sweep.varied.concat('direction').filter((name) => names.includes(name))]);
    // What has most values lies on the axis.
    const many = (name) => new Set(rows.map((row) => row[name])).size;
    const varied = across.filter((name) => sweep.varied.includes(name));
    if (varied.length) x.value = varied.reduce((best, name) => (many(name) > many(best) ? name : best));
    if (sweep.varied.length > 1) by.value = sweep.varied.find((name) => name !== x.value) || '–';
    let chart = null;
    const show = () => {
      const lines = by.value === '–' || by.value === x.value ? new Map([[y.value, rows]]) : grouped(rows, by.value);
      const few = [...lines].slice(0, 12);
      const sorted = (all) => [...all].filter((row) => typeof row[y.value] === 'number' && typeof row[x.value] === 'number').sort((a, b) => a[x.value] - b[x.value]);
      const series = few.map(([name, all], k) => ({ ...line(sorted(all), x.value, y.value, name, { style: k % 6, dash: DASHES[(k + Math.floor(k / 6)) % 6] }) })).filter((one) => one.x.length);
      const spec = { id: 'sweep-table', title: `${y.value} over ${x.value}`, x: { label: x.value, unit: '1' }, y: { label: y.value, unit: '1' }, series, note: lines.size > few.length ? `the first ${few.length} of ${lines.size} lines` : '' };
      if (!series.length) return;
      if (!chart) chart = new Chart(host, spec);
      else { chart.spec = spec; chart.hidden.clear(); chart.view = null; chart.figure.querySelector('figcaption').textContent = spec.title; chart.render(); }
    };
    show();
  }
  drawn(own, data.figures);
  const more = add(own, 'details', undefined, { class: 'screen' });
  add(more, 'summary', `table.csv: ${rows.length} rows`);
  more.addEventListener('toggle', () => {
    if (!more.open || more.children.length > 1) return;
    table(more, names, rows.slice(0, 500).map((row) => names.map((column) => (typeof row[column] === 'number' ? shown(row[column], 6) : row[column]))));
    if (rows.length > 500) add(more, 'p', 'The first 500 rows; the file has all of them.', { class: 'soft' });
  });
}

// Lines that tell what an analysis comes to, and among them what must not be missed.
const DANGER = /^UNSTABLE|NOT STABLE|^DOES NOT PASS|too large for a linear|vary by (?:[2-9]\d|\d{3,}) %/;
const FOUND = /^stable |^a further motion|^one motion stops|^no critical speed|critically damped|joints are linear, within|nothing closes the clearance|^all modes are|^in operation|has no amplitudes|^PASSES/;

// Sentences of the terminal without the quotes of its commands.
const plain = (words, sentence = true) => (sentence ? words.replace(/`([^`]+)`/g, '$1').replace(/(^|[\s(=])-(?=\d)/g, '$1−').replace(/^(left out: .*? rpm), as no equilibrium was found .*$/, '$1, where no equilibrium was found') : words);

// Lines as the terminal has them; notes, which are sentences, wrap.
function worded(parent, lines) {
  let [kept, note] = [[], false];
  const flush = () => { if (kept.some((line) => line.trim())) add(parent, note ? 'p' : 'pre', plain(kept.join('\n').trimEnd(), note), note ? { class: kept.some((line) => DANGER.test(line)) ? 'note loud' : 'note' } : { style: `--wide: ${Math.max(...kept.map((line) => line.length))}` }); kept = []; };
  for (const line of lines) {
    const is = line.startsWith('note: ') || (line.length > 150 && !/ {3}/.test(line));
    if (is || note !== is) flush();
    note = is;
    kept.push(line);
  }
  flush();
}

function analysed() {
  if (!analyses) return;
  const tables = new Map(data.tables.map((own) => [own.name, parsed(own.csv)]));
  for (const { name, kind, heading, text, files, interrupted, failed } of analyses.analyses) {
    const own = part(`analysis-${slug(name)}`, heading);
    if (failed) { add(add(own, 'div', undefined, { class: 'verdict bad' }), 'p', `Analysis \u201c${name}\u201d came to nothing: ${text}.`); continue; }
    const usual = name === kind ? '' : `Analysis \u201c${name}\u201d. `;
    if (usual || interrupted) add(own, 'p', `${usual}${interrupted ? 'Interrupted: what was found up to then.' : ''}`, { class: 'soft' });
    const lines = text.trimEnd().split('\n').filter((line, k) => k > 0 || !line.startsWith(`${about.name}: `));
    while (lines.length && !lines[0].trim()) lines.shift();
    const chaptered = kind === 'lateral' && lateral(own, name, tables, lines);
    for (const figure of data.figures) if (chaptered && figure.name === `${name}.svg`) figure.shown = true;
    const folds = lines.length > (kind === 'torsion' ? 60 : 24) || chaptered;
    if (!folds) worded(own, lines);
    // What must not be missed, however long the rest is.
    const loud = lines.filter((words) => DANGER.test(words) || FOUND.test(words));
    if (folds && !chaptered && loud.length) { worded(own, loud.slice(0, 6)); if (loud.length > 6) add(own, 'p', `${loud.length - 6} more of these lines are in the words below.`, { class: 'soft' }); }
    const grid = add(own, 'div', undefined, { class: 'grid' });
    const replaced = CHARTED[kind]?.(grid, name, tables) || [];
    for (const figure of data.figures) if (replaced.includes(figure.name)) figure.shown = true;
    // The same roots as those of a Campbell diagram before it.
    const twice = kind === 'stability' && analyses.analyses.some((other) => other.kind === 'campbell');
    for (const figure of data.figures) if (twice && figure.name === `${name}.roots.svg`) figure.shown = true;
    drawn(own, data.figures.filter((figure) => files.includes(figure.name) && !figure.shown));
    inSpace(own, name);
    if (folds) { const more = add(own, 'details', undefined, { class: 'words-of' }); add(more, 'summary', `All that was found, in words (${lines.length} lines)`); worded(more, lines); }
    for (const file of files) {
      const table_ = tables.get(file);
      if (!table_ || !table_.rows.length) continue;
      const more = add(own, 'details', undefined, { class: 'screen' });
      add(more, 'summary', `${file}: ${table_.rows.length} ${table_.rows.length === 1 ? 'row' : 'rows'}`);
      // Made when it is opened: there may be many.
      more.addEventListener('toggle', () => {
        if (!more.open || more.children.length > 1) return;
        table(more, table_.names, table_.rows.slice(0, 500).map((row) => table_.names.map((column) => (typeof row[column] === 'number' ? shown(row[column], 6) : row[column]))));
        if (table_.rows.length > 500) add(more, 'p', 'The first 500 rows; the file has all of them.', { class: 'soft' });
      });
    }
  }
}
