// The machine in space, by WebGL: surfaces of bodies that turn and deform, one shader: of a cycle a frame and the next mixed, of a
// mode or an orbit a cos φ + b sin φ.

const VERTEX = `#version 300 es
in vec3 place; in vec3 before; in vec3 after; in float sizeBefore; in float sizeAfter;
uniform mat4 view; uniform mat2 turn; uniform vec2 axis; uniform vec2 weights; uniform float scale, largest, stressed;
out vec3 at; out float share;
void main() {
  vec3 moved = weights.x * before + weights.y * after;
  vec3 own = place + scale * moved;
  at = vec3(turn * own.xy + axis, own.z);
  share = stressed > 0.5 ? weights.x * sizeBefore + weights.y * sizeAfter : length(moved) / largest;
  gl_Position = view * vec4(at, 1.0);
}`;
const FRAGMENT = `#version 300 es
precision highp float;
in vec3 at; in float share;
uniform vec3 eye; uniform vec3 plain; uniform vec3 ground; uniform float coloured, fog, dense;
out vec4 colour;
vec3 scaled(float t) {
  // From blue over white to red: told apart by people who do not see all colours, and on paper.
  vec3 low = vec3(0.13, 0.30, 0.65), middle = vec3(0.95, 0.93, 0.86), high = vec3(0.70, 0.09, 0.13);
  return t < 0.5 ? mix(low, middle, 2.0 * t) : mix(middle, high, 2.0 * t - 1.0);
}
void main() {
  vec3 normal = normalize(cross(dFdx(at), dFdy(at)));
  float light = 0.42 + 0.58 * abs(dot(normal, normalize(eye)));
  vec3 own = coloured > 0.5 ? scaled(clamp(share, 0.0, 1.0)) : plain;
  colour = vec4(mix(own * light, ground, fog), dense);
}`;
const LINES = {
  vertex: '#version 300 es\nin vec3 place; uniform mat4 view; void main() { gl_Position = view * vec4(place, 1.0); }',
  fragment: '#version 300 es\nprecision highp float; uniform vec3 plain; out vec4 colour; void main() { colour = vec4(plain, 1.0); }',
};
// Orbits that go with the rotation, against it, and neither.
const SENSES = [[0.0, 0.45, 0.7], [0.84, 0.37, 0.0], [0.42, 0.46, 0.5]];
// Levels along a body at which orbits are drawn, and their points.
const LEVELS = 11;
const AROUND = 48;
const BODIES = [[0.36, 0.52, 0.68], [0.72, 0.63, 0.50], [0.47, 0.62, 0.45], [0.66, 0.50, 0.62], [0.60, 0.60, 0.35], [0.45, 0.62, 0.64]];

// Whether there is no graphics card: smooth edges take twice the time then.
function drawnBySoftware() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const facts = gl?.getExtension('WEBGL_debug_renderer_info');
  return /swiftshader|llvmpipe|software/i.test(facts ? gl.getParameter(facts.UNMASKED_RENDERER_WEBGL) : '');
}

// How far a node gets in its orbit a cos φ + b sin φ.
function reach(own, node) {
  let [aa, bb, ab] = [0, 0, 0];
  for (let axis = 0; axis < 3; axis++) {
    const [a, b] = [own.parts[3 * node + axis], own.parts[3 * (own.nodes + node) + axis]];
    aa += a * a; bb += b * b; ab += a * b;
  }
  return Math.sqrt(0.5 * (aa + bb + Math.hypot(aa - bb, 2 * ab)));
}

// Whether a body, a cylinder in the place of what has no mesh, has all of another one in it.
function holds(own, other) {
  const ends = (one, axis) => { let [low, high] = [Infinity, -Infinity]; for (let k = axis; k < one.points.length; k += 3) { const x = one.points[k] + (one.body.axis[axis] || 0); low = Math.min(low, x); high = Math.max(high, x); } return [low, high]; };
  return [0, 1, 2].every((axis) => { const [[a, b], [c, d]] = [ends(own, axis), ends(other, axis)]; const room = axis < 2 ? 0 : 0.3 * (d - c); return a - room <= c && d <= b + room; });
}

