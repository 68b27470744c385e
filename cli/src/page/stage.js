// The machine in space on the page: what is chosen above the picture and said below it, of a run and of analyses.

let scene = null;
const scenes = [];

// A canvas with the bodies of shapes, and what is chosen above it: none where the browser cannot draw it.
function stage(own, shapes, about_) {
  const choose = add(own, 'div', undefined, { class: 'choose screen' });
  const frame = add(own, 'div', undefined, { class: 'framed' });
  const canvas = add(frame, 'canvas', undefined, { class: 'scene', tabindex: 0, role: 'img', 'aria-label': about_ });
  let made;
  try { made = new Scene(canvas, shapes); } catch (error) {
    frame.remove();
    choose.remove();
    add(own, 'p', `This browser cannot draw it (${error.message}).`);
    return null;
  }
  scenes.push(made);
  const changed = (change) => (value) => { change(value); made.draw(); };
  const check = (words, on, change) => { const box = add(add(choose, 'label'), 'input', undefined, { type: 'checkbox' }); box.after(` ${words}`); box.checked = on; box.addEventListener('change', () => changed(change)(box.checked)); };
  const select = (words, options, value, change) => {
    const box = add(add(choose, 'label', `${words} `), 'select');
    for (const [group, all] of Array.isArray(options) ? [['', options]] : Object.entries(options)) {
      const host = group ? add(box, 'optgroup', undefined, { label: group }) : box;
      for (const [name, text] of all) add(host, 'option', text, { value: name });
    }
    box.value = value;
    box.addEventListener('change', () => changed(change)(box.value));
    return box;
  };
  // Plays by steps, each from 0 up to an end.
  const player = (end, perStep, at, set, words) => {
    const button = add(choose, 'button', 'Play', { type: 'button' });
    const slide = add(add(choose, 'label', `${words} `), 'input', undefined, { type: 'range', min: 0, max: end, step: 'any', value: 0 });
    let playing = false;
    const step = () => {
      if (!playing) return;
      set((at() + perStep) % end);
      slide.value = at();
      made.draw();
      requestAnimationFrame(step);
    };
    slide.addEventListener('input', () => changed(set)(Number(slide.value)));
    made.play = () => { playing = !playing; button.textContent = playing ? 'Stop' : 'Play'; step(); };
    button.addEventListener('click', made.play);
  };
  const toggles = () => { if (made.marks.count) check('joints', true, (on) => { made.joints = on; }); const names = [...new Set(shapes.bodies.map((body) => body.name))]; if (names.length > 1) for (const name of names) check(name, true, (on) => { if (on) made.off.delete(name); else made.off.add(name); }); };
  add(own, 'p', `Drag turns, Shift and drag moves, Ctrl and the wheel zoom. By keys: arrows turn, + and − zoom, 0 shows all, Space plays.`, { class: 'soft screen' });
  return { made, check, select, player, toggles, choose };
}

// The scale of the colours: to what they reach, in a unit, and whether that is an amplitude.
function ramp(own, ends) {
  const bar = add(own, 'p', undefined, { class: 'soft' });
  const fill = () => {
    bar.replaceChildren();
    const found = ends();
    if (!found) return;
    bar.append('0 ');
    add(bar, 'span', undefined, { class: 'ramp' });
    const factor = found[2] ? Amplitudes.factor : 1;
    bar.append(found[1] ? ` ${shown(found[0] * factor * Units.of(found[1])[1], 4)} ${Units.of(found[1])[0]}${found[2] ? ` ${Amplitudes.words}` : ''}` : ` ${found[0]}`);
  };
  fill();
  redraw.push(fill);
  return fill;
}

// Bodies that the picture has not.
const notShown = ({ left_out, without_shape }) => `${left_out.length ? ` Too large to be shown here: ${left_out.join(', ')}.` : ''}${without_shape?.length ? ` Not drawn, as nothing tells their shape: ${without_shape.join(', ')}.` : ''}`;

function machine() {
  const { shapes } = data;
  if (!shapes) return;
  const own = part('machine', 'The machine');
  const moves = shapes.bodies.some((body) => body.motion);
  const rest = notShown(shapes);
  const played = data.motions.length ? ' Analyses below show its modes and orbits.' : '';
  add(own, 'p', `Bodies, x up: by their meshes${shapes.bodies.some((body) => body.sketched) ? '; what has none as cylinders of the same mass and inertias' : ''}.${shapes.joints?.length ? ' Rings are joints, with a foot where they stand on the ground.' : ''}${played}${rest}`, { class: 'soft' });
  const on = stage(own, shapes, 'The bodies of the machine in space');
  if (!on) return;
  scene = on.made;
  on.toggles();
  if (moves) {
    const said = add(own, 'p', '', { class: 'soft' });
    const say = () => {
      const largest = scene.bodies.filter((one) => one.body.motion).map((one) => `${one.body.name} ${shown(1e6 * one.body.motion.largest * Units.of('µm')[1], 4)} ${Units.of('µm')[0]}${one.body.motion.stress ? `, ${shown(one.body.motion.largest_mpa * Units.of('MPa')[1], 4)} ${Units.of('MPa')[0]} by von Mises` : ''}`).join('; ');
      said.textContent = `t = ${scene.seconds().toFixed(5)} s, displacements ${scene.scale === 1 ? 'as they are' : `${shown(scene.scale)} times as large`}. Largest on the surface in these frames: ${largest}.`;
    };
    on.player(Math.max(scene.frames - 1, 1), 0.15, () => scene.time, (value) => { scene.time = value; say(); }, 'time');
    const scales = [...new Set([1, 10, 100, 1e3, 1e4, 1e5, scene.scale])].sort((a, b) => a - b).filter((one) => one <= 10 * Math.max(scene.scale, 1));
    on.select('displacements', scales.map((one) => [String(one), `\u00d7 ${one}`]), String(scene.scale), (value) => { scene.scale = Number(value); say(); });
    const stresses = shapes.bodies.some((body) => body.motion?.stress);
    scene.colour = stresses ? 'stress' : 'displacement';
    const fill = ramp(own, () => (scene.colour === 'body' ? null : scene.colour === 'stress' ? [Math.max(...scene.bodies.map((one) => one.body.motion?.largest_mpa || 0)), 'MPa'] : [1e6 * scene.largest, 'µm']));
    on.select('colour', [['body', 'bodies'], ['displacement', 'displacement'], ...(stresses ? [['stress', 'stress (von Mises)']] : [])], scene.colour, (value) => { scene.colour = value; fill(); });
    on.check('turn with the bodies', true, (value) => { scene.turning = value; });
    say();
    redraw.push(say);
  }
  scene.draw();
}

