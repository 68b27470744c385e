// The report: its parts in the order of their weight, each only if there is something to say.

const data = JSON.parse(document.getElementById('data').textContent);
const page = document.getElementById('page');
const { summary, run, analyses, sweep } = data;
// A folder of analyses or of a sweep has no run.
const about = data.about || { source: '', words: [], ...(analyses || sweep), columns: [], groups: [], signals: [], journals: [] };
const redraw = [];

// Packed numbers, decoded once.
function numbers(packed) {
  if (packed.values) return packed.values;
  const text = atob(packed.base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
  const kind = { f32: Float32Array, f64: Float64Array, u16: Uint16Array, u32: Uint32Array }[packed.type];
  packed.values = new kind(bytes.buffer);
  return packed.values;
}

function add(parent, tag, text, attributes = {}) {
  const own = document.createElement(tag);
  if (text !== undefined) own.textContent = text;
  for (const [name, value] of Object.entries(attributes)) own.setAttribute(name, value);
  parent.append(own);
  return own;
}

function part(id, title) {
  const own = add(page, 'section', undefined, { id });
  add(own, 'h2', title);
  add(document.getElementById('contents'), 'a', title, { href: `#${id}` });
  return own;
}

// A table with units that follow the switch: cells are texts, [value, unit], or functions that give texts; `mark` is given each.
function table(parent, heads, rows, words = [], mark = () => {}) {
  const own = add(add(parent, 'div', undefined, { class: 'scroll' }), 'table');
  const fill = () => {
    own.replaceChildren();
    const head = add(add(own, 'thead'), 'tr');
    heads.forEach((text, k) => add(head, 'th', Array.isArray(text) ? `${text[0]} (${Units.of(text[1])[0]})` : text, words.includes(k) ? { class: 'words' } : {}));
    const body = add(own, 'tbody');
    for (const row of rows) {
      const line = add(body, 'tr');
      row.forEach((cell, k) => mark(add(line, 'td', Array.isArray(cell) ? shown(cell[0] * Units.of(cell[1])[1], 4) : typeof cell === 'function' ? cell() : cell, words.includes(k) ? { class: 'words' } : {})));
    }
  };
  fill();
  redraw.push(fill);
  return own;
}

// What an axis is called: the title says of what.
const short = (quantity) => quantity.replace(/^displacement of .*$/, 'displacement');
const kindOf = (unit) => (unit === '1' ? '' : unit);
const slug = (text) => text.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '');
const size = (bytes) => (bytes < 1e3 ? `${bytes} B` : bytes < 1e6 ? `${shown(bytes / 1e3, 3)} kB` : `${shown(bytes / 1e6, 3)} MB`);

// The columns of the histories by their names.
const columns = new Map();
if (run) {
  run.names.forEach((name, k) => columns.set(name, run.histories.columns[k]));
  run.ratios.forEach((title, k) => columns.set(`ratio ${title}`, run.histories.columns[run.names.length + k]));
}

function series(name, label, factor, style) {
  const own = columns.get(name);
  const scaled = (packed) => (factor === 1 ? numbers(packed) : numbers(packed).map((value) => value * factor));
  const x = numbers(run.histories.time);
  return own.values ? { name: label, x, y: scaled(own.values), style } : { name: label, x, least: scaled(own.least), most: scaled(own.most), style };
}

function extremes(name) {
  const own = columns.get(name);
  let [least, most] = [Infinity, -Infinity];
  for (const value of numbers(own.values || own.least)) if (value < least) least = value;
  for (const value of numbers(own.values || own.most)) if (value > most) most = value;
  return [least, most];
}

function head() {
  add(page, 'h1', about.title || about.name);
  add(page, 'p', `${about.title ? about.name : ''}${about.source ? ` · ${about.source}` : ''}`, { class: 'soft' });
  if (!summary) return;
  if (analyses) add(page, 'p', 'The verdict is on the run; analyses say themselves what limits them.', { class: 'soft' });
  const { verdict } = summary;
  const box = add(page, 'div', undefined, { class: verdict.sound ? 'verdict' : 'verdict bad', id: 'verdict' });
  add(box, 'strong', verdict.sound ? 'Numerically sound' : 'NOT SOUND: do not use these results');
  if (verdict.sound) add(box, 'p', 'Every step of this run passed the checks of the program: the numbers can be used. What they say of the machine is for you to judge.');
  else {
    const list = add(box, 'ul');
    for (const own of verdict.findings) {
      const amount = (value) => (value === null ? 'no number' : own.unit === '1' ? `${shown(100 * value, 3)} %` : `${shown(value, 3)} ${own.unit}`);
      add(list, 'li', `${own.what}: ${amount(own.value)}, limit ${amount(own.limit)}. Remedy: ${own.remedy}`);
    }
  }
  if (summary.error) add(box, 'p', `The run ended early: ${summary.error}.`);
  facts();
}

