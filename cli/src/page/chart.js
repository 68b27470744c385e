// Charts as SVG: lines over an axis, paths, and maps. Each can be read back: `chart.values()` gives what is shown, in the units shown.

const DASHES = ['', '7 3', '3 2', '9 3 2 3', '1.5 2.5', '12 4', ''];
// Decades of a logarithmic axis.
const DECADES = 4;
const MARGIN = { left: 64, right: 14, top: 8, bottom: 44 };

class Chart {
  // `spec`: id, title, x: {label, unit}, y: {label, unit, amplitude}, series: [{name, x, y | least and most, style, path, words,
  // pieces: [{x, y, dash}]}], marks, levels, dots: [{x, y, style, label}], circles, arrows, equal, height, sync, map, zero, top, origin, note.
  // With x.log the abscissae are logarithms to the base of 10; with x.names they are 1, 2, … and stand for these. With y.log the
  // ordinates are drawn by theirs.
  constructor(host, spec) {
    Object.assign(this, { spec, view: null, cursor: null, hidden: new Set() });
    this.figure = document.createElement('figure');
    this.figure.className = 'chart';
    // Joints and outputs may have one name.
    while (document.getElementById(spec.id)) spec.id += '-too';
    this.figure.id = spec.id;
    this.figure.tabIndex = 0;
    this.figure.setAttribute('role', 'group');
    this.figure.innerHTML = '<figcaption></figcaption><div class="legend"></div><svg class="plot" xmlns="http://www.w3.org/2000/svg"></svg>';
    this.figure.querySelector('figcaption').textContent = spec.title;
    this.svg = this.figure.querySelector('svg');
    this.legend = this.figure.querySelector('.legend');
    host.append(this.figure);
    this.listen();
    Chart.all.push(this);
    Chart.seen.observe(this.figure);
  }

  // An abscissa in words.
  told(value, digits) {
    const { log, names } = this.spec.x;
    if (names) return escaped(names[Math.round(value) - 1] ?? '');
    if (log && digits === undefined) return `10${[...String(value)].map((digit) => ({ '-': '⁻' })[digit] || '⁰¹²³⁴⁵⁶⁷⁸⁹'[digit]).join('')}`;
    return shown(log ? 10 ** value : value, digits);
  }

  // Where an ordinate is drawn on its axis.
  high(y) { return !this.spec.y.log ? y : y > 0 ? Math.log10(y) : NaN; }

  get zoomable() { return !this.spec.map; }

  axis(which) {
    const own = this.spec[which];
    const [unit, factor] = Units.of(own.unit || '');
    const amplitude = own.amplitude ? Amplitudes.factor : 1;
    const words = own.amplitude ? `, ${Amplitudes.words}` : '';
    return { label: own.label + words + (unit && unit !== '1' ? ` (${unit})` : ''), factor: factor * amplitude, unit };
  }

  // What is drawn, in the units shown.
  values() {
    const [fx, fy] = [this.axis('x').factor, this.axis('y').factor];
    const scaled = (all, factor) => all && Array.from(all, (own) => own * factor);
    return {
      title: this.spec.title, x: this.axis('x').label, y: this.axis('y').label, view: this.shownView(),
      series: this.spec.series.map((own) => ({
        name: own.name, x: scaled(own.x, fx), y: scaled(own.y, fy), least: scaled(own.least, fy), most: scaled(own.most, fy),
      })),
      marks: this.spec.marks, readout: this.legend.textContent,
    };
  }

  shownView() {
    const v = this.range();
    const [fx, fy] = [this.axis('x').factor, this.axis('y').factor];
    const y = [v.y0, v.y1].map((own) => (this.spec.y.log ? 10 ** own : own) * fy);
    return { x: [v.x0 * fx, v.x1 * fx], y };
  }

  // First and last place of a rising series within the view.
  within(own, x0, x1) {
    const place = (at) => {
      let [low, high] = [0, own.x.length];
      while (low < high) { const middle = (low + high) >> 1; if (own.x[middle] < at) low = middle + 1; else high = middle; }
      return low;
    };
    return [Math.max(place(x0) - 1, 0), Math.min(place(x1) + 1, own.x.length)];
  }

