// What is asked first: the verdict, the largest values, the case in words, and the last cycle.

function head() {
  add(page, 'h1', about.title || about.name);
  add(page, 'p', `${about.title ? about.name : ''}${about.source ? ` · ${about.source}` : ''}`, { class: 'soft' });
  if (!summary) { foundBox(); return; }
  if (analyses) add(page, 'p', 'The verdict is on the run; analyses say themselves what limits them.', { class: 'soft' });
  const { verdict } = summary;
  const box = add(page, 'div', undefined, { class: verdict.sound ? 'verdict' : 'verdict bad', id: 'verdict' });
  add(box, 'strong', verdict.sound ? 'Numerically sound' : 'NOT SOUND: do not use these results');
  if (verdict.sound) add(box, 'p', 'Every step of this run passed the checks of the program: the numbers can be used. What they say of the machine is for you to judge.');
  else {
    const list = add(box, 'ul');
    for (const own of verdict.findings) {
      const amount = (value) => (value === null ? 'no number' : own.unit === '1' ? `${shown(100 * value, 3)} %` : `${shown(value, 3)} ${own.unit}`);
      add(list, 'li', `${own.what}: ${amount(own.value)}, limit ${amount(own.limit)}. Remedy: ${plain(own.remedy)}`);
    }
  }
  foundBox();
  if (summary.error) add(box, 'p', `The run ended early: ${summary.error}.`);
  facts();
}

// A joint as charts call it.
const titleOf = (name) => { const plain_ = name.replace(/^\S+ /, ''); return [plain_, name[0].toUpperCase() + name.slice(1)].find((own) => columns.has(`ratio ${own}`)) || plain_; };

// Bodies that turn freely and otherwise in the state of an analysis than at the end of the run.
function otherSpeeds(text) {
  if (!run) return [];
  const free = about.words.find((one) => one.title === 'Speeds')?.lines.filter((line) => /: free/.test(line)).map((line) => line.split(':')[0]) || [];
  const lines = about.groups.find((own) => own.title === 'Speed of rotation')?.lines || [];
  return text.split('\n').flatMap((line) => {
    const [, body, told] = /^(\S+) at (-?[\d.]+) rpm$/.exec(line) || [];
    const column = free.includes(body) && columns.get(lines.find(([, own]) => own === body)?.[0]);
    if (!column) return [];
    const all = numbers(column.values || column.most);
    const ends = (all[all.length - 1] * 30) / Math.PI;
    return Math.abs(ends - told) > 0.1 * Math.max(Math.abs(ends), Math.abs(told)) ? [`${body} turns at ${shown(Number(told), 4)} rpm in the state of this analysis, and at ${shown(ends, 4)} rpm at the end of the run: where no couple acts on it, its speed in the analysis is a guess`] : [];
  });
}

// Where the run moves farther than joints are linear about the state of an analysis.
function beyondLinear(text) {
  if (!run || /too large for a linear/.test(text)) return [];
  const told = text.match(/joints are linear, within 10 % of stiffness and damping, for amplitudes up to (.+)/)?.[1] || '';
  const half = (name) => { const [least, most] = lastCycle(name); return 0.5 * (most - least); };
  const found = [];
  for (const own of told.split(', ')) {
    const [, amplitude, name] = /^(\S+) µm in (.+)$/.exec(own) || [];
    const journal = name && about.journals.find((one) => one.title === titleOf(name));
    if (!journal || !journal.columns.every((one) => columns.has(one))) continue;
    const moves = Math.max(...journal.columns.map(half));
    if (moves > 1.5 * Number(amplitude)) found.push({ moves, words: `${name} is linear for amplitudes up to ${amplitude} µm about the state of this analysis, and moves by ${shown(moves, 3)} µm in the last cycle of the run` });
  }
  const most = found.reduce((best, own) => (own.moves > (best?.moves || 0) ? own : best), null);
  return most ? [`${most.words}${found.length > 1 ? `; ${found.length === 2 ? '1 more is beyond its limit' : `${found.length - 1} more are beyond their limits`}` : ''}: what is found here holds for small motions alone`] : [];
}

