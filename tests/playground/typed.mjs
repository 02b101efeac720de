// typed.mjs [WASM BUILD] - what is typed as L or H: its parser, its motion, its C.  For bits.mjs, the examples.
//
// Values come from JavaScript, motions from the scenes written by hand and from closed forms, and the ends from the
// C program, whose derivatives are complex steps.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const page = new URL('../../docs/playground/', import.meta.url), read = name => readFileSync(new URL(name, page), 'utf8');
const lagrange = new Function(`${read('lagrangian.js')}; return lagrange;`)();
export const EXAMPLES = new Function(`return ${/const EXAMPLES = (\{[^]*?\n\});/.exec(read('page.js'))[1]};`)();

/* What own_take is given, and what own_room holds then. */
export function handedOver(text) {
  const r = lagrange(text), room = new Float64Array(2455);
  r.steps.forEach((s, k) => room.set(s, 4*k));
  room.set([...r.q, ...r.v], 2400);
  room.set(r.draw, 2416);
  room.set(r.names.map((_, i) => r.force[i] ?? -1), 2440);
  room.set([r.holds.length + r.rolls.length, r.rolls.length, ...r.holds, ...r.rolls], 2448);
  room[2454] = r.momenta ? -1 : r.kind;
  return { r, room, given: [r.n, r.length, r.steps.length, r.draw.length/2, r.end] };
}

let passed = 0, failed = 0;
const check = (what, ok, ...seen) => { if (ok) passed++; else failed++, console.error(`FAILED ${what}`, ...seen); };