// What is asked first.
function facts() {
  const list = add(page, 'dl', undefined, { class: 'facts' });
  const fact = (name, value, small) => {
    const own = add(list, 'div');
    add(own, 'dt', name);
    const dd = add(own, 'dd');
    const fill = () => { dd.textContent = Array.isArray(value) ? `${shown(value[0] * Units.of(value[1])[1], 4)} ${Units.of(value[1])[0]}` : value; if (small) add(dd, 'small', typeof small === 'function' ? small() : small); };
    fill();
    redraw.push(fill);
  };
  const { march, time } = summary;
  fact('simulated', `${shown(time.simulated_s, 4)} s`, `${march.steps}${march.complete ? '' : ` of ${march.steps_asked}`} steps in ${shown(time.march_wall_s, 3)} s`);
  const [first, ...rest] = about.steady.split(/[:,] /);
  fact('steady state', first, rest.join(', '));
  if (!run) return;
  const largest = (names, of) => names.map((name) => [name, of(name)]).reduce((best, own) => (own[1] > best[1] ? own : best), ['', -Infinity]);
  if (run.ratios.length) {
    const [title, most] = largest(run.ratios, (name) => extremes(`ratio ${name}`)[1]);
    fact('largest eccentricity', `${shown(100 * most, 3)} % of the clearance`, `${title}, in the whole run`);
  }
  const forces = about.groups.filter((own) => own.quantity === 'force' && own.lines.every(([name]) => columns.has(name)));
  if (forces.length) {
    const of = (own) => Math.max(...own.lines.map(([name]) => Math.max(...extremes(name).map(Math.abs))));
    const group = forces.reduce((best, own) => (of(own) > of(best) ? own : best));
    fact('largest force component', [of(group), group.unit], `${group.title}, in the whole run`);
  }
  const top = strongest();
  if (top) fact('strongest motion', top.words, () => `${top.title}: ${shown(top.amplitude * Units.of(top.unit)[1] * Amplitudes.factor, 3)} ${Units.of(top.unit)[0]} ${Amplitudes.words} at ${shown(top.hertz, 4)} Hz`);
  const orders = (summary.orders?.signals || []).filter((own) => own.signal.endsWith('_um'));
  const last = Math.max(...orders.map((own) => own['1X'].amplitude), 0);
  // Over a run-up the last revolutions are half a window behind the last point.
  const passed = [largestOrder()].find((own) => own && own.amplitude >= last);
  const slow = largestBelow();
  if (slow) fact('largest part below 1X, 0-pk', [slow.amplitude, 'µm'], `${slow.title}: ${shown(slow.order, 3)} times the speed of ${shown(slow.rpm, 4)} rpm`);
  if (passed) fact('largest 1X, 0-pk', [passed.amplitude, 'µm'], `${passed.title}, at ${shown(passed.rpm, 4)} rpm`);
  else if (orders.length) {
    const top = orders.reduce((best, own) => (own['1X'].amplitude > best['1X'].amplitude ? own : best));
    const title = about.signals.find((own) => own.columns.some(([name]) => name === top.signal));
    fact('largest 1X, 0-pk', [top['1X'].amplitude, 'µm'], `${title ? title.title : top.signal}, last ${top.revolutions === 1 ? 'revolution' : `${top.revolutions} revolutions`}`);
  }
}

// Where 1X of displacements is largest over a run-up.
function largestOrder() {
  let top = null;
  for (const all of run.tracked) {
    const rpm = numbers(all.rpm);
    for (const signal of all.signals.filter((own) => own.column.endsWith('_um'))) {
      const title = about.signals.find((own) => own.columns.some(([name]) => name === signal.column))?.title || signal.column;
      const overall = numbers(signal.overall);
      // Where something else moves more, it leaks into the fit.
      numbers(signal.first).forEach((amplitude, k) => { if (amplitude > 0.55 * overall[k] && (!top || amplitude > top.amplitude)) top = { amplitude, rpm: rpm[k], title }; });
    }
  }
  return top;
}

// Where the largest part below 1X is largest over a run-up, if it is more than a fifth of all motion there.
function largestBelow() {
  let top = null;
  for (const all of run.tracked) {
    const rpm = numbers(all.rpm);
    for (const signal of all.signals.filter((own) => own.column.endsWith('_um'))) {
      const title = about.signals.find((own) => own.columns.some(([name]) => name === signal.column))?.title || signal.column;
      const [overall, order] = [numbers(signal.overall), numbers(signal.below_order)];
      numbers(signal.below).forEach((amplitude, k) => { if (amplitude > 0.2 * overall[k] && (!top || amplitude > top.amplitude)) top = { amplitude, rpm: rpm[k], order: order[k], title }; });
    }
  }
  return top;
}

// The largest line of the spectra of displacements, as a multiple of the speed.
function strongest() {
  let top = null;
  // Of what runs up a spectrum mixes speeds.
  const varies = new Set(run.envelopes.flatMap((all) => all.signals.map((own) => own.column)));
  run.spectra.forEach((spectrum, k) => {
    const signal = about.signals[k];
    if (signal.unit !== 'µm' || !(spectrum.turning_hz > 0) || signal.columns.some(([name]) => varies.has(name))) return;
    for (const line of spectrum.lines) {
      const [frequency, amplitude] = [numbers(line.frequency_hz), numbers(line.amplitude)];
      for (let at = 0; at < frequency.length; at++) {
        const order = frequency[at] / spectrum.turning_hz;
        // Nearer to nothing it is a drift.
        if (Math.abs(order) < 0.1) continue;
        const body = /^theta_(.+)_rad$/.exec(signal.angle)?.[1];
        // Circles run through both ways make an ellipse, whose semi-axes are their sum and difference.
        const other = spectrum.two_sided ? mirrored(frequency, amplitude, -frequency[at]) : 0;
        // The larger circle gives its sense.
        if (other > amplitude[at] || (top && amplitude[at] + other <= top.amplitude)) continue;
        const way = !spectrum.two_sided ? '' : other > 0.9 * amplitude[at] ? ', along a line' : order > 0 ? ' forward' : ' backward';
        top = { amplitude: amplitude[at] + other, hertz: Math.abs(frequency[at]), unit: signal.unit, title: signal.title, words: `${shown(Math.abs(order), 3)} times the speed${body ? ` of ${body}` : ''}${way}` };
      }
    }
  });
  return top;
}

// The amplitude at the frequency that is nearest.
function mirrored(frequency, amplitude, wanted) {
  let best = 0;
  for (let k = 1; k < frequency.length; k++) if (Math.abs(frequency[k] - wanted) < Math.abs(frequency[best] - wanted)) best = k;
  const near = Math.abs(frequency[best] - wanted) <= 1e-3 * Math.abs(wanted) + 1e-12;
  return near ? amplitude[best] : 0;
}

function theCase() {
  if (!about.words.length) return;
  const own = part('case', 'The case');
  for (const { title, table: rows, lines } of about.words) {
    add(own, 'h3', title);
    if (rows) table(own, rows[0], rows.slice(1));
    if (lines) { const list = add(own, 'ul', undefined, { class: 'plain' }); for (const line of lines) add(list, 'li', line); }
  }
}