// What analyses found that must not be missed, a line each; of a page without a run also what passes.
function foundBox() {
  const lines = new Map();
  const note = (name, line) => { const words = line.replace(/^note: /, ''); if (!lines.has(words)) lines.set(words, []); lines.get(words).push(name); };
  let bad = false;
  for (const { name, text, failed, interrupted } of analyses?.analyses || []) {
    if (failed) note(name, `came to nothing: ${text}`);
    if (interrupted) note(name, 'interrupted: only what was found until then is shown');
    const danger = failed ? [] : text.split('\n').filter((line) => DANGER.test(line));
    bad ||= failed || interrupted;
    // What the run presses together stands open in the state of the analysis.
    const open = (failed ? '' : text).match(/nothing closes the clearance of (.+): without stiffness/)?.[1].split(', ').map(titleOf) || [];
    const closed = open.filter((own) => columns.has(`ratio ${own}`) && extremes(`ratio ${own}`)[1] > 1);
    if (!failed) otherSpeeds(text).forEach((line) => note(name, line));
    if (!closed.length && !failed) beyondLinear(text).forEach((line) => note(name, line));
    if (closed.length) { bad = true; note(name, `nothing closes the clearance of ${closed.join(', ')} in the state of this analysis, but the run does: what is found here does not describe the motion of the run`); }
    // One bearing that moves too far stands for all, and a run that is here has the answer.
    const far = danger.filter((line) => /too large for a linear/.test(line));
    const rest = danger.filter((line) => !far.includes(line));
    bad ||= rest.length > 0 || far.length > 0;
    // Of what does not pass the first lines.
    const all = failed ? [] : text.split('\n');
    const fails = all.slice(all.findIndex((line) => /^DOES NOT PASS/.test(line)) + 1).filter((line) => /^ {2}\d/.test(line)).map((line) => symbols(line.trim()));
    rest.slice(0, 3).forEach((line) => note(name, /^DOES NOT PASS/.test(line) && fails.length ? `${line}: ${fails.slice(0, 8).join('; ')}${fails.length > 8 ? `; and ${fails.length - 8} more in its chapter` : ''}` : line));
    if (rest.length > 3) note(name, `${rest.length - 3} more such lines stand in its chapter`);
    if (far.length) note(name, far[0].replace(/ Run it in time.*$/, summary ? '' : '$&') + (far.length > 1 ? ` The same holds for ${far.length - 1} more.` : '') + (summary ? ' The run on this page has no such limit.' : ''));
    if (!summary && !failed) text.split('\n').filter((line) => /^PASSES|^stable at all/.test(line)).slice(0, 1).forEach((line) => note(name, line));
  }
  if (!lines.size) return;
  const passes = [...lines.keys()].every((words) => /^PASSES|^stable at all/.test(words));
  const box = add(page, 'div', undefined, { class: bad ? 'verdict bad' : passes ? 'verdict' : 'verdict told', id: 'found' });
  add(box, 'strong', 'What the analyses found');
  const list = add(box, 'ul');
  for (const [words, names] of lines) add(list, 'li', plain(`${names.join(', ')}: ${words}`));
}