function test(wasm, build) {
  const { exports: x } = new WebAssembly.Instance(new WebAssembly.Module(readFileSync(wasm)), {});
  x._initialize?.();
  const numbers = new Float64Array(x.memory.buffer), octets = new Uint8Array(x.memory.buffer);
  const words = p => { let e = p; while (octets[e]) e++; return new TextDecoder().decode(octets.subarray(p, e)); };
  const OWN = x.scene_count() - 1;
  const take = text => {
    const { r, room, given } = handedOver(text);
    numbers.set(room, x.own_room()/8);
    r.why = words(x.own_take(...given));
    r.kind = words(x.scene_text(OWN, 11, 0));
    return r;
  };
  const open = (scene, on, degree = 8) => {
    for (let i = 0; i < 4; i++) numbers[x.parameters()/8 + i] = i < 3 ? x.scene_number(scene, 33, i) : 0;
    return x.world_open(1, scene, on, degree, 0, 0, 0);
  };
  const end = (scene, on, h, span, method = 0) => {
    let status = open(scene, on) || x.race_begin(1, method, h, span);
    while (!status) status = x.race_steps(1, 1000);
    const n = x.scene_number(scene, 0, 0), q = status === 1 ? x.race_end(1)/8 : NaN;
    return [...Array(n)].map((_, i) => numbers[q + i] ?? NaN);
  };
  const far = (a, b) => Math.max(...a.map((v, i) => Math.abs(v - b[i])));
  const index = name => { let i = 0; while (words(x.scene_text(i, 0, 0)) !== name) i++; return i; };

  /* values: as a constant, and at rest the energy is -L */
  for (const [typed, js] of [['2^3^2', 2**9], ['-2^2', -4], ['2^-1', 0.5], ['6/3*2', 4], ['1 - 2 - 3', -4], ['1 - (2 - 3)', 2], ['2*-3', -6], ['--2', 2],
    ['.5e1 + 1.', 6], ['1e-3', 1e-3], ['pow(2, 0.5)', Math.SQRT2], ['sqrt(2)*sin(1) - cos(2)/tan(0.3)', Math.SQRT2*Math.sin(1) - Math.cos(2)/Math.tan(0.3)],
    ['exp(log(3))', 3], ['2\n  *3', 6], ['3 # *4\n + 1', 4], ['pi', Math.PI], ['(1+2)*(3+4)', 21], ['8/2/2', 2], ['2 pi', 2*Math.PI], ['2(3 + 4)', 14], ['(1 + 2)(3 + 4)', 21], ['3²', 9], ['2·3 × 4', 24], ['5 − 2', 3], ['sin^2(0.3)', Math.sin(0.3)**2], ['cos²(0.3)', Math.cos(0.3)**2], ['ln(3)', Math.log(3)],
    ['cosh(0.7) - sinh(0.7)', Math.exp(-0.7)], ['tanh(0.4)', Math.tanh(0.4)], ['atan(0.3) + atan(5)', Math.atan(0.3) + Math.atan(5)], ['asin(0.6)', Math.asin(0.6)], ['π', Math.PI], ['2*3^2', 18], ['1/2', 0.5]]) {
    check(`end = ${typed}`, Math.abs(lagrange(`L = vx^2 x(0) = 0 end = ${typed.startsWith('-') || js < 0 ? `100 + (${typed})` : typed}`).end - (js < 0 || typed.startsWith('-') ? 100 + js : js)) <= 1e-14*Math.max(100, Math.abs(js)), typed);
    /* the same with a coordinate in the place of each number that is not an exponent */
    const r = take(`u = y/y\nL = vx^2/2 + vy^2/2 + u*(${typed})\nx(0) = 0, y(0) = 3`);
    open(OWN, 1);
    check(`L = ${typed}: its value`, !r.why && Math.abs(x.world_number(1, 20, 0) + js) <= 4e-15*Math.max(1, Math.abs(js)), r.why, x.world_number(1, 20, 0), js);
  }
  const at = 0.7, b = 1.3;
  for (const [typed, js] of [['x^y', at**b], ['x^3', at**3], ['x^-2.5', at**-2.5], ['x^0.3', at**0.3], ['2^x', 2**at], ['pow(x, y)', at**b], ['sin(x)/cos(y)', Math.sin(at)/Math.cos(b)], ['tan(x) - exp(-y)', Math.tan(at) - Math.exp(-b)],
    ['log(x*y)', Math.log(at*b)], ['sqrt(x + y)', Math.sqrt(at + b)], ['-x^2/y', -at*at/b], ['x - y - x*y', at - b - at*b], ['exp(20*x)', Math.exp(14)], ['exp(-30*y)', Math.exp(-39)], ['log(1e-9*x)', Math.log(7e-10)], ['atan(x) + atan(-y*9)', Math.atan(at) - Math.atan(9*b)], ['tanh(x)*cosh(y)', Math.tanh(at)*Math.cosh(b)], ['3x y^2 sin(x)', 3*at*b*b*Math.sin(at)]]) {
    const r = take(`L = vx^2/2 + vy^2/2 + (${typed})\nx(0) = ${at}, y(0) = ${b}`);
    open(OWN, 1);
    check(`${typed}: its value`, !r.why && Math.abs(x.world_number(1, 20, 0) + js) <= 8e-16*Math.max(1, Math.abs(js))*4, r.why, x.world_number(1, 20, 0), js);
  }

  /* bad input: the place, and why */
  for (const [typed, line, column, why] of [
    ['L = 2\nx', 2, 1, /sign such as \* is missing before "x"/], ['L = 2x + vy^2\ny(0) = 1', 1, 6, /x is not known/], ['L = sin^x(x)\nx(0) = 1', 1, 9, /whole number belongs here/], ['F = 1\nL = vx^2 + vy^2\nx(0) = 1, y(0) = 1', 1, 1, /a force on x is Fx/], ['x(0) = 1\nL = vx^2 -', 2, 11, /not the end/], ['x(0) = 1\nL = (vx^2', 2, 10, /"\)" is missing before the end/],
    ['L = vx^2/2 - abs(x)\nx(0) = 1', 1, 14, /abs has a kink, and L and H have to be smooth/], ['L = foo(x)', 1, 5, /foo is not a function; there are sqrt, exp/],
    ['x(0) = 1\nL = vx^2 - k*x', 2, 12, /k is not known/], ['L = vx^2 $', 1, 10, /not with "\$"/], ['L = vx^2/2', 1, 11, /no coordinate/], ['x(0) = 1', 1, 9, /"L = \.\.\." or "H = \.\.\." is missing/],
    ['L = vx^2\n0 = 3\nx(0) = 1', 2, 1, /has to depend on a coordinate/], ['L = vx^2\n0 = x 0 = x 0 = x 0 = x\n0 = 2x\nx(0) = 0', 3, 1, /room for 4 constraints/], ['L = vx^2\n0 = x - k\nx(0) = 0', 2, 9, /k is not known/],
    ['x(0) = y\ny(0) = 1\nL = vx^2', 1, 1, /x\(0\) has to be a number: it depends on what moves/], ['L = vx^2 + a\na = b\nb = a\nx(0) = 1', 3, 5, /a depends on itself/],
    ['L = vx^2 x(0) = 0\ndraw = (vx, 0)', 2, 1, /not of velocities/], ['sin = 3', 1, 1, /sin has a meaning/], ['a = 1/0\nL = a*vx^2 x(0) = 1', 1, 1, /a is no finite number/],
    ['x = 3\nL = vx^2 x(0) = 1', 1, 1, /x is a coordinate/], ['L = pow(x) x(0) = 1', 1, 10, /pow takes two/], ['L = vx^2\nL = 3 x(0) = 1', 2, 1, /L is given twice/], ['L = vx^2 x(0) = 1 end = -1', 1, 19, /end has to be above 0/],
    ['x(0) = 1\nL = vx^2 draw = x', 2, 17, /a point \(x, y\) belongs here, not "x"/], ['', 1, 1, /no coordinate/], ['L', 1, 1, /"=" is missing after L/], ['t(0) = 1', 1, 1, /t has a meaning/],
    ["L = x'^2/2 - V(x)\nV = x^2\nx(0) = 1", 1, 14, /V is not a function.* stands without \(\)/], ['V(x) = x^2\nL = vx^2/2 - V\nx(0) = 1', 1, 1, /V = \.\.\., and a start is V\(0\)/], ['L = m(3)\nx(0) = 1', 1, 5, /a product has \*/],
    ['H = p^2/2m\nm = 2\nx(0) = 1', 1, 10, /is m below the line\? If so, \/\(2 m\), else \/2\*m/], ["L = x'^2/2(x + 3)\nx(0) = 1", 1, 11, /\/\(2 \(\.\.\.\)\)/], ["L = θ'^2/2 + cos θ\nθ(0) = 1", 1, 14, /parentheses: cos\(θ\)/], ["L = x'^2/2 - sin^2 x\nx(0) = 1", 1, 14, /parentheses: sin\(x\)/],
    ["L = x''^2\nx(0) = 1", 1, 5, /x'' is a second derivative/], ['L = ẍ\nx(0) = 1', 1, 5, /ẍ is a second derivative/], ["L = x'^2/2 - |x|\nx(0) = 1", 1, 14, /\|x\| has a kink/], ['L = v[0]^2\nx(0) = 1', 1, 6, /coordinates q1 and q2, not q\[0\]/], ['L = 2[x]\nx(0) = 1', 1, 6, /brackets are \( and \)/], ['L = \\dot{x}^2\nx(0) = 1', 1, 5, /LaTeX is not read/],
    ["L = x'^2/2 - mgx\nm = 1, g = 2\nx(0) = 1", 1, 14, /mgx is not known; with spaces it is m g x/], ["L = lθ'^2\nl = 1\nθ(0) = 1", 1, 5, /lθ' is not known; with spaces it is l theta/], ['g = 9,81\nL = vx^2 x(0) = 1', 1, 7, /a point, not a comma/], ["L = (dx/dt)^2\nx(0) = 1", 1, 6, /the derivative of x is x'/], ['H = p^2/2 + e^x\nx(0) = 1', 1, 13, /exp\(x\) for e\^x/], ['L = x\'^2 - ln x\nx(0) = 1', 1, 12, /ln needs parentheses: ln\(x\)/], ["L = ½2 x'^2\nx(0) = 1", 1, 6, /not with "2"/], ['L = я^2\nx(0) = 1', 1, 5, /letters are a to z and Greek/],
    ["H = px^2/2 + vx\nx(0) = 1", 1, 14, /vx is a velocity, and H takes momenta: px/], ["H = x'^2/2\nx(0) = 1", 1, 5, /x' is a velocity, and H takes momenta: px/], ["H = q̇₁²/2\nq1(0) = 1", 1, 5, /q̇₁ is a velocity, and H takes momenta: p1/], ["L = px^2/2\nx(0) = 1", 1, 5, /px is a momentum, and L takes velocities: vx or x'/], ["L = p^2/2 - q^2\nq(0) = 1", 1, 5, /p is a momentum, and L takes velocities: v or q'/],
    ["H = px^2/2\nx(0) = 1, x'(0) = 2", 2, 11, /vx\(0\) is a velocity, and H takes momenta: px\(0\)/], ["L = vx^2/2\nx(0) = 1, px(0) = 2", 2, 11, /px\(0\) is a momentum, and L takes velocities: vx\(0\)/], ["L = vx^2/2 + vy^2/2\nx(0) = 1, y(0) = 1, v(0) = 2", 2, 21, /v\(0\) is a start of which coordinate\? Write vx\(0\)/], ["H = p^2/2\nx(0) = 1, y(0) = 1", 1, 5, /p is not known: of which coordinate\? px, py/],
    ["H = px^2/2\n0 = x\nx(0) = 0", 2, 1, /a constraint needs L/], ["H = px^2/2\nFx = -px\nx(0) = 0", 2, 1, /Fx is a force, and needs L/], ["H = px^2/2\nL = vx^2/2\nx(0) = 0", 1, 1, /both L and H are given/], ["H = x^2/2\nx(0) = 1", 1, 1, /H depends on no momentum: that of x is px/], ["px = 2\nH = px^2\nx(0) = 1", 1, 1, /px is a coordinate or its momentum/],
    ['x(0) = 1, y(0) = 2, L = vx^2 +* vy', 1, 31, /not "\*"/], [`L = 1 ${[...'abcdefghi'].map(c => `${c}(0) = 1`).join(' ')}`, 1, undefined, /room for 8 coordinates/]]) {
    let said = '';
    try { lagrange(typed); } catch (e) { said = e.message; }
    check(`${JSON.stringify(typed)} is refused`, said.startsWith(`Line ${line}, column ${column ?? ''}`) && why.test(said), said);
  }
  /* whatever is typed: a sentence with its place, or operations whose operands come before them */
  const WORDS = ['L', '=', 'x', 'vx', 'y', 'vy', '(', ')', '(0)', '=', '1', '2.5', '+', '-', '*', '/', '^', ',', '\n', 'sin', 'pow', 't', 'pi', 'end', 'draw', 'a', '#', '$', 'L = vx^2', 'x(0) = 1', 'q', 'v', 'q(0)=', '\'', '.', 'e5', 'θ', 'x\'', '²', 'Fx', 'ln', 'cosh', '0 =', 'H = ', 'p', 'px', '½', 'ẋ', '√', 'H'];
  let seed = 1, whole = 0, wrong = '';
  for (let k = 0; k < 100000; k++) {
    let typed = k % 2 ? 'x(0) = 1 L = vx^2/2 + ' : '';
    for (let j = 0; j < k % 13; j++) seed = (seed*16807)%2147483647, typed += WORDS[seed%WORDS.length] + (seed & 1024 ? ' ' : '');
    try {
      const r = lagrange(typed), inputs = 1 + 2*r.n;
      whole++;
      if (!r.steps.every(([op, a, b], i) => op <= 12 && a < inputs + i && b < inputs + i) || !r.draw.every(p => p < inputs + r.steps.length) || !r.length) wrong = typed;
    } catch (e) { if (!/^Line \d+, column \d+: .{10,200}\.$/s.test(e.message)) wrong = `${typed}: ${e.message}`; }
  }
  check('whatever is typed', !wrong && whole > 1000, JSON.stringify(wrong), whole);
  for (const [typed, why] of [['L = vx^2/2 - y^2\nx(0) = 1, y(0) = 1', /L has no kinetic energy in q\[1\]/], ['L = log(x)*vx^2/2\nx(0) = -1', /L is not finite at the start/],
    ['L = x*vy - y*vx\nx(0) = 1, y(0) = 1', /linear in v/], ['L = x\nx(0) = 1', /linear in v/], ['L = (vx + vy)^2\nx(0) = 1, y(0) = 1', /some direction/], ['L = vx^2/2 - sqrt(x^2)\nx(0) = 0', /not finite/]])
    check(`${JSON.stringify(typed)} is refused by lagrangian.h`, why.test(take(typed).why), take(typed).why);

  /* as on paper: the same operations as typed plainly */
  for (const [typed, plainly] of [["L = ½ m ẋ² - k x²/2\nm = 2, k = 3\nx(0) = 1, ẋ(0) = 2", "L = 1/2*m*vx^2 - k*x^2/2\nm = 2, k = 3\nx(0) = 1, vx(0) = 2"], ['L = m v^2/2 - x^2\nm = 2\nx(0) = 1, v(0) = 3', 'L = m*vx^2/2 - x^2\nm = 2\nx(0) = 1, vx(0) = 3'],
    ["L = 1/2 (x'^2 + ydot**2) - g_0 (1 - cos(x))\ng_0 = 2  // a comment\nx(0) = 1; y(0) = 0 % another", "L = 1/2*(vx^2 + vy^2) - g0*(1 - cos(x))\ng0 = 2\nx(0) = 1, y(0) = 0"], ["L(q, q') := q’²/2 - √(1 + q²)\nq(0) = 1", 'L = v^2/2 - sqrt(1 + q^2)\nq(0) = 1'],
    ["L = θ̇₁²/2 - k(θ_1 - 1)^2 + 2θ1(t)\nk = 2\nθ₁(0) = 1", 'L = vtheta1^2/2 - k*(theta1 - 1)^2 + 2*theta1\nk = 2\ntheta1(0) = 1'], ['H(q, p) = p²/(2m) + ¾ q⁴ − arcsin(q/3) q⁻¹\nm = 2\nq(0) = 1, p(0) = 2', 'H = p^2/(2*m) + 3/4*q^4 - asin(q/3)*q^-1\nm = 2\nq(0) = 1, p(0) = 2'],
    ['H = p^2/2 + x^2\nx(0) = 1, p(0) = 2', 'H = px^2/2 + x^2\nx(0) = 1, px(0) = 2'], ['H = p_r²/2 + p_ϕ²/(2 r²)\nr(0) = 1, ϕ(0) = 0, p_φ(0) = 1', 'H = pr^2/2 + pphi^2/(2*r^2)\nr(0) = 1, phi(0) = 0, pphi(0) = 1'], ['H = px^2/2 + L^2\nL = x px\nx(0) = 1', 'H = px^2/2 + A^2\nA = x*px\nx(0) = 1'], ["L = x'^2/2 - H x\nH = 2\nx(0) = 1", "L = vx^2/2 - h*x\nh = 2\nx(0) = 1"]]) {
    const [a, b] = [typed, plainly].map(t => { try { return lagrange(t); } catch (e) { return { c: e.message }; } });
    check(`${JSON.stringify(typed)}: as typed plainly`, a.steps && JSON.stringify([a.steps, a.names, a.q, a.v, a.momenta]) === JSON.stringify([b.steps, b.names, b.q, b.v, b.momenta]), a.c, b.c);
  }

  /* motions: the scenes written by hand, from effects */
  const MOTIONS = [
    ['pendulum', 1, "v'M(t,q)v/2 - V(t,q)", EXAMPLES['a double pendulum'], q => q],
    ['elastic', 3, "v'Mv/2 - V(t,q)", EXAMPLES['a pendulum on a spring'], q => q],
    ['kepler', 1, "v'Mv/2 - V(t,q)", 'i = 25*pi/180  w = sqrt(39.4784176*4) L = (vx^2 + vy^2 + vz^2)/2 + 39.4784176/sqrt(x^2 + y^2 + z^2)\nx(0) = 0.4, y(0) = 0, z(0) = 0 vy(0) = w*cos(i) vz(0) = w*sin(i)', q => q],
    ['charge', 5, "v'Mv/2 + a(t,q)'v - V(t,q)", 'L = (vx^2 + vy^2 + vz^2)/2 + (x*vy - y*vx)/2 + 0.6/sqrt(x^2 + y^2 + z^2)\nx(0) = 1, y(0) = 0, z(0) = 0 vy(0) = 1.1, vz(0) = 0.1', q => q],
    ['top', 1, "v'M(t,q)v/2 - V(t,q)", 'A = 2e-4 C = 8e-5 L = A*(vn^2 + (sin(n)*vp)^2)/2 + C*(vs + cos(n)*vp)^2/2 - 0.1*9.81*0.04*cos(n)\nn(0) = pi/6, p(0) = 0, s(0) = 0 vs(0) = 150', q => q],
  ];
  for (const [name, on, kind, typed] of MOTIONS) {
    const i = index(name), h = x.scene_number(i, 2, 0), span = x.scene_number(i, 3, 0)/4, hand = end(i, on, h/2, span), r = take(typed);
    check(`${name}: what L is`, !r.why && r.kind === kind, r.why, r.kind);
    const off = far(end(OWN, 1, h/2, span), hand), size = Math.max(...hand.map(Math.abs)), rival = far(end(OWN, 1, 1e-13, span, 3), hand);
    check(`${name}: the motion typed is that by hand, to rounding`, off < 1e-12*Math.max(1, size), off);
    check(`${name}: so is that by DOP853, from second derivatives`, rival < 1e-10*Math.max(1, size), rival);
  }
  /* a closed form: a relativistic particle in a uniform field, from rest: x = sqrt(1 + t t) - 1 */
  const rest = take('L = -sqrt(1 - vx^2 - vy^2) + x\nx(0) = 0, y(0) = 0');
  check('a relativistic particle: Newton', rest.kind === 'of no special form' && !open(OWN, 1) && x.world_number(1, 4, 0) === 5, rest);
  const fast = end(OWN, 1, 0.05, 3);
  check('a relativistic particle: the hyperbola', far(fast, [Math.sqrt(10) - 1, 0]) < 1e-13, fast);
  /* and with t: a driven oscillator, x = (sin w t - w sin t)/(1 - w w) */
  check('an oscillator driven: L reads t', take('L = vx^2/2 - x^2/2 + sin(2*t)*x\nx(0) = 0').timed);
  for (const method of [0, 3]) {
    const driven = end(OWN, 1, method ? 1e-13 : 0.05, 3, method);
    check('an oscillator driven: its closed form', far(driven, [(Math.sin(6) - 2*Math.sin(3))/-3]) < 1e-12, driven);
  }

  /* H, against closed forms: q and p at the end, by gvi.h and by DOP853 */
  const endOf = (h, span, method = 0) => { const q = end(OWN, 1, h, span, method); return [...q, ...q.map((_, i) => x.world_number(1, method ? 43 : 31, method ? q.length + i : i))]; };
  const turned = (w, list) => list.map(([a, b]) => [Math.cos(w)*a - Math.sin(w)*b, Math.sin(w)*a + Math.cos(w)*b]);
  const angles = [0, 1, 2].map(k => [Math.cos(2*Math.PI*k/3), Math.sin(2*Math.PI*k/3)]), three = turned(3/(2*Math.PI), angles), pair = turned(9/(2*Math.PI), [[-2/3, 0], [1/3, 0]]);
  const [cos6, sin6] = [Math.cos(6), Math.sin(6)];
  const vortices = `${[1, 2, 3].map(k => `q${k}(0) = ${angles[k - 1][0]}, p${k}(0) = ${angles[k - 1][1]}`).join('\n')}`;
  const FORMS = [
    ['an oscillator', 'H = p^2/2 + 2 q^2\nq(0) = 1', [cos6, -2*sin6]],
    ['H linear in p', 'H = x p\nx(0) = 1, p(0) = 2', [Math.exp(3), 2*Math.exp(-3)]],
    ['a relativistic particle', 'H = sqrt(1 + p^2) - x\nx(0) = 0', [Math.sqrt(10) - 1, 3]],
    ['an oscillator driven', 'H = p^2/2 + x^2/2 - sin(2t) x\nx(0) = 0', [(sin6 - 2*Math.sin(3))/-3, (2*cos6 - 2*Math.cos(3))/-3]],
    /* a circle of radius 1 about (2, 0) at twice its rate: v = (px + y, py - x) = (0, 2) at (1, 0) */
    ['a charge in a magnetic field', 'H = ((px + y)^2 + (py - x)^2)/2\nx(0) = 1, y(0) = 0, py(0) = 3', [2 - cos6, sin6, 2*sin6 - sin6, 2*cos6 + 2 - cos6]],
    ['vortices of strengths 1 and 2', 'H = -2 log((q1 - q2)^2 + (p1 - p2/2)^2)/(4 pi)\nq1(0) = -2/3, q2(0) = 1/3', [pair[0][0], pair[1][0], pair[0][1], 2*pair[1][1]]],
    ['three vortices', `H = -(log((q1 - q2)^2 + (p1 - p2)^2) + log((q2 - q3)^2 + (p2 - p3)^2) + log((q3 - q1)^2 + (p3 - p1)^2))/(4 pi)\n${vortices}`, [...three.map(a => a[0]), ...three.map(a => a[1])]],
    ['two masses of Toda', 'H = (p1^2 + p2^2)/2 + exp(q1 - q2)\nq1(0) = 0, q2(0) = 0', [-Math.log(Math.cosh(3)), Math.log(Math.cosh(3)), -Math.tanh(3), Math.tanh(3)]],
  ];
  for (const [name, typed, exact] of FORMS) {
    const r = take(typed), size = Math.max(1, ...exact.map(Math.abs));
    check(`H, ${name}: its formula`, !r.why && r.momenta && far(endOf(0.05, 3), exact) < 1e-12*size, r.why, endOf(0.05, 3), exact);
    check(`H, ${name}: DOP853 as well`, far(endOf(1e-13, 3, 3), exact) < 1e-11*size, endOf(1e-13, 3, 3), exact);
  }
  /* its order is 2s, on both sides */
  take(FORMS[5][1]);
  for (const degree of [1, 2, 3]) {
    const off = [24, 48].map(steps => { open(OWN, 1, degree); x.world_advance(1, 3/steps, steps); return far([0, 1].flatMap(i => [x.world_number(1, 30, i), x.world_number(1, 31, i)]), [pair[0][0], pair[0][1], pair[1][0], 2*pair[1][1]]); });
    const order = Math.log2(off[0]/off[1]);
    check(`H: order ${2*degree}`, Math.abs(order - 2*degree) < 0.2, order, off);
  }
  /* typed as L and as H: another formulation of the same */
  for (const [name, L, H] of [['Henon-Heiles', "L = (x'^2 + y'^2)/2 - (x^2 + y^2)/2 - x^2 y + y^3/3\nx(0) = 0, y(0) = 0.1, x'(0) = 0.49", EXAMPLES['H: a star in a galaxy (Hénon-Heiles)']],
    ['a planet in polar coordinates', "L = (r'^2 + r^2 φ'^2)/2 + 1/r\nr(0) = 1, φ(0) = 0, φ'(0) = 0.8", 'H = p_r²/2 + p_φ²/(2 r²) - 1/r\nr(0) = 1, φ(0) = 0, p_φ(0) = 0.8'], ['a relativistic oscillator', "L = -sqrt(1 - x'^2) - x^2\nx(0) = 1", 'H = sqrt(1 + p^2) + x^2\nx(0) = 1']]) {
    const hand = (take(L), end(OWN, 1, 0.05, 5)), H0 = (take(H), end(OWN, 1, 0.05, 5));
    check(`${name}: L and H end at the same place`, far(hand, H0) < 1e-12, hand, H0);
  }
  /* Toda's ring of three keeps p1 p2 p3 - p1 exp(q2 - q3) - p2 exp(q3 - q1) - p3 exp(q1 - q2), by Lax */
  take(EXAMPLES['H: three masses on a ring (Toda)']);
  const lax = ([a, b, c, p1, p2, p3]) => p1*p2*p3 - p1*Math.exp(b - c) - p2*Math.exp(c - a) - p3*Math.exp(a - b), ring = endOf(0.05, 20);
  check("H, Toda: Lax's integral", Math.abs(lax(ring) - lax([1, 0, -1, 0, 1, -1])) < 1e-12 && Math.abs(ring[0] - 1) > 0.1, lax(ring), ring);
  /* its energy is H; a picture shows momenta; a run that is switched goes on from them */
  take('H = p^2/2 + x^2/2 + x^4\nx(0) = 1, p(0) = 2');
  open(OWN, 1);
  x.world_advance(1, 0.05, 20);
  const [here, there] = [30, 31].map(i => x.world_number(1, i, 0)), seen = x.world_place(1, x.world_number(1, 0, 0))/8;
  check('H: its energy', Math.abs(x.world_number(1, 20, 0) - 3.5) < 1e-14 && Math.abs(there*there/2 + here*here/2 + here**4 - 3.5) < 1e-14);
  check('H: its picture is q and p', Math.abs(numbers[seen] - here) < 1e-15 && Math.abs(numbers[seen + 1] - there) < 1e-15, numbers[seen], here, numbers[seen + 1], there);
  x.world_open(1, OWN, 1, 4, 0, 0, 1);
  check('H: another degree goes on from q and p', x.world_number(1, 30, 0) === here && x.world_number(1, 31, 0) === there);
  check('H: no rule but Gauss, no Verlet', x.world_open(1, OWN, 1, 4, 2, 0, 0) === -1 && /for H the rule is Gauss/.test(words(x.status_text(1, -1))) && !open(OWN, 1) && x.race_begin(1, 1, 0.1, 1) !== 0);
  check('H: what is not finite', /H is not finite at the start/.test(take('H = p^2/2 + log(x)\nx(0) = -1').why));

  /* a bump far from the start: seen, and then said to be M(q) */
  const bump = "L = x'^2/2 (1 + h^2) - 9.81 exp(-(x - 50)^2)\nh = -2 (x - 50) exp(-(x - 50)^2)\nx(0) = 0, x'(0) = 25\n";
  take(bump);
  open(OWN, 1);
  const stopped = x.world_advance(1, 0.02, 200);
  check('L that looks simpler at the start: it is stopped', stopped === -9 && /set L.kind = LAGRANGIAN_MASS after/.test(words(x.status_text(1, stopped))), stopped, words(x.status_text(1, stopped)));
  const curved = take(`${bump}kind = MASS`), over = end(OWN, 1, 0.01, 4), other = end(OWN, 1, 1e-13, 4, 3);
  check('kind = MASS: the motion by DOP853', curved.kind === "v'M(t,q)v/2 - V(t,q)" && far(over, other) < 1e-9 && over[0] > 90, over, other);
  for (const [typed, why] of [[`${bump}kind = MASSIVE`, /a kind is POTENTIAL, LINEAR/], ['kind = MASS\nH = p^2/2\nx(0) = 1', /kind says what L is/]]) {
    let said = '';
    try { lagrange(typed); } catch (e) { said = e.message; }
    check(`${JSON.stringify(typed)} is refused`, why.test(said), said);
  }
  check('a name like kind', lagrange("kind = 3\nL = kind x'^2/2\nx(0) = 1").kind === 0);

  /* with forces: x'' + 2 c x' + x = sin 2t, from rest */
  const c = 0.1, [A, B] = [-3, -4*c].map(a => a/(9 + 16*c*c)), w = Math.sqrt(1 - c*c);
  for (const [typed, method] of [['Fx', 0], ['Fx', 3], ['F', 0]]) {
    const forced = take(`L = x'²/2 - x²/2\n${typed} = sin(2t) - ${2*c} x'\nx(0) = 0`);
    const off = far(end(OWN, 3, method ? 1e-13 : 0.05, 3, method), [A*Math.sin(6) + B*Math.cos(6) - Math.exp(-3*c)*(B*Math.cos(3*w) + (2*A + c*B)/w*Math.sin(3*w))]);
    check(`a force typed, ${typed}: its closed form`, !forced.why && off < 1e-12, forced.why, off);
  }
  take('θ = 1\nL = x\'^2/2 + y\'^2/2 - θ x\nFy = -y\'\nx(0) = 0, y(0) = 0, y\'(0) = 1');
  check('a force on one of two', far(end(OWN, 3, 0.05, 1), [-0.5, 1 - Math.exp(-1)]) < 1e-13);

  /* constraints and rolling, lesson 52's formulas: a wire that turns, a knife edge on a slope, x in lengths of its curve */
  const ROWS = [
    ['a turning wire', "L = (x'^2 + y'^2)/2\n0 = cos(0.5 t) y - sin(0.5 t) x\nx(0) = 1, y(0) = 0, y'(0) = 0.5", [Math.cosh(1)*Math.cos(1), Math.cosh(1)*Math.sin(1)], 2],
    ['a knife edge', "g = 9.81, s = 0.3\nL = (x'^2 + y'^2)/2 + 0.1 θ'^2 + g sin(s) x\n0 = sin(θ) x' - cos(θ) y'\nx(0) = 0, y(0) = 0, θ(0) = 0, θ'(0) = 1.5",
      (k => [k*Math.sin(3)**2, k*(3 - Math.sin(3)*Math.cos(3)), 3])(9.81*Math.sin(0.3)/4.5), 2],
    ['a wheel that is driven', "L = (x'^2 + y'^2)/2\n0 = y' - 2 t, 0 = x' - y\nx(0) = 0, y(0) = 1, x'(0) = 1", [2 + 8/3, 5], 2],
    ['a pendulum as a constraint and a force', "a = 1\nL = (x'^2 + y'^2)/2\nFy = -3 a\n0 = (x^2 + y^2 - a)/2\nx(0) = 0.6, y(0) = -0.8", end(OWN, 1, 0.01, 2, take("L = φ'^2/2 + 3 cos(φ)\nφ(0) = asin(0.6)") && 0).flatMap(a => [Math.sin(a), -Math.cos(a)]), 2],
  ];
  for (const [name, typed, exact, span] of ROWS) {
    const r = take(typed), on = (1 << (1 + (r.force.length > 0) + (r.holds.length > 0) + (r.rolls.length > 0))) - 1, off = far(end(OWN, on, 0.02, span), exact);
    check(`${name}: its formula`, !r.why && off < 1e-12, r.why, off);
    open(OWN, on);
    x.world_advance(1, 0.02, 50);
    check(`${name}: what is typed holds`, x.world_number(1, 22, 0) < 1e-14, x.world_number(1, 22, 0));
    check(`${name}: no rival has it`, x.race_begin(1, 3, 1e-9, span) !== 0);
  }
  check('a row with velocities squared is refused', /not linear/.test(take("L = (x'^2 + y'^2)/2\n0 = x'^2 - y'\nx(0) = 0, y(0) = 0").why));

  /* second derivatives of everything: where v is within f, DOP853 needs them and Galerkin steps do not */
  for (const f of ['sqrt(u)', 'exp(u)', 'log(u)', 'sin(u)', 'cos(u)', 'tan(u)', 'u^3', 'u^-1.5', 'u^0.3', '2^u', 'u^u', '1/u', 'u*u/(1 + u)', 'u*t - u', 'atan(u)', 'atan(9*u)', 'sinh(u)', 'cosh(u)', 'tanh(u)', 'asin(u/2)', 'sin^3(u)']) {
    take(`u = 0.7 + x/8 + vx/9 + y*vy/7\nL = 3*vx^2 + 2*vy^2 - x^2 + x*y + ${f}\nx(0) = 0.3, y(0) = 0.2, vx(0) = 0.1 vy(0) = -0.2`);
    const [ours, theirs] = [end(OWN, 1, 0.05, 1), end(OWN, 1, 1e-13, 1, 3)], apart = far(ours, theirs);
    check(`${f}: its second derivatives`, apart < 1e-11, apart);
  }

  /* the body of the C: compiled as it is, its end by derivatives from complex steps */
  const TRAPS = { ...EXAMPLES,
    'whole numbers': 'n = 3\nL = 1/2*vx^2 + 3/2*x*vx - 1/3*x^4 + 7/2 - (1 + 2)/4*x^2 + 2^-1*x - n/2*x^2\nx(0) = 1 end = 2',
    'names of C': 'int = 2, user = 1, main = 3\nL = vdouble^2/2 - int*double^2*user/main + v^2/2 - q^2\ndouble(0) = 1, q(0) = 0.5 end = 2',
    'powers': 'L = vx^2/2*(1 + x^2)^1.5 - 2^x - x^-1 - pow(x, 3) - (x + 2)^x + tan(x/4) - log(x)*exp(-x)\nx(0) = 1 end = 1',
    'forces': "at = 2, int = 0.5\nθ = x - y\nL = x'²/2 + at y'²/2 - cosh(θ) + sin²(x)\nFx = -int x' + sin(t) θ\nFy = tanh(x) - at^2 atan(y')\nx(0) = 0.4, y(0) = 0 end = 2",
    'rows': "row = 2, r = x^2 + y^2\nL = (x'^2 + y'^2 + z'^2)/2 - row z\n0 = r - row/2\n0 = z' - x y' + y x' - sin(t)/3\nFz = -z'\nx(0) = 0.6, y(0) = 0.8, x'(0) = 0.8, y'(0) = -0.6, z(0) = 0, z'(0) = -1 end = 2",
    'H: names of C': 'p = 2, int = 1, H2 = 3\nH = px^2/2*p + ph^2/2 + px h^2/int - v*h/2 + x^2 + L\nL = H2 h^4 cos(t)\nv = 2\nx(0) = 1, h(0) = 0.5, ph(0) = 0.1 end = 2',
    'H: one p': 'H = sqrt(p² + m²) + ½ x⁴\nm = 2\nx(0) = 1, p(0) = 0.5 end = 2',
    'order': 'L = vx^2/2 + a - b\nb = a - (x - a*2)/(3*x/2)\na = -x^2/2 - (-x)\nx(0) = 0.4 end = 1' };
  const cc = (...given) => execFileSync(process.env.CC || 'cc', ['-std=c99', '-I.', '-Iexamples', ...given], { stdio: ['ignore', 'inherit', 'inherit'] });
  const library = join(build, 'typed-gvi.o');
  cc('-O1', '-DGVI_IMPLEMENTATION', '-xc', '-c', 'gvi.h', '-o', library);
  for (const [name, typed] of Object.entries(TRAPS)) {
    const r = take(typed), more = [[r.force, 'FORCE, .points = force'], [r.holds, `CONSTRAINT, .points = holds, .rows = ${r.holds.length}`], [r.rolls, `NONHOLONOMIC, .points = rolls, .rows = ${r.rolls.length}`]]
      .flatMap(([list, effect]) => list.length ? `, { .kind = GVI_${effect} }` : []), source = join(build, 'typed.c'), binary = join(build, 'typed'), steps = 2000;
    const chaos = name === 'a double pendulum' || name === 'a pendulum on a cart' ? 1e-10 : 1e-12, span = Math.min(r.end, 5);
    const kind = r.momenta ? 'hamiltonian' : 'lagrangian';
    writeFileSync(source, `#include "tools/lagrangian.h"\n${r.c}\nint main(void)\n{\n    static double memory[1 << 17];\n    static ${kind} L;\n    const double q[] = { ${r.q} }, v[] = { ${r.v} };
    const char *wrong = ${kind}_init(&L, own, NULL, 0, q, v);\n    const gvi_effect effect[] = { ${kind}_effect(&L)${more.join('')} };\n    const gvi_desc desc = { .n = ${r.n}, .degree = 4, .mass = ${kind}_mass(&L), .effects = effect, .effect_count = ${1 + more.length}, .formulation = ${r.momenta ? 'GVI_MOMENTA' : 0} };
    gvi_stepper st;\n    if (wrong) return puts(wrong), 1;\n    gvi_init(&st, &desc, memory, sizeof memory);\n    ${r.momenta ? 'gvi_start_momentum' : 'gvi_start'}(&st, 0, q, v);\n    for (int k = 0; k < ${steps}; ++k) gvi_step(&st, ${span}.0/${steps});\n    for (int i = 0; i < ${r.n}; ++i) printf("%.17g\\n", st.q[i]);\n    puts(${r.momenta ? '"Hamilton\'s equations"' : 'lagrangian_text(&L)'});\n    return st.status;\n}\n`.replace(/(\.\d+)\.0\//, '$1/'));
    try {
      cc('-Wall', '-Wextra', '-Wpedantic', '-Wconversion', '-Werror', source, library, '-o', binary, '-lm');
      const said = execFileSync(binary, { encoding: 'utf8' }).trim().split('\n'), what = said.pop(), q = said.map(Number), here = end(OWN, 2 ** (1 + more.length) - 1, span/steps, span), off = far(here, q);
      check(`${name}: the C ends where the page does`, !r.why && what === r.kind && off < chaos*Math.max(1, ...q.map(Math.abs)), r.why, what, off, q, here);
    } catch (e) { check(`${name}: the C compiles`, false, e.message, r.c); }
  }
  console.log(`playground: Lagrangians typed, ${passed} passed, ${failed} failed`);
  process.exit(failed ? 1 : 0);
}
if (process.argv[1].endsWith('typed.mjs')) test(...process.argv.slice(2));