  get visible() { return this.spec.series.filter((own) => !this.hidden.has(own.name)); }

  range() {
    const spec = this.spec;
    if (spec.map) return spec.map.view;
    let [x0, x1] = spec.range || [Infinity, -Infinity];
    if (!spec.range) {
      for (const own of spec.series) for (const x of own.path ? own.x : [own.x[0], own.x[own.x.length - 1]]) { if (x < x0) x0 = x; if (x > x1) x1 = x; }
    }
    if (this.view) [x0, x1] = this.view;
    let [y0, y1] = [Infinity, -Infinity];
    const take = (all, from, to) => { for (let k = from; k < to; k++) { const y = this.high(all[k]); if (y < y0) y0 = y; if (y > y1) y1 = y; } };
    for (const own of this.visible) {
      const [from, to] = own.path ? [0, own.x.length] : this.within(own, x0, x1);
      if (own.y) take(own.y, from, to); else { take(own.least, from, to); take(own.most, from, to); }
    }
    for (const circle of spec.circles || []) {
      if (circle.r > 0 && spec.framed) { x0 = Math.min(x0, -circle.r); x1 = Math.max(x1, circle.r); y0 = Math.min(y0, -circle.r); y1 = Math.max(y1, circle.r); }
    }
    for (const level of spec.levels || []) if (level.framed) take([level.y], 0, 1);
    if (spec.origin) { x0 = Math.min(x0, 0); x1 = Math.max(x1, 0); y0 = Math.min(y0, 0); y1 = Math.max(y1, 0); }
    if (spec.top) y1 = Math.max(y1, spec.top);
    const zero = spec.zero && !spec.y.log;
    if (zero) y0 = Math.min(y0, 0);
    // Below a few decades nothing is looked for.
    if (spec.y.log) y0 = Math.max(y0, y1 - DECADES);
    if (!(x1 > x0)) { const d = Math.abs(x0) || 1; x0 -= 0.05 * d; x1 += 0.05 * d; }
    if (!Number.isFinite(y0)) [y0, y1] = [0, 1];
    if (!(y1 - y0 > 1e-9 * Math.max(Math.abs(y0), Math.abs(y1)))) { const d = Math.abs(y0) || 1; y0 -= 0.1 * d; y1 += 0.1 * d; }
    const pad = 0.05 * (y1 - y0);
    if (spec.equal) { const px = 0.05 * (x1 - x0); return { x0: x0 - px, x1: x1 + px, y0: y0 - pad, y1: y1 + pad }; }
    return { x0, x1, y0: zero && y0 === 0 ? 0 : y0 - pad, y1: y1 + pad };
  }