// What is asked first.
function facts() {
  const list = add(page, 'dl', undefined, { class: 'facts' });
  const fact = (name, value, small) => {
    const own = add(list, 'div');
    add(own, 'dt', name);
    const dd = add(own, 'dd');
    const fill = () => { dd.textContent = Array.isArray(value) ? `${shown(value[0] * Units.of(value[1])[1] * (value[2] ? Amplitudes.factor : 1), 4)} ${Units.of(value[1])[0]}${value[2] ? ` ${Amplitudes.words}` : ''}` : value; if (small) add(dd, 'small', typeof small === 'function' ? small() : small); };
    fill();
    redraw.push(fill);
  };
  const { march, time } = summary;
  fact('simulated', `${shown(time.simulated_s, 4)} s`, `${march.steps}${march.complete ? '' : ` of ${march.steps_asked}`} steps in ${shown(time.march_wall_s, 3)} s`);
  const [first, ...rest] = about.steady.split(/[:,] /);
  // A run-up is not meant to come to rest, nor is a run of one cycle.
  const settled = isSteady();
  if ((settled || !run?.tracked.length) && !wholeRun()) fact('steady state', first, rest.join(', '));
  if (!run) return;
  const largest = (names, of) => names.map((name) => [name, of(name)]).reduce((best, own) => (own[1] > best[1] ? own : best), ['', -Infinity]);
  if (run.ratios.length) {
    const [title, most] = largest(run.ratios, (name) => extremes(`ratio ${name}`)[1]);
    const pressed = most > 1 ? '; beyond 100 % the parts are pressed together' : '';
    if (settled) {
      const [last, now] = largest(run.ratios, (name) => lastCycle(`ratio ${name}`)[1]);
      fact('largest eccentricity', `${shown(100 * now, 3)} % of the clearance`, `${last}, in the last cycle; ${shown(100 * most, 3)} % in the whole run${pressed}`);
    } else fact('largest eccentricity', `${shown(100 * most, 3)} % of the clearance`, `${title}, in the whole run${pressed}`);
  }
  const films = (prefix, unit) => [...columns.keys()].filter((name) => name.startsWith(prefix) && name.endsWith(unit));
  const ofFilm = (name) => name.replace(/^(hmin|pmax)_(.*)_(um|MPa)$/, '$2');
  if (films('hmin_', '_um').length) {
    const [name, least] = films('hmin_', '_um').map((own) => [own, extremes(own)[0]]).reduce((best, own) => (own[1] < best[1] ? own : best));
    fact('thinnest film', [least, 'µm'], `${ofFilm(name)}, in the whole run`);
  }
  if (films('pmax_', '_MPa').length) {
    const [name, most] = largest(films('pmax_', '_MPa'), (own) => extremes(own)[1]);
    fact('largest pressure in a film', [most, 'MPa'], `${ofFilm(name)}, in the whole run`);
  }
  const forces = about.groups.filter((own) => own.quantity === 'force' && own.lines.every(([name]) => columns.has(name)));
  if (forces.length) {
    const of = (own) => Math.max(...own.lines.map(([name]) => Math.max(...extremes(name).map(Math.abs))));
    const group = forces.reduce((best, own) => (of(own) > of(best) ? own : best));
    const now = (own) => Math.max(...own.lines.map(([name]) => Math.max(...lastCycle(name).map(Math.abs))));
    const last = forces.reduce((best, own) => (now(own) > now(best) ? own : best));
    if (settled) fact('largest force component', [now(last), last.unit], () => `${last.title}, in the last cycle; ${shown(of(group) * Units.of(group.unit)[1], 4)} ${Units.of(group.unit)[0]} in the whole run`);
    else fact('largest force component', [of(group), group.unit], `${group.title}, in the whole run`);
  }
  const moments = about.groups.filter((own) => own.quantity === 'moment' && own.shown && own.lines.every(([name]) => columns.has(name)));
  if (moments.length) {
    const of = (own) => Math.max(...own.lines.map(([name]) => Math.max(...extremes(name).map(Math.abs))));
    const group = moments.reduce((best, own) => (of(own) > of(best) ? own : best));
    fact('largest torque', [of(group), group.unit], `${group.title}, in the whole run`);
  }
  // What is nothing beside the displacements themselves is no motion.
  const displaced = Math.max(0, ...about.signals.filter((own) => own.unit === 'µm').flatMap((own) => own.columns.filter(([name]) => columns.has(name)).flatMap(([name]) => lastCycle(name).map(Math.abs))));
  const top = [strongest()].find((own) => own && own.amplitude > 1e-4 * displaced);
  if (top) fact('strongest motion', top.words, () => `${top.title}: ${shown(top.amplitude * Units.of(top.unit)[1] * Amplitudes.factor, 3)} ${Units.of(top.unit)[0]} ${Amplitudes.words} at ${shown(top.hertz, 4)} Hz`);
  // Not what cannot be told from another body, nor what is nothing beside the rest.
  const matters = (own) => { const [least, most] = lastCycle(own.signal); return own['1X'].amplitude > 0.02 * (most - least); };
  const orders = (summary.orders?.signals || []).filter((own) => own.signal.endsWith('_um') && !own.mixed_with?.length && columns.has(own.signal) && matters(own) && isOrder(own));
  const last = Math.max(...orders.map((own) => own['1X'].amplitude), 0);
  // Over a run-up the last revolutions are half a window behind the last point.
  const passed = [largestOrder()].find((own) => own && own.amplitude >= last);
  const slow = largestBelow();
  if (slow) fact('largest part below 1X', [slow.amplitude, 'µm', true], `${slow.title}: ${shown(slow.order, 3)} times the speed of ${shown(slow.rpm, 4)} rpm, ${shown((slow.order * slow.rpm) / 60, 3)} Hz${slow.rings ? ', a motion that keeps this frequency and rings down' : ''}${slow.first ? '; before, it cannot be told from 1X' : ''}`);
  if (top && /^1X/.test(top.words)) return;
  if (passed) fact('largest 1X', [passed.amplitude, 'µm', true], `${passed.title}, at ${shown(passed.rpm, 4)} rpm${passed.first ? ', where the curve begins' : ''}; looked for where more than half of what moves is 1X`);
  else if (orders.length) {
    const top = orders.reduce((best, own) => (own['1X'].amplitude > best['1X'].amplitude ? own : best));
    const title = about.signals.find((own) => own.columns.some(([name]) => name === top.signal));
    fact('largest 1X', [top['1X'].amplitude, 'µm', true], `${title ? title.title : top.signal}, last ${top.revolutions === 1 ? 'revolution' : `${top.revolutions} revolutions`}`);
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
      numbers(signal.first).forEach((amplitude, k) => { if (amplitude > 0.55 * overall[k] && (!top || amplitude > top.amplitude)) top = { amplitude, rpm: rpm[k], title, first: k === 0 }; });
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
      const below = numbers(signal.below);
      // What keeps its frequency while it fades rings down.
      const hertz = (k) => (order[k] * rpm[k]) / 60;
      const rings = (k) => {
        let faded = k;
        while (faded + 1 < below.length && below[faded + 1] < below[faded] && Math.abs(hertz(faded + 1) - hertz(k)) < 0.05 * hertz(k)) faded++;
        return below[faded] < 0.5 * below[k];
      };
      below.forEach((amplitude, k) => { if (amplitude > 0.2 * overall[k] && (!top || amplitude > top.amplitude)) top = { amplitude, rpm: rpm[k], order: order[k], title, rings: rings(k), first: k > 0 && !(below[k - 1] > 0) }; });
    }
  }
  return top;
}

