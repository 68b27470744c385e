// What is embedded in the page, and what its parts are built with.

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
  const beside = [...run.ratios.map((title) => `ratio ${title}`), ...run.teeth.map(({ title }) => `teeth ${title}`)];
  beside.forEach((name, k) => columns.set(name, run.histories.columns[run.names.length + k]));
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