  render() {
    const spec = this.spec;
    const width = Math.max(240, Chart.printing ? (spec.equal ? 230 : 345) : this.figure.clientWidth || 520);
    const inner = { left: MARGIN.left, top: MARGIN.top, width: width - MARGIN.left - MARGIN.right - (spec.map ? 62 : 0) };
    let v = this.range();
    if (spec.equal) {
      // One unit has the same length on both axes, in a square.
      inner.height = inner.width;
      const scale = Math.max((v.x1 - v.x0) / inner.width, (v.y1 - v.y0) / inner.height) / 2;
      const [cx, cy] = [(v.x0 + v.x1) / 2, (v.y0 + v.y1) / 2];
      v = { x0: cx - scale * inner.width, x1: cx + scale * inner.width, y0: cy - scale * inner.height, y1: cy + scale * inner.height };
    } else {
      inner.height = spec.height || Math.min(230, 0.5 * width + 20);
    }
    const height = inner.top + inner.height + MARGIN.bottom;
    const [ax, ay] = [this.axis('x'), this.axis('y')];
    const px = (x) => inner.left + ((x - v.x0) / (v.x1 - v.x0)) * inner.width;
    const py = (y) => inner.top + inner.height - ((this.high(y) - v.y0) / (v.y1 - v.y0)) * inner.height;
    Object.assign(this, { width, height, inner, drawn: v, px, py });
    const out = [];
    const clip = `clip-${spec.id}`;
    out.push(`<defs><clipPath id="${clip}"><rect x="${inner.left}" y="${inner.top}" width="${inner.width}" height="${inner.height}"/></clipPath></defs>`);
    const right = inner.left + inner.width;
    const bottom = inner.top + inner.height;
    const { names, log } = spec.x;
    const whole = ticks(v.x0 * ax.factor, v.x1 * ax.factor, names || log ? Math.min(inner.width / 60, v.x1 - v.x0) : inner.width / 80, ax.unit);
    for (const tick of whole.filter((own) => !(names || log) || Number.isInteger(own))) {
      const x = px(tick / ax.factor).toFixed(1);
      const [text, edge] = [this.told(tick), width - 3];
      const end = Number(x) + 3.3 * text.length > edge;
      out.push(`<line class="grid-line" x1="${x}" x2="${x}" y1="${inner.top}" y2="${bottom}"/><text x="${end ? edge : x}" y="${bottom + 15}" text-anchor="${end ? 'end' : 'middle'}">${text}</text>`);
    }
    for (const tick of (spec.y.log ? rungs(v, ay.factor) : ticks(v.y0 * ay.factor, v.y1 * ay.factor, inner.height / 42, ay.unit))) {
      const y = py(tick / ay.factor).toFixed(1);
      out.push(`<line class="grid-line" x1="${inner.left}" x2="${right}" y1="${y}" y2="${y}"/><text x="${inner.left - 6}" y="${Number(y) + 4}" text-anchor="end">${Math.abs(tick) >= 1e5 ? shown(tick / 10 ** Math.floor(Math.log10(Math.abs(tick)))) + 'e' + Math.floor(Math.log10(Math.abs(tick))) : shown(tick)}</text>`);
    }
    if (spec.map) this.drawMap(out, clip);
    out.push(`<rect class="frame" x="${inner.left}" y="${inner.top}" width="${inner.width}" height="${inner.height}"/>`);
    out.push(`<text class="axis" x="${(inner.left + right) / 2}" y="${height - 8}" text-anchor="middle">${escaped(ax.label)}</text>`);
    out.push(`<text class="axis" transform="translate(13 ${(inner.top + bottom) / 2}) rotate(-90)" text-anchor="middle">${escaped(ay.label)}</text>`);
    out.push(`<g clip-path="url(#${clip})">`);
    for (const own of spec.circles || []) {
      if (own.r > 0) out.push(`<circle class="limit" cx="${px(0).toFixed(1)}" cy="${py(0).toFixed(1)}" r="${(px(own.r) - px(0)).toFixed(1)}"/>`);
    }
    for (const own of spec.levels || []) {
      const y = py(own.y).toFixed(1);
      out.push(`<line class="level" x1="${inner.left}" x2="${right}" y1="${y}" y2="${y}"/><text x="${right - 4}" y="${Number(y) - 4}" text-anchor="end">${escaped(own.name)}</text>`);
    }
    // A mark and its name stand or fall together, so that no name stands at another one's line: the first ones come first.
    const marked_ = [];
    for (const own of spec.marks || []) {
      if (own.x < v.x0 || own.x > v.x1) continue;
      const x = px(own.x);
      const wide = 6.2 * own.name.length + 6;
      const left = x + wide > right;
      const [from, to] = left ? [x - wide, x] : [x, x + wide];
      const row = [0, 1, 2].find((line_) => marked_.every((other) => other.row !== line_ || other.to < from || other.from > to));
      if (own.name && row === undefined) continue;
      marked_.push({ row, from, to });
      out.push(`<line class="mark" x1="${x.toFixed(1)}" x2="${x.toFixed(1)}" y1="${inner.top}" y2="${bottom}"/>`);
      if (own.name) out.push(`<text class="label" x="${(left ? x - 3 : x + 3).toFixed(1)}" y="${inner.top + 11 + 13 * row}" text-anchor="${left ? 'end' : 'start'}">${escaped(own.name)}</text>`);
    }
    spec.series.forEach((own, k) => {
      if (this.hidden.has(own.name)) return;
      const style = own.style ?? k % 7;
      const dash = own.dash ?? DASHES[style];
      for (const piece of own.pieces || [{ ...own, dash }]) out.push(`<path class="line ${own.className || `s${style}`}" ${piece.dash ? `stroke-dasharray="${piece.dash}"` : ''} d="${own.path ? this.path(own) : this.line(piece, v, inner)}"/>`);
      if (own.arrows) for (const at of own.arrows) out.push(this.arrow(own, at, style));
    });
    const [labels, dots] = [this.tags(out, v), []];
    const placed = (spec.dots || []).map((own) => [px(own.x), py(own.y)]);
    for (const own of spec.dots || []) {
      const [x, y] = [px(own.x), py(own.y)];
      dots.push(`<circle class="f${own.style ?? 1}" cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="3.6"/>`);
      if (!own.label) continue;
      // Beside its dot where no other label is.
      const wide = 6.4 * own.label.length;
      const spots = [[6, -5], [6, 13], [-6 - wide, -5], [-6 - wide, 13], [6, -18], [-6 - wide, -18], [6, 26], [-6 - wide, 26]].map(([dx, dy]) => [x + dx, y + dy]);
      const fits = ([a, b]) => a > inner.left && a + wide < right && b > inner.top + 9 && b < bottom && labels.every((other) => a > other[0] + other[2] || a + wide < other[0] || Math.abs(b - other[1]) > 12) && placed.every(([dx, dy]) => dx < a - 3 || dx > a + wide + 3 || dy < b - 12 || dy > b + 5);
      const spot = spots.find(fits);
      if (!spot) continue;
      labels.push([...spot, wide]);
      out.push(`<text class="label" x="${spot[0].toFixed(1)}" y="${spot[1].toFixed(1)}">${escaped(own.label)}</text>`);
    }
    out.push(...dots);
    out.push('<g class="over"></g></g>');
    this.svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.svg.innerHTML = out.join('');
    this.over = this.svg.querySelector('.over');
    this.figure.setAttribute('aria-label', `${spec.title}: ${ay.label} over ${ax.label}`);
    this.tell();
  }

