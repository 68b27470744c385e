// Bode plots of a response, with what the run has at the same places.

// The columns of a point of a response.
const columnsOf = (point) => { const [, kind, name] = /^(joint|output)\.(.+)$/.exec(point) || []; const middle = /^\d+$/.test(name) ? name : `_${name}`; return kind === 'joint' ? [`X${middle}_um`, `Y${middle}_um`] : [`x${middle}_um`, `y${middle}_um`]; };

// Once a turn in the run: over the speed of a run-up, or at the speed of a steady state.
function inTheRun(name_, body, point, order) {
  const none = { series: [], dots: [], note: '' };
  if (order !== 1 || !run) return none;
  const names = columnsOf(point);
  const signal = about.signals.find((one) => one.columns.some(([name]) => names.includes(name)));
  if (!signal?.angle || (severalTurn() && turningOf(signal.angle) !== body)) return none;
  // The response of a joint is that of its journal in the bore: where the bore moves, the run has another motion.
  const relative = (name) => name.replace(/^([XY])/, 'E$1');
  const swing = (name) => { const [least, most] = lastCycle(name); return most - least; };
  const moves = names.some((name) => name !== relative(name) && columns.has(relative(name)) && Math.abs(swing(relative(name)) - swing(name)) > 0.02 * Math.max(swing(relative(name)), swing(name)));
  if (moves) return { ...none, note: 'of the journal in its bore, which moves, too: the run has 1X of the motion in space only' };
  const tracked_ = run.tracked.find((all) => all.signals.some((one) => names.includes(one.column)));
  if (tracked_) {
    const { x, turn } = overSpeed(tracked_);
    const rpm = x.unit === 'rpm' ? speedOfAxis(name_, tracked_, x, turn) : null;
    if (!rpm) return none;
    // Where something moves below 1X the joints are other ones, and as it appears or ceases the fit has a part of it.
    const shaken = (one) => { const [below, overall] = [numbers(one.below), numbers(one.overall)]; const moves = Array.from(below, (own, k) => own > 0.2 * overall[k]); return turn(Float32Array.from(numbers(one.first), (value, k) => (moves.slice(Math.max(k - 4, 0), k + 5).some(Boolean) ? NaN : value))); };
    const own = names.map((name) => tracked_.signals.find((one) => one.column === name));
    const series_ = own.map((one, k) => one && { name: `${'xy'[k]} in the run`, x: rpm, y: shaken(one), style: k, dash: '1.5 2.5' }).filter(Boolean);
    const seconds = numbers(tracked_.time);
    return { ...none, series: series_, note: `the run, which passes these speeds in ${shown(Math.abs(seconds[seconds.length - 1] - seconds[0]), 3)} s, need not follow the linear response: peaks take time to build up, and joints change with the amplitude; it is left out where something moves below 1X` };
  }
  const omega = [...columns.keys()].find((name) => name === signal.angle.replace('theta', 'omega').replace(/_rad$/, '_rad_s'));
  if (!isSteady() || !omega) return none;
  const rpm = (lastCycle(omega).reduce((a, b) => a + b) / 2) * (30 / Math.PI);
  const dots = names.map((name, k) => ({ own: summary.orders?.signals.find((one) => one.signal === name), k })).filter(({ own }) => own).map(({ own, k }) => ({ x: Math.abs(rpm), y: own['1X'].amplitude, style: k, name: 'in the run', label: `run ${'xy'[k]}` }));
  return { ...none, dots };
}

// Speeds (rpm) of the body over whose speed an analysis is, where the run was tracked by the angle of another one; none where that
// does not rise all along.
function speedOfAxis(name, tracked_, x, turn) {
  const of = analyses.analyses.find((own) => own.name === name)?.of;
  const signal = about.signals.find((one) => one.columns.some(([column]) => tracked_.signals.some((own) => own.column === column)));
  if (!of || turningOf(signal.angle) === of) return x.values;
  const column = about.groups.find((own) => own.title === 'Speed of rotation')?.lines.find(([, body]) => body === of)?.[0];
  const own = columns.get(column);
  if (!own) return null;
  const [time, most] = [numbers(run.histories.time), numbers(own.values || own.most)];
  let k = 0;
  const rpm = turn(Float32Array.from(numbers(tracked_.time), (at) => { while (k < time.length - 1 && time[k] < at) k++; return Math.abs(most[k]) * (30 / Math.PI); }));
  return rpm.every((value, at) => at === 0 || value > rpm[at - 1]) ? rpm : null;
}

// A switch above charts between a linear and a logarithmic axis.
function logarithmic(host, charts) {
  if (!charts.length) return;
  const label = document.createElement('label');
  label.className = 'choose screen';
  const box = add(label, 'input', undefined, { type: 'checkbox' });
  box.after(' logarithmic amplitudes');
  host.before(label);
  box.addEventListener('change', () => { for (const chart of charts) { chart.spec.y.log = box.checked; if (chart.over) chart.render(); } });
}

