// Maps: what lies over two axes as colours.

// Colours of amplitudes over so many dB: dark to light, told apart without colour.
const DECIBELS = 60;
const SCALE = [[13, 8, 35], [60, 15, 92], [120, 28, 109], [178, 50, 90], [222, 89, 52], [247, 151, 29], [250, 214, 96], [252, 253, 200]];
function colour(share) {
  const at = Math.min(Math.max(share, 0), 1) * (SCALE.length - 1);
  const k = Math.min(Math.floor(at), SCALE.length - 2);
  return SCALE[k].map((own, c) => Math.round(own + (at - k) * (SCALE[k + 1][c] - own)));
}

// Where a value is on the scale: amplitudes by decibels, what has a least value evenly from there to the largest.
function shareOf({ least, largest }, value) {
  if (least !== undefined) return largest > least ? (value - least) / (largest - least) : 0;
  return 1 + (20 * Math.log10(Math.max(value / largest, 1e-9))) / DECIBELS;
}

// Places on the scale, and what stands beside them.
function steps({ least, largest }, factor) {
  if (least !== undefined) return [0, 0.25, 0.5, 0.75, 1].map((share) => [share, shown((least + share * (largest - least)) * factor, 3)]);
  return [0, -20, -40, -60].map((db) => [1 + db / DECIBELS, shown(largest * factor * 10 ** (db / 20), 2)]);
}

// A map as a PNG: `columns` cells from left to right, rows wherever `row` finds them.
function picture(map) {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [map.columns, 240];
  const context = canvas.getContext('2d');
  const image = context.createImageData(canvas.width, canvas.height);
  for (let j = 0; j < canvas.height; j++) {
    const y = map.view.y1 - ((j + 0.5) / canvas.height) * (map.view.y1 - map.view.y0);
    const row = map.row(y);
    for (let i = 0; i < map.columns; i++) {
      const own = colour(shareOf(map, map.value(row, i)));
      image.data.set([...own, 255], 4 * (j * canvas.width + i));
    }
  }
  context.putImageData(image, 0, 0);
  return canvas.toDataURL('image/png');
}