  // A rising series, of each pixel the first, least, largest and last value.
  line(own, v, inner) {
    const { px, py } = this;
    const [from, to] = this.within(own, v.x0, v.x1);
    const parts = [];
    const add = (x, y) => { if (Number.isFinite(y)) parts.push(`${parts.length ? 'L' : 'M'}${x.toFixed(1)} ${y.toFixed(1)}`); };
    if (!own.y) {
      let up = true;
      this.pixels(own, from, to, (x, least, most) => {
        add(x, py(up ? least : most));
        add(x, py(up ? most : least));
        up = !up;
      });
    } else if (to - from <= 2 * inner.width) {
      let lift = true;
      for (let k = from; k < to; k++) {
        const y = own.y[k];
        if (!Number.isFinite(this.high(y))) lift = true;
        if (!Number.isFinite(this.high(y))) continue;
        parts.push(`${lift ? 'M' : 'L'}${px(own.x[k]).toFixed(1)} ${py(y).toFixed(1)}`);
        lift = false;
      }
    } else {
      let [at, first, least, most, last] = [NaN, 0, 0, 0, 0];
      const flush = () => { if (!Number.isNaN(at)) { for (const y of [first, least, most, last]) add(at, py(y)); } };
      for (let k = from; k < to; k++) {
        const x = Math.round(px(own.x[k]));
        const y = own.y[k];
        if (x !== at) { flush(); [at, first, least, most] = [x, y, y, y]; }
        if (y < least) least = y;
        if (y > most) most = y;
        last = y;
      }
      flush();
    }
    return parts.join('');
  }

  // Least and largest values a pixel.
  pixels(own, from, to, each) {
    const { px } = this;
    let [at, least, most] = [NaN, 0, 0];
    const few = to - from <= this.inner.width;
    for (let k = from; k < to; k++) {
      const x = few ? px(own.x[k]) : Math.round(px(own.x[k]));
      if (x !== at) { if (!Number.isNaN(at)) each(at, least, most); [at, least, most] = [x, own.least[k], own.most[k]]; }
      least = Math.min(least, own.least[k]);
      most = Math.max(most, own.most[k]);
    }
    if (!Number.isNaN(at)) each(at, least, most);
  }