function results() {
  if (!summary || !(summary.supports.length || summary.orders)) return;
  const own = part('results', 'The last cycle');
  add(own, 'p', `A cycle is ${shown(1e3 * summary.cycle_s, 5)} ms: ${about.cycle}. ${about.steady[0].toUpperCase()}${about.steady.slice(1)}.`);
  const moving = summary.supports;
  if (moving.length && about.words[0]?.title === 'The mass') {
    table(own, ['', '', ['force', 'N'], ['displacement of the mass', 'mm']], moving.flatMap((support, k) => ['min', 'mean', 'max'].map((which) => [which === 'min' ? `Stop ${k + 1}` : '', which, [support.RX_N[which], 'N'], [1e-3 * support.X_um[which], 'mm']])), [1]);
  } else if (moving.length) {
    const heads = ['', '', ['force x', 'N'], ['force y', 'N'], ['eccentricity x', 'µm'], ['eccentricity y', 'µm'], ['clearance', 'µm']];
    const pushes = (support) => ['RX_N', 'RY_N', 'EX_um', 'EY_um'].some((name) => ['min', 'max'].some((which) => support[name]?.[which] !== 0));
    const named_ = moving.map((support, k) => [support.joint || supportName(k), support]);
    const still = named_.filter(([, support]) => !pushes(support)).map(([name]) => name);
    const rows = named_.filter(([, support]) => pushes(support)).flatMap(([name, support]) => ['min', 'mean', 'max'].map((which) => [
      which === 'min' ? name : '', which, [support.RX_N[which], 'N'], [support.RY_N[which], 'N'], [support.EX_um[which], 'µm'], [support.EY_um[which], 'µm'],
      which === 'min' && support.clearance_um > 0 ? [support.clearance_um, 'µm'] : '']));
    table(own, heads, rows, [1]);
    if (still.length) add(own, 'p', `Nothing moves or pushes across the axis in ${still.join(', ')}.`, { class: 'soft' });
  }
  if (summary.orders) {
    add(own, 'h3', 'Orders');
    const { signals } = summary.orders;
    add(own, 'p', `x = A cos(nθ + φ), A from 0 to the peak, fitted over whole revolutions at the end of the run${new Set(signals.map((one) => one.angle)).size > 1 ? ', with once and twice the angles of the other bodies beside' : ''}. What is not a multiple of half the speed leaks into these numbers where the revolutions are few: see the spectra.`, { class: 'soft' });
    const named = (name) => { const signal = about.signals.find((one) => one.columns.some(([column]) => column === name)); return signal ? `${signal.title}: ${signal.quantity} ${signal.columns.find(([column]) => column === name)[1]}` : name; };
    const unit = (name) => about.signals.find((one) => one.columns.some(([column]) => column === name))?.unit || '';
    const heads = ['', '1X, 0-pk', '', 'phase (°)', '2X, 0-pk', '', 'phase (°)', 'revolutions'];
    const rows = () => signals.filter((one) => one['1X'].amplitude > 0 || one['2X'].amplitude > 0).map((one) => {
      const u = unit(one.signal);
      return [named(one.signal), [one['1X'].amplitude, u], Units.of(u)[0], shown(one['1X'].phase_deg, 4), [one['2X'].amplitude, u], Units.of(u)[0], shown(one['2X'].phase_deg, 4), String(one.revolutions)];
    });
    const host = add(own, 'div');
    const fill = () => { host.replaceChildren(); table(host, heads, rows(), [2, 5]); };
    fill();
    redraw.push(fill);
  }
  const bodies = Object.entries(summary.stresses || {});
  if (bodies.length) {
    add(own, 'h3', 'Largest stresses in the frames of the cycle');
    table(own, ['', ['von Mises', 'MPa'], 'node', 'at (mm)', 'time (s)'], bodies.map(([name, one]) => [name, [one.von_mises_MPa, 'MPa'], String(one.node), one.position_mm.map((x) => shown(x)).join(', '), shown(one.time_s, 6)]));
  }
}

const supportName = (k) => about.journals[k]?.title || `Support ${k + 1}`;

function histories() {
  if (!run) return;
  const own = part('histories', 'Histories');
  const every = run.histories.every;
  add(own, 'p', every === 1
    ? `All ${run.histories.rows} rows of history.csv, to seven digits.`
    : `The ${run.histories.rows} rows of history.csv, of every ${every} the least and the largest value, so that no peak is lost; history.csv has all of them.`, { class: 'soft' });
  add(own, 'p', 'Drag over a chart to zoom into all of them, double-click to see the whole run again; Shift and drag moves. By keys: arrows move the cursor, + and − zoom, 0 shows all. A click on a name in a legend hides its line.', { class: 'soft screen' });
  const choose = add(own, 'div', undefined, { class: 'choose' });
  const grid = add(own, 'div', undefined, { class: 'grid' });
  const groups = [];
  if (run.ratios.length) {
    groups.push({ title: 'Eccentricity relative to the clearance', quantity: '|E| / c', unit: '1', shown: true, factor: 1, lines: run.ratios.map((title) => [`ratio ${title}`, title]), levels: [{ y: 1, name: 'clearance' }], zero: true });
  }
  groups.push(...about.groups);
  const idle = (group) => group.lines.every(([name]) => extremes(name).every((value) => value === 0));
  const varies = (group) => group.lines.some(([name]) => { const [least, most] = extremes(name); return most - least > 1e-3 * Math.max(Math.abs(least), Math.abs(most)); });
  const make = (group) => new Chart(grid, {
    id: `history-${slug(group.title)}`, title: group.title, sync: 'time', x: { label: 'time', unit: 's' }, y: { label: group.quantity, unit: group.unit },
    range: [run.begins, run.ends], levels: group.levels, zero: group.zero,
    series: group.lines.map(([name, label], k) => series(name, label, group.factor, k % 7)),
  });
  for (const group of groups) {
    const box = add(add(choose, 'label'), 'input', undefined, { type: 'checkbox' });
    box.after(` ${group.title}`);
    box.checked = group.shown && !idle(group) && (group.unit !== 'rpm' || varies(group));
    let chart = box.checked ? make(group) : null;
    box.addEventListener('change', () => {
      chart = chart || make(group);
      chart.figure.hidden = !box.checked;
    });
  }
  const still = groups.filter((group) => group.shown && idle(group)).map((group) => group.title);
  if (still.length) add(own, 'p', `Zero all along: ${still.join('; ')}.`, { class: 'soft' });
  const hidden = groups.length > 8;
  if (hidden) { const more = add(own, 'details', undefined, { class: 'screen' }); add(more, 'summary', 'Choose what is shown'); more.append(choose); own.insertBefore(more, grid); }
}