// Modes or orbits of an analysis in space.
function inSpace(own, name) {
  const content = data.motions.find((one) => one.name === `${name}.motions.json`)?.content;
  if (!content) return;
  // Surfaces of several analyses are the same, and stand there once.
  const { motions } = content;
  const shapes = typeof content.shapes === 'string' ? data.motions.find((one) => one.name === content.shapes).content.shapes : content.shapes;
  const sized = motions[0].metres !== null;
  add(own, 'h3', sized ? 'Orbits in space' : 'Modes in space');
  const rest = `${notShown(shapes)}${content.left_out ? ` ${content.left_out} more had no room on this page.` : ''}`;
  add(own, 'p', `In the fixed frame, x up: the rotation of the bodies themselves is left out. ${sized ? 'φ counts from where the body that excites them stands at θ = 0.' : 'Amplitudes of modes have no size, and decay and growth are left out; at φ = 0 the point that gets furthest is there.'} Lines are orbits of points at the top of the bodies: blue with the rotation, orange against it, grey neither. Grey is the machine without the motion.${rest}`, { class: 'soft' });
  const on = stage(own, shapes, `Motions of ${name} in space`);
  if (!on) return;
  const { made } = on;
  made.name = name;
  made.colour = 'displacement';
  const groups = {};
  motions.forEach((motion, k) => (groups[motion.group] = groups[motion.group] || []).push([String(k), motion.name]));
  let factor = 'fit';
  const said = add(own, 'p', '', { class: 'soft' });
  const say = () => {
    const { motion } = made;
    const degrees = Math.round((made.angle * 180) / Math.PI);
    const size_ = sized ? ` Displacements ${made.scale === 1 ? 'as they are' : `${shown(made.scale)} times as large`}, the largest ${shown(1e6 * motion.metres * Units.of('µm')[1] * Amplitudes.factor, 4)} ${Units.of('µm')[0]} ${Amplitudes.words}.` : '';
    said.textContent = `${motion.group[0].toUpperCase()}${motion.group.slice(1)}, ${motion.name}. ${motion.words}. φ = ${degrees}°.${size_}`;
  };
  const scaled = () => {
    const fit = (0.14 * made.radius) / Math.max(made.reach, 1e-30);
    made.scale = factor !== 'fit' ? Number(factor) * (sized ? 1 : fit) : sized ? 10 ** Math.floor(Math.log10(fit)) * [5, 2, 1].find((m) => m * 10 ** Math.floor(Math.log10(fit)) <= fit) : fit;
  };
  const show = (k) => { made.show(motions[k]); scaled(); say(); };
  const fill = ramp(own, () => (made.colour === 'body' ? null : sized ? [1e6 * made.motion?.metres || 0, 'µm', true] : ['the largest', null]));
  const box = on.select(sized ? 'orbit' : 'mode', groups, '0', (value) => { show(Number(value)); fill(); });
  on.player(2 * Math.PI, 0.06, () => made.angle, (value) => { made.angle = value; say(); }, 'φ');
  const scales = sized ? [['fit', 'to be seen'], ...[1, 10, 100, 1e3, 1e4, 1e5, 1e6].map((one) => [String(one), `\u00d7 ${one}`])] : [['0.4', 'small'], ['fit', 'to be seen'], ['2.5', 'large']];
  on.select('displacements', scales, 'fit', (value) => { factor = value; scaled(); say(); });
  on.select('colour', [['displacement', 'displacement'], ['body', 'bodies']], 'displacement', (value) => { made.colour = value; fill(); });
  on.check('orbits', true, (value) => { made.orbits = value; });
  on.check('machine at rest', true, (value) => { made.ghost = value; });
  on.toggles();
  const grows = motions.findIndex((motion) => /GROWS/.test(motion.words));
  const first = sized ? motions.reduce((best, motion, k) => (motion.metres > motions[best].metres ? k : best), 0) : Math.max(grows, 0);
  box.value = String(first);
  show(first);
  fill();
  redraw.push(say);
  made.draw();
}