  path(own) {
    const { px, py } = this;
    const parts = [];
    for (let k = 0; k < own.x.length; k++) parts.push(`${k ? 'L' : 'M'}${px(own.x[k]).toFixed(1)} ${py(own.y[k]).toFixed(1)}`);
    return parts.join('');
  }

  // Short names at the right ends of lines, where no other one is.
  tags(out, v) {
    const placed = [];
    for (const own of this.visible) {
      if (own.tag === undefined) continue;
      const [, to] = this.within(own, v.x0, v.x1);
      let at = to - 1;
      while (at >= 0 && !(own.x[at] <= v.x1 && this.high(own.y[at]) >= v.y0 && this.high(own.y[at]) <= v.y1)) at--;
      if (at < 0) continue;
      const wide = 6.4 * String(own.tag).length;
      const [x, y] = [this.px(own.x[at]) - wide - 3, this.py(own.y[at]) - 3];
      if (placed.some(([a, b, w]) => x < a + w && a < x + wide && Math.abs(b - y) < 11)) continue;
      placed.push([x, y, wide]);
      out.push(`<text class="label" x="${x.toFixed(1)}" y="${y.toFixed(1)}">${escaped(own.tag)}</text>`);
    }
    return placed;
  }

  // A head that points the way of time at a place of a path.
  arrow(own, at, style) {
    const { px, py } = this;
    const [x, y] = [px(own.x[at]), py(own.y[at])];
    let back = at - 1;
    while (back > 0 && Math.hypot(px(own.x[back]) - x, py(own.y[back]) - y) < 6) back--;
    const angle = Math.atan2(y - py(own.y[back]), x - px(own.x[back]));
    const corner = (turn, size) => `${(x + size * Math.cos(angle + turn)).toFixed(1)} ${(y + size * Math.sin(angle + turn)).toFixed(1)}`;
    return `<path class="f${style}" d="M${corner(0, 6)}L${corner(2.5, 6)}L${corner(-2.5, 6)}Z"/>`;
  }

  drawMap(out, clip) {
    const { map } = this.spec;
    const { inner } = this;
    if (!map.image) map.image = picture(map);
    out.push(`<g clip-path="url(#${clip})"><image x="${inner.left}" y="${inner.top}" width="${inner.width}" height="${inner.height}" preserveAspectRatio="none" href="${map.image}"/></g>`);
    // The scale of colours.
    const [x, w] = [inner.left + inner.width + 12, 10];
    for (let k = 0; k < 60; k++) {
      const y = inner.top + inner.height * (1 - (k + 1) / 60);
      out.push(`<rect x="${x}" y="${y.toFixed(1)}" width="${w}" height="${(inner.height / 60 + 0.5).toFixed(1)}" fill="rgb(${colour((k + 0.5) / 60)})"/>`);
    }
    for (const [share, text] of steps(map, this.axis('z').factor)) {
      const y = inner.top + inner.height * (1 - share);
      out.push(`<text x="${x + w + 3}" y="${(y + (share < 1 ? 3 : 9)).toFixed(1)}">${text}</text>`);
    }
  }