function orbits() {
  if (!run || !run.orbits.length) return;
  const own = part('orbits', 'Orbits and forces');
  const turns = run.orbits.some((orbit) => orbit.revolutions > 0);
  const [isJournal, all] = [(orbit) => orbit.moved === 'the journal', run.orbits];
  const whose = all.every(isJournal) ? 'Centre of each journal in its bore' : all.some(isJournal) ? 'Centre of each journal in its bore, and of the first side of bushings against the second' : 'The first side of each bushing against the second';
  add(own, 'p', turns
    ? `${whose}, seen along +z: x up, y to the right, so that positive rotation is clockwise. Arrows show the direction of motion, dots where the keyphasor is seen (θ a multiple of 360°).`
    : `${whose} in the last cycle, seen along +z: x up, y to the right. Arrows show the direction of motion.`, { class: 'soft' });
  const choose = add(own, 'div', undefined, { class: 'choose screen' });
  const grid = add(own, 'div', undefined, { class: 'grid squares' });
  const most = Math.max(...run.orbits.map((orbit) => orbit.revolutions));
  let shownRevolutions = turns ? Math.min(2, most) : 0;
  let framed = true;
  const charts = run.orbits.map((orbit) => {
    const [x, y, before] = [numbers(orbit.x_um), numbers(orbit.y_um), numbers(orbit.before)];
    const spec = { id: `orbit-${slug(orbit.title)}`, equal: true, x: { label: 'y, lateral', unit: 'µm' }, y: { label: 'x, vertical', unit: 'µm' }, circles: [{ r: orbit.clearance_um, name: 'clearance' }], series: [], dots: [] };
    spec.update = () => {
      let from = 0;
      if (orbit.revolutions > 0) while (from < before.length - 2 && before[from] > shownRevolutions * (1 + 1e-6)) from++;
      const count = x.length - from;
      spec.framed = framed;
      spec.series = [{ name: isJournal(orbit) ? 'centre of the journal' : `centre of ${orbit.moved}`, path: true, x: y.subarray(from), y: x.subarray(from), style: 0, arrows: [Math.floor(0.35 * count), Math.floor(0.8 * count)].filter((at) => at > 0) }];
      spec.dots = orbit.keyphasors.filter((own) => own[2] <= shownRevolutions * (1 + 1e-6)).map(([px, py]) => ({ x: py, y: px, style: 1, name: 'keyphasor' }));
      const over = orbit.revolutions > 0 ? (shownRevolutions >= orbit.revolutions ? `last ${shown(orbit.revolutions, 3)} revolutions` : shownRevolutions === 1 ? 'last revolution' : `last ${shown(shownRevolutions, 3)} revolutions`) : 'last cycle';
      spec.note = orbit.revolutions > 0 ? (orbit.sense > 0 ? `${over}, rotation ↻` : `${over}, rotation ↺`) : over;
    };
    spec.update();
    spec.title = orbit.title;
    return new Chart(grid, spec);
  });
  add(own, 'h3', all.every(isJournal) ? 'Forces on the journals, polar' : 'Forces, polar');
  const polar = add(own, 'div', undefined, { class: 'grid squares' });
  for (const orbit of run.orbits) {
    const [fx, fy, before] = [numbers(orbit.fx_n), numbers(orbit.fy_n), numbers(orbit.before)];
    if ([fx, fy].every((own_) => own_.every((value) => value === 0))) continue;
    const spec = { id: `polar-${slug(orbit.title)}`, title: `${orbit.title}: force`, equal: true, origin: true, x: { label: 'force along y', unit: 'N' }, y: { label: 'force along x', unit: 'N' }, series: [], dots: [{ x: 0, y: 0, style: 6, name: 'no force' }] };
    spec.update = () => {
      let from = 0;
      if (orbit.revolutions > 0) while (from < before.length - 2 && before[from] > shownRevolutions * (1 + 1e-6)) from++;
      const count = fx.length - from;
      spec.series = [{ name: `force on ${orbit.moved}`, path: true, x: fy.subarray(from), y: fx.subarray(from), style: 2, arrows: [Math.floor(0.35 * count), Math.floor(0.8 * count)].filter((at) => at > 0) }];
    };
    spec.update();
    charts.push(new Chart(polar, spec));
  }
  const update = () => { for (const chart of charts) { chart.spec.update(); if (chart.over) chart.render(); } };
  if (turns && most > 1) {
    const label = add(choose, 'label', 'revolutions ');
    const select = add(label, 'select');
    for (const many of [1, 2, 4, 8]) if (many <= most || many === 1) add(select, 'option', String(many), { value: many });
    select.value = String(shownRevolutions);
    select.addEventListener('change', () => { shownRevolutions = Number(select.value); update(); });
  }
  const fit = add(add(choose, 'label'), 'input', undefined, { type: 'checkbox' });
  fit.after(' fill the frame with the orbit');
  fit.addEventListener('change', () => { framed = !fit.checked; update(); });
}

// Charts over the angle of the last revolutions, in which forces and films repeat themselves.
function overAngle() {
  if (!run || !run.turned.length) return;
  const own = part('angle', 'Over the angle');
  const most = Math.max(...run.turned.map((one) => one.revolutions));
  add(own, 'p', `Every row of the last ${most > 1.05 ? `${shown(most, 3)} revolutions` : 'revolution'}, the angle counted from where the first of them begins.`, { class: 'soft' });
  const grid = add(own, 'div', undefined, { class: 'grid' });
  for (const { group, revolutions, before, columns: packed } of run.turned) {
    const { title, quantity, unit, factor, lines } = about.groups[group];
    if (packed.every((own_) => numbers(own_).every((value) => value === 0))) continue;
    const x = numbers(before).map((degrees) => 360 * revolutions - degrees);
    new Chart(grid, {
      id: `angle-${slug(title)}`, title, sync: `angle ${revolutions.toFixed(3)}`, x: { label: 'angle', unit: '°' }, y: { label: quantity, unit }, range: [0, 360 * revolutions],
      series: lines.map(([, label], k) => ({ name: label, x, y: factor === 1 ? numbers(packed[k]) : numbers(packed[k]).map((value) => value * factor), style: k % 7 })),
    });
  }
}

// The body of a column of an angle.
const turningOf = (angle) => /^theta_(.+)_rad$/.exec(angle || '')?.[1] || about.groups.flatMap((own) => own.lines).find(([name]) => name === 'omega_rad_s')?.[1] || 'the first body that turns';