// At levels along a body the node that is highest there; of a cylinder one.
function uppermost(own) {
  const { points, nodes } = own;
  let [low, high] = [Infinity, -Infinity];
  for (let k = 0; k < nodes; k++) { low = Math.min(low, points[3 * k + 2]); high = Math.max(high, points[3 * k + 2]); }
  const levels = own.body.sketched ? 1 : LEVELS;
  const best = new Array(levels).fill(-1);
  for (let k = 0; k < nodes; k++) {
    const part = high > low ? (points[3 * k + 2] - low) / (high - low) : 0;
    const level = Math.min(Math.floor(part * levels), levels - 1);
    if (best[level] < 0 || points[3 * k] > points[3 * best[level]] + 1e-9) best[level] = k;
  }
  return best.filter((node) => node >= 0);
}

class Scene {
  constructor(canvas, shapes) {
    const gl = canvas.getContext('webgl2', { antialias: !drawnBySoftware(), preserveDrawingBuffer: true });
    if (!gl) throw new Error('no WebGL 2');
    Object.assign(this, { canvas, gl, shapes, yaw: -0.6, pitch: 0.35, zoom: 1, moved: [0, 0], time: 0, scale: 1, colour: 'body', off: new Set(), turning: true, motion: null, angle: 0, orbits: true, ghost: true, joints: true });
    this.program = this.linked(VERTEX, FRAGMENT);
    this.lines = this.linked(LINES.vertex, LINES.fragment);
    gl.useProgram(this.program);
    this.at = (name) => gl.getUniformLocation(this.program, name);
    this.of = (name) => gl.getAttribLocation(this.program, name);
    gl.enable(gl.DEPTH_TEST);
    const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    this.bodies = shapes.bodies.map((body) => {
      const points = numbers(body.points);
      const triangles = numbers(body.triangles);
      for (let k = 0; k < points.length; k++) { const axis = k % 3; const x = points[k] + (axis < 2 ? body.axis[axis] : 0); low[axis] = Math.min(low[axis], x); high[axis] = Math.max(high[axis], x); }
      const own = { body, count: triangles.length, kind: triangles.BYTES_PER_ELEMENT === 2 ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT, points, place: this.buffer(points), triangles: this.buffer(triangles, gl.ELEMENT_ARRAY_BUFFER), nodes: points.length / 3 };
      if (body.motion) {
        const { displacement, largest, stress } = body.motion;
        own.frames = this.buffer(Float32Array.from(numbers(displacement), (part) => ((part - 32768) / 32767) * largest));
        if (stress) own.stress = this.buffer(Float32Array.from(numbers(stress), (part) => part / 65535));
      }
      return own;
    });
    for (const own of this.bodies) own.glass = own.body.sketched && this.bodies.some((other) => other !== own && holds(own, other));
    this.marks = marked(shapes.joints || [], this.bodies, 0.5 * Math.hypot(...high.map((own, k) => own - low[k])));
    this.marks.points.forEach((own, k) => { low[k % 3] = Math.min(low[k % 3], own); high[k % 3] = Math.max(high[k % 3], own); });
    this.marks.count = this.marks.triangles.length;
    if (this.marks.count) {
      this.marks.place = this.buffer(this.marks.points);
      this.marks.corners = this.buffer(this.marks.triangles, gl.ELEMENT_ARRAY_BUFFER);
      for (const own of this.marks.names) own.label = add(canvas.parentElement, 'span', own.name, { class: 'joint' });
    }
    this.middle = low.map((own, k) => 0.5 * (own + high[k]));
    this.radius = 0.5 * Math.hypot(...high.map((own, k) => own - low[k]));
    // Half of what the corners of the machine span on the screen as it stands at first.
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    const half = high.map((own, k) => 0.5 * (own - low[k]));
    this.across = half[1] * Math.abs(sy) + half[2] * Math.abs(cy);
    this.upward = half[0] * cp + half[1] * Math.abs(cy * sp) + half[2] * Math.abs(sy * sp);
    const moving = this.bodies.filter((own) => own.body.motion);
    this.largest = Math.max(...moving.map((own) => own.body.motion.largest), 1e-30);
    this.frames = moving.length ? moving[0].body.motion.time.length : 0;
    this.fitting = this.frames ? 10 ** Math.floor(Math.log10((0.15 * this.radius) / this.largest)) : 1;
    this.scale = Math.max(this.fitting, 1);
    this.listen();
  }