  // The legend, with the values at the cursor.
  tell() {
    const { spec } = this;
    const [ax, ay] = [this.axis('x'), this.axis('y')];
    const parts = [];
    if (this.cursor !== null && spec.map) {
      const own = spec.map.at(this.cursor[0], this.cursor[1]);
      const z = this.axis('z');
      if (own) parts.push(`<span><b>${shown(own.x * ax.factor)}</b> ${escaped(ax.unit)}, <b>${shown(own.y * ay.factor)}</b> ${escaped(ay.unit)}: <b>${shown(own.value * z.factor, 4)}</b> ${escaped(kindOf(z.unit))}${spec.z.amplitude ? ` ${Amplitudes.words}` : ''}</span>`);
    } else if (this.cursor !== null) {
      parts.push(`<span>${escaped(spec.x.short || spec.x.label)} <b>${this.told(this.cursor * ax.factor, 6)}</b> ${escaped(ax.unit === '1' ? '' : ax.unit)}</span>`);
    }
    if (spec.map && this.cursor === null) parts.push(`<span>colour: ${escaped(this.axis('z').label)}</span>`);
    spec.series.forEach((own, k) => {
      if (own.silent) return;
      const style = own.style ?? k % 7;
      const dash = own.dash ?? DASHES[style];
      let value = '';
      if (this.cursor !== null && !spec.map && own.x.length) {
        const at = this.nearest(own, this.cursor);
        // A line tells nothing beyond its ends.
        const room = 0.02 * (this.drawn.x1 - this.drawn.x0);
        const beyond = !own.path && (this.cursor < own.x[0] - room || this.cursor > own.x[own.x.length - 1] + room);
        value = beyond ? '<b>–</b>' : own.y ? `<b>${shown(own.y[at] * ay.factor)}</b>` : `<b>${shown(own.least[at] * ay.factor)} … ${shown(own.most[at] * ay.factor)}</b>`;
        value = ` ${value} ${escaped(ay.unit === '1' ? '' : ay.unit)}${own.words ? ` ${escaped(own.words[at])}` : ''}`;
      }
      const off = this.hidden.has(own.name) ? ' style="opacity:.4"' : '';
      parts.push(`<span data-name="${escaped(own.name)}"${off}><svg viewBox="0 0 26 8"><path class="line ${own.className ? 's6' : `s${style}`}" stroke-width="2" ${dash ? `stroke-dasharray="${dash}"` : ''} d="M0 4H26"/></svg>${escaped(own.name)}${value}</span>`);
    });
    for (const own of spec.circles || []) if (own.r > 0 && own.name) parts.push(`<span><svg viewBox="0 0 26 8"><path stroke="var(--mark)" stroke-width="1.5" stroke-dasharray="2 3" d="M0 4H26"/></svg>${escaped(own.name)}</span>`);
    if ((spec.dots || []).length) parts.push(`<span class="wraps"><svg viewBox="0 0 26 8"><circle class="f${spec.dots[0].style ?? 1}" cx="13" cy="4" r="3.6"/></svg>${escaped(spec.dots[0].name)}</span>`);
    if (spec.note) parts.push(`<span class="wraps">${escaped(spec.note)}</span>`);
    this.legend.innerHTML = parts.join('');
  }

  nearest(own, x) {
    if (own.path) return own.x.length - 1;
    const [from] = this.within(own, x, x);
    const to = Math.min(from + 1, own.x.length - 1);
    const next = Math.min(to + 1, own.x.length - 1);
    return [from, to, next].reduce((best, k) => (Math.abs(own.x[k] - x) < Math.abs(own.x[best] - x) ? k : best), from);
  }

  // Shows a cursor at an abscissa, or at a point of a map, or none.
  point(at, alone) {
    this.cursor = at;
    if (!this.over) return;
    if (at === null) this.over.innerHTML = '';
    else if (this.spec.map) this.over.innerHTML = `<circle cx="${this.px(at[0])}" cy="${this.py(at[1])}" r="4" fill="none" stroke="#fff"/>`;
    else { const x = this.px(at).toFixed(1); this.over.innerHTML = `<line class="cursor" x1="${x}" x2="${x}" y1="${this.inner.top}" y2="${this.inner.top + this.inner.height}"/>`; }
    this.tell();
    if (!alone && this.spec.sync) for (const own of Chart.all) if (own !== this && own.spec.sync === this.spec.sync && own.over) own.point(at, true);
  }

  zoom(view) {
    if (!this.zoomable || this.spec.equal) return;
    for (const own of Chart.all) {
      if (own === this || (this.spec.sync && own.spec.sync === this.spec.sync)) { own.view = view; if (own.over) own.render(); }
    }
  }

  // Zooms by a factor about an abscissa, or moves by a part of the view.
  step(factor, about, moved = 0) {
    const { x0, x1 } = this.drawn;
    const width = (x1 - x0) * factor;
    const from = about - (about - x0) * factor + moved * (x1 - x0);
    this.zoom([from, from + width]);
  }