function spectra() {
  if (!run || !run.spectra.some((spectrum) => spectrum.lines.length)) return;
  const own = part('spectra', 'Spectra');
  const two = run.spectra.some((spectrum) => spectrum.two_sided);
  // Angles of bodies whose speed varies.
  const varies = new Set(about.signals.filter((one) => run.tracked.some((all) => all.signals.some((signal) => one.columns.some(([name]) => name === signal.column)))).map((one) => one.angle));
  add(own, 'p', `Over the last ${shown(1e3 * run.spectrum_s, 4)} ms, Hann window.${two ? ' Where x and y are known, the motion is taken as circles: those that run with the rotation have positive frequencies, those against it negative ones. A circle shows its radius; what moves along a line shows half of its amplitude on both sides.' : ''}`, { class: 'soft' });
  const grid = add(own, 'div', undefined, { class: 'grid' });
  run.spectra.forEach((spectrum, k) => {
    const signal = about.signals[k];
    if (!spectrum.lines.length) return;
    const orders = spectrum.turning_hz > 0 ? [1, 2, 0.5] : [];
    const marks = orders.flatMap((order) => { const name = order === 0.5 ? '½X' : `${order}X`; const at = order * spectrum.turning_hz; return spectrum.two_sided ? [{ x: -at, name: `−${name}` }, { x: at, name }] : [{ x: at, name }]; });
    const body = turningOf(signal.angle);
    const note = spectrum.turning_hz > 0 ? `1X: ${body} at ${shown(60 * spectrum.turning_hz, 4)} rpm${varies.has(signal.angle) ? ' on average' : ''}` : '';
    new Chart(grid, {
      id: `spectrum-${slug(signal.title)}-${slug(signal.quantity)}`, title: `${signal.title}: ${signal.quantity}`, zero: true, sync: `frequency ${spectrum.two_sided}`,
      x: { label: spectrum.two_sided ? 'frequency, backward < 0 < forward' : 'frequency', unit: 'Hz', short: 'frequency' }, y: { label: short(signal.quantity), unit: signal.unit, amplitude: true },
      marks, note, series: spectrum.lines.map((line, place) => ({ name: line.name, x: numbers(line.frequency_hz), y: numbers(line.amplitude), style: place })),
    });
  });
}

// The abscissa of what is found over a run: speed if it rises or falls all along, time if not; and values in its order.
function overSpeed(all) {
  const [rpm, time] = [numbers(all.rpm), numbers(all.time)];
  const rises = rpm.every((value, k) => k === 0 || value > rpm[k - 1]);
  const falls = rpm.every((value, k) => k === 0 || value < rpm[k - 1]);
  const turn = (values) => (falls ? Float32Array.from(values).reverse() : values);
  return { turn, x: rises || falls ? { label: 'speed', unit: 'rpm', values: turn(rpm) } : { label: 'time', unit: 's', values: time } };
}

function tracked() {
  if (!run || !run.tracked.length) return;
  const own = part('orders', 'Orders over speed');
  for (const all of run.tracked) {
    const n = all.revolutions;
    add(own, 'p', `Amplitudes and phases of x = A cos(nθ + φ), tracked by the angle: each point is a fit over ${shown(n)} revolutions with the weights of a Hann window. It tells an order from what differs from it by ${shown(2 / n, 3)} orders or more; nearer than that, both are in one. Overall is half of largest less least value in the same revolutions, of the direction in which it is larger: where it is far above 1X, something else moves: the largest part between ${shown(2 / n, 2)} and ${shown(1 - 2 / n, 2)} times the speed is shown with its order where it matters${run.tracked.length > 1 || new Set(about.signals.map((one) => one.angle)).size > 1 ? ', without once and twice the speeds of other bodies' : ''}. Curves begin and end half of ${shown(n)} revolutions inside the run.`, { class: 'soft' });
    const { turn, x } = overSpeed(all);
    const grid = add(own, 'div', undefined, { class: 'grid' });
    for (const whole of about.signals) {
      const own = whole.columns.map(([name, axis]) => [axis, all.signals.find((signal) => signal.column === name)]).filter(([, signal]) => signal);
      if (!own.length) continue;
      const title = `${whole.title}: ${whole.quantity}`;
      const id = slug(own[0][1].column);
      const draw = (values, name, style, more) => ({ name, x: x.values, y: values, style, ...more });
      const one = (which, name, style, more) => own.map(([axis, signal], k) => draw(turn(numbers(signal[which])), `${name} ${axis}`, style + k, more));
      const axis = { label: x.label, unit: x.unit };
      // What is small beside all motion is no whirl but the rest of a fit.
      const [overall, below] = ['overall', 'below'].map((which) => own.map(([, signal]) => numbers(signal[which])));
      const moves = (k, place) => below[k][place] > 0.2 * overall[k][place];
      const slow = below.some((all_, k) => all_.some((_, place) => moves(k, place)));
      new Chart(grid, {
        id: `order-${id}`, title, zero: true, sync: 'orders', x: axis, y: { label: short(whole.quantity), unit: whole.unit, amplitude: true },
        series: [...one('first', '1X', 0), ...one('second', '2X', 2), ...(slow ? one('below', 'largest below 1X', 4) : []), draw(own.map(([, signal]) => turn(numbers(signal.overall))).reduce((most, values) => most.map((value, k) => Math.max(value, values[k]))), 'overall', 6, { dash: '2 3' })],
      });
      new Chart(grid, {
        id: `phase-${id}`, title: `${title}, phase of 1X`, sync: 'orders', x: axis, y: { label: 'phase', unit: '°' },
        series: own.map(([axis, signal], k) => draw(unwrapped(turn(numbers(signal.first_phase_deg))), `1X ${axis}`, k)),
      });
      if (slow) new Chart(grid, {
        id: `below-${id}`, title: `${title}, order of the largest part below 1X`, sync: 'orders', x: axis, y: { label: 'order', unit: '1' }, note: 'where it is more than a fifth of overall',
        series: own.map(([axis, signal], k) => draw(turn(Float32Array.from(numbers(signal.below_order), (order, place) => (moves(k, place) ? order : NaN))), axis, k)),
      });
    }
  }
}