  linked(vertex, fragment) {
    const { gl } = this;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return program;
  }

  // Shows a mode or an orbit: of each body what goes with cos φ, then what goes with sin φ.
  show(motion) {
    const { gl } = this;
    this.motion = motion;
    this.reach = 0;
    this.bodies.forEach((own, k) => {
      own.parts = Float32Array.from(numbers(motion.points[k]), (part) => ((part - 32768) / 32767) * motion.largest);
      for (let node = 0; node < own.nodes; node++) this.reach = Math.max(this.reach, reach(own, node));
      if (own.circling) gl.deleteBuffer(own.circling);
      own.circling = this.buffer(own.parts);
    });
  }

  // Orbits of the uppermost nodes at levels along the bodies.
  traces() {
    const all = [];
    for (const own of this.bodies) {
      if (this.off.has(own.body.name)) continue;
      own.watched = own.watched || uppermost(own);
      const [x, y] = own.body.axis;
      for (const node of own.watched) {
        const [a, b] = [node * 3, (own.nodes + node) * 3];
        if (reach(own, node) < 0.02 * this.reach) continue;
        const path = new Float32Array(3 * AROUND);
        for (let k = 0; k < AROUND; k++) {
          const [c, s] = [Math.cos((2 * Math.PI * k) / AROUND), Math.sin((2 * Math.PI * k) / AROUND)];
          for (let axis = 0; axis < 3; axis++) path[3 * k + axis] = own.points[a + axis] + [x, y, 0][axis] + this.scale * (own.parts[a + axis] * c + own.parts[b + axis] * s);
        }
        const round = 2 * (own.parts[a] * own.parts[b + 1] - own.parts[a + 1] * own.parts[b]) * (this.motion.rpm < 0 ? -1 : 1);
        const whole = [0, 1].reduce((sum, axis) => sum + own.parts[a + axis] ** 2 + own.parts[b + axis] ** 2, 0);
        all.push({ path, sense: this.motion.rpm === null || Math.abs(round) <= 0.1 * whole ? 2 : round > 0 ? 0 : 1 });
      }
    }
    return all;
  }

  buffer(values, kind = this.gl.ARRAY_BUFFER) {
    const own = this.gl.createBuffer();
    this.gl.bindBuffer(kind, own);
    this.gl.bufferData(kind, values, this.gl.STATIC_DRAW);
    return own;
  }

  // Column by column: x of the machine is up, z to the right at first.
  matrix() {
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    const right = [0, -sy, cy];
    const toward = [sp, cy * cp, sy * cp];
    const up = [toward[1] * right[2] - toward[2] * right[1], toward[2] * right[0] - toward[0] * right[2], toward[0] * right[1] - toward[1] * right[0]];
    this.eye = toward;
    const { width, height } = this.canvas;
    const fit = 0.9 * this.zoom * Math.min(width / this.across, height / this.upward);
    const [fx, fy] = [fit / width, fit / height];
    const rows = [right.map((own) => own * fx), up.map((own) => own * fy), toward.map((own) => (-own * 0.4) / this.radius)];
    const shift = rows.map((row) => -row.reduce((sum, own, k) => sum + own * this.middle[k], 0));
    shift[0] += this.moved[0];
    shift[1] += this.moved[1];
    return new Float32Array([0, 1, 2].flatMap((k) => [rows[0][k], rows[1][k], rows[2][k], 0]).concat([...shift, 1]));
  }

