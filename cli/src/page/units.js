// Units, numbers as they are shown, and where axes have their lines.

const Units = {
  system: 'si',
  us: {
    'µm': ['mil', 1 / 25.4], 'mm': ['in', 1 / 25.4], 'N': ['lbf', 1 / 4.4482216152605], 'mm/s': ['in/s', 1 / 25.4],
    'm/s²': ['g', 1 / 9.80665], 'N·m': ['lbf·ft', 1 / 1.3558179483314004], 'W': ['hp', 1 / 745.6998715822702],
    'J': ['ft·lbf', 1 / 1.3558179483314004], 'MPa': ['ksi', 1 / 6.894757293168361],
  },
  // The unit shown for one, and the factor to it.
  of(unit) { return (this.system === 'us' && this.us[unit]) || [unit, 1]; },
};

// Amplitudes are carried from 0 to the peak.
const Amplitudes = { factor: 1, get words() { return this.factor === 1 ? '0-pk' : 'pk-pk'; } };

function shown(value, digits = 5) {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(digits - 1).replace(/\.?0+e/, 'e').replace('e+', 'e').replaceAll('-', '−');
  return String(Number(value.toPrecision(digits))).replace('-', '−');
}

function escaped(text) {
  return String(text).replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);
}

// Round numbers from `from` to `to`, about so many.
function ticks(from, to, count, unit) {
  const rough = (to - from) / Math.max(count, 1);
  if (!(rough > 0) || !Number.isFinite(rough)) return [];
  const power = 10 ** Math.floor(Math.log10(rough));
  // Angles that people know.
  const known = unit === '°' && rough > 20 && rough <= 360 ? [30, 45, 90, 180, 360].find((k) => k >= rough * 0.999) : 0;
  const step = known || power * [1, 2, 5, 10].find((k) => k * power >= rough * 0.999);
  const at = (own) => {
    const all = [];
    for (let k = Math.ceil(from / own - 1e-9); k * own <= to + 1e-9 * own; k++) all.push(Number((k * own).toPrecision(12)));
    return all;
  };
  // One or two say little of a scale.
  const few = at(step);
  return few.length > 2 || known ? few : at(step / (step === 2 * power ? 2 : 2.5));
}

// The same of an axis by decades: `v` has logarithms to the base of 10.
function rungs(v, factor) {
  const [low, high] = [10 ** v.y0 * factor, 10 ** v.y1 * factor];
  const parts = v.y1 - v.y0 > 2.5 ? [1] : v.y1 - v.y0 > 0.7 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9];
  const all = [];
  for (let decade = Math.floor(Math.log10(low)); decade <= Math.log10(high); decade++) for (const part of parts) all.push(Number((part * 10 ** decade).toPrecision(3)));
  return all.filter((own) => own >= low && own <= high);
}