Object.assign(CHARTED, {
  response(host, name, tables) {
    const rows = tables.get(`${name}.csv`)?.rows;
    if (!rows?.length) return [];
    const moves = (own) => own.some((row) => row.major_um > 1e-6);
    const high = (own) => own.reduce((most, row) => Math.max(most, row.major_um), 0);
    const every = [...grouped(rows, 'body', 'point', 'order')].filter(([, own]) => own.length > 1 && moves(own));
    const largest = Math.max(...every.filter(([, own]) => own[0].order !== 0).map(([, own]) => high(own)), 0);
    // Once a turn of each body first, then by their size; what is small beside the largest is in the file.
    const rank = (own) => (own[0].order === 1 ? 0 : own[0].order === 0 ? 2 : 1);
    const told = every.filter(([, own]) => own[0].order === 0 || high(own) >= 0.01 * largest).sort(([, a], [, b]) => rank(a) - rank(b) || (rank(a) === 1 ? high(b) - high(a) : 0));
    const all = told.slice(0, 24);
    const charts = [];
    const unstable = [...((analyses?.analyses || []).find((own) => own.name === name)?.text || '').matchAll(/^UNSTABLE above ([\d.]+) rpm/gm)].map((own) => ({ x: Number(own[1]), name: `unstable above ${shown(Number(own[1]), 5)}` }));
    const several = new Set(rows.map((row) => row.body)).size > 1;
    const found = (tables.get(`${name}.peaks.csv`)?.rows || []).filter((row) => typeof row.major_um !== 'number' || row.major_um > 1e-6);
    const beside = grouped(tables.get(`${name}.near.csv`)?.rows || [], 'body', 'point', 'order');
    for (const [key, tabled] of all) {
      const [{ body, point, order }] = tabled;
      // Peaks lie between the speeds of the table.
      const own = [...tabled, ...(beside.get(key) || [])].sort((a, b) => a.speed_rpm - b.speed_rpm);
      const x = speedOf(name);
      const where = point.replace(/^(joint|output)\./, '$1 ');
      const title = order === 0 ? `${where}, mean position` : `${where}, ${order}X${several ? ` of ${body}` : ''}`;
      const id = slug(`${name} ${body} ${point} ${order}`);
      const ran = inTheRun(name, body, point, order);
      const peaks = found.filter((row) => row.body === body && row.point === point && row.order === order && typeof row.major_um === 'number');
      charts.push(new Chart(host, {
        id: `bode-${id}`, title, zero: true, sync: `speed ${name}`, x, y: { label: /^joint/.test(point) ? 'displacement in the joint' : 'displacement', unit: 'µm', amplitude: order !== 0 },
        series: order === 0
          ? [line(own, 'speed_rpm', 'x_um', 'x'), line(own, 'speed_rpm', 'y_um', 'y')].map((one, k) => ({ ...one, y: one.y.map((value, at) => value * Math.cos((Math.PI * own[at][`${'xy'[k]}_phase_deg`]) / 180)) }))
          : [line(own, 'speed_rpm', 'x_um', 'x'), line(own, 'speed_rpm', 'y_um', 'y'), line(own, 'speed_rpm', 'major_um', 'major semi-axis of the orbit', { style: 6, dash: '2 3' }), ...ran.series],
        dots: [...peaks.map((row) => ({ x: row.speed_rpm, y: row.major_um, style: 1, name: 'peak', label: `${shown(row.speed_rpm, 5)} rpm` })), ...ran.dots],
        marks: [...unstable, ...runMarks(name)], note: [peaks.length ? 'peaks are of the major semi-axis' : '', ran.note].filter(Boolean).join('; '),
      }));
      if (order !== 0) new Chart(host, {
        id: `bode-phase-${id}`, title: `${title}: phase`, sync: `speed ${name}`, x, y: { label: 'phase', unit: '°' }, marks: runMarks(name),
        series: ['x', 'y'].map((axis) => { const phase = line(own, 'speed_rpm', `${axis}_phase_deg`, axis); // What does not move has no phase.
        return { ...phase, y: unwrapped(phase.y.map((value, k) => (own[k][`${axis}_um`] > 0 ? value : NaN))) }; }),
      });
    }
    if (!every.some(([, own]) => own[0].order !== 0)) add(host, 'p', 'Nothing in the case excites the machine once a turn, or by a multiple of that: the response is zero but for rounding.', { class: 'soft wide' });
    logarithmic(host, charts.filter((chart) => chart.spec.y.amplitude));
    if (every.length > all.length) add(host, 'p', `${every.length - all.length} more curves, ${told.length > all.length ? 'the smaller ones' : 'below 1 % of the largest'}, are in ${name}.csv.`, { class: 'soft wide' });
    if (found.length) {
      const more = add(host, 'div', undefined, { class: 'wide' });
      add(more, 'h3', 'Peaks');
      const [told_, high_] = [found.filter((row) => row.order > 0), 0.01 * Math.max(...found.map((own) => own.major_um || 0))];
      const left_ = told_.filter((row) => typeof row.major_um === 'number' && row.major_um <= high_).length;
      if (left_) add(more, 'p', `Of ${told_.length} peaks ${left_} below 1 % of the largest are only in ${name}.peaks.csv.`, { class: 'soft' });
      const several_ = several || new Set(found.map((row) => row.order)).size > 1;
      table(more, ['point', ...(several_ ? ['order'] : []), `speed${whose(name)} (rpm)`, ['major semi-axis', 'µm'], 'amplification factor'], found.filter((row) => row.order > 0 && (typeof row.major_um !== 'number' || row.major_um > 0.01 * Math.max(...found.map((own) => own.major_um || 0)))).slice(0, 60).map((row) => [row.point.replace(/^(joint|output)\./, '$1 '), ...(several_ ? [`${row.order}X of ${row.body}`] : []), shown(row.speed_rpm, 5), typeof row.major_um === 'number' ? [row.major_um, 'µm'] : 'undamped', typeof row.amplification_factor === 'number' ? `${shown(row.amplification_factor, 4)}${/^(below|above)$/.test(row.half_power) ? ` (by the side ${row.half_power})` : ''}` : '–']), several_ ? [1] : []);
    }
    return all.length ? [`${name}.svg`] : [];
  },
});