  draw() {
    const { gl, canvas } = this;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    if (width && (canvas.width !== width || canvas.height !== height)) [canvas.width, canvas.height] = [width, height];
    gl.useProgram(this.program);
    gl.viewport(0, 0, canvas.width, canvas.height);
    const style = getComputedStyle(document.documentElement).getPropertyValue('--card').trim();
    const rgb = [1, 3, 5].map((k) => parseInt(style.slice(k, k + 2), 16) / 255);
    gl.clearColor(...rgb, 1);
    gl.uniform3fv(this.at('ground'), rgb);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const view = this.matrix();
    gl.uniformMatrix4fv(this.at('view'), false, view);
    gl.uniform3fv(this.at('eye'), this.eye);
    // The machine at rest is seen where nothing is before it.
    if (this.motion && this.ghost) { this.surfaces(true); gl.clear(gl.DEPTH_BUFFER_BIT); }
    this.surfaces(false);
    this.joined(view);
    if (!this.motion || !this.orbits) return;
    gl.useProgram(this.lines);
    gl.uniformMatrix4fv(gl.getUniformLocation(this.lines, 'view'), false, view);
    const place = gl.getAttribLocation(this.lines, 'place');
    gl.enableVertexAttribArray(place);
    this.path = this.path || gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.path);
    // Seen through the bodies, so that they are whole.
    gl.disable(gl.DEPTH_TEST);
    for (const { path, sense } of this.traces()) {
      gl.bufferData(gl.ARRAY_BUFFER, path, gl.DYNAMIC_DRAW);
      gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
      gl.uniform3fv(gl.getUniformLocation(this.lines, 'plain'), SENSES[sense]);
      gl.drawArrays(gl.LINE_LOOP, 0, AROUND);
    }
    gl.enable(gl.DEPTH_TEST);
  }

  // The bodies as they move, or as a shade of where they are without that.
  surfaces(still) {
    const { gl, motion } = this;
    const frame = Math.floor(this.time) % Math.max(this.frames, 1);
    const next = Math.min(frame + 1, Math.max(this.frames - 1, 0));
    const part = this.time - Math.floor(this.time);
    gl.uniform2fv(this.at('weights'), motion ? [Math.cos(this.angle), Math.sin(this.angle)] : [1 - part, part]);
    gl.uniform1f(this.at('scale'), still ? 0 : this.scale);
    gl.uniform1f(this.at('largest'), motion ? this.reach : this.largest);
    gl.uniform1f(this.at('fog'), still ? 0.8 : 0);
    // What others are in is of glass, and stands before them.
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ZERO, gl.ONE);
    for (const [place, own] of [...this.bodies.entries()].sort((a, b) => a[1].glass - b[1].glass)) {
      if (this.off.has(own.body.name)) continue;
      if (own.glass) { gl.enable(gl.BLEND); gl.depthMask(false); }
      gl.uniform1f(this.at('dense'), own.glass ? 0.35 : 1);
      const cycle = own.body.motion;
      const angle = !motion && cycle && this.turning ? cycle.angle[frame] + part * (cycle.angle[next] - cycle.angle[frame]) : 0;
      gl.uniformMatrix2fv(this.at('turn'), false, [Math.cos(angle), Math.sin(angle), -Math.sin(angle), Math.cos(angle)]);
      gl.uniform2fv(this.at('axis'), own.body.axis);
      gl.uniform3fv(this.at('plain'), still ? [0.55, 0.58, 0.6] : BODIES[place % BODIES.length]);
      const stressed = !motion && this.colour === 'stress' && Boolean(own.stress);
      gl.uniform1f(this.at('coloured'), !still && (motion || cycle) && (this.colour === 'displacement' || stressed) ? 1 : 0);
      gl.uniform1f(this.at('stressed'), stressed ? 1 : 0);
      this.attribute('place', own.place, 3, 0);
      const size = own.nodes * 4;
      this.attribute('before', motion ? own.circling : own.frames, 3, motion ? 0 : frame * 3 * size);
      this.attribute('after', motion ? own.circling : own.frames, 3, motion ? 3 * size : next * 3 * size);
      this.attribute('sizeBefore', own.stress, 1, frame * size);
      this.attribute('sizeAfter', own.stress, 1, next * size);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, own.triangles);
      gl.drawElements(gl.TRIANGLES, own.count, own.kind, 0);
    }
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    gl.uniform1f(this.at('dense'), 1);
  }

  // Joints where they stand at rest, and their names.
  joined(view) {
    const { gl, canvas, marks } = this;
    const taken = [];
    for (const { at, label } of marks.names) {
      const [x, y] = [0, 1].map((row) => at.reduce((sum, own, k) => sum + own * view[4 * k + row], view[12 + row]));
      label.hidden = !this.joints || Math.abs(x) > 1 || Math.abs(y) > 1;
      const left = 0.5 * (1 + x) * canvas.clientWidth;
      let top = 0.5 * (1 - y) * canvas.clientHeight;
      // Names that would lie on one another are stacked.
      const wide = 7 * label.textContent.length + 8;
      while (!label.hidden && taken.some((own) => Math.abs(own.left - left) < 0.5 * (own.wide + wide) && Math.abs(own.top - top) < 14)) top -= 15;
      if (!label.hidden) taken.push({ left, top, wide });
      label.style.left = `${left.toFixed(1)}px`;
      label.style.top = `${top.toFixed(1)}px`;
    }
    if (!this.joints || !marks.count) return;
    gl.uniform1f(this.at('scale'), 0);
    gl.uniform1f(this.at('fog'), 0);
    gl.uniform1f(this.at('coloured'), 0);
    gl.uniformMatrix2fv(this.at('turn'), false, [1, 0, 0, 1]);
    gl.uniform2fv(this.at('axis'), [0, 0]);
    gl.uniform3fv(this.at('plain'), [0.42, 0.32, 0.16]);
    this.attribute('place', marks.place, 3, 0);
    for (const name of ['before', 'after', 'sizeBefore', 'sizeAfter']) this.attribute(name, undefined, 3, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, marks.corners);
    // Faint where bodies are before them.
    gl.disable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendColor(0, 0, 0, 0.3);
    gl.blendFunc(gl.CONSTANT_ALPHA, gl.ONE_MINUS_CONSTANT_ALPHA);
    gl.drawElements(gl.TRIANGLES, marks.count, gl.UNSIGNED_INT, 0);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.drawElements(gl.TRIANGLES, marks.count, gl.UNSIGNED_INT, 0);
  }

  attribute(name, buffer, size, offset) {
    const { gl } = this;
    const at = this.of(name);
    if (at < 0) return;
    if (!buffer) { gl.disableVertexAttribArray(at); gl.vertexAttrib3f(at, 0, 0, 0); return; }
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, offset);
  }

  // Seconds of the run at what is drawn.
  seconds() {
    const { time } = this.bodies.find((own) => own.body.motion).body.motion;
    const frame = Math.min(Math.floor(this.time), time.length - 1);
    const next = Math.min(frame + 1, time.length - 1);
    return time[frame] + (this.time - frame) * (time[next] - time[frame]);
  }

  listen() {
    const { canvas } = this;
    let begun = null;
    canvas.addEventListener('pointerdown', (event) => { begun = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId); });
    canvas.addEventListener('pointermove', (event) => {
      if (!begun) return;
      const [dx, dy] = [event.clientX - begun[0], event.clientY - begun[1]];
      begun = [event.clientX, event.clientY];
      if (event.shiftKey) { this.moved[0] += (2 * dx) / canvas.clientWidth; this.moved[1] -= (2 * dy) / canvas.clientHeight; } else this.turn(0.008 * dx, 0.008 * dy);
      this.draw();
    });
    canvas.addEventListener('pointerup', () => { begun = null; });
    canvas.addEventListener('wheel', (event) => {
      if (!event.ctrlKey) return;
      event.preventDefault();
      this.zoom *= event.deltaY > 0 ? 0.87 : 1.15;
      this.draw();
    }, { passive: false });
    canvas.addEventListener('keydown', (event) => {
      if (event.altKey || event.metaKey) return;
      const turned = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
      if (turned) this.turn(...turned);
      else if (event.key === '+' || event.key === '=') this.zoom *= 1.15;
      else if (event.key === '-') this.zoom *= 0.87;
      else if (event.key === '0' || event.key === 'Home') Object.assign(this, { yaw: -0.6, pitch: 0.35, zoom: 1, moved: [0, 0] });
      else if (event.key === ' ') this.play?.();
      else return;
      event.preventDefault();
      this.draw();
    });
  }

  turn(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = Math.min(Math.max(this.pitch + pitch, -1.55), 1.55);
  }
}
