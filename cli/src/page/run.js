// Charts of a run: histories, orbits, spectra, orders, and the balance of its energy.

const supportName = (k) => about.journals[k]?.title || `Bearing ${k + 1}`;

function histories() {
  if (!run) return;
  const own = part('histories', 'Histories');
  const every = run.histories.every;
  add(own, 'p', every === 1
    ? `All ${run.histories.rows} rows of history.csv, to seven digits.`
    : `The ${run.histories.rows} rows of history.csv, of every ${every} the least and the largest value, so that no peak is lost; history.csv has all of them.`, { class: 'soft' });
  add(own, 'p', 'Drag over a chart to zoom into all of them, double-click to see the whole run again; Shift and drag moves. By keys: arrows move the cursor, + and − zoom, 0 shows all. A click on a name in a legend hides its line, and the axis fits the others.', { class: 'soft screen' });
  const choose = add(own, 'div', undefined, { class: 'choose' });
  const grid = add(own, 'div', undefined, { class: 'grid' });
  const groups = [];
  if (run.ratios.length) {
    groups.push({ title: 'Eccentricity relative to the clearance', quantity: '|E| / c', unit: '1', shown: true, factor: 1, lines: run.ratios.map((title) => [`ratio ${title}`, title]), levels: [{ y: 1, name: 'clearance' }], zero: true });
  }
  for (const { title, backlash } of run.teeth) {
    const words = backlash ? 'above zero on the flank by which the first gear pushes the second from x to y, below zero on the other one, zero while they are apart' : 'below zero they would part, as there is no backlash in the case';
    groups.push({ title: `${title}: normal force of the teeth`, quantity: 'normal force', unit: 'N', shown: true, factor: 1, lines: [[`teeth ${title}`, 'normal force']], levels: extremes(`teeth ${title}`)[0] > 0 ? [] : [{ y: 0, name: '' }], note: words });
  }
  groups.push(...about.groups);
  // A millionth of a revolution a minute is rounding.
  const nothing = (group) => (group.unit === 'rpm' ? 1e-6 / group.factor : 0);
  const idle = (group) => group.lines.every(([name]) => extremes(name).every((value) => Math.abs(value) <= nothing(group)));
  const varies = (group) => group.lines.some(([name]) => { const [least, most] = extremes(name); return most - least > 1e-3 * Math.max(Math.abs(least), Math.abs(most)); });
  const make = (group) => new Chart(grid, {
    id: `history-${slug(group.title)}`, title: group.title, sync: 'time', x: { label: 'time', unit: 's' }, y: { label: group.quantity, unit: group.unit },
    range: [run.begins, run.ends], levels: group.levels, zero: group.zero, note: group.note,
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

// Where arrows stand on a path; on a line, which is passed to and fro, they would say nothing.
function arrowed(x, y) {
  const mean = (all) => all.reduce((a, b) => a + b, 0) / all.length;
  const [mx, my] = [mean(x), mean(y)];
  let [xx, xy, yy] = [0, 0, 0];
  for (let k = 0; k < x.length; k++) { const [a, b] = [x[k] - mx, y[k] - my]; xx += a * a; xy += a * b; yy += b * b; }
  const [middle, apart] = [0.5 * (xx + yy), Math.hypot(0.5 * (xx - yy), xy)];
  if (middle - apart < 1e-4 * (middle + apart)) return [];
  return [0.35, 0.8].map((part_) => Math.floor(part_ * x.length)).filter((at) => at > 0);
}

function orbits() {
  if (!run || !run.orbits.length) return;
  const own = part('orbits', 'Orbits and forces');
  const turns = run.orbits.some((orbit) => orbit.revolutions > 0);
  const [isJournal, all] = [(orbit) => orbit.moved === 'the journal', run.orbits];
  const whose = all.every((orbit) => orbit.moved === 'the mass') ? 'Centre of the mass within the stop' : all.every(isJournal) ? 'Centre of each journal in its bore' : all.some(isJournal) ? 'Centre of each journal in its bore, and of the first side of bushings against the second' : 'The first side of each bushing against the second';
  add(own, 'p', turns
    ? `${whose}, seen along +z: x up, y to the right, so that positive rotation is clockwise. Arrows show the direction of motion, dots where the keyphasor is seen (θ a multiple of 360°).`
    : `${whose} in the last cycle, seen along +z: x up, y to the right. Arrows show the direction of motion.`, { class: 'soft' });
  const choose = add(own, 'div', undefined, { class: 'choose screen' });
  const grid = add(own, 'div', undefined, { class: 'grid squares' });
  const most = Math.max(...run.orbits.map((orbit) => orbit.revolutions));
  // A machine that comes to no steady state is seen from its start; a run-up would be a smear.
  const unsteady = /^not steady/.test(about.steady) && !run.tracked.length;
  // Of a whirl at a part of the speed a whole turn.
  const slow = /^0\.\d+ times the speed/.test(strongest()?.words || '');
  let shownRevolutions = unsteady ? Infinity : turns ? Math.min(slow ? 4 : 2, most) : 0;
  // What moves by no more than rounding has no orbit.
  const stands = (orbit) => (unsteady ? ['way_x_um', 'way_y_um'] : ['x_um', 'y_um']).every((name) => { const all = numbers(orbit[name]); let [least, most_] = [Infinity, -Infinity]; for (const value of all) { if (value < least) least = value; if (value > most_) most_ = value; } return !(most_ - least > 1e-4 * Math.max(Math.abs(least), Math.abs(most_), orbit.clearance_um || 0)); });
  const moving = run.orbits.filter((orbit) => !stands(orbit));
  const still = run.orbits.filter(stands);
  if (still.length) add(own, 'p', `Without an orbit, as nothing moves there: ${still.map((orbit) => orbit.title).join(', ')}.`, { class: 'soft' });
  if (!moving.length) return;
  let framed = true;
  const charts = moving.map((orbit) => {
    const before = numbers(orbit.before);
    const spec = { id: `orbit-${slug(orbit.title)}`, equal: true, x: { label: 'y, lateral', unit: 'µm' }, y: { label: 'x, vertical', unit: 'µm' }, circles: [{ r: orbit.clearance_um, name: 'clearance' }], series: [], dots: [] };
    spec.update = () => {
      const whole = shownRevolutions === Infinity;
      const [x, y] = (whole ? [orbit.way_x_um, orbit.way_y_um] : [orbit.x_um, orbit.y_um]).map(numbers);
      let from = 0;
      if (!whole && orbit.revolutions > 0) while (from < before.length - 2 && before[from] > shownRevolutions * (1 + 1e-6)) from++;
      spec.framed = framed;
      spec.series = [{ name: isJournal(orbit) ? 'centre of the journal' : `centre of ${orbit.moved}`, path: true, x: y.subarray(from), y: x.subarray(from), style: 0, arrows: arrowed(y.subarray(from), x.subarray(from)) }];
      spec.dots = whole ? [{ x: y[0], y: x[0], style: 1, name: 'start' }] : orbit.keyphasors.filter((own) => own[2] <= shownRevolutions * (1 + 1e-6)).map(([px, py]) => ({ x: py, y: px, style: 1, name: 'keyphasor' }));
      const over = whole ? 'the whole run' : orbit.revolutions > 0 ? (shownRevolutions >= orbit.revolutions ? `last ${shown(orbit.revolutions, 3)} revolutions` : shownRevolutions === 1 ? 'last revolution' : `last ${shown(shownRevolutions, 3)} revolutions`) : 'last cycle';
      const whose_ = severalTurn() && !whole && orbit.revolutions > 0 ? ` of ${turningOf(about.journals.find((one) => one.title === orbit.title)?.angle)}` : '';
      spec.note = orbit.revolutions > 0 ? `${over}${whose_}, rotation ${orbit.sense > 0 ? '↻' : '↺'}` : over;
    };
    spec.update();
    spec.title = orbit.title;
    return new Chart(grid, spec);
  });
  add(own, 'h3', all.every(isJournal) ? 'Forces on the journals, polar' : 'Forces, polar');
  const polar = add(own, 'div', undefined, { class: 'grid squares' });
  const constant = [];
  for (const orbit of moving) {
    const [fx, fy, before] = [numbers(orbit.fx_n), numbers(orbit.fy_n), numbers(orbit.before)];
    const size_ = Math.max(...[fx, fy].map((all_) => all_.reduce((a, b) => Math.max(a, Math.abs(b)), 0)));
    // What stays where it is has no figure.
    if ([fx, fy].every((all_) => all_.reduce((a, b) => Math.max(a, b), -Infinity) - all_.reduce((a, b) => Math.min(a, b), Infinity) <= 1e-3 * size_)) { constant.push(orbit.title); continue; }
    const spec = { id: `polar-${slug(orbit.title)}`, title: `${orbit.title}: force`, equal: true, origin: true, x: { label: 'force along y', unit: 'N' }, y: { label: 'force along x', unit: 'N' }, series: [], dots: [{ x: 0, y: 0, style: 6, name: 'no force' }] };
    spec.update = () => {
      let from = 0;
      if (orbit.revolutions > 0) while (from < before.length - 2 && before[from] > shownRevolutions * (1 + 1e-6)) from++;
      const turned = Math.min(shownRevolutions, orbit.revolutions);
      const whose_ = severalTurn() && orbit.revolutions > 0 ? ` of ${turningOf(about.journals.find((one) => one.title === orbit.title)?.angle)}` : '';
      spec.note = `${orbit.revolutions > 0 ? (turned === 1 ? 'last revolution' : `last ${shown(turned, 3)} revolutions`) : 'last cycle'}${whose_}`;
      spec.series = [{ name: `force on ${orbit.moved}`, path: true, x: fy.subarray(from), y: fx.subarray(from), style: 2, arrows: arrowed(fy.subarray(from), fx.subarray(from)) }];
    };
    spec.update();
    charts.push(new Chart(polar, spec));
  }
  if (constant.length) add(own, 'p', `Without a figure, as the force is zero or does not change: ${constant.join(', ')}.`, { class: 'soft' });
  const update = () => { for (const chart of charts) { chart.spec.update(); if (chart.over) chart.render(); } };
  if (turns && (most > 1 || unsteady)) {
    const label = add(choose, 'label', 'revolutions ');
    const select = add(label, 'select');
    for (const many of [1, 2, 4, 8]) if (many <= most || many === 1) add(select, 'option', String(many), { value: many });
    add(select, 'option', 'whole run', { value: Infinity });
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
  add(own, 'p', `Every row of the last ${most > 1.05 ? `${shown(Math.abs(most - Math.round(most)) < 0.05 ? Math.round(most) : most, 3)} revolutions` : 'revolution'} that ${most > 1.05 ? 'end' : 'ends'} with the keyphasor; at 0 and 360° θ of the body is a multiple of 360°.`, { class: 'soft' });
  const grid = add(own, 'div', undefined, { class: 'grid' });
  for (const { group, revolutions, degrees, columns: packed } of run.turned) {
    const { title, quantity, unit, factor, lines } = about.groups[group];
    if (packed.every((own_) => numbers(own_).every((value) => value === 0))) continue;
    const x = numbers(degrees);
    const all = packed.map((own_) => (factor === 1 ? numbers(own_) : numbers(own_).map((value) => value * factor)));
    // Ripples far from zero, or from each other, would be flat.
    const ends_ = all.map((values) => values.reduce(([a, b], value) => [Math.min(a, value), Math.max(b, value)], [Infinity, -Infinity]));
    const reach_ = Math.max(0, ...ends_.map((own_) => own_[1])) - Math.min(0, ...ends_.map((own_) => own_[0]));
    const means = all.map((values) => values.reduce((a, b) => a + b, 0) / values.length);
    const flat = ends_.every(([a, b]) => b - a < 0.05 * reach_) && ends_.some(([a, b]) => b - a > 1e-6 * reach_);
    const called = (label, k) => (flat ? `${label} less its mean, ${shown(means[k] * Units.of(unit)[1], 5)} ${kindOf(Units.of(unit)[0])}` : label);
    new Chart(grid, {
      id: `angle-${slug(title)}`, title, sync: `angle ${revolutions.toFixed(3)}`, x: { label: severalTurn() ? `angle of ${turningOf(about.groups[group].angle)}` : 'angle', unit: '°' }, y: { label: quantity, unit }, range: [x[0] < 10 ? 0 : x[0], revolutions > 0.95 ? 360 * Math.round(x[x.length - 1] / 360) : x[x.length - 1]],
      series: lines.map(([, label], k) => ({ get name() { return called(label, k); }, x, y: flat ? all[k].map((value) => value - means[k]) : all[k], style: k % 7 })),
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
  const varies = new Set(about.signals.filter((one) => [...run.tracked, ...run.envelopes].some((all) => all.signals.some((signal) => one.columns.some(([name]) => name === signal.column)))).map((one) => one.angle));
  add(own, 'p', `Over the last ${shown(1e3 * run.spectrum_s, 4)} ms with a Hann window: lines that differ by less than ${shown(2 / run.spectrum_s, 2)} Hz are one.${two ? ' Where x and y are known, the motion is taken as circles: those that run with the rotation have positive frequencies, those against it negative ones. A circle shows its radius; what moves along a line shows half of its amplitude on both sides.' : ''}`, { class: 'soft' });
  const smeared = run.spectra.flatMap((spectrum, k) => (spectrum.lines.length && smears(spectrum, about.signals[k].angle) ? [k] : []));
  const sharp = run.spectra.filter((_, k) => !smeared.includes(k));
  if (!sharp.some((spectrum) => spectrum.lines.length)) { add(own, 'p', 'There are none: the speed changes too much in this time for lines to be seen. See the orders, the envelope and the spectra over the run.', { class: 'soft' }); return; }
  // As far as something moves in one of them, and three times the speed.
  const far = Math.max(...sharp.map((spectrum) => Math.max(3.3 * (spectrum.turning_hz || 0), ...spectrum.lines.map(lastPeak))));
  const end = Math.max(...run.spectra.flatMap((spectrum) => spectrum.lines.map((line) => { const all = numbers(line.frequency_hz); return all[all.length - 1]; })));
  const charts = [];
  // Each as far as it has something to show.
  const own_ = (spectrum) => Math.max(3.3 * (spectrum.turning_hz || 0), ...spectrum.lines.map(lastPeak));
  const near = (spectrum) => (far < 0.7 * end || own_(spectrum) < 0.7 * far ? [spectrum.two_sided ? -own_(spectrum) : 0, own_(spectrum)] : undefined);
  if (far < 0.7 * end) {
    const whole = add(add(own, 'label', undefined, { class: 'choose screen' }), 'input', undefined, { type: 'checkbox' });
    whole.after(` all frequencies, to ${shown(end, 4)} Hz: beyond what is shown nothing is above a thousandth of the largest`);
    whole.addEventListener('change', () => { for (const chart of charts) { chart.spec.range = whole.checked ? undefined : near(chart.spec.spectrum); chart.view = null; if (chart.over) chart.render(); } });
  }
  const grid = add(own, 'div', undefined, { class: 'grid' });
  if (smeared.length) add(own, 'p', `Left out, as its speed changes too much in this time for lines to be seen: ${[...new Set(smeared.map((k) => about.signals[k].title))].join(', ')}. See the orders, the envelope and the spectra over the run.`, { class: 'soft' });
  run.spectra.forEach((spectrum, k) => {
    const signal = about.signals[k];
    if (!spectrum.lines.length || smeared.includes(k)) return;
    const marked_ = (orders) => orders.flatMap((order) => { const name = order === 0.5 ? '½X' : `${order}X`; const at = order * spectrum.turning_hz; return spectrum.two_sided ? [{ x: -at, name: `−${name}` }, { x: at, name }] : [{ x: at, name }]; });
    const body = turningOf(signal.angle);
    // What turns otherwise has its own 1X.
    const marks = spectrum.turning_hz > 0 ? marked_([1]) : [];
    for (const [other, hertz] of spectrum.turning_hz > 0 ? turningHertz() : []) if (other !== body && marks.every((one) => Math.abs(Math.abs(one.x) - hertz) > 0.02 * hertz)) marks.push(...(spectrum.two_sided ? [{ x: -hertz, name: `−1X ${other}` }] : []), { x: hertz, name: `1X ${other}` });
    if (spectrum.turning_hz > 0) marks.push(...marked_([2, 0.5]).filter((one) => marks.every((other) => Math.abs(other.x - one.x) > 0.02 * Math.abs(one.x))));
    const note = spectrum.turning_hz > 0 ? `1X: ${body} at ${shown(60 * spectrum.turning_hz, 4)} rpm${varies.has(signal.angle) ? ' on average' : ''}` : '';
    charts.push(new Chart(grid, {
      spectrum, range: near(spectrum), id: `spectrum-${slug(signal.title)}-${slug(signal.quantity)}`, title: `${signal.title}: ${signal.quantity}`, zero: true, sync: `frequency ${spectrum.two_sided}`,
      x: { label: spectrum.two_sided ? 'frequency, backward < 0 < forward' : 'frequency', unit: 'Hz', short: 'frequency' }, y: { label: short(signal.quantity), unit: signal.unit, amplitude: true },
      marks, note, series: spectrum.lines.map((line, place) => ({ name: line.name, x: numbers(line.frequency_hz), y: numbers(line.amplitude), style: place })),
    }));
  });
}

// How fast bodies turn (Hz) over the time of the spectra, by their names.
function turningHertz() {
  const lines = about.groups.find((own) => own.title === 'Angle of rotation')?.lines || [];
  const time = numbers(run.histories.time);
  let first = time.length - 1;
  while (first > 0 && time[first] > run.ends - run.spectrum_s) first--;
  const speed = (name) => { const own = columns.get(name); const all = own && numbers(own.values || own.most); return all ? Math.abs(all[all.length - 1] - all[first]) / (time[time.length - 1] - time[first]) / (2 * Math.PI) : 0; };
  return lines.map(([name, body]) => [body, speed(name)]).filter(([, hertz]) => hertz * run.spectrum_s > 2);
}

// Whether the line of 1X moves by more than its width.
const smears = (spectrum, angle) => { const span = speedSpan(angle); return span > 0.1 || span * spectrum.turning_hz * run.spectrum_s > 2; };

// By how much of itself the speed of a body changes in the time of the spectra.
function speedSpan(angle) {
  const own = columns.get(angle);
  if (!own?.values || !(run.spectrum_s > 0)) return 0;
  const [time, theta] = [numbers(run.histories.time), numbers(own.values)];
  const speed = (from, to) => (theta[to] - theta[from]) / (time[to] - time[from]);
  let first = time.length - 1;
  while (first > 0 && time[first] > run.ends - run.spectrum_s) first--;
  const part = Math.floor((time.length - 1 - first) / 8);
  if (part < 1) return 0;
  const [begin, end] = [speed(first, first + part), speed(time.length - 1 - part, time.length - 1)];
  return Math.abs(end - begin) / Math.max(Math.abs(begin), Math.abs(end), 1e-9);
}

// The last frequency (Hz, either way) with a thousandth of a line's largest amplitude, and a little room.
function lastPeak(line) {
  const [frequency, amplitude] = [numbers(line.frequency_hz), numbers(line.amplitude)];
  const least = 1e-3 * amplitude.reduce((a, b) => Math.max(a, b), 0);
  return 1.1 * frequency.reduce((last, own, k) => (amplitude[k] > least ? Math.max(last, Math.abs(own)) : last), 0);
}

// Where an analysis says that the machine begins or ends to be unstable, for charts over the speed of the same body.
function thresholds(x) {
  if (x.unit !== 'rpm' || !analyses) return [];
  const [first, last] = [x.values[0], x.values[x.values.length - 1]];
  const found = [];
  for (const { name, of } of analyses.analyses) {
    if (of && x.label !== `speed of ${of}` && x.label !== 'speed') continue;
    for (const [file, whole] of [[`${name}.critical.csv`, false], [`${name}.thresholds.csv`, true]]) {
      const csv = data.tables.find((one) => one.name === file)?.csv;
      const rows = csv ? parsed(csv).rows.filter((row) => whole || row.what !== 'critical speed') : [];
      for (const row of rows) if (row.speed_rpm > first && row.speed_rpm < last && !found.some((one) => Math.abs(one.x - row.speed_rpm) < 2e-3 * last)) found.push({ x: row.speed_rpm, name: `${row.what} ${shown(row.speed_rpm, 4)}` });
    }
  }
  return found.slice(0, 4);
}

// The abscissa of what is found over a run: speed if it rises or falls all along, time if not; and values in its order.
const severalTurn = () => new Set(about.signals.map((one) => one.angle).filter(Boolean)).size > 1;
function overSpeed(all) {
  const [rpm, time] = [numbers(all.rpm), numbers(all.time)];
  const rises = rpm.every((value, k) => k === 0 || value > rpm[k - 1]);
  const falls = rpm.every((value, k) => k === 0 || value < rpm[k - 1]);
  const turn = (values) => (falls ? Float32Array.from(values).reverse() : values);
  const signal = about.signals.find((one) => one.columns.some(([name]) => all.signals.some((own) => own.column === name)));
  const of = severalTurn() && signal?.angle ? ` of ${turningOf(signal.angle)}` : '';
  return { turn, x: rises || falls ? { label: `speed${of}`, unit: 'rpm', values: turn(rpm) } : { label: 'time', unit: 's', values: time } };
}

function tracked() {
  if (!run || !run.tracked.length) return;
  const own = part('orders', `Orders over ${run.tracked.some((all) => overSpeed(all).x.unit === 'rpm') ? 'speed' : 'time'}`);
  for (const all of run.tracked) {
    const n = all.revolutions;
    add(own, 'p', `Amplitudes and phases of x = A cos(nθ + φ), tracked by the angle: each point is a fit over ${shown(n)} revolutions with the weights of a Hann window. It tells an order from what differs from it by ${shown(2 / n, 3)} orders or more; nearer than that, both are in one. Overall is half of largest less least value in the same revolutions, of the direction in which it is larger: where it is far above 1X, something else moves${2 / n < 0.45 ? `: the largest part between ${shown(2 / n, 2)} and ${shown(1 - 2 / n, 2)} times the speed is shown with its order where it matters${run.tracked.length > 1 || new Set(about.signals.map((one) => one.angle)).size > 1 ? ', 1X of other bodies left out' : ''}` : ', and its spectra tell what'}. Curves begin and end half of ${shown(n)} revolutions inside the run.${severalTurn() ? ' A whirl of one body may stand as 2X of another one: see the spectra.' : ''}`, { class: 'soft' });
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
      const most = Math.max(...overall.map((all_) => all_.reduce((a, b) => Math.max(a, b), 0)));
      new Chart(grid, {
        id: `order-${id}`, title, zero: true, sync: 'orders', x: axis, y: { label: short(whole.quantity), unit: whole.unit, amplitude: true }, marks: thresholds(x),
        series: [...one('first', '1X', 0), ...one('second', '2X', 2).filter((two) => two.y.some((value) => value > 0.01 * most)), ...(slow ? one('below', 'largest below 1X', 4).map((line) => ({ ...line, y: Array.from(line.y, (value) => (value > 0 ? value : NaN)) })) : []), draw(own.map(([, signal]) => turn(numbers(signal.overall))).reduce((most, values) => most.map((value, k) => Math.max(value, values[k]))), 'overall', 6, { dash: '2 3' })],
        note: [thresholds(x).length ? 'what begins to grow at a mark is seen later: growth takes time' : '', slow ? `a part below 1X can be told from 1X where it is ${shown(2 / n, 2)} orders or more below it; within ${shown(n)} revolutions of where a motion below 1X appears or ceases, 1X and its phase contain a part of it` : ''].filter(Boolean).join('; '),
      });
      const phases = own.map(([axis, signal], k) => { const first = numbers(signal.first); const most_ = Math.max(...own.map(([, one_]) => numbers(one_.first).reduce((a, b) => Math.max(a, b), 0))); return draw(unwrapped(turn(Float32Array.from(numbers(signal.first_phase_deg), (phase, place) => (first[place] > 0.02 * most_ && first[place] > 0.02 * overall[k][place] ? phase : NaN)))), `1X ${axis}`, k); });
      const told_ = phases.filter((one_) => Array.from(one_.y).filter(Number.isFinite).length > 2);
      if (told_.length) new Chart(grid, {
        id: `phase-${id}`, title: `${title}, phase of 1X`, sync: 'orders', x: axis, y: { label: 'phase', unit: '°' },
        // What hardly moves has a phase by chance.
        series: told_,
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
  const own = part('envelope', `Envelope over ${run.envelopes.some((all) => overSpeed(all).x.unit === 'rpm') ? 'speed' : 'time'}`);
  const told = new Set();
  for (const all of run.envelopes) {
    if (!told.has(all.revolutions)) add(own, 'p', all.revolutions > 1 ? `A point is the least and the largest value of ${shown(all.revolutions)} revolutions and of as many on both sides.` : 'A point is the least and the largest value of a revolution and of its two neighbours.', { class: 'soft' });
    told.add(all.revolutions);
    const { turn, x } = overSpeed(all);
    const grid = add(own, 'div', undefined, { class: 'grid' });
    for (const whole of about.signals) {
      const columns_ = whole.columns.map(([name, axis]) => [axis, all.signals.find((signal) => signal.column === name)]).filter(([, signal]) => signal);
      if (!columns_.length) continue;
      new Chart(grid, {
        id: `envelope-${slug(columns_[0][1].column)}`, title: `${whole.title}: ${whole.quantity}`, sync: 'orders', x: { label: x.label, unit: x.unit }, y: { label: short(whole.quantity), unit: whole.unit }, marks: thresholds(x),
        series: columns_.flatMap(([axis, signal], k) => [{ name: `largest ${axis}`, x: x.values, y: turn(numbers(signal.most)), style: k, dash: '' }, { name: `least ${axis}`, x: x.values, y: turn(numbers(signal.least)), style: k, dash: '5 3' }]),
      });
    }
  }
}

// A speed (rad/s) at which a body turns, and not only rocks.
const REVERSED = 1;

// Why a run whose speed varies has no orders over it.
function reversed() {
  if (!run || run.tracked.length) return;
  const names = [...columns.keys()].filter((name) => /^omega_.*rad_s$/.test(name) && extremes(name)[0] < -REVERSED && extremes(name)[1] > REVERSED);
  if (!names.length) return;
  const own = part('orders', 'Orders over speed');
  add(own, 'p', `There are none: ${names.map((name) => name.replace(/^omega_(?:(.*)_)?rad_s$/, (_, body) => body || 'the first body that turns')).join(', ')} turns in both directions in this run, and orders are tracked by an angle that goes on one way. Run each direction by itself for them.`, { class: 'soft' });
}

function waterfalls() {
  // Maps whose parts are too short to tell ½X from 1X at the highest speed say nothing.
  const tells = (fall) => 2 / fall.slice_s < 0.5 * (Math.max(...fall.rpm.map(Math.abs)) / 60);
  if (!run || !run.waterfalls.some(tells)) return;
  const own = part('waterfall', 'Spectra over the run');
  add(own, 'p', `Spectra of ${run.waterfalls[0].time.length} overlapping parts of the run, each ${shown(1e3 * run.waterfalls[0].slice_s, 3)} ms long with a Hann window, which tells lines apart that differ by ${shown(2 / run.waterfalls[0].slice_s, 2)} Hz or more; every cell has the largest amplitude in it. Dashed lines are ½, 1 and 2 times the speed.`, { class: 'soft' });
  const grid = add(own, 'div', undefined, { class: 'grid' });
  for (const fall of run.waterfalls.filter(tells)) {
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
  // To the digits that show the error.
  const largest = Math.max(...Object.values(summary.energy_balance_j).map(Math.abs));
  const digits = Math.min(9, 2 + Math.ceil(Math.log10(Math.max(largest / Math.max(Math.abs(summary.energy_balance_j.error || 0), 1e-10 * largest), 100))));
  const rows = names.map((name) => [words[name] || name.replaceAll('_', ' '), () => shown(summary.energy_balance_j[name] * Units.of('J')[1], name === 'error' ? 3 : digits)]);
  const made = summary.verdict.measures.energy_made_share;
  add(own, 'p', `Balance from the start to the end of the run. The error is what the program lost or made in all${typeof made === 'number' ? `; the verdict also counts what single joints made or lost, whatever that comes to in all: ${shown(100 * made, 3)} %` : ''}.`, { class: 'soft' });
  table(own, ['', ['energy', 'J']], rows);
  const { march, time, counts } = summary;
  const list = add(own, 'ul', undefined, { class: 'plain' });
  const step = march.time_step_s ? `time step ${shown(march.time_step_s)} s` : `steps of ${shown(march.automatic.shortest_step_s, 3)} to ${shown(march.automatic.longest_step_s, 3)} s, chosen by the program`;
  add(list, 'li', `${march.integrator}, ${step}; ${march.steps} steps, ${march.iterations} iterations, ${march.factorisations} ${march.factorisations === 1 ? 'factorisation' : 'factorisations'}`);
  add(list, 'li', `${counts.active} unknowns, ${counts.springs} ${counts.springs === 1 ? 'spring' : 'springs'}`);
  add(list, 'li', `${shown(time.total_wall_s, 3)} s in all, of which time integration took ${shown(time.march_wall_s, 3)} s and the reduction of the bodies ${shown(time.reduction_wall_s, 3)} s${time.reduction_cached ? ' (from the cache)' : ''}`);
  const more = add(own, 'details');
  add(more, 'summary', 'Measures behind the verdict');
  table(more, ['', 'measured'], Object.entries(summary.verdict.measures).map(([name, value]) => [name.replaceAll('_', ' '), value === null ? '–' : shown(value, 3)]));
}