// The load that has a frequency (Hz), as the case tells of it.
function exciting(hertz) {
  const loads = about.words.find((one) => one.title === 'Loads')?.lines || [];
  const found = loads.map((line) => /^(load \S+) .*sine of ([\d.]+) Hz/.exec(line)).find((one) => one && Math.abs(Math.abs(hertz) / Number(one[2]) - 1) < 0.01);
  return found ? found[1] : null;
}

// The largest line of the spectra of displacements, as a multiple of the speed.
function strongest() {
  let top = null;
  // Of what runs up a spectrum mixes speeds.
  const varies = new Set(isSteady() ? [] : run.envelopes.flatMap((all) => all.signals.map((own) => own.column)));
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
        const [fine, more] = between(frequency, amplitude, at, spectrum);
        const order_ = (frequency[at] + fine) / spectrum.turning_hz;
        top = { amplitude: more * (amplitude[at] + other), hertz: Math.abs(frequency[at] + fine), unit: signal.unit, title: signal.title, words: exciting(frequency[at] + fine) && Math.abs(Math.abs(order_) - 1) >= 0.005 ? `at the frequency of ${exciting(frequency[at] + fine)}${way}` : `${Math.abs(Math.abs(order_) - 1) < 0.005 ? '1X' : `${shown(Math.abs(order_), 3)} times the speed`}${body ? ` of ${body}` : ''}${way}` };
      }
    }
  });
  return top;
}

// How far a line lies from the largest of its frequencies (Hz), and by what its amplitude is larger: of a sine with a Hann window. Where
// the neighbours are not those of one sine, two lie closer than the rows resolve, and it stays where it is.
function between(frequency, amplitude, at, { step_hz: step, resolved_hz: resolved }) {
  const beside = (k) => (k >= 0 && k < amplitude.length && Math.abs(Math.abs(frequency[k] - frequency[at]) - step) < 0.01 * step ? amplitude[k] / amplitude[at] : 0);
  const [below, above] = [beside(at - 1), beside(at + 1)];
  const stays = [0, 1];
  if (!(below > 0 && above > 0)) return stays;
  // The transform of the window, x in parts of 1/T.
  const lobe = (x) => (Math.abs(x) < 1e-9 ? 1 : Math.abs(Math.abs(x) - 1) < 1e-9 ? 0.5 : Math.abs(Math.sin(Math.PI * x) / (Math.PI * x * (1 - x * x))));
  const width = step / resolved;
  const share = (off, side) => lobe(width - side * off) / lobe(off);
  const [more, less] = [Math.max(below, above), Math.min(below, above)];
  let [least, most] = [0, 0.5 * width];
  for (let k = 0; k < 50; k++) { const middle = 0.5 * (least + most); if (share(middle, 1) < more) least = middle; else most = middle; }
  const off = 0.5 * (least + most);
  if (Math.abs(share(off, -1) - less) > 0.1 || Math.abs(share(off, 1) - more) > 0.1) return stays;
  return [(above > below ? off : -off) * resolved, 1 / lobe(off)];
}

