// Joints in the picture of the machine.

// Points of a ring where a joint stands.
const RING = 40;

// The radius at which a body is seen at a z, about an axis.
function radiusAt(own, axis, z) {
  const { points, nodes, body } = own;
  let [low, high, nearest] = [Infinity, -Infinity, Infinity];
  for (let k = 0; k < nodes; k++) { const at = points[3 * k + 2]; low = Math.min(low, at); high = Math.max(high, at); nearest = Math.min(nearest, Math.abs(at - z)); }
  const reach_ = nearest + 0.005 * (high - low);
  let most = 0;
  for (let k = 0; k < nodes; k++) if (Math.abs(points[3 * k + 2] - z) <= reach_) most = Math.max(most, Math.hypot(points[3 * k] + body.axis[0] - axis[0], points[3 * k + 1] + body.axis[1] - axis[1]));
  return most;
}

// Where joints stand, as triangles: rings about the journals with struts between them, a foot on the ground, a dot at a point.
function marked(joints, bodies, size) {
  const [points, triangles, names] = [[], [], []];
  const quad = (a, b, c, d) => { const k = points.length / 3; points.push(...a, ...b, ...c, ...d); triangles.push(k, k + 1, k + 2, k, k + 2, k + 3); };
  const dot = (at, r) => {
    const corners = [[r, 0, 0], [0, r, 0], [-r, 0, 0], [0, -r, 0]].map((own) => own.map((x, k) => x + at[k]));
    for (const end of [r, -r]) corners.forEach((own, k) => quad(own, corners[(k + 1) % 4], [at[0], at[1], at[2] + end], [at[0], at[1], at[2] + end]));
  };
  for (const { name, of, to, axis, z, radius, point, angle, named_at, exact } of joints) {
    const shown_ = bodies.find((own) => own.body.name === of);
    const [first, last] = [Math.min(...z), Math.max(...z)];
    const middle = 0.5 * (first + last);
    const r = exact ? radius : point ? 0.015 * size : 1.02 * (Math.max(radius || 0, !radius || shown_?.body.sketched ? (shown_ ? radiusAt(shown_, axis, middle) : 0) : 0) || 0.1 * size);
    const at = (turn, z_, far = r) => [axis[0] + far * Math.cos(turn), axis[1] + far * Math.sin(turn), z_];
    const half = 0.006 * size;
    if (point) dot([...axis, middle], r);
    else if (angle !== null) dot(at(angle, middle), 2 * half);
    else {
      for (const own of new Set(z)) for (let k = 0; k < RING; k++) { const [a, b] = [k, k + 1].map((one) => (2 * Math.PI * one) / RING); quad(at(a, own - half), at(b, own - half), at(b, own + half), at(a, own + half)); }
      const wide = Math.min(half / r, 0.3);
      if (last > first) for (let k = 0; k < 8; k++) { const a = (2 * Math.PI * k) / 8; quad(at(a - wide, first), at(a + wide, first), at(a + wide, last), at(a - wide, last)); }
    }
    if (to === null && angle === null) {
      const [tip, tall, wide] = [[axis[0] - r, axis[1], middle], 0.06 * size, 0.035 * size];
      const base = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([b, c]) => [tip[0] - tall, tip[1] + wide * b, tip[2] + wide * c]);
      base.forEach((own, k) => quad(tip, tip, own, base[(k + 1) % 4]));
      quad(...base);
    }
    if (name) names.push({ name, at: at(named_at, middle, r + 0.01 * size) });
  }
  return { points: new Float32Array(points), triangles: new Uint32Array(triangles), names };
}