  listen() {
    const at = (event) => {
      const box = this.svg.getBoundingClientRect();
      const x = ((event.clientX - box.left) / box.width) * this.width;
      const y = ((event.clientY - box.top) / box.height) * this.height;
      const { x0, x1, y0, y1 } = this.drawn;
      return [x0 + ((x - this.inner.left) / this.inner.width) * (x1 - x0), y0 + ((this.inner.top + this.inner.height - y) / this.inner.height) * (y1 - y0)];
    };
    const flat = (event) => (this.spec.map ? at(event) : at(event)[0]);
    let begun = null;
    this.svg.addEventListener('pointerdown', (event) => {
      if (event.button || event.pointerType === 'touch') return;
      begun = { x: at(event)[0], view: [this.drawn.x0, this.drawn.x1], pan: event.shiftKey, at: event.clientX };
      this.svg.setPointerCapture(event.pointerId);
    });
    this.svg.addEventListener('pointermove', (event) => {
      if (this.spec.equal) return;
      if (!begun) { this.point(flat(event)); return; }
      if (begun.pan) {
        const moved = ((event.clientX - begun.at) / this.svg.getBoundingClientRect().width) * this.width / this.inner.width * (begun.view[1] - begun.view[0]);
        this.zoom([begun.view[0] - moved, begun.view[1] - moved]);
      } else if (this.zoomable) {
        const [a, b] = [begun.x, at(event)[0]].map((x) => this.px(x)).sort((a, b) => a - b);
        this.over.innerHTML = `<rect class="brush" x="${a}" width="${b - a}" y="${this.inner.top}" height="${this.inner.height}"/>`;
      }
    });
    this.svg.addEventListener('pointerup', (event) => {
      if (!begun) return;
      const [a, b] = [begun.x, at(event)[0]].sort((a, b) => a - b);
      const wide = Math.abs(event.clientX - begun.at) > 5;
      if (wide && !begun.pan) this.zoom([a, b]);
      begun = null;
    });
    this.svg.addEventListener('pointerleave', () => { if (!begun) this.point(null); });
    this.svg.addEventListener('dblclick', () => this.zoom(null));
    this.svg.addEventListener('wheel', (event) => {
      if (!event.ctrlKey || !this.zoomable) return;
      event.preventDefault();
      this.step(event.deltaY > 0 ? 1.25 : 0.8, at(event)[0]);
    }, { passive: false });
    this.legend.addEventListener('click', (event) => {
      const name = event.target.closest('[data-name]')?.dataset.name;
      if (name === undefined || this.spec.series.length < 2) return;
      if (this.hidden.has(name)) this.hidden.delete(name); else if (this.visible.length > 1) this.hidden.add(name);
      this.render();
    });
    this.figure.addEventListener('keydown', (event) => {
      if (this.spec.equal || this.spec.map || event.ctrlKey || event.altKey || event.metaKey) return;
      const { x0, x1 } = this.drawn;
      const middle = this.cursor ?? (x0 + x1) / 2;
      const side = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (side && event.shiftKey) this.step(1, middle, 0.2 * side);
      else if (side) {
        const own = this.visible[0];
        const k = this.nearest(own, middle);
        const fine = own.x[Math.min(Math.max(k + side, 0), own.x.length - 1)];
        // A pixel at least.
        const coarse = middle + (side * (x1 - x0)) / this.inner.width;
        this.point(Math.min(Math.max(this.cursor === null ? middle : side > 0 ? Math.max(fine, coarse) : Math.min(fine, coarse), x0), x1));
      } else if (event.key === '+' || event.key === '=') this.step(0.7, middle);
      else if (event.key === '-') this.step(1 / 0.7, middle);
      else if (event.key === '0' || event.key === 'Home') this.zoom(null);
      else if (event.key === 'Escape') this.point(null);
      else return;
      event.preventDefault();
    });
  }

  static renderAll() { for (const own of Chart.all) if (own.over || Chart.printing) own.render(); }
}
Chart.all = [];
Chart.printing = false;
// Charts are drawn when they come near the window, and again when their width changes.
Chart.seen = new IntersectionObserver((entries) => {
  for (const entry of entries) {
    if (!entry.isIntersecting) continue;
    const own = Chart.all.find((chart) => chart.figure === entry.target);
    Chart.seen.unobserve(entry.target);
    if (own && !own.over) own.render();
  }
}, { rootMargin: '600px' });