// Least and largest values of every revolution of a run-up or a run-down.
function envelopes() {
  if (!run || !run.envelopes.length) return;
  const own = part('envelope', 'Envelope over speed');
  for (const all of run.envelopes) {
    add(own, 'p', all.revolutions > 1 ? `The least and the largest value of every ${shown(all.revolutions)} revolutions.` : 'The least and the largest value of every revolution.', { class: 'soft' });
    const { turn, x } = overSpeed(all);
    const grid = add(own, 'div', undefined, { class: 'grid' });
    for (const whole of about.signals) {
      const columns_ = whole.columns.map(([name, axis]) => [axis, all.signals.find((signal) => signal.column === name)]).filter(([, signal]) => signal);
      if (!columns_.length) continue;
      new Chart(grid, {
        id: `envelope-${slug(columns_[0][1].column)}`, title: `${whole.title}: ${whole.quantity}`, sync: 'orders', x: { label: x.label, unit: x.unit }, y: { label: short(whole.quantity), unit: whole.unit },
        series: columns_.flatMap(([axis, signal], k) => [{ name: `largest ${axis}`, x: x.values, y: turn(numbers(signal.most)), style: k, dash: '' }, { name: `least ${axis}`, x: x.values, y: turn(numbers(signal.least)), style: k, dash: '5 3' }]),
      });
    }
  }
}

// Why a run whose speed varies has no orders over it.
function reversed() {
  if (!run || run.tracked.length) return;
  const names = [...columns.keys()].filter((name) => /^omega_.*rad_s$/.test(name) && extremes(name)[0] < 0 && extremes(name)[1] > 0);
  if (!names.length) return;
  const own = part('orders', 'Orders over speed');
  add(own, 'p', `There are none: ${names.map((name) => name.replace(/^omega_(?:(.*)_)?rad_s$/, (_, body) => body || 'the first body that turns')).join(', ')} turns in both directions in this run, and orders are tracked by an angle that goes on one way. Run each direction by itself for them.`, { class: 'soft' });
}

function waterfalls() {
  if (!run || !run.waterfalls.length) return;
  const own = part('waterfall', 'Spectra over the run');
  add(own, 'p', `Spectra of ${run.waterfalls[0].time.length} overlapping parts of the run, each with a Hann window; every cell has the largest amplitude in it. Dashed lines are ½, 1 and 2 times the speed.`, { class: 'soft' });
  const grid = add(own, 'div', undefined, { class: 'grid' });
  for (const fall of run.waterfalls) {
    const signal = about.signals[fall.signal];
    const { cells, rpm, time } = fall;
    const across = fall.two_sided ? 2 * cells - 1 : cells;
    const values = numbers(fall.amplitude);
    const rises = rpm.every((value, k) => k === 0 || value > rpm[k - 1]);
    const heights = rises ? rpm : time;
    const edge = fall.cell_hz * (cells - 0.5);
    const view = { x0: fall.two_sided ? -edge : -0.5 * fall.cell_hz, x1: edge, y0: heights[0], y1: heights[heights.length - 1] };
    const row = (y) => heights.reduce((best, own, k) => (Math.abs(own - y) < Math.abs(heights[best] - y) ? k : best), 0);
    const value = (k, i) => (values[k * across + i] / 65535) * fall.largest;
    const map = {
      view, columns: across, largest: fall.largest, row, value,
      at: (x, y) => { const i = Math.round((x - view.x0) / fall.cell_hz - 0.5); const k = row(y); return i >= 0 && i < across ? { x: view.x0 + (i + 0.5) * fall.cell_hz, y: heights[k], value: value(k, i) } : null; },
    };
    const orders = (fall.two_sided ? [-2, -1, -0.5, 0.5, 1, 2] : [0.5, 1, 2]).map((order) => ({ name: `${order}X`, path: true, silent: true, className: 'order', dash: '5 4', x: rpm.map((own) => (order * own) / 60), y: heights }));
    new Chart(grid, {
      id: `waterfall-${slug(signal.title)}-${slug(signal.quantity)}`, title: `${signal.title}: ${signal.quantity}${fall.two_sided ? '' : ` ${signal.columns[0][1]}`}`, height: 260, map, series: orders,
      x: { label: fall.two_sided ? 'frequency, backward < 0 < forward' : 'frequency', unit: 'Hz' }, y: rises ? { label: 'speed', unit: 'rpm' } : { label: 'time', unit: 's' }, z: { label: short(signal.quantity), unit: signal.unit, amplitude: true },
    });
  }
}

function energy() {
  if (!summary) return;
  const own = part('quality', 'Energy and quality of the run');
  const words = { work_in: 'work of loads, drives and gravity', kinetic: 'change of the kinetic energy', strain: 'change of the strain energy', spring_stored: 'change of the energy stored in joints', spring_dissipated: 'energy dissipated in joints', dissipated: 'energy dissipated in bodies', error: 'error of the balance' };
  const names = [...new Set([...Object.keys(words), ...Object.keys(summary.energy_balance_j)])].filter((name) => name in summary.energy_balance_j);
  const rows = names.map((name) => [words[name] || name.replaceAll('_', ' '), [summary.energy_balance_j[name], 'J']]);
  add(own, 'p', 'Balance from the start to the end of the run. The error is what the program lost or made; it is part of the verdict.', { class: 'soft' });
  table(own, ['', ['energy', 'J']], rows);
  const { march, time, counts } = summary;
  const list = add(own, 'ul', undefined, { class: 'plain' });
  const step = march.time_step_s ? `time step ${shown(march.time_step_s)} s` : `steps of ${shown(march.automatic.shortest_step_s, 3)} to ${shown(march.automatic.longest_step_s, 3)} s, chosen by the program`;
  add(list, 'li', `${march.integrator}, ${step}; ${march.steps} steps, ${march.iterations} iterations, ${march.factorisations} factorisations`);
  add(list, 'li', `${counts.active} unknowns, ${counts.springs} springs`);
  add(list, 'li', `${shown(time.total_wall_s, 3)} s in all, of which time integration took ${shown(time.march_wall_s, 3)} s and the reduction of the bodies ${shown(time.reduction_wall_s, 3)} s${time.reduction_cached ? ' (from the cache)' : ''}`);
  const more = add(own, 'details');
  add(more, 'summary', 'Measures behind the verdict');
  table(more, ['', 'measured'], Object.entries(summary.verdict.measures).map(([name, value]) => [name.replaceAll('_', ' '), value === null ? '–' : shown(value, 3)]));
}