// The amplitude at the frequency that is nearest.
function mirrored(frequency, amplitude, wanted) {
  let best = 0;
  for (let k = 1; k < frequency.length; k++) if (Math.abs(frequency[k] - wanted) < Math.abs(frequency[best] - wanted)) best = k;
  const near = Math.abs(frequency[best] - wanted) <= 1e-3 * Math.abs(wanted) + 1e-12;
  return near ? amplitude[best] : 0;
}

// How often and how long journals were beyond their clearances, and teeth apart.
function contacts(own) {
  if (!run) return;
  toothContacts(own);
  if (!run.contacts.length) return;
  add(own, 'h3', 'Contacts in the whole run');
  const lasts = (one) => (one.lasts ? ', to the end' : '');
  table(own, ['', 'times', 'first at (s)', 'share of the time', 'longest'], run.contacts.map((one) => [one.title, String(one.times), shown(one.first_s, 5), `${shown(100 * one.share, 3)} %`, `${shown(1e3 * one.longest_s, 4)} ms${lasts(one)}`]));
  add(own, 'p', 'Beyond 100 % of the clearance the parts are pressed together; a contact ends when they part.', { class: 'soft' });
}

function toothContacts(own) {
  if (!run.teeth.length) return;
  add(own, 'h3', 'Teeth in the whole run');
  table(own, ['', ['largest normal force', 'N'], ['least', 'N'], 'parted', 'share of the time', 'longest apart'], run.teeth.map(({ title, backlash, apart }) => {
    const [least, most] = extremes(`teeth ${title}`);
    const parted = apart ? [`${apart.times} ${apart.times === 1 ? 'time' : 'times'}, first at ${shown(apart.first_s, 5)} s`, `${shown(100 * apart.share, 3)} %`, `${shown(1e3 * apart.longest_s, 4)} ms${apart.lasts ? ', to the end' : ''}`] : [backlash ? 'never' : 'cannot', '', ''];
    return [title, [most, 'N'], [least, 'N'], ...parted];
  }));
  if (run.teeth.some(({ title, backlash }) => backlash && extremes(`teeth ${title}`)[0] < 0)) add(own, 'p', 'Below zero the other flank carries: the teeth were driven back.', { class: 'soft' });
}

function theCase() {
  if (!about.words.length) return;
  const own = part('case', 'The case');
  for (const { title, table: rows, lines } of about.words) {
    add(own, 'h3', title);
    if (rows) table(own, rows[0], rows.slice(1));
    if (lines) { const list = add(own, 'ul', undefined, { class: 'plain' }); for (const line of lines) add(list, 'li', plain(line)); }
    if (title === 'Joints') lawCurves(own);
  }
  if (!about.words.some((one) => one.title === 'Joints')) lawCurves(own);
}

// Forces of laws along the first thing on which they hang.
function lawCurves(own) {
  if (!about.laws?.length) return;
  const grid = add(own, 'div', undefined, { class: 'grid' });
  for (const { law, title, x, y, points } of about.laws) {
    new Chart(grid, {
      id: `law-${slug(law)}`, title, note: `law ${law.replaceAll('um', 'µm')}`, x: { label: x[0], unit: x[1].replace('um', 'µm') }, y: { label: y[0], unit: y[1] }, levels: [{ y: 0, name: '' }], marks: points[0][0] < 0 && points[points.length - 1][0] > 0 ? [{ x: 0, name: '' }] : [],
      series: [{ name: `${y[0]} over ${x[0]}, all others zero`, x: points.map((one) => one[0]), y: points.map((one) => one[1]), style: 0 }],
    });
  }
  for (const figure of data.figures) if (figure.name === 'laws.svg') figure.shown = true;
}

