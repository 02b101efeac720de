'use strict';
(async () => {
const $ = id => document.getElementById(id);
const now = () => performance.now();

/* ---- the program: PROGRAM, its octets, as page.html unpacks it ---- */
const { exports: x } = await WebAssembly.instantiate(await WebAssembly.compile(PROGRAM), {});
x._initialize?.();
const numbers = new Float64Array(x.memory.buffer), octets = new Uint8Array(x.memory.buffer);
const utf8 = new TextDecoder();
const text = p => { let e = p; while (octets[e]) e++; return utf8.decode(octets.subarray(p, e)); };

const RULES = ['gauss', 'gauss+2', 'lobatto', 'verlet', 'kicks8'];
const RULE_NAMES = ['Gauss, as many points as degrees', 'Gauss, two points more', 'Lobatto, one point more', 'kicks: Störmer-Verlet, order 2', 'kicks: Kahan-Li, order 8'];
const RULE_SHORT = ['Gauss', 'Gauss +2', 'Lobatto', 'Störmer-Verlet kicks', 'Kahan-Li kicks'];
const TOLERANCES = [0, 1e-12, 1e-9, 1e-6, 1e-3];
const DIALS = [0, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14];
const FORMULATIONS = ['not set up', 'explicit', 'positions', 'velocities', 'momenta', 'Newton'];
const METHODS = ['gvi.h', 'Störmer-Verlet', 'Runge-Kutta 4', 'DOP853'];
const COLOURS = ['gvi', 'verlet', 'rk4', 'dop'];

const effectsOf = i => [...Array(x.scene_number(i, 20, 0)).keys()].map(e => {
  const T = f => text(x.scene_text(i, f, e)), N = f => x.scene_number(i, f, e);
  return { name: T(10), what: T(11), code: T(12), on: N(21), kind: N(22) };
});
const scenes = [];
for (let i = 0; i < x.scene_count(); i++) {
  const N = (f, k = 0) => x.scene_number(i, f, k), T = (f, k = 0) => text(x.scene_text(i, f, k));
  const s = { i, n: N(0), degree: N(1), h: N(2), span: N(3), speed: N(4), bodies: N(5), space: N(6), view: N(7),
    centre: [N(8, 0), N(8, 1), N(8, 2)], trails: N(9), fixed: N(10), name: T(0), title: T(1), about: T(2), time: T(3),
    unit: T(4), text: T(5), make: T(6), mass: T(7), length: T(8), radius: [], effects: [], parameters: [], rods: [], kept: [] };
  for (let b = 0; b < s.bodies; b++) s.radius.push(N(11, b));
  s.effects = effectsOf(i);
  for (let p = 0; p < 3 && T(20, p); p++) s.parameters.push({ name: T(20, p), unit: T(21, p), low: N(30, p), high: N(31, p), step: N(32, p), value: N(33, p) });
  for (let r = 0; r < 16 && N(42, r); r++) s.rods.push([N(40, r), N(41, r), N(42, r)]);
  for (let k = 0; k < 2 && T(30, k); k++) s.kept.push({ name: T(30, k), unless: T(31, k).split(',') });
  s.first = s.effects.reduce((m, e, k) => m | e.on << k, 0);
  s.clock = s.effects.findIndex(e => e.kind === 3);
  scenes.push(s);
}
const mine = scenes[scenes.length - 1];                  // the visitor's own, from own.h

/* ---- words for numbers ---- */
const sup = n => String(n).replace('-', '⁻').replace(/\d/g, d => '⁰¹²³⁴⁵⁶⁷⁸⁹'[d]);
const short = (v, d = 2) => !isFinite(v) ? '–' : v === 0 ? '0' : Math.abs(v) >= 0.01 && Math.abs(v) < 1e5 ? String(+v.toPrecision(d + 1)) : v.toExponential(d - 1).replace('-', '−').replace('+', '');
const many = v => v >= 1e6 ? (v / 1e6).toPrecision(3) + ' M' : Math.round(v).toLocaleString('en');
const duration = ms => ms >= 1000 ? (ms / 1000).toPrecision(3) + ' s' : ms >= 1 ? ms.toPrecision(3) + ' ms' : (ms * 1000).toPrecision(3) + ' µs';
const html = s => String(s).replace(/[&<>"]/g, c => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' }[c]));

/* ---- the visitor's own scene ---- */
const EXAMPLES = {
  'a double pendulum': `g = 9.81                 # rods of 1, masses of 1
L = va^2 + vb^2/2 + va*vb*cos(a - b)
  + g*(2*cos(a) + cos(b))

a(0) = pi/2
b(0) = 2*pi/3
end = 10
draw = (0, 0) (sin(a), -cos(a))
       (sin(a) + sin(b), -cos(a) - cos(b))`,
  'a pendulum on a cart': `M = 2, m = 1, l = 1, g = 9.81
L = (M + m)*vx^2/2 + m*l*vx*va*cos(a)
  + m*l^2*va^2/2 + m*g*l*cos(a)

x(0) = 0
a(0) = 2.5
end = 10
draw = (x - 0.3, 0) (x + 0.3, 0),
       (x, 0) (x + l*sin(a), -l*cos(a))`,
  'a pendulum on a spring': `k = 40, m = 1, g = 9.81
r = sqrt(x^2 + y^2)
L = m*(vx^2 + vy^2)/2 - k*(r - 1)^2/2 - m*g*y

x(0) = 1.2*sin(pi/3)
y(0) = -1.2*cos(pi/3)
end = 20
draw = (0, 0) (x, y)`,
  'a planet': `L = (vx^2 + vy^2)/2 + 1/sqrt(x^2 + y^2)

x(0) = 1, y(0) = 0
vx(0) = 0, vy(0) = 0.8
end = 20
draw = (0, 0), (x, y)`,
  'a relativistic particle': `c = 1                    # L is not quadratic in v
L = -c^2*sqrt(1 - (vx^2 + vy^2)/c^2) + 0.2/sqrt(x^2 + y^2)

x(0) = 1, y(0) = 0
vy(0) = 0.4
end = 40
draw = (0, 0), (x, y)`,
  'a pendulum with friction and a motor': `g = 9.81, b = 0.4, A = 2
L = θ'^2/2 + g cos(θ)
Fθ = A cos(3t) - b θ'           # a force on θ

θ(0) = 1
end = 30
draw = (0, 0) (sin(θ), -cos(θ))`,
  'two rods, as constraints': `g = 9.81                 # 0 = ... is what always holds
L = (x'^2 + y'^2 + u'^2 + w'^2)/2 - g*(y + w)
0 = x^2 + y^2 - 1
0 = (u - x)^2 + (w - y)^2 - 1

x(0) = 0.6, y(0) = 0.8
u(0) = 1.6, w(0) = 0.8
end = 10
draw = (0, 0) (x, y) (u, w)`,
  'a skate on a slope': `g = 9.81, s = 0.3         # it glides along its edge alone
L = (x'^2 + y'^2)/2 + 0.1 θ'^2 + g sin(s) x
0 = sin(θ) x' - cos(θ) y'

x(0) = 0, y(0) = 0, θ(0) = 0, θ'(0) = 1.5
end = 6
draw = (y - 0.4 sin(θ), -x + 0.4 cos(θ))
       (y + 0.4 sin(θ), -x - 0.4 cos(θ))`,
  'a pendulum whose pivot shakes': `A = 0.1, w = 60, g = 9.81    # Kapitza: it stays upright
y = A*cos(w*t)
L = va^2/2 - A*w*sin(w*t)*va*sin(a) + g*cos(a)

a(0) = 3
end = 5
draw = (0, y) (sin(a), y - cos(a))`,
  'H: vortices that leapfrog': `# strengths 1, -1, 1, -1: a vortex at (x, y)
# has q = x and p = its strength times y
y1 = p1, y2 = -p2, y3 = p3, y4 = -p4
H = log(d12 d14 d23 d34/(d13 d24))/(4 pi)

d12 = (q1 - q2)^2 + (y1 - y2)^2
d13 = (q1 - q3)^2 + (y1 - y3)^2
d14 = (q1 - q4)^2 + (y1 - y4)^2
d23 = (q2 - q3)^2 + (y2 - y3)^2
d24 = (q2 - q4)^2 + (y2 - y4)^2
d34 = (q3 - q4)^2 + (y3 - y4)^2
q1(0) = 0, q2(0) = 0, q3(0) = 0.5, q4(0) = 0.5
p1(0) = 0.5, p2(0) = 0.5, p3(0) = 0.5, p4(0) = 0.5
end = 10
draw = (q1, y1), (q2, y2), (q3, y3), (q4, y4)`,
  'H: a star in a galaxy (Hénon-Heiles)': `H = (px² + py²)/2 + (x² + y²)/2 + x² y - y³/3

x(0) = 0, y(0) = 0.1
px(0) = 0.49, py(0) = 0
end = 40`,
  'H: three masses on a ring (Toda)': `a = q1 - q2, b = q2 - q3, c = q3 - q1
H = (p1^2 + p2^2 + p3^2)/2 + exp(a) + exp(b) + exp(c)

q1(0) = 1, q2(0) = 0, q3(0) = -1
p1(0) = 0, p2(0) = 1, p3(0) = -1
end = 20
draw = (a, b)`,
};
let good = null;
function put(r) {
  const room = x.own_room() / 8;
  r.steps.forEach((s, k) => numbers.set(s, room + 4 * k));
  numbers.set([...r.q, ...r.v], room + 2400);
  numbers.set(r.draw, room + 2416);
  numbers.set(r.names.map((_, i) => r.force[i] ?? -1), room + 2440);
  numbers.set([r.holds.length + r.rolls.length, r.rolls.length, ...r.holds, ...r.rolls], room + 2448);
  numbers[room + 2454] = r.momenta ? -1 : r.kind;
  return text(x.own_take(r.n, r.length, r.steps.length, r.draw.length / 2, r.end));
}
/* What lagrangian.h says of C, of what is typed here */
const boxed = why => why.replace(/(d[LH]\/\S+) is +by numbers.*/, '$1 is not what differences show: it is not smooth there').replace(/a derivative of ([LH]) is lost.*/, '$1 is not smooth there')
  .replace(/; give H.*HAMILTONIAN/, '; type H = ... in its place').replace(/as a row, by HOLDS.*/, 'as a line 0 = ...').replace(/: at t = .*; set L.kind = LAGRANGIAN_(\w+) .*/, '; add the line kind = $1');
/* Takes what is typed: the sentence that says what is wrong, or ''. What ran before goes on then. */
function own(typed) {
  let r;
  try { r = lagrange(typed); } catch (e) { return e.message; }
  const why = boxed(put(r));
  if (why) { if (good) put(good); return why.replace(/q\[(\d)]/g, (_, i) => r.names[i]).replace(/v\[(\d)]/g, (_, i) => speedOf(r.names[i])).replace(/p\[(\d)]/g, (_, i) => momentumOf(r.names[i])) + '.'; }
  good = r;
  for (const [key, p] of problems) if (p.o.scene === mine.i) problems.delete(key);
  const still = i => [0, 1].every(k => { const s = r.steps[r.draw[2 * i + k] - 2 * r.n - 1]; return s && !s[0]; });
  const rods = r.rods.filter(a => a[2] > 1), ends = r.rods.map(a => a[0] + a[2] - 1), points = [...Array(r.draw.length / 2).keys()];
  const bits = list => list.reduce((sum, i) => sum | 1 << i, 0);
  Object.assign(mine, { n: r.n, span: r.end, speed: r.end / 10, bodies: points.length, rods, timed: r.timed, momenta: r.momenta, kind: r.kind, mass: text(x.scene_text(mine.i, 7, 0)), text: r.c, radius: points.map(i => still(i) ? rods.length ? 4 : 10 : 7),
    fixed: bits(points.filter(still)), trails: bits(ends.filter(i => !still(i))), mark: Math.random() });
  mine.effects = effectsOf(mine.i).map(e => ({ ...e, code: e.code.replace('ROWS', e.kind === 5 ? r.rolls.length : r.holds.length) }));
  mine.first = 2 ** mine.effects.length - 1;
  return tryOut(), '';
}
/* A run by the dial: its steps tell one that suits, and where it goes is what is seen. */
function tryOut() {
  const stop = now() + 150, low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  let t = 0, steps = 0, status = open(2, { scene: mine.i, on: mine.first, p: [], degree: 8, rule: 'gauss', tol: 0, dial: 1e-12 });
  const look = p => { for (let i = 0; i < 2 * mine.bodies; i++) { const v = numbers[p / 8 + 3 * (i >> 1) + i % 2]; if (isFinite(v)) low[i % 2] = Math.min(low[i % 2], v), high[i % 2] = Math.max(high[i % 2], v); } };
  look(x.world_place(2, 0));
  while (!status && t < mine.span && now() < stop) {
    status = x.world_advance(2, 1, 1);
    if (status) break;
    t = x.world_number(2, 0, 0); steps++;
    for (let k = 1; k < 5; k++) look(x.world_curve(2, k / 4));
  }
  mine.h = +(0.7 * t / steps || mine.span / 200).toPrecision(2);
  mine.centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, 0];
  mine.view = 0.6 * Math.max(high[0] - low[0], high[1] - low[1]) || 1;
}
function takeTyped(typed) {
  const wrong = own(typed);
  $('wrong').textContent = wrong || (mine.momenta ? "H: q' = dH/dp, p' = -dH/dq." : `L is ${mine.effects[0].what}.`);
  $('wrong').classList.toggle('bad', !!wrong);
  if (!wrong) set.L = typed;
  return wrong;
}
const problems = new Map();

/* ---- the state that the address holds ---- */
const set = { scene: 0, on: 0, p: [], degree: 8, rule: 'gauss', h: 0.1, tol: 0, dial: 0, want: -8, by: 'evaluations' };
const scene = () => scenes[set.scene];
const slug = s => s.replace(/ /g, '-');
const defaults = i => Object.assign(set, { scene: i, on: scenes[i].first, p: scenes[i].parameters.map(p => p.value), degree: scenes[i].degree, rule: 'gauss', h: scenes[i].h, tol: 0, dial: 0 });
const ladder = k => +(scene().h * 2 ** Math.floor(k / 4) * [1, 1.189207115002721, 1.4142135623730951, 1.681792830507429][((k % 4) + 4) % 4]).toPrecision(4);
const held = () => scene().effects.some((e, k) => e.kind > 3 && set.on >> k & 1);
const clocked = () => scene().clock >= 0 && !!(set.on >> scene().clock & 1);

function address() {
  const s = scene();
  const a = { scene: s.name, L: s === mine ? set.L : '', on: s.effects.filter((e, k) => set.on >> k & 1).map(e => slug(e.name)).join(','), p: set.p.join(','), degree: set.degree, rule: set.rule, h: set.h, tol: set.tol, dial: set.dial || '', want: set.want };
  return '#' + Object.entries(a).filter(([k, v]) => v !== '' || k === 'on').map(([k, v]) => k + '=' + encodeURIComponent(v).replace(/%2C/g, ',')).join('&');
}
let written = '';
function remember() {
  written = address();
  try { history.replaceState(null, '', written); } catch { location.hash = written; }
}
/* The own scene as it was, as the address says, or as an example. */
function start(typed = set.L || EXAMPLES['a double pendulum']) {
  if (good && typed === set.L) return '';
  $('typed').value = typed;
  $('examples').selectedIndex = Object.values(EXAMPLES).indexOf(typed);
  return takeTyped(typed);
}
/* What the address says is handed to the library as it is: the library judges. */
function recall() {
  const a = {};
  for (const part of location.hash.slice(1).split('&')) {
    const [k, v] = part.split('=');
    if (!v && k !== 'on') continue;
    try { a[k] = decodeURIComponent(v || ''); } catch { a[k] = v; }
  }
  const i = a.scene === undefined ? 0 : scenes.findIndex(s => s.name === a.scene);
  const wrong = i === mine.i && start(a.L);
  defaults(wrong ? 0 : Math.max(i, 0));
  if (wrong) return { call: 'L', status: -1, why: wrong.replace(/\.$/, '') };
  if (i < 0) return { call: `scene "${a.scene}"`, status: -1, why: 'it is not one of the scenes' };
  if (a.on !== undefined) set.on = scene().effects.reduce((m, e, k) => m | a.on.split(',').includes(slug(e.name)) << k, 0);
  if (a.p !== undefined) a.p.split(',').slice(0, set.p.length).forEach((v, k) => { set.p[k] = Number(v); });
  for (const k of ['degree', 'h', 'tol', 'dial']) if (a[k] !== undefined) set[k] = Number(a[k]);
  if (a.rule !== undefined) set.rule = a.rule;
  if (a.want !== undefined && isFinite(+a.want)) set.want = Math.max(-14, Math.min(-1, Math.round(+a.want)));
  return null;
}
const open = (world, o, keep = 0) => {
  numbers[x.parameters() / 8 + 3] = o.dial;
  numbers.set([o.p[0] || 0, o.p[1] || 0, o.p[2] || 0].map((v, k) => o.p[k] !== undefined && !isFinite(o.p[k]) ? NaN : v), x.parameters() / 8);
  return x.world_open(world, o.scene, o.on, o.degree, RULES.indexOf(o.rule), o.tol, keep);
};

/* ---- what moves ---- */
const calm = matchMedia('(prefers-reduced-motion: reduce)');
const live = { ok: false, playing: !calm.matches, fast: false, dir: 1, k: 0, t: 0, target: 0, elapsed: 0, origin: [], speed: 0, base: [], said: '' };
const ghost = { on: true, ok: false, h: 0, k: 0, t: 0 };
const curves = { gvi: [], rk4: [], kept: [[], []], gap: [], gap4: [] };
let E0 = 0, Escale = 1, kept0 = [], trails = [], dots = [], view = 1;
const turn = { yaw: 0.6, pitch: 0.5 };
let dirty = true, plotDirty = true;

function complain(call, status, more = '', world = 0, why = '') {
  const a = $('alert');
  a.hidden = !status;
  if (!status) return;
  const e = status === -9 || status === -10 || status === -11 || status < -13 ? x.world_number(world, 11, 0) : -1;
  const said = why || boxed(text(x.status_text(world, status)));
  $('alert-text').textContent = `${call}: ${said}${e >= 0 && !/^[LH] is /.test(said) ? ` (${scene().effects[e].name})` : ''}. ${more}`;
  $('alert').dataset.status = status;
  $('halve').hidden = why || set.dial || !/^-(8|9|10|14)$/.test(status);
  $('alert-clock').hidden = why || scene().clock < 0 || clocked();
  pause();
}

/* Opens the scene as it is set; keep: goes on from where it is. */
function apply(keep, first) {
  const s = scene();
  const before = live.said;
  if (keep) s.effects.forEach((e, k) => { live.base[k] = (live.base[k] || 0) + x.world_number(0, 3, k); });
  else live.base = s.effects.map(() => 0);
  if (!first) remember();
  let status = open(0, set, keep ? 1 : 0), call = text(x.world_call(0)) || 'gvi_init', world = 0;
  if (!status) { call = 'gvi_step'; world = 2; status = probe(); }
  live.ok = !status;
  complain(call, status, status === -15 ? 'What was held has moved away: restart to mount it again.' : 'Change the setting to go on.', world);
  if (first) complain(first.call, first.status, 'Here is another scene.', 2, first.why), live.playing = !calm.matches;
  Object.assign(live, { k: 0, t: x.world_number(0, 0, 0), from: x.world_number(0, 0, 0), elapsed: 0, origin: s.effects && [...Array(s.n)].map((_, i) => x.world_number(0, 30, i)) });
  if (!keep) live.target = live.t, live.dir = 1;
  if (Math.abs(live.target - live.t) > 2 * Math.abs(set.h) || !keep) live.target = live.t;
  E0 = x.world_number(0, 20, 0);
  Escale = Math.abs(E0) > 1e-12 ? Math.abs(E0) : 1;
  kept0 = s.kept.map((q, k) => x.world_number(0, 21, k));
  Object.assign(curves, { gvi: [], rk4: [], kept: [[], []], gap: [], gap4: [] });
  ghost.ok = live.ok && ghost.on && !x.ghost_open(0) && ghost.h > 0;
  ghost.k = 0; ghost.t = live.t;
  dots = [];
  if (!keep) { trails = s.radius.map(() => []); view = s.view; if (live.ok) sampleTrail(1); }
  $('from-start').textContent = '';
  live.said = live.ok ? FORMULATIONS[x.world_number(0, 4, 0)] : '';
  showFormulation(before && before !== live.said);
  showControls();
  problem();
  dirty = plotDirty = true;
}

/* A few steps elsewhere: does the library take the setting, and what would RK4 get for it? */
function probe() {
  let status = open(2, set);
  if (status) return status;
  const end = now() + 6;
  let n = 0;
  while (!status && now() < end && n < 400 && (n < 12 || (clocked() && x.world_number(2, 0, 0) < scene().span / 4))) { status = x.world_advance(2, set.h, 1); n++; }
  const evaluations = x.world_number(2, 12, 0), t = x.world_number(2, 0, 0);
  ghost.h = evaluations > 0 && t > 0 ? 4 * t / evaluations : 0;
  return n <= 1 ? status : 0;
}

function pause() { live.playing = false; $('play').classList.add('paused'); $('play').setAttribute('aria-label', 'Play'); }
function play() {
  if (!live.ok) return;
  live.playing = true; $('play').classList.remove('paused'); $('play').setAttribute('aria-label', 'Pause'); $('alert').hidden = true;
}

const penUp = () => trails.forEach(t => t.length && t.push(NaN, 0, 0));
function sampleTrail(tau) {
  const p = x.world_curve(0, tau) / 8, s = scene();
  for (let b = 0; b < s.bodies; b++) {
    if (!(s.trails >>> b & 1)) continue;
    const t = trails[b];
    t.push(numbers[p + 3 * b], numbers[p + 3 * b + 1], numbers[p + 3 * b + 2]);
    if (t.length > 3600) t.splice(0, 900);
  }
}

/* The greatest error so far, at 24 places in a decade. */
function record(curve, error) {
  const at = Math.floor(24 * Math.log10(live.elapsed / scene().h)), last = curve[curve.length - 1];
  if (!isFinite(error)) error = 1e9;
  if (last) error = Math.max(error, last[1]);
  if (last && last[0] >= at) last[1] = error, last[2] = Math.max(last[2], live.elapsed);
  else curve.push([at, error, live.elapsed]);
}
function sampleEnergy() {
  record(curves.gvi, Math.abs(x.world_number(0, 20, 0) - E0) / Escale);
  kept0.forEach((q, k) => record(curves.kept[k], Math.abs(x.world_number(0, 21, k) - q) / (Math.abs(q) > 1e-9 ? Math.abs(q) : 1)));
  if (ghost.ok) record(curves.rk4, Math.abs(x.world_number(0, 42, 0) - E0) / Escale);
  if (held()) record(curves.gap, x.world_number(0, 22, 0)), ghost.ok && record(curves.gap4, x.world_number(0, 44, 0));
}

/* What is drawn lies inside the last step; Runge-Kutta 4 is taken there, too. */
const shown = () => live.dir > 0 ? Math.min(live.t, live.target) : Math.max(live.t, live.target);
function follow() {
  if (!ghost.ok) return;
  const count = Math.min(4000, Math.ceil(live.dir * (shown() - ghost.t) / ghost.h - 1e-9));
  if (count > 0) {
    x.ghost_advance(0, live.dir * ghost.h, count);
    ghost.t += live.dir * ghost.h * count;
    ghost.k += live.dir * count;
  }
  if (!isFinite(x.world_number(0, 43, 0))) ghost.ok = false;
}

let sampled = 0, trailed = 0, drawnPoints = 0;
function stepOnce() {
  const status = x.world_advance(0, live.dir * set.h, 1);
  if (status) { complain(`gvi_step at t = ${short(live.t, 3)}`, status, 'The state is as it was before the step.' + (live.dir < 0 && scene().effects.some((e, k) => e.kind === 1 && set.on >> k & 1) ? ' Backwards, friction drives the motion instead of damping it.' : '')); return false; }
  const t = x.world_number(0, 0, 0), dt = Math.abs(t - live.t);
  live.k += live.dir;
  live.t = t;
  live.elapsed += dt;
  follow();
  if (set.dial) {                                        // a dot where each step ends
    const p = x.world_place(0, t) / 8, s = scene();
    for (let b = 0; b < s.bodies; b++) if (s.trails >>> b & 1) dots.push([...numbers.subarray(p + 3 * b, p + 3 * b + 3)]);
    if (dots.length > 120) dots.shift();
  }
  const fine = scene().speed / 50, pieces = clocked() ? 6 : Math.min(16, Math.ceil(dt / fine));
  trailed += dt;
  if (drawnPoints > 600) { if (drawnPoints < 1e6) { penUp(); drawnPoints = 1e6; } }
  else if (trailed >= fine * 0.9) { for (let j = 1; j <= pieces; j++) sampleTrail(j / pieces); trailed = 0; drawnPoints += pieces; }
  if (++sampled >= Math.max(1, Math.abs(live.k) / 400)) { sampleEnergy(); sampled = 0; }
  return true;
}

/* At the start again; by the dial the way back may have another number of steps. */
const back = () => live.dir < 0 && (set.dial ? live.t <= live.from : live.k === 0);
function arrive() {
  const q = [...Array(scene().n)].map((_, i) => x.world_number(0, 30, i));
  const off = Math.max(...q.map((v, i) => Math.abs(v - live.origin[i])));
  let rk4 = '';
  if (ghost.ok) {
    live.k = 0;
    x.ghost_advance(0, -ghost.h, Math.max(0, ghost.k)); ghost.k = 0; ghost.t = live.t;
    rk4 = `; Runge-Kutta 4 to ${short(Math.max(...q.map((v, i) => Math.abs(x.world_number(0, 43, i) - live.origin[i]))))}`;
  }
  $('from-start').textContent = `back at the start, to ${short(off)} ${scene().unit}${rk4}`;
  $('from-start').dataset.off = off;
  live.dir = 1;
  pause();
}

function simulate(dt) {
  const end = now() + 6, rate = scene().speed * 2 ** live.speed;
  drawnPoints = 0;
  if (live.fast) live.target = live.dir * Infinity;
  else live.target += live.dir * dt * rate;
  let going = true;
  while (going && live.dir * (live.target - live.t) > 0 && now() < end) {
    if (back()) break;
    going = stepOnce();
  }
  if (back() && live.target <= live.t) { live.target = live.t; arrive(); }
  if (live.dir * (live.target - live.t) > 0) live.target = live.t;      // as fast as it goes
  follow();
  dirty = plotDirty = true;
}

/* ---- the picture ---- */
const canvas = $('canvas'), pen = canvas.getContext('2d');
let colours = {};
function readColours() {
  const c = getComputedStyle(document.documentElement);
  for (const k of ['ink', 'muted', 'line', 'gvi', 'rk4', 'verlet', 'dop', 'card']) colours[k] = c.getPropertyValue('--' + k).trim();
  dirty = plotDirty = costDirty = true;
}
const colourOf = b => {
  const s = scene();
  if (s.rods.length) return s.fixed >> b & 1 ? colours.muted : s.trails >> b & 1 ? colours.verlet : colours.gvi;
  return s.fixed >> b & 1 ? (b ? colours.rk4 : colours.verlet) : [colours.gvi, colours.dop, colours.verlet][s.fixed ? 0 : b % 3];
};
const nice = v => { const e = 10 ** Math.floor(Math.log10(v)); return v / e >= 5 ? 5 * e : v / e >= 2 ? 2 * e : e; };

function draw() {
  const s = scene(), box = canvas.getBoundingClientRect(), ratio = devicePixelRatio || 1, W = box.width, H = box.height;
  if (canvas.width !== Math.round(W * ratio) || canvas.height !== Math.round(H * ratio)) canvas.width = Math.round(W * ratio), canvas.height = Math.round(H * ratio);
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, W, H);
  const at = x.world_place(0, shown()) / 8;
  const bodies = [];
  for (let b = 0; b < s.bodies; b++) bodies.push([numbers[at + 3 * b], numbers[at + 3 * b + 1], numbers[at + 3 * b + 2]]);
  let reach = 0;
  bodies.forEach((p, b) => { if (s.trails >>> b & 1) reach = Math.max(reach, Math.hypot(p[0] - s.centre[0], p[1] - s.centre[1], p[2] - s.centre[2])); });
  const wide = Math.max(s.view, reach > 1.3 * s.view ? Math.min(1.1 * reach, 4 * s.view) : 0);
  view += (wide - view) * (calm.matches ? 1 : 0.05);
  const scale = Math.min(W, H) / 2 / view * 0.94;
  const cy = Math.cos(turn.yaw), sy = Math.sin(turn.yaw), cp = Math.cos(turn.pitch), sp = Math.sin(turn.pitch);
  const project = (X, Y, Z) => {
    X -= s.centre[0]; Y -= s.centre[1]; Z -= s.centre[2];
    if (!s.space) return [W / 2 + scale * X, H / 2 - scale * Y, 0];
    const depth = sy * X + cy * Y;
    return [W / 2 + scale * (cy * X - sy * Y), H / 2 - scale * (Z * cp + depth * sp), depth * cp - Z * sp];
  };
  /* ground: circles in space, a grid in the plane */
  pen.lineWidth = 1; pen.strokeStyle = colours.line;
  const unit = nice(view / 1.7);
  if (s.space && s.name !== 'net') {
    for (let k = 1; k * unit < view * 1.1; k++) {
      pen.beginPath();
      for (let a = 0; a <= 72; a++) { const p = project(k * unit * Math.cos(a * Math.PI / 36), k * unit * Math.sin(a * Math.PI / 36), 0); pen.lineTo(p[0], p[1]); }
      pen.stroke();
    }
    for (const [a, b] of [[1, 0], [0, 1]]) { pen.beginPath(); for (const e of [-view, view]) { const p = project(a * e, b * e, 0); pen.lineTo(p[0], p[1]); } pen.stroke(); }
  } else if (!s.space) {
    pen.beginPath();
    for (let k = -Math.ceil(W / 2 / scale / unit); k * unit * scale < W / 2; k++) { const X = Math.round(W / 2 + k * unit * scale) + 0.5; pen.moveTo(X, 0); pen.lineTo(X, H); }
    for (let k = -Math.ceil(H / 2 / scale / unit); k * unit * scale < H / 2; k++) { const Y = Math.round(H / 2 + k * unit * scale) + 0.5; pen.moveTo(0, Y); pen.lineTo(W, Y); }
    pen.stroke();
  }
  /* trails, older ones paler */
  pen.lineJoin = pen.lineCap = 'round';
  trails.forEach((t, b) => {
    if (t.length < 6) return;
    pen.strokeStyle = colourOf(b); pen.lineWidth = 1.6;
    const points = t.length / 3, pieces = 10;
    for (let k = 0; k < pieces; k++) {
      pen.globalAlpha = 0.08 + 0.62 * ((k + 1) / pieces) ** 1.6;
      pen.beginPath();
      let down = false;
      for (let j = Math.floor(points * k / pieces); j <= Math.min(points - 1, Math.floor(points * (k + 1) / pieces)); j++) {
        const X = t[3 * j];
        if (X !== X) { down = false; continue; }
        const p = project(X, t[3 * j + 1], t[3 * j + 2]);
        if (down) pen.lineTo(p[0], p[1]); else pen.moveTo(p[0], p[1]);
        down = true;
      }
      pen.stroke();
    }
  });
  pen.globalAlpha = 1;
  pen.fillStyle = colours.ink;
  for (const d of dots) { const p = project(...d); pen.beginPath(); pen.arc(p[0], p[1], 1.8, 0, 7); pen.fill(); }
  const figure = (list, rk4) => {
    const on = list.map(p => project(p[0], p[1], p[2]));
    pen.strokeStyle = rk4 ? colours.rk4 : colours.muted; pen.lineWidth = rk4 ? 1.2 : s.bodies > 20 ? 1.3 : 2.4;
    for (const [first, step, count] of s.rods) {
      pen.beginPath();
      for (let j = 0; j < count; j++) { const p = on[first + j * step]; if (j) pen.lineTo(p[0], p[1]); else pen.moveTo(p[0], p[1]); }
      if (count > 3 && s.bodies < 20 && !rk4) { pen.globalAlpha = 0.16; pen.fillStyle = colours.gvi; pen.fill(); pen.globalAlpha = 1; }
      pen.stroke();
    }
    on.map((p, b) => [p, b]).sort((a, b) => b[0][2] - a[0][2]).forEach(([p, b]) => {
      if (!isFinite(p[0]) || !s.radius[b] || (rk4 && s.fixed >> b & 1)) return;
      pen.beginPath();
      pen.arc(p[0], p[1], s.radius[b], 0, 7);
      if (rk4) { pen.strokeStyle = colours.rk4; pen.lineWidth = 1.6; pen.stroke(); }
      else { pen.fillStyle = colourOf(b); pen.fill(); pen.strokeStyle = colours.card; pen.lineWidth = 1.5; pen.stroke(); }
    });
  };
  if (ghost.ok && s.bodies < 20) {
    const g = x.ghost_place(0) / 8, list = [];
    for (let b = 0; b < s.bodies; b++) list.push([numbers[g + 3 * b], numbers[g + 3 * b + 1], numbers[g + 3 * b + 2]]);
    if (s.bodies !== 16) figure(list, true);
    else { const p = project(...list[1]); pen.beginPath(); pen.arc(p[0], p[1], 5, 0, 7); pen.strokeStyle = colours.rk4; pen.lineWidth = 1.6; pen.stroke(); }
  }
  figure(bodies, false);
  /* scale */
  if (s.length || !s.space) {
    const L = unit * scale, X = W - 20 - L, Y = H - 14;
    pen.strokeStyle = pen.fillStyle = colours.muted; pen.lineWidth = 1.2;
    pen.beginPath(); pen.moveTo(X, Y - 4); pen.lineTo(X, Y); pen.lineTo(X + L, Y); pen.lineTo(X + L, Y - 4); pen.stroke();
    pen.font = '12px system-ui, sans-serif'; pen.textAlign = 'center'; pen.strokeStyle = colours.card; pen.lineWidth = 4;
    for (const f of ['strokeText', 'fillText']) pen[f](`${short(unit)} ${s.length}`, X + L / 2, Y - 8);
  }
  $('ghost-key').hidden = !(ghost.ok && s.bodies < 20);
}

/* ---- readouts ---- */
const lastCounts = { at: 0, total: [], rate: [] };
function showNumbers() {
  const s = scene(), time = now();
  const steps = x.world_number(0, 1, 0);
  $('time').textContent = live.ok || live.t ? shown().toFixed(Math.abs(live.t) < 100 ? 3 : 1) + (s.time ? ' ' + s.time : '') : '–';
  $('stepped').textContent = many(Math.abs(live.k));
  const e = curves.gvi.length ? Math.abs(x.world_number(0, 20, 0) - E0) / Escale : 0;
  $('energy').textContent = live.ok ? short(e) : '–';
  $('energy-word').textContent = s.timed || s.effects.some((a, k) => a.kind === 1 && set.on >> k & 1) ? 'energy changed by' : 'energy off by';
  /* the energy's error, from 1e-16 at the foot to 1, over the logarithm of the time so far */
  const first = Math.max(0, curves.gvi[0]?.[0] ?? 0), wide = Math.max(1, (curves.gvi.at(-1)?.[0] ?? 0) - first);
  const path = curve => curve.map(([k, error], i) => `${i ? 'L' : 'M'}${(118 * Math.max(0, k - first) / wide + 1).toFixed(1)} ${(21 - 20 * Math.min(1, Math.max(0, 1 + Math.log10(error || 1e-17) / 16))).toFixed(1)}`).join('');
  $('trace').innerHTML = (ghost.on ? `<path d="${path(curves.rk4)}" stroke="var(--rk4)"/>` : '') + `<path d="${path(curves.gvi)}" stroke="var(--gvi)"/>`;
  const total = s.effects.map((_, k) => (live.base[k] || 0) + x.world_number(0, 3, k)), seconds = (time - lastCounts.at) / 1000;
  s.effects.forEach((_, k) => {
    const row = $('rows').children[k];
    if (!row) return;
    const rate = Math.max(0, total[k] - (lastCounts.total[k] ?? total[k])) / seconds;
    const perStep = steps > 0 && set.on >> k & 1 ? x.world_number(0, 3, k) / steps : 0;
    row.dataset.total = total[k];
    row.children[1].textContent = perStep ? perStep.toFixed(perStep < 100 ? 1 : 0) : '0';
    row.children[2].textContent = many(rate);
  });
  Object.assign(lastCounts, { at: time, total });
  const used = FORMULATIONS[x.world_number(0, 4, 0)];
  if (live.ok && used !== live.said) { live.said = used; showFormulation(true); }
}

function showFormulation(changed) {
  const f = $('formulation'), s = scene();
  if (!live.ok) { f.textContent = 'No formulation: the library refused this setting.'; f.dataset.formulation = ''; return; }
  const why = text(x.world_formulation(0)), pinned = x.world_number(0, 6, 0), name = FORMULATIONS[x.world_number(0, 4, 0)];
  f.innerHTML = `Formulation chosen: <b>${name}</b><br>` + (s.momenta ? 'H is of positions and momenta' : pinned ? 'pinned by this page: Newton’s method, kept in reserve, would need too much memory here' : html(why.replace(/^[^:]*: /, '')));
  f.dataset.formulation = name;
  if (changed) { f.classList.remove('flash'); void f.offsetWidth; f.classList.add('flash'); }
}

function showControls() {
  const s = scene(), kicks = set.rule === 'verlet' || set.rule === 'kicks8';
  const put = (id, v) => { if (document.activeElement !== $(id)) $(id).value = v === v ? v : ''; };
  $('scene-title').textContent = s.title;
  $('about').textContent = s.about;
  put('degree', set.degree); put('degree-n', set.degree); put('h-n', set.h);
  $('degree').disabled = $('degree-n').disabled = kicks;
  $('h').disabled = $('h-n').disabled = !!set.dial;
  put('dial', set.dial);
  put('h', Math.round(4 * Math.log2(Math.abs(set.h) / s.h)) || 0);
  put('rule', RULES.includes(set.rule) ? set.rule : ''); put('tolerance', set.tol);
  $('h').setAttribute('aria-valuetext', `${set.h} ${clocked() ? 'of the clock' : s.time}`);
  document.querySelector('label[for=h]').innerHTML = clocked() ? 'step <i>h</i> in <i>τ</i>' : `step <i>h</i>${s.time ? ', ' + s.time : ''}`;
  $('own').hidden = s !== mine;
  document.querySelector('main').classList.toggle('typing', s === mine);
  [...$('scenes').children].forEach((b, i) => { b.setAttribute('aria-checked', i === set.scene); b.tabIndex = i === set.scene ? 0 : -1; });
  if ($('rows').dataset.scene !== s.name + s.mark) {
    $('rows').dataset.scene = s.name + s.mark;
    if (s === mine) $('own').append($('code-box')), $('code-box').open = true;
    else $('points').closest('details').before($('code-box'));
    $('rows').innerHTML = s.effects.map((e, k) => `<tr data-effect="${slug(e.name)}"><td><label class="switch"><input type="checkbox" role="switch" data-k="${k}"${s === mine ? ' disabled' : ''}><span>${html(e.name)}<small>${html(e.what)}</small></span></label></td><td>0</td><td>0</td></tr>`).join('');
    $('parameters').innerHTML = s.parameters.map((p, k) => `<label for="p${k}">${html(p.name)}</label><input type="range" id="p${k}" data-k="${k}" min="${p.low}" max="${p.high}" step="${p.step}"><output class="number" for="p${k}" id="p${k}-out"></output>`).join('') || `<span class="note wide">${s === mine ? 'in the text' : 'fixed in this scene'}</span>`;
    canvas.classList.toggle('space', !!s.space);
    canvas.setAttribute('aria-label', `${s.title}. ${s.about}${s.space ? ' Arrow keys turn it.' : ''}`);
    lastCounts.total = [];
    const chip = $('scenes').children[set.scene];
    $('scenes').scrollLeft = chip.offsetLeft + chip.offsetWidth / 2 - $('scenes').clientWidth / 2;
  }
  s.effects.forEach((e, k) => { const row = $('rows').children[k]; row.querySelector('input').checked = !!(set.on >> k & 1); row.classList.toggle('off', !(set.on >> k & 1)); });
  s.parameters.forEach((p, k) => { $('p' + k).value = set.p[k]; $(`p${k}-out`).textContent = `${set.p[k]}${p.unit}`; });
  $('clocks').hidden = s.clock < 0;
  $('clock').disabled = clocked();
  $('reverse').setAttribute('aria-pressed', live.dir < 0);
  $('want').value = set.want; $('want-out').textContent = '10' + sup(set.want); $('want').setAttribute('aria-valuetext', `10 to the ${set.want}`);
  $('play').classList.toggle('paused', !live.playing);
}

/* ---- plots, both axes logarithmic ---- */
function axes(svg, o) {
  const W = svg.clientWidth || 500, H = svg.clientHeight || 340, L = 50, R = 14, T = 24, B = 40;
  const X = v => L + (W - L - R) * (Math.log10(v) - o.x[0]) / (o.x[1] - o.x[0]);
  const Y = v => T + (H - T - B) * (o.y[1] - Math.log10(v)) / (o.y[1] - o.y[0]);
  let out = '';
  for (let k = o.y[0]; k <= o.y[1]; k += 2) out += `<line class="grid" x1="${L}" x2="${W - R}" y1="${Y(10 ** k)}" y2="${Y(10 ** k)}"/><text x="${L - 8}" y="${Y(10 ** k) + 4}" text-anchor="end">${k === 0 ? '1' : '10' + sup(k)}</text>`;
  for (let k = Math.ceil(o.x[0]); k <= o.x[1]; k++) out += `<line class="grid" y1="${T}" y2="${H - B}" x1="${X(10 ** k)}" x2="${X(10 ** k)}"/><text x="${X(10 ** k)}" y="${H - B + 17}" text-anchor="middle">${o.tick(k)}</text>`;
  out += `<text class="axis" x="${W - R}" y="${H - 6}" text-anchor="end">${o.xlabel}</text><text class="axis" x="${0}" y="12">${o.ylabel}</text>`;
  return { X, Y, W, H, L, R, T, B, out, inside: (x, y) => [Math.max(L, Math.min(W - R, X(x))), Math.max(T, Math.min(H - B, Y(y)))] };
}
const marker = (m, X, Y, r, attributes = '') => m === 0 ? `<circle cx="${X}" cy="${Y}" r="${r}" ${attributes}/>`
  : m === 1 ? `<path d="M${X - r} ${Y + r * .8}h${2 * r}l${-r} ${-1.8 * r}z" ${attributes}/>`
  : m === 2 ? `<path d="M${X - r * .85} ${Y - r * .85}h${1.7 * r}v${1.7 * r}h${-1.7 * r}z" ${attributes}/>`
  : `<path d="M${X} ${Y - 1.15 * r}l${1.15 * r} ${1.15 * r}l${-1.15 * r} ${1.15 * r}l${-1.15 * r} ${-1.15 * r}z" ${attributes}/>`;

function drawStability() {
  const s = scene(), svg = $('stability'), h = s.h;
  const end = Math.max(live.elapsed, 20 * h), lo = Math.floor(Math.log10(h) + 0.0001), hi = Math.ceil(Math.log10(end) + 0.02);
  const a = axes(svg, { x: [lo, Math.max(hi, lo + 2)], y: [-18, 2], xlabel: `time integrated, ${s.time || 'units of the scene'}`, ylabel: 'largest error so far, relative to the start', tick: k => k < -3 || k > 4 ? '10' + sup(k) : String(+(10 ** k).toPrecision(1)) });
  const line = (c, colour, width, extra = '') => c.length > 1 ? `<path d="${c.map((p, i) => { const [X, Y] = a.inside(p[2], Math.max(p[1], 1e-18)); return (i ? 'L' : 'M') + X.toFixed(1) + ' ' + Y.toFixed(1); }).join('')}" fill="none" stroke="var(--${colour})" stroke-width="${width}" stroke-linejoin="round" ${extra}/>` : '';
  const eps = 1.1e-16, step = Math.abs(set.h), x0 = Math.max(step, 10 ** lo), x1 = 10 ** Math.max(hi, lo + 2);
  let out = a.out;
  if (step > 0 && isFinite(step)) { const [X0, Y0] = a.inside(x0, eps * Math.sqrt(x0 / step)), [X1, Y1] = a.inside(x1, eps * Math.sqrt(x1 / step)); out += `<line x1="${X0}" y1="${Y0}" x2="${X1}" y2="${Y1}" stroke="var(--muted)" stroke-dasharray="5 4"/>`; }
  const acting = s.effects.filter((e, k) => set.on >> k & 1), forces = acting.filter(e => e.kind === 1);
  const stays = s.kept.map(q => !acting.some(e => q.unless.includes(e.name)));
  out += (stays[1] ? line(curves.kept[1], 'verlet', 1.2) : '') + (stays[0] ? line(curves.kept[0], 'dop', 1.2) : '') + line(curves.gap4, 'rk4', 1.4, 'stroke-dasharray="2 3"') + line(curves.gap, 'ink', 1.4, 'stroke-dasharray="2 3"') + line(curves.rk4, 'rk4', 1.8) + line(curves.gvi, 'gvi', 2.2);
  svg.innerHTML = out;
  const last = c => c.length ? c[c.length - 1][1] : 0;
  svg.setAttribute('aria-label', `Error of the energy over ${short(live.elapsed)} of time: gvi.h ${short(last(curves.gvi))}${curves.rk4.length ? `, Runge-Kutta 4 ${short(last(curves.rk4))}` : ''}.${curves.gap.length ? ` Constraint: gvi.h ${short(last(curves.gap))}${curves.gap4.length ? `, Runge-Kutta 4 ${short(last(curves.gap4))}` : ''}.` : ''}`);
  const swatch = (c, w, dash = '') => `<svg aria-hidden="true"><line x1="1" x2="21" y1="6" y2="6" stroke="var(--${c})" stroke-width="${w}" stroke-dasharray="${dash}"/></svg>`;
  const legend = `<li>${swatch('gvi', 2.2)}energy, gvi.h</li>` + (ghost.on ? `<li>${swatch('rk4', 1.8)}energy, Runge-Kutta 4${ghost.h ? `, h = ${short(ghost.h)}` : ''}</li>` : '')
    + s.kept.map((q, k) => stays[k] ? `<li>${swatch(k ? 'verlet' : 'dop', 1.2)}${html(q.name)}, gvi.h</li>` : '').join('') + (held() ? `<li>${swatch('ink', 1.4, '2 3')}constraint, |g|, gvi.h</li>` + (ghost.ok ? `<li>${swatch('rk4', 1.4, '2 3')}constraint, |g|, Runge-Kutta 4</li>` : '') : '') + `<li>${swatch('muted', 1.2, '4 3')}Brouwer: ε √steps</li>`;
  if ($('stability-legend').dataset.is !== legend) { $('stability-legend').innerHTML = legend; $('stability-legend').dataset.is = legend; }
  const broken = s.kept.filter(q => acting.some(e => q.unless.includes(e.name)));
  let note = s.timed ? `${s.momenta ? 'H' : 'L'} depends on t: the energy is not to stay. ` : forces.length ? `The energy is not to stay while ${forces.map(e => e.name).join(', ')} ${forces.length > 1 ? 'act' : 'acts'}: switch that off to see what the integrator keeps. ` : 'The energy of the exact motion is constant. ';
  if (held() && s.kept) note += `The constraint is |g|, the largest over the run${s.length ? `, in ${s.length}²` : ''}: gvi.h satisfies it in each step, Runge-Kutta 4 only its second derivative. `;
  broken.forEach(q => { note += `The ${q.name} is changed by ${acting.filter(e => q.unless.includes(e.name)).map(e => e.name).join(', ')}. `; });
  $('stability-note').textContent = note;
  $('stability-caption').textContent = `${many(x.world_number(0, 1, 0))} steps since the last change${ghost.on ? '; Runge-Kutta 4 gets as many evaluations' : ''}.`;
}

/* ---- races: a queue that runs in slices between frames ---- */
let race = null, problemNow = null, costDirty = true;
const wanted = [];

function problem() {
  const key = JSON.stringify([set.scene, set.on, set.p]);
  if (!problems.has(key)) problems.set(key, { key, points: [], o: { scene: set.scene, on: set.on, p: [...set.p] }, todo: null, reference: null, floor: 0, note: '' });
  const p = problems.get(key);
  if (problemNow !== p) { problemNow = p; wanted.length = 0; race = campaign(p); }
  const here = setting();
  if (live.ok && !p.points.some(a => a.id === here.id)) { if (!wanted.some(a => a.id === here.id)) wanted.push(here); }
  costDirty = true;
  delete $('cost').dataset.left;
}
const setting = () => job(0, { degree: set.degree, rule: set.rule, tol: set.tol, h: set.h, dial: set.dial });
function job(method, o) {
  const j = { method, degree: 0, rule: 'gauss', tol: 0, h: 0, dial: 0, ...o };
  if (j.rule === 'verlet' || j.rule === 'kicks8') j.degree = 1;
  if (j.h < 0) j.h = -j.h;
  j.id = [method, j.degree, j.rule, j.tol, j.dial ? 'dial ' + j.dial : j.h].join(' ');
  return j;
}

/* One run: its end, and with `timed` the least of some times. */
function* run(p, j, timed, on = p.o.on) {
  const o = { ...p.o, on, degree: j.method ? 8 : j.degree, rule: j.method ? 'gauss' : j.rule, tol: j.method ? 0 : j.tol, dial: j.dial }, span = scenes[o.scene].span;
  let chunk = 8, first = 0, status = open(1, o) || x.race_begin(1, j.method, j.h, span);
  const once = function* () {
    let sum = 0;
    while (status === 0) {
      const t = now();
      status = x.race_steps(1, chunk);
      const d = now() - t;
      sum += d;
      if (d < 1) chunk = Math.min(2 * chunk, 1 << 20); else if (d > 3) chunk = Math.max(1, chunk >> 1);
      if (sum > (timed ? 1200 : 5000)) status = 99;   // without a reference there is no plot
      yield;
    }
    return sum;
  };
  first = yield* once();
  if (status < 0 || status === 99) return { ...j, status };
  const result = { ...j, work: x.race_number(1, 1), steps: x.race_number(1, 0), used: x.race_number(1, 2), iterations: x.race_number(1, 3) };
  const q = x.race_end(1) / 8;
  result.q = [...numbers.subarray(q, q + scenes[o.scene].n)];
  let best = Math.max(first, 1e-3);
  if (timed && first > 6) for (let k = 0; k < (first > 150 ? 0 : 2); k++) { status = x.race_begin(1, j.method, j.h, span); best = Math.min(best, yield* once()); }
  else if (timed) {
    let times = 1, kept = 0;
    best = Infinity;
    for (let k = 0; k < 30 && kept < 4; k++) {
      const t = now();
      x.race_repeat(1, times, j.h);
      const d = now() - t;
      if (d < 2 && times < 4096) times *= d < 0.5 ? 4 : 2; else { best = Math.min(best, d / times); kept++; }
      yield;
    }
  }
  result.time = best;
  return result;
}

function* campaign(p) {
  const s = scenes[p.o.scene], far = (a, b) => Math.max(...a.map((v, i) => Math.abs(v - b[i])));
  if (!p.todo) {
    /* the reference: degree 16, small steps, with the scene's clock if that is possible; a second
       one with half the step tells how well it is known */
    const tries = s.clock >= 0 ? [p.o.on | 1 << s.clock, p.o.on] : [p.o.on];
    for (const on of tries) {
      const a = yield* run(p, job(0, { degree: 16, h: s.h / 3 }), false, on);
      if (!a.q) continue;
      const b = yield* run(p, job(0, { degree: 16, h: s.h / 6 }), false, on);
      if (!b.q || b.q.some(v => !isFinite(v))) continue;
      p.reference = b.q; p.floor = Math.max(far(a.q, b.q), 1e-16);
      break;
    }
    p.todo = [];
    if (!p.reference) p.note = 'No reference: even small steps of degree 16 fail here.';
    else {
      for (const dial of [1e-8, 1e-10, 1e-12, 1e-14, 1e-6, 1e-4]) p.todo.push(job(0, { degree: 8, h: s.h, dial, longer: dial > 1e-8 }));
      for (let k = 3; k <= 13; k += 2) p.todo.push(job(3, { h: +`1e-${k}` }));
      for (let k = 2; k <= 9; k++) p.todo.push(job(2, { h: s.h / 2 ** k }));
      for (let k = 2; k <= 10; k++) p.todo.push(job(1, { h: s.h / 2 ** k }));
      for (const [degree, tol] of [[2, 0], [4, 0], [8, 0], [16, 0], [4, 1e-9], [8, 1e-12], [8, 1e-6], [16, 1e-12]])
        for (const k of tol ? [0, -1, -2, 1] : [0, -1, -2, -3, 1, 2]) p.todo.push(job(0, { degree, tol, h: s.h * 2 ** (k + (degree === 16) - (degree === 2)), longer: k > 0 }));
    }
    p.all = p.todo.length;
  }
  const slow = {}, kind = j => [j.method, j.degree, j.rule, j.tol, !!j.dial, !!j.longer].join(' ');
  for (;;) {
    const mine = wanted.length > 0, j = mine ? wanted.shift() : p.todo.shift();
    if (!j) {
      /* nothing to do: time what was timed again, the least counts */
      const again = p.points.filter(a => a.q0 && a.seen < 3 && a.time < 30).sort((a, b) => a.seen - b.seen)[0];
      if (!again) { yield 'idle'; continue; }
      const r = yield* run(p, again, true);
      again.seen++;
      if (r.time < again.time) { again.time = r.time; costDirty = true; }
      continue;
    }
    if (!p.reference || p.points.some(a => a.id === j.id) || (!mine && (slow[kind(j)] || slow[j.method]))) { costDirty = true; continue; }
    const r = yield* run(p, j, true);
    if (r.status === -6 && j.method) slow[j.method] = true;           // not for this scene
    if (r.time > 40 || r.status === 99) slow[kind(j)] = true;
    if (r.q) { r.error = far(r.q, p.reference); delete r.q; r.q0 = true; r.seen = 0; }
    r.mine = mine;
    p.points.push(r);
    costDirty = true;
  }
}

function measure(budget) {
  const end = now() + budget;
  while (race && now() < end) { const r = race.next(); if (r.done || r.value === 'idle') break; }
}

const costOf = a => set.by === 'time' ? a.time : Math.max(a.work, 1);    // 0: drawn at 1
const priceOf = a => set.by === 'time' ? duration(a.time) : many(a.work) + ' evaluations';
const power = v => '10' + sup(Math.round(Math.log10(v))), plainly = v => v >= 1e-4 ? String(+v.toPrecision(4)) : short(v, 3);
const describe = a => a.method === 0 ? `degree ${a.degree}, ${RULE_SHORT[RULES.indexOf(a.rule)] ?? a.rule}, ${a.dial ? `the dial at ${power(a.dial)}` : `h = ${plainly(a.h)}`}${a.tol ? `, iterated to ${power(a.tol)}` : ''}`
  : a.method === 3 ? `DOP853 with tolerance ${power(a.h)}` : `${METHODS[a.method]} with h = ${plainly(a.h)}`;
let cheapest = null;

function drawCost() {
  costDirty = false;
  const p = problemNow, s = scene(), svg = $('cost'), good = p.points.filter(a => isFinite(a.error) && a.time > 0);
  const cost = good.map(costOf), byTime = set.by === 'time';
  const lo = Math.floor(Math.log10(Math.min(...cost, byTime ? 0.1 : 1e3)) + 0.05), hi = Math.ceil(Math.log10(Math.max(...cost, byTime ? 1 : 1e4)) - 0.05);
  const a = axes(svg, { x: [lo, hi], y: [-16, 2], xlabel: byTime ? 'time of the run, ms' : 'evaluations of all effects', ylabel: `error at the end${s.unit ? ', ' + s.unit : ''}`, tick: k => byTime && k > -3 && k < 4 ? String(+(10 ** k).toPrecision(1)) : '10' + sup(k) });
  let out = a.out;
  const floor = Math.max(p.floor, 2e-16), top = a.Y(floor);
  if (p.reference) out += `<rect x="${a.L}" width="${a.W - a.L - a.R}" y="${top}" height="${Math.max(0, a.H - a.B - top)}" fill="var(--soft)"/><text x="${a.L + 4}" y="${Math.min(top + 14, a.H - a.B - 3)}">error of the reference</text>`;
  const w = a.Y(10 ** set.want);
  out += `<line x1="${a.L}" x2="${a.W - a.R}" y1="${w}" y2="${w}" stroke="var(--ink)" stroke-dasharray="2 4"/><text class="axis" x="${a.L + 4}" y="${w - 5}">wanted</text>`;
  const groups = new Map();
  for (const q of good) {
    const key = q.method ? 'm' + q.method : [q.degree, q.rule, q.tol, !!q.dial].join(' ');
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(q);
  }
  const here = setting().id;
  let labels = '';
  const placed = [];
  for (const list of [...groups.values()].sort((g, k) => k[0].method - g[0].method)) {
    list.sort((b, c) => c.h - b.h || c.dial - b.dial);
    const colour = `var(--${COLOURS[list[0].method]})`, at = list.map(q => a.inside(costOf(q), Math.max(q.error, 1e-16)));
    if (list.length > 1 && (!list[0].tol || list.some(q => q.id === here))) out += `<path d="M${at.map(q => q[0].toFixed(1) + ' ' + q[1].toFixed(1)).join('L')}" fill="none" stroke="${colour}" stroke-width="1.3" opacity="${list[0].method ? 0.75 : 0.45}"/>`;
    list.forEach((q, i) => {
      out += marker(q.method, at[i][0], at[i][1], q.method ? 3.6 : 4, `class="point" ${q.tol ? `fill="var(--card)" stroke="${colour}" stroke-width="1.6"` : `fill="${colour}"`} data-id="${q.id}" data-method="${q.method}" data-degree="${q.degree}" data-h="${q.h}" data-error="${q.error}" data-time="${q.time}" data-work="${q.work}"`);
      if (q.id === here) out += `<circle id="here" cx="${at[i][0]}" cy="${at[i][1]}" r="9" fill="none" stroke="${colour}" stroke-width="2.2" pointer-events="none"/>`;
    });
    if (!list[0].method && at.length) {
      const end = at[at.length - 1], name = !byTime && !list[0].work ? '' : list[0].dial ? 'dial' : list[0].rule === 'gauss' && !list[0].tol ? list[0].degree : '';
      const places = [[8, 4], [-8, 4], [8, -9], [8, 17], [-8, -9], [-8, 17]].map(([dx, dy]) => [end[0] + dx, end[1] + dy, dx < 0]);
      const free = ([X, Y, left]) => (left || X < a.W - 32) && !placed.some(o => Math.abs(o[0] - X - (left ? -12 : 12)) < 24 && Math.abs(o[1] - Y) < 13);
      const [X, Y, left] = places.find(free) || places[0];
      if (name !== '') {
        placed.push([X + (left ? -12 : 12), Y]);
        labels += `<text x="${X}" y="${Y}" text-anchor="${left ? 'end' : 'start'}" style="fill:${colour};font-weight:600;stroke:var(--card);stroke-width:3;paint-order:stroke">${name}</text>`;
      }
    }
  }
  svg.innerHTML = out + labels;
  const used = [0, 1, 2, 3].filter(m => good.some(q => q.method === m));
  $('cost-legend').innerHTML = used.map(m => `<li><svg aria-hidden="true">${marker(m, 11, 6, 4.4, `fill="var(--${COLOURS[m]})"`)}</svg>${METHODS[m]}${m === 0 ? ', by degree' : ''}</li>`).join('')
    + (good.some(q => q.tol) ? `<li><svg aria-hidden="true">${marker(0, 11, 6, 4, 'fill="var(--card)" stroke="var(--gvi)" stroke-width="1.6"')}</svg>iterated to a tolerance</li>` : '')
    + (good.some(q => q.id === here) ? '<li><svg aria-hidden="true"><circle cx="11" cy="6" r="5" fill="none" stroke="var(--gvi)" stroke-width="2"/></svg>as set now</li>' : '');
  const left = (p.todo ? p.todo.length : 40) + wanted.length, none = [1, 2, 3].filter(m => p.points.some(q => q.method === m && q.status === -6));
  $('cost-caption').textContent = p.note || `A run to t = ${short(s.span, 3)}${s.time ? ' ' + s.time : ''}. ` + (left ? `Measuring, ${left} runs to go.` : none.length ? `${none.map(m => METHODS[m]).join(', ')} cannot: ${s.momenta ? 'it needs H split as T(p) + V(q)' : s === mine ? 'L is ' + s.effects[0].what : s.mass && !s.mass.includes('MASS_DIAGONAL') ? 'the mass depends on q' : held() ? 'a constraint acts (degree 1 with Lobatto is RATTLE)' : 'a force reads v'}.` : 'All measured here, now.') + (s === mine ? ` Of the others an evaluation is ${s.momenta ? "of q' and p'" : 'an acceleration'}.` : '');
  svg.dataset.left = left;
  svg.dataset.height = a.H;
  /* the cheapest for the wanted error */
  const fit = m => good.filter(q => (m ? q.method > 0 : q.method === 0) && q.error <= 10 ** set.want).sort((b, c) => costOf(b) - costOf(c))[0];
  cheapest = fit(0);
  const rival = fit(1), goal = `an error of 10${sup(set.want)}${s.unit ? ' ' + html(s.unit) : ''}`;
  const current = good.find(q => q.id === here);
  let words = cheapest ? `Cheapest setting so far for ${goal}: <b>${describe(cheapest)}</b>, ${priceOf(cheapest)}. ` : `No setting so far reaches ${goal}. `;
  if (rival && cheapest && (byTime || cheapest.work)) { const r = costOf(rival) / costOf(cheapest); words += `The best rival, ${describe(rival)}, takes ${priceOf(rival)}: ${r > 1.05 ? short(r, 1) + ' times as much.' : r < 0.95 ? short(r, 1) + ' of that.' : 'about the same.'}`; }
  else if (rival) words += cheapest ? 'Nothing acts, so nothing is evaluated.' : `${describe(rival)} does, in ${priceOf(rival)}.`;
  else if (left === 0) words += 'No rival here reaches it.';
  if (cheapest && cheapest.id !== here) words += '<br><button type="button" id="use">Use it</button>';
  else if (cheapest) words += '<br>';
  if (cheapest) words += '<button type="button" id="copy-too">Copy the C</button>';
  if ($('cheapest').dataset.is !== words) { $('cheapest').innerHTML = words; $('cheapest').dataset.is = words; }
  svg.setAttribute('aria-label', `Error at the end of the run against ${byTime ? 'time' : 'evaluations'}; ${good.length} points. ${$('cheapest').textContent.replace(/(Use it)?(Copy the C)?$/, '')}`);
  if (!pointed) current ? tell(current, 'As set now: ') : $('point').textContent = 'Each setting that you try leaves a point. Click one to go back to it.';
  $('dial-out').textContent = set.dial && current ? `${many(current.steps)} steps in ${duration(current.time)} a run` : '';
  $('code').textContent = program(cheapest || current || setting());
  $('points').innerHTML = '<thead><tr><th>setting</th><th>error</th><th>time</th><th>evaluations</th><th>steps</th></tr></thead><tbody>' + p.points.filter(q => q.time).sort((b, c) => b.method - c.method || b.degree - c.degree || c.h - b.h).map(q => `<tr><td>${describe(q)}</td><td>${short(q.error)}</td><td>${duration(q.time)}</td><td>${many(q.work)}</td><td>${many(q.steps)}</td></tr>`).join('') + '</tbody>';
}
let pointed = false;
const tell = (q, lead = '') => { const words = `${lead}${describe(q)}: error ${short(q.error)}${scene().unit ? ' ' + scene().unit : ''} in ${duration(q.time)}, ${many(q.steps)} steps, ${many(q.work)} evaluations${q.method ? '' : ` (${duration(q.time / q.steps)} a step)`}.`; if ($('point').textContent !== words) $('point').textContent = words; };

/* ---- the C that makes a point ---- */
/* Lines again for what a macro made one line of: "{" after ") " opens a block, any other a list. */
function pretty(code) {
  let out = '', round = 0;
  const open = [], depth = () => open.filter(b => b).length;
  for (let i = 0; i < code.length; i++) {
    const c = code[i];
    round += c === '(' ? 1 : c === ')' ? -1 : 0;
    if (c === '{') open.push(/\) $/.test(code.slice(0, i)) && !round);
    const block = c === '{' && open[open.length - 1], end = c === '}' && open.pop();
    out = end ? out.replace(/ *$/, '') + '    '.repeat(depth()) + '}' : out + c;
    if (block || end || (c === ';' && !round && open.every(b => b))) {
      out += '\n' + '    '.repeat(depth());
      while (code[i + 1] === ' ') i++;
    }
  }
  return out.trimEnd();
}
/* Only the definitions that the effects which are on lead to. */
function needed(code, roots) {
  const parts = pretty(code).split(/\n(?=\S)(?!\})/);
  const name = p => (/^(?:GVI_\w+\(|static.*? )(\w+)(?:[[(,;]| =)/.exec(p) || [])[1];
  for (;;) {
    const keep = parts.filter(p => /^enum/.test(p) || [roots, ...parts.filter(o => o !== p)].some(o => new RegExp(`\\b${name(p)}\\b`).test(o)));
    if (keep.length === parts.length) return keep.join('\n');
    parts.splice(0, parts.length, ...keep);
  }
}
function program(j) {
  const s = scene(), on = s.effects.filter((e, k) => set.on >> k & 1), tau = clocked();
  const steps = Math.ceil(s.span / j.h - 1e-9), C = v => Number.isInteger(v) ? v + '.0' : String(v);
  const typed = s === mine, v = s.momenta ? 'p' : 'v', code = typed ? s.text : needed(s.text, [...on.map(e => e.code), s.make, s.mass].join(' '));
  const state = f => [...Array(s.n)].map((_, i) => x.world_number(0, f, i)).join(', ').replace(/(.{60,90}?), /g, '$1,\n                        ');
  const rule = { gauss: '', 'gauss+2': ` .rule = { .points = ${j.degree + 2} },`, lobatto: ' .rule = { .kind = GVI_LOBATTO },' }[j.rule];
  const kicks = rule === undefined;
  return `/* ${s.title}: ${describe(j)}. Written by the playground of gvi.h.
   cc -I. -Iexamples -Idocs/playground this.c -lm      in the top folder of gvi.h  */
#define GVI_IMPLEMENTATION
#include "${typed ? 'tools/lagrangian.h' : /_clock /.test(code) ? 'clocks.h' : 'tools/effects.h'}"${/ bodies /.test(code) ? '\n#include "tools/body.h"' : ''}
#include <stdio.h>
#include <stdlib.h>

${code}

int main(void)
{
    const double q[] = { ${state(32)} };
    const double ${v}[] = { ${state(33)} };
${typed ? `    static ${s.momenta ? 'hamiltonian H' : 'lagrangian L'};
    const char *wrong = ${s.momenta ? 'hamiltonian_init(&H' : 'lagrangian_init(&L'}, own, NULL, 0, q, ${v});
    if (wrong) return puts(wrong), 1;
${s.kind ? `    L.kind = LAGRANGIAN_${KINDS[s.kind]};\n` : ''}` : ''}${on.length ? `    const gvi_effect effects[] = {
${on.map(e => `        ${e.code},`).join('\n')}
    };
` : ''}${kicks && j.rule === 'verlet' ? '    const double nodes[] = { 0, 1 }, weights[] = { 0.5, 0.5 };\n' : kicks ? kicks8() : ''}    gvi_desc desc = { .n = ${s.n}, .degree = ${j.degree},${kicks ? ` .rule = { GVI_KICKS, ${j.rule === 'verlet' ? 2 : 18}, nodes, weights },` : rule}${j.tol ? ` .tolerance = ${j.tol.toExponential(0)},` : ''}${j.dial ? ` .resolution = ${j.dial.toExponential(0)},` : ''}${on.length ? `
                      .effects = effects, .effect_count = ${on.length}` : ''}${s.momenta ? ', .formulation = GVI_MOMENTA' : ''} };
    gvi_stepper st;
${s.make ? `    ${s.make}\n` : ''}${s.mass ? `    desc.mass = ${s.mass.replace(/^\((\(.*)\)$/, '$1')};\n${held() && !typed ? '    desc.mass.velocity = NULL;                  // with constraints gvi.h solves for it\n' : ''}` : ''}    double *memory = malloc(gvi_size(&desc));
    if (gvi_init(&st, &desc, memory, gvi_size(&desc)) == GVI_OK) ${s.momenta ? 'gvi_start_momentum' : 'gvi_start'}(&st, 0, q, ${v});
    ${j.dial ? `while (st.status == GVI_OK && st.t < ${C(s.span)}) gvi_advance(&st, ${C(s.span)});` : tau ? `while (st.status == GVI_OK && st.t < ${C(s.span)}) gvi_step(&st, ${C(j.h)});      // h in tau` : `for (int k = 0; k < ${steps} && st.status == GVI_OK; ++k) gvi_step(&st, ${C(s.span)}/${steps});`}
    printf("%s at t = %.17g\\n", gvi_why(&st), st.t);
    for (int i = 0; i < ${s.n}; ++i) printf("q[%d] = %.17g\\n", i, st.q[i]);
    free(memory);
    return st.status != GVI_OK;
}
`;
}
function kicks8() {
  const rows = at => [...numbers.subarray(at, at + 18)].join(', ').replace(/((?:[^,]+, ){3}[^,]+), /g, '$1,\n        ');
  return `    static const double nodes[] = {\n        ${rows(x.kicks() / 8)} };\n    static const double weights[] = {\n        ${rows(x.kicks() / 8 + 18)} };\n`;
}

/* ---- what a person does ---- */
function change(o, keep = true) { Object.assign(set, o); pointed = false; apply(keep && live.t !== undefined); }
$('examples').innerHTML = Object.keys(EXAMPLES).map(k => `<option>${k}</option>`).join('');
$('examples').onchange = e => { $('typed').value = EXAMPLES[e.target.value]; if (!takeTyped($('typed').value)) choose(mine.i); };
let typing = 0;
$('typed').oninput = () => { clearTimeout(typing); typing = setTimeout(() => { if (!takeTyped($('typed').value)) choose(mine.i); }, 400); };
const list = (id, values, names) => { $(id).innerHTML = values.map((v, i) => `<option value="${v}">${names[i]}</option>`).join(''); };
list('rule', RULES, RULE_NAMES);
list('dial', DIALS, DIALS.map(d => d ? `the dial: accurate to 10${sup(Math.log10(d))}` : 'all of length h'));
list('tolerance', TOLERANCES, TOLERANCES.map(t => t ? `a change below 10${sup(Math.log10(t))}` : 'rounding: symplectic to the last bit'));
$('scenes').innerHTML = scenes.map((s, i) => `<button type="button" role="radio" data-scene="${s.name}" aria-checked="false">${html(s.title)}</button>`).join('');
const choose = i => { if (i === mine.i) start(); defaults(i); pointed = false; live.fast = false; $('fast').setAttribute('aria-pressed', false); $('encounter').textContent = ''; live.playing = !calm.matches; turn.yaw = 0.6; turn.pitch = 0.5; apply(false); };
$('scenes').onclick = e => { const b = e.target.closest('button'); if (b) choose([...$('scenes').children].indexOf(b)); };
$('scenes').onkeydown = e => {
  const d = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[e.key];
  if (!d) return;
  e.preventDefault(); e.stopPropagation();
  choose((set.scene + d + scenes.length) % scenes.length);
  $('scenes').children[set.scene].focus();
};
$('rows').onchange = e => { const k = +e.target.dataset.k; change({ on: e.target.checked ? set.on | 1 << k : set.on & ~(1 << k) }); };
$('parameters').oninput = e => { set.p[+e.target.dataset.k] = +e.target.value; change({}, false); };
$('degree').oninput = e => { $('degree-n').value = e.target.value; change({ degree: +e.target.value }); };
$('degree-n').onchange = e => change({ degree: e.target.value === '' ? NaN : +e.target.value });
$('h').oninput = e => { const h = ladder(+e.target.value); $('h-n').value = h; change({ h }); };
$('h-n').onchange = e => change({ h: e.target.value === '' ? NaN : +e.target.value });
$('rule').onchange = e => change({ rule: e.target.value, degree: /verlet|kicks/.test(e.target.value) ? 1 : set.degree === 1 ? scene().degree : set.degree });
$('tolerance').onchange = e => change({ tol: +e.target.value });
$('dial').onchange = e => change({ dial: +e.target.value, h: +e.target.value ? scene().h : set.h });
$('play').onclick = () => live.playing ? pause() : play();
$('restart').onclick = () => { const p = live.playing; apply(false); if (p) play(); };
$('reverse').onclick = () => {
  live.dir = -live.dir;
  live.target = live.dir > 0 ? Math.min(live.t, live.target) : Math.max(Math.min(live.target, live.t), -Infinity);
  if (live.fast) live.target = live.t;
  $('reverse').setAttribute('aria-pressed', live.dir < 0);
  play();
};
$('step').onclick = () => { pause(); if (live.ok && !back()) { stepOnce(); live.target = live.t; sampleEnergy(); if (back()) arrive(); dirty = plotDirty = true; showNumbers(); } };
$('speed').oninput = e => { live.speed = +e.target.value; const v = 2 ** live.speed; $('speed-out').textContent = (v < 1 ? `1/${1 / v}` : v) + '×'; };
$('fast').onclick = () => { live.fast = !live.fast; if (!live.fast) live.target = live.t; $('fast').setAttribute('aria-pressed', live.fast); if (live.fast) play(); };
$('ghost').onclick = () => { ghost.on = !ghost.on; $('ghost').setAttribute('aria-pressed', ghost.on); apply(true); };
$('halve').onclick = () => { change({ h: +(set.h / 2).toPrecision(6) }); play(); };
const clockOn = () => { change({ on: set.on | 1 << scene().clock, rule: 'gauss' }, false); play(); $('encounter').textContent = `The clock runs slowly near the encounter: h = ${set.h} is now a step in τ, with dt = g(q) dτ, and the map is as symplectic as with fixed steps.`; };
$('clock').onclick = $('alert-clock').onclick = clockOn;
$('break').onclick = () => {
  const s = scene();
  const o = s.name === 'kepler' ? { on: 1, p: [0.97, set.p[1]], h: 0.02, degree: 8 } : { on: set.on & ~(1 << s.clock), h: s.name === 'pythagoras' ? 0.05 : 0.4, degree: 8, p: s.name === 'eight' ? [-0.1] : set.p };
  change({ ...o, rule: 'gauss', tol: 0, dial: 0 }, false);
  play();
  $('encounter').textContent = `A fixed step of ${set.h} is far too long where the bodies meet, and nothing adapts it: watch the energy at each encounter. Then turn the clock on.`;
};
$('want').oninput = e => { set.want = +e.target.value; remember(); showControls(); costDirty = true; };
const by = v => { set.by = v; for (const [id, k] of [['by-time', 'time'], ['by-work', 'evaluations']]) { $(id).setAttribute('aria-checked', v === k); $(id).tabIndex = v === k ? 0 : -1; } costDirty = true; };
$('by-time').onclick = () => by('time'); $('by-work').onclick = () => by('evaluations');
$('by-time').parentNode.onkeydown = e => { if (/^Arrow/.test(e.key)) { e.preventDefault(); e.stopPropagation(); by(set.by === 'time' ? 'evaluations' : 'time'); $(set.by === 'time' ? 'by-time' : 'by-work').focus(); } };
const pointAt = e => { const m = e.target.closest?.('.point'); return m && problemNow.points.find(a => a.id === m.dataset.id); };
$('cost').onmousemove = e => { const q = pointAt(e); if (q) { pointed = true; tell(q); } };
$('cost').onmouseleave = () => { pointed = false; costDirty = true; };
const adopt = q => change({ degree: q.degree, rule: q.rule, tol: q.tol, h: q.h, dial: q.dial });
$('cost').onclick = e => { const q = pointAt(e); if (q) { tell(q); if (!q.method) adopt(q); } };
$('cheapest').onclick = e => { if (e.target.id === 'copy-too') copy($('code').textContent, e.target); if (e.target.id === 'use' && cheapest) adopt(cheapest); };
async function copy(what, button) {
  const before = button.textContent;
  try { await navigator.clipboard.writeText(what); }
  catch { const a = document.createElement('textarea'); a.value = what; document.body.append(a); a.select(); document.execCommand('copy'); a.remove(); }
  button.textContent = 'Copied'; $('said').textContent = 'Copied';
  setTimeout(() => { button.textContent = before; $('said').textContent = ''; }, 1200);
}
$('copy').onclick = () => copy($('code').textContent, $('copy'));
$('save').onclick = () => {
  const sheet = document.createElement('canvas'), paint = sheet.getContext('2d'), link = document.createElement('a');
  sheet.width = canvas.width; sheet.height = canvas.height;
  paint.fillStyle = colours.card;
  paint.fillRect(0, 0, sheet.width, sheet.height);
  paint.drawImage(canvas, 0, 0);
  link.href = sheet.toDataURL('image/png');
  link.download = `${scene().name}.png`;
  link.click();
  $('said').textContent = 'Saved';
};
$('share').onclick = () => { remember(); copy(location.href, $('share')); };
const THEMES = [['', 'Auto', 'as the system'], ['light', 'Light', 'light'], ['dark', 'Dark', 'dark']];
let theme = 0;
$('theme').onclick = () => {
  theme = (theme + 1) % 3;
  if (THEMES[theme][0]) document.documentElement.dataset.theme = THEMES[theme][0]; else delete document.documentElement.dataset.theme;
  $('theme').textContent = THEMES[theme][1]; $('theme').setAttribute('aria-label', 'Colours: ' + THEMES[theme][2]);
  readColours();
};
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', readColours);
const grip = { id: -1, x: 0, y: 0 };
const spin = (a, b) => { turn.yaw += a; turn.pitch = Math.max(-1.5, Math.min(1.5, turn.pitch + b)); dirty = true; };
canvas.onpointerdown = e => { if (!scene().space) return; Object.assign(grip, { id: e.pointerId, x: e.clientX, y: e.clientY }); canvas.setPointerCapture(e.pointerId); };
canvas.onpointermove = e => { if (e.pointerId !== grip.id) return; spin((e.clientX - grip.x) * 0.008, (e.clientY - grip.y) * 0.008); grip.x = e.clientX; grip.y = e.clientY; };
canvas.onpointerup = canvas.onpointercancel = () => { grip.id = -1; };
canvas.onkeydown = e => {
  const d = { ArrowLeft: [-0.12, 0], ArrowRight: [0.12, 0], ArrowUp: [0, -0.12], ArrowDown: [0, 0.12] }[e.key];
  if (d && scene().space) { spin(...d); e.preventDefault(); e.stopPropagation(); }
};
addEventListener('keydown', e => {
  if (e.ctrlKey || e.metaKey || e.altKey || /^(INPUT|SELECT|TEXTAREA|PRE)$/.test(e.target.tagName)) return;
  const act = { ' ': 'play', ArrowRight: 'step', r: 'reverse', R: 'reverse', 0: 'restart' }[e.key];
  if (!act || (e.key === ' ' && /^(BUTTON|SUMMARY|A)$/.test(e.target.tagName))) return;
  e.preventDefault();
  $(act).click();
});
addEventListener('hashchange', () => { if (location.hash !== written) { const bad = recall(); apply(false, bad); } });
const resized = new ResizeObserver(() => { dirty = plotDirty = costDirty = true; });
for (const id of ['canvas', 'cost', 'stability']) resized.observe($(id));

/* ---- frames ---- */
let last = now(), counted = 0, plotted = 0;
function frame() {
  requestAnimationFrame(frame);                          // first: whatever goes wrong, there is a next one
  const t = now(), dt = Math.min(0.05, (t - last) / 1000);
  last = t;
  if (live.playing && live.ok) simulate(dt);
  measure(live.fast ? 3 : 4);
  if (dirty) { draw(); dirty = live.playing; }
  if (t - counted > 300) { showNumbers(); counted = t; }
  if (t - plotted > 160) {
    if (plotDirty) { drawStability(); plotDirty = false; plotted = t; }
    else if (costDirty) { drawCost(); plotted = t; }
    if (costDirty && t - lastCost > 500) { drawCost(); lastCost = t; }
  }
}
let lastCost = 0;
readColours();
apply(false, recall());
draw(); showNumbers(); drawStability();
document.documentElement.dataset.ready = Math.round(now());
requestAnimationFrame(frame);
window.gvi = { x, set, live, text, problems };           // for those who want to look inside, and tests
})();