// Figures of files, as they are.
function drawn(parent, figures) {
  if (!figures.length) return;
  const grid = add(parent, 'div', undefined, { class: 'grid' });
  for (const figure of figures) {
    figure.shown = true;
    const frame = add(grid, 'figure', undefined, { class: 'drawing' });
    add(frame, 'img', undefined, { src: `data:image/svg+xml;base64,${figure.base64}`, alt: figure.title });
    add(frame, 'figcaption', figure.name, { class: 'soft' });
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
  for (let k = 1; k < all.length; k++) if (Number.isFinite(all[k - 1])) all[k] -= 360 * Math.round((all[k] - all[k - 1]) / 360);
  return all;
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

// Modes without those so far above the rest that they would squeeze it: the five lowest and what is below five times the highest
// order are always there.
function withRoom(all, rpm) {
  const top = ([, own]) => Math.max(...own.map((row) => row.frequency_hz));
  const tops = all.map(top).sort((a, b) => a - b);
  const ceiling = Math.max(tops[4] ?? Infinity, (5 * rpm) / 60);
  if (0.5 * tops[tops.length - 1] <= ceiling) return { modes: all, above: 0 };
  const modes = all.filter((own) => top(own) <= ceiling);
  return { modes, above: all.length - modes.length };
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
    const all = [...grouped(rows, 'branch')].filter(([, own]) => own.length > 1);
    const { modes, above } = withRoom(all, Math.max(...orders) * Math.max(...speeds.map(Math.abs)));
    const top = 1.1 * Math.max(...modes.flatMap(([, own]) => own.map((row) => row.frequency_hz)));
    const across = orders.map((order) => { const x = [ends[0], Math.min(ends[1], (60 * top) / order)]; return { name: `${order}X`, x, y: x.map((rpm) => (order * rpm) / 60), style: 6, dash: { 0.5: '6 2 1 2', 1: '2 3', 2: '1 4' }[order] || '4 4' }; }).filter((own) => own.x[1] > own.x[0]);
    const x = { label: 'speed', unit: 'rpm' };
    const kinds = [...new Set(modes.flatMap(([, own]) => own.map((row) => row.whirl)))];
    const letter = (row) => ({ axial: 'A', torsional: 'T' })[row.motion] || { forward: 'F', backward: 'B' }[row.whirl] || '';
    const letters = [['F', 'forward'], ['B', 'backward'], ['T', 'torsional'], ['A', 'axial']].filter(([one]) => critical.some((row) => letter(row) === one)).map((one) => one.join(' ')).join(', ');
    const thresholds = (tables.get(`${name}.critical.csv`)?.rows || []).filter((row) => row.what !== 'critical speed').map((row) => ({ x: row.speed_rpm, name: `${row.what} ${shown(row.speed_rpm, 5)}` }));
    const note = `${[['forward', 'solid: forward whirl'], ['backward', 'dashed: backward'], ['-', 'dotted: neither']].filter(([kind]) => kinds.includes(kind)).map(([, words]) => words).join(', ')}${letters ? `; ${letters}` : ''}${above ? `; ${above} more ${above === 1 ? 'mode' : 'modes'} above` : ''}`;
    new Chart(host, {
      id: `campbell-${slug(name)}`, title: 'Natural frequencies', zero: true, sync: `speed ${name}`, x, y: { label: 'frequency', unit: 'Hz' },
      series: [...modes.map(([branch, own], k) => whirled(own, 'frequency_hz', `mode ${branch}`, k % 6)), ...across], note,
      dots: critical.filter((row) => row.frequency_hz <= top).sort((a, b) => (b.whirl === 'forward') - (a.whirl === 'forward')).map((row) => ({ x: row.speed_rpm, y: row.frequency_hz, style: row.damping_ratio > 0.2 ? 6 : 1, name: critical.some((one) => one.damping_ratio > 0.2) ? 'critical speed (black: amplification 1/(2ζ) below 2.5)' : 'critical speed', label: `${shown(row.speed_rpm, 5)} ${letter(row)}`.trim() })),
      marks: thresholds,
    });
    new Chart(host, {
      id: `decrement-${slug(name)}`, title: 'Damping: unstable below zero', sync: `speed ${name}`, x, y: { label: 'log decrement', unit: '1' }, levels: [{ y: 0, name: '', framed: true }], marks: thresholds,
      series: modes.map(([branch, own], k) => whirled(own, 'log_decrement', `mode ${branch}`, k % 6)),
    });
    return [`${name}.svg`];
  },
  response(host, name, tables) {
    const rows = tables.get(`${name}.csv`)?.rows;
    if (!rows?.length) return [];
    const moves = (own) => own.some((row) => row.major_um > 1e-6);
    const all = [...grouped(rows, 'body', 'point', 'order')].filter(([, own]) => own.length > 1 && moves(own)).sort(([, a], [, b]) => (a[0].order === 0) - (b[0].order === 0)).slice(0, 24);
    const several = new Set(rows.map((row) => row.body)).size > 1;
    const found = tables.get(`${name}.peaks.csv`)?.rows || [];
    for (const [, own] of all) {
      const [{ body, point, order }] = own;
      const x = { label: several ? `speed of ${body}` : 'speed', unit: 'rpm' };
      const title = order === 0 ? `${point}, mean position` : `${point}, ${order}X${several ? ` of ${body}` : ''}`;
      const id = slug(`${name} ${body} ${point} ${order}`);
      // Peaks lie between the speeds of the table.
      const peaks = found.filter((row) => row.body === body && row.point === point && row.order === order && typeof row.major_um === 'number');
      const beside = peaks.flatMap((row) => [[row.half_power_below_rpm, Math.SQRT1_2], [row.speed_rpm, 1], [row.half_power_above_rpm, Math.SQRT1_2]].filter(([rpm]) => typeof rpm === 'number').map(([rpm, part_]) => ({ speed_rpm: rpm, major_um: part_ * row.major_um })));
      const whole = [...own, ...beside].sort((a, b) => a.speed_rpm - b.speed_rpm);
      new Chart(host, {
        id: `bode-${id}`, title, zero: true, sync: `speed ${name}`, x, y: { label: 'displacement', unit: 'µm', amplitude: order !== 0 },
        series: order === 0
          ? [line(own, 'speed_rpm', 'x_um', 'x'), line(own, 'speed_rpm', 'y_um', 'y')].map((one, k) => ({ ...one, y: one.y.map((value, at) => value * Math.cos((Math.PI * own[at][`${'xy'[k]}_phase_deg`]) / 180)) }))
          : [line(own, 'speed_rpm', 'x_um', 'x'), line(own, 'speed_rpm', 'y_um', 'y'), line(whole, 'speed_rpm', 'major_um', 'major semi-axis of the orbit', { style: 6, dash: '2 3' })],
        dots: peaks.map((row) => ({ x: row.speed_rpm, y: row.major_um, style: 1, name: 'peak', label: `${shown(row.speed_rpm, 5)} rpm` })),
        note: peaks.length ? 'peaks and half powers between the speeds of the table are of the major semi-axis' : '',
      });
      if (order !== 0) new Chart(host, {
        id: `bode-phase-${id}`, title: `${title}: phase`, sync: `speed ${name}`, x, y: { label: 'phase', unit: '°' },
        series: ['x', 'y'].map((axis) => { const phase = line(own, 'speed_rpm', `${axis}_phase_deg`, axis); return { ...phase, y: unwrapped(phase.y) }; }),
      });
    }
    return all.length ? [`${name}.svg`] : [];
  },
  stability(host, name, tables) {
    const rows = tables.get(`${name}.csv`)?.rows;
    if (!rows || rows.length < 2) return [];
    const marks = (tables.get(`${name}.thresholds.csv`)?.rows || []).map((row) => ({ x: row.speed_rpm, name: `${row.what} ${shown(row.speed_rpm, 5)}` }));
    new Chart(host, {
      id: `stability-${slug(name)}`, title: 'The least stable mode: unstable below zero', x: { label: 'speed', unit: 'rpm' }, y: { label: 'log decrement', unit: '1' }, marks, levels: [{ y: 0, name: '', framed: true }],
      series: [line(rows, 'speed_rpm', 'least_log_decrement', 'least log decrement')],
    });
    return [`${name}.svg`];
  },
};

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
  const up = numeric.filter((name) => !across.includes(name));
  if (across.length && up.length) {
    add(own, 'h3', 'Any number of the table over what varies');
    const choose = add(own, 'div', undefined, { class: 'choose screen' });
    const host = add(own, 'div', undefined, { class: 'grid' });
    const pick = (words, options) => { const box = add(add(choose, 'label', `${words} `), 'select'); for (const name of options) add(box, 'option', name, { value: name }); box.addEventListener('change', () => show()); return box; };
    const [y, x] = [pick('show', up), pick('over', across)];
    const by = pick('a line for each', ['–', ...sweep.varied.concat('direction').filter((name) => names.includes(name))]);
    if (sweep.varied.length > 1) by.value = sweep.varied.find((name) => name !== x.value) || '–';
    let chart = null;
    const show = () => {
      const lines = by.value === '–' || by.value === x.value ? new Map([[y.value, rows]]) : grouped(rows, by.value);
      const few = [...lines].slice(0, 12);
      const sorted = (all) => [...all].filter((row) => typeof row[y.value] === 'number' && typeof row[x.value] === 'number').sort((a, b) => a[x.value] - b[x.value]);
      const series = few.map(([name, all], k) => ({ ...line(sorted(all), x.value, y.value, name, { style: k % 7 }) })).filter((one) => one.x.length);
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

// Lines as the terminal has them; notes, which are sentences, wrap.
function worded(parent, lines) {
  let [kept, note] = [[], false];
  const flush = () => { if (kept.some((line) => line.trim())) add(parent, note ? 'p' : 'pre', kept.join('\n').trimEnd(), note ? { class: 'note' } : {}); kept = []; };
  for (const line of lines) {
    const is = line.startsWith('note: ');
    if (is || note !== is) flush();
    note = is;
    kept.push(line);
  }
  flush();
}

function analysed() {
  if (!analyses) return;
  const tables = new Map(data.tables.map((own) => [own.name, parsed(own.csv)]));
  for (const { name, kind, heading, text, files, interrupted } of analyses.analyses) {
    const own = part(`analysis-${slug(name)}`, heading);
    const usual = name === kind ? '' : `Analysis \u201c${name}\u201d. `;
    if (usual || interrupted) add(own, 'p', `${usual}${interrupted ? 'Interrupted: what was found up to then.' : ''}`, { class: 'soft' });
    const lines = text.trimEnd().split('\n').filter((line, k) => k > 0 || !line.startsWith(`${about.name}: `));
    while (lines.length && !lines[0].trim()) lines.shift();
    const chaptered = kind === 'lateral' && lateral(own, name, tables, lines);
    for (const figure of data.figures) if (chaptered && figure.name === `${name}.svg`) figure.shown = true;
    const folds = lines.length > 24 || chaptered;
    if (!folds) worded(own, lines);
    // What must not be missed, however long the rest is.
    const loud = lines.filter((words) => /UNSTABLE|NOT STABLE|becomes unstable|too large for a linear|critically damped/.test(words));
    if (folds && !chaptered && loud.length) { worded(own, loud.slice(0, 6)); if (loud.length > 6) add(own, 'p', `${loud.length - 6} more of these lines are in the words below.`, { class: 'soft' }); }
    const grid = add(own, 'div', undefined, { class: 'grid' });
    const replaced = CHARTED[kind]?.(grid, name, tables) || [];
    for (const figure of data.figures) if (replaced.includes(figure.name)) figure.shown = true;
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

function files() {
  const own = part('files', 'Files');
  add(own, 'p', 'Beside this report.', { class: 'soft' });
  const body = table(own, ['file', 'size', 'what it is'], data.files.map((file) => [file.name, size(file.bytes), file.what]), [2]);
  for (const cell of body.querySelectorAll('tbody td:first-child')) { const name = cell.textContent; cell.textContent = ''; add(cell, 'a', name, { href: encodeURI(name) }); }
  redraw.pop();
  if (about.columns.length) {
    const more = add(own, 'details');
    add(more, 'summary', `The ${about.columns.length} columns of history.csv`);
    table(more, ['column', 'unit', 'what it is'], about.columns.map((column) => [column.name, kindOf(column.unit), column.meaning]), [1, 2]);
  }
}

page.replaceChildren();
// Of a run-up what goes over the speed comes first: no cycle of it is like another one.
const speeds = [tracked, reversed, envelopes, waterfalls];
const cycles = [results, histories, orbits, overAngle, spectra];
const ofRun = run?.tracked.length ? [...speeds, ...cycles] : [...cycles, ...speeds];
for (const make of [head, theCase, machine, ...ofRun, swept, analysed, energy, drawings, files]) make();
add(page, 'footer', `whirl ${about.version}`);

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