// Least and largest value of a column over the last cycle.
function lastCycle(name) {
  const [own, time] = [columns.get(name), numbers(run.histories.time)];
  let [least, most] = [Infinity, -Infinity];
  for (let k = time.length - 1; k >= 0 && time[k] > run.ends - summary.cycle_s - 0.51 * about.row_s; k--) {
    least = Math.min(least, numbers(own.values || own.least)[k]);
    most = Math.max(most, numbers(own.values || own.most)[k]);
  }
  return [least, most];
}

// Whether the run came to a steady state.
const isSteady = () => /^steady/.test(about.steady);

// Whether orders of a signal tell something: a revolution of a run-up is none of an order.
function isOrder(one) {
  const runsUp = isSteady() ? [] : [...run?.tracked || [], ...run?.envelopes || []];
  return one.revolutions >= 2 || !runsUp.some((all) => all.signals.some((own) => own.column === one.signal));
}

// Whether the last cycle is all of the run.
const wholeRun = () => summary.cycle_s >= 0.98 * summary.time.simulated_s;

function results() {
  if (!summary || !(summary.supports.length || summary.orders)) return;
  const own = part('results', wholeRun() ? 'The whole run' : 'The last cycle');
  if (!wholeRun()) add(own, 'p', `A cycle is ${shown(1e3 * summary.cycle_s, 5)} ms: ${plain(about.cycle)}. ${about.steady[0].toUpperCase()}${about.steady.slice(1)}.`);
  const moving = summary.supports;
  if (moving.length && about.words[0]?.title === 'The mass') {
    // A mean that is nothing beside the extremes is rounding.
    const clean = (all, which) => (Math.abs(all[which]) > 1e-7 * Math.max(Math.abs(all.min), Math.abs(all.max)) ? all[which] : 0);
    table(own, ['', '', ['force x', 'N'], ['displacement of the mass, x', 'mm']], moving.flatMap((support, k) => ['min', 'mean', 'max'].map((which) => [which === 'min' ? `Stop ${k + 1}` : '', which, [clean(support.RX_N, which), 'N'], [1e-3 * clean(support.X_um, which), 'mm']])), [1]);
  } else if (moving.length) {
    // What has no clearance is displaced, and has no place in a bore.
    const bores = moving.filter((support) => support.clearance_um > 0).length;
    const called = bores === moving.length ? 'eccentricity' : bores ? 'eccentricity or displacement' : 'displacement';
    const heads = ['', '', ['force x', 'N'], ['force y', 'N'], [`${called} x`, 'µm'], [`${called} y`, 'µm'], ...(bores ? [['clearance', 'µm']] : [])];
    // What is nothing beside the largest of its kind is rounding.
    const most = (names) => Math.max(...moving.flatMap((support) => names.flatMap((name) => ['min', 'max'].map((which) => Math.abs(support[name]?.[which] || 0)))));
    const [force, way] = [most(['RX_N', 'RY_N']), most(['EX_um', 'EY_um'])];
    const clean = (value, largest) => (Math.abs(value) > 1e-9 * largest ? value : 0);
    const pushes = (support) => ['RX_N', 'RY_N', 'EX_um', 'EY_um'].some((name) => ['min', 'max'].some((which) => support[name]?.[which] !== 0));
    const named_ = moving.map((support, k) => [support.joint || supportName(k), support]);
    // A coupling turns and does not push.
    const couples = ([name, support]) => !about.journals.some((one) => one.title === name) && ['RX_N', 'RY_N'].every((key) => ['min', 'max'].every((which) => support[key]?.[which] === 0));
    const still = named_.filter((one) => !couples(one) && !pushes(one[1])).map(([name]) => name);
    const rows = named_.filter((one) => !couples(one) && pushes(one[1])).flatMap(([name, support]) => ['min', 'mean', 'max'].map((which) => [
      which === 'min' ? name : '', which, [clean(support.RX_N[which], force), 'N'], [clean(support.RY_N[which], force), 'N'], [clean(support.EX_um[which], way), 'µm'], [clean(support.EY_um[which], way), 'µm'],
      ...(!bores ? [] : [which === 'min' && support.clearance_um > 0 ? [support.clearance_um, 'µm'] : ''])]));
    table(own, heads, rows, [1]);
    const moments = about.groups.filter((group) => group.quantity === 'moment' && group.shown && group.lines.every(([name]) => columns.has(name)));
    if (moments.length) table(own, ['', '', ['torque', 'N·m']], moments.flatMap((group) => group.lines.map(([name]) => lastCycle(name)).flatMap(([least, most]) => [[group.title, 'min', [least, 'N·m']], ['', 'max', [most, 'N·m']]])), [1]);
    if (still.length) add(own, 'p', `Nothing moves or pushes across the axis in ${still.join(', ')}.`, { class: 'soft' });
  }
  contacts(own);
  if (summary.orders && !summary.orders.signals.some(isOrder)) {
    add(own, 'h3', 'Orders');
    add(own, 'p', 'There are none: they would be fitted to less than two revolutions of a run whose speed changes. See the envelope over speed.', { class: 'soft' });
  } else if (summary.orders) {
    add(own, 'h3', 'Orders');
    const { signals } = summary.orders;
    add(own, 'p', `x = A cos(nθ + φ), A from 0 to the peak, fitted over whole revolutions at the end of the run${/^not steady/.test(about.steady) ? ' with the weights of a Hann window, as it is not steady' : ''}${new Set(signals.map((one) => one.angle)).size > 1 ? ', with once and twice the angles of the other bodies beside' : ''}.${/^not steady/.test(about.steady) ? '' : ' What is no multiple of half the speed leaks into these numbers where the revolutions are few: see the spectra.'}`, { class: 'soft' });
    const named = (name) => { const signal = about.signals.find((one) => one.columns.some(([column]) => column === name)); return signal ? `${signal.title}: ${signal.quantity} ${signal.columns.find(([column]) => column === name)[1]}` : name; };
    const unit = (name) => about.signals.find((one) => one.columns.some(([column]) => column === name))?.unit || '';
    const has = (order) => signals.some((one) => one[order] && one[order].amplitude > 0.1 * Math.max(one['1X'].amplitude, one['2X'].amplitude));
    const orders = [...(has('0.5X') ? ['0.5X'] : []), '1X', ...(has('1.5X') ? ['1.5X'] : []), '2X'];
    const heads = () => ['', ...orders.flatMap((order) => [`${order.replace('0.5', '½').replace('1.5', '1½')}, ${Amplitudes.words}`, '', 'phase (°)']), 'revolutions'];
    // What is small beside the rest is the end of a fit.
    const counts = (one) => {
      if (!isOrder(one)) return false;
      const [least, most] = columns.has(one.signal) ? lastCycle(one.signal) : [0, 0];
      return Math.max(...orders.map((order) => one[order]?.amplitude || 0)) > 0.005 * (most - least);
    };
    const rows = () => signals.filter(counts).map((one) => {
      const u = unit(one.signal);
      const told = (order) => (one[order] ? [[one[order].amplitude * Amplitudes.factor, u], Units.of(u)[0], shown(one[order].phase_deg, 4)] : ['–', '', '']);
      return [named(one.signal), ...orders.flatMap(told), String(one.revolutions)];
    });
    const mixed = signals.filter((one) => one.mixed_with?.length && counts(one));
    if (mixed.length) add(own, 'p', `${mixed.length === signals.length ? 'In all of these' : `In ${[...new Set(mixed.map((one) => named(one.signal)))].join(', ')}`} 1X or 2X of another body has the same or nearly the same frequency: the numbers have a part of it.`, { class: 'soft' });
    const host = add(own, 'div');
    const fill = () => { host.replaceChildren(); table(host, heads(), rows(), orders.map((_, k) => 2 + 3 * k)); };
    fill();
    redraw.push(fill);
  }
  const bodies = Object.entries(summary.stresses || {});
  if (bodies.length) {
    add(own, 'h3', 'Largest stresses in the frames of the cycle');
    table(own, ['', ['von Mises', 'MPa'], 'node', 'at (mm)', 'time (s)'], bodies.map(([name, one]) => [name, [one.von_mises_MPa, 'MPa'], String(one.node), one.position_mm.map((x) => shown(x)).join(', '), shown(one.time_s, 6)]));
  }
}
