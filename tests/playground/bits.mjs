// bits.mjs NATIVE WASM - every run of native.c again in WebAssembly: the same statuses, counts and
// bits of the state.  A NaN is a NaN.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { EXAMPLES, handedOver } from './typed.mjs';

const [native, wasm] = process.argv.slice(2);
const module = new WebAssembly.Module(readFileSync(wasm)), imports = WebAssembly.Module.imports(module);
const { exports: x } = new WebAssembly.Instance(module, {});
x._initialize?.();
const numbers = new Float64Array(x.memory.buffer), one = new DataView(new ArrayBuffer(8));
const bits = v => { one.setFloat64(0, v === v ? v : NaN); return v === v ? one.getBigUint64(0).toString(16).padStart(16, '0') : '7ff8000000000000'; };

function run(scene, on, degree, rule, tolerance, method, parameter) {
  for (let i = 0; i < 3; i++) numbers[x.parameters()/8 + i] = x.scene_number(scene, 33, i);
  const dial = method === -2;
  numbers[x.parameters()/8 + 3] = dial ? parameter : 0;
  let status = x.world_open(1, scene, on, degree, rule, tolerance, 0);
  numbers[x.parameters()/8 + 3] = 0;
  if (dial) method = 0;
  if (!status) status = x.race_begin(1, method, parameter, x.scene_number(scene, 3, 0)/4);
  while (!status) status = x.race_steps(1, 1000);
  const out = [status];
  if (status !== 1) return out;
  const n = x.scene_number(scene, 0, 0);
  out.push(bits(x.race_number(1, 1)), bits(x.race_number(1, 0)));
  const q = x.race_end(1)/8;
  for (let i = 0; i < n; i++) out.push(bits(numbers[q + i]));
  for (let i = 0; i < n; i++) out.push(bits(x.world_number(1, method ? 43 : 31, method ? n + i : i)));
  out.push(bits(x.world_number(1, method ? 42 : 20, 0)), bits(x.world_number(1, method ? 44 : 22, 0)));
  return out;
}
function broken(scene, on, degree, rule, h) {
  const out = [];
  let rod = 0;
  for (let e = 0; e < 32; e++) if (on >> e & 1 && x.scene_number(scene, 22, e) > 3) rod = 1 << e;
  for (let i = 0; i < 3; i++) numbers[x.parameters()/8 + i] = x.scene_number(scene, 33, i);
  for (let k = 0; k < 3; k++) {
    const status = x.world_open(0, scene, k === 1 ? on & ~rod : on, degree, rule, 0, k > 0 ? 1 : 0);
    out.push(status, status ? 0 : x.world_advance(0, h, 20));
    for (let i = 0; i < x.scene_number(scene, 0, 0); i++) out.push(bits(x.world_number(0, 30, i)), bits(x.world_number(0, 31, i)));
    out.push(bits(x.world_number(0, 22, 0)));
    for (let e = 0; e < 4; e++) out.push(bits(x.world_number(0, 3, e)));
  }
  return out;
}

const text = p => { let e = p, o = new Uint8Array(x.memory.buffer); while (o[e]) e++; return new TextDecoder().decode(o.subarray(p, e)); };
const scene = name => { let i = 0; while (text(x.scene_text(i, 0, 0)) !== name) i++; return i; };
/* What can be held again: nothing acts on the quaternion's length, nor does the second diagonal change the motion. */
const quaternion = scene('quaternion'), frame = scene('frame'), spare = 31;
const stays = ([scene, on]) => scene === quaternion || (scene === frame && on === spare);

let passed = 0, failed = 0, compared = 0;
const kinds = {};
const owns = Object.values(EXAMPLES).map(handedOver), file = `${native}.own`;
writeFileSync(file, Buffer.concat(owns.map(o => Buffer.from(Float64Array.of(...o.given, ...o.room).buffer))));
if (imports.length) { console.error('the program imports', imports); failed++; }
for (const line of execFileSync(native, [file], { encoding: 'utf8', maxBuffer: 1 << 26 }).trim().split('\n')) {
  const [input, output] = line.split(': '), given = input.split(' ').map(Number);
  if (input.startsWith('own')) {
    numbers.set(owns[given[1]].room, x.own_room()/8);
    const why = text(x.own_take(...owns[given[1]].given));
    if (why || output) failed++, console.error(input, 'native:', output, 'wasm:', why); else passed++;
    continue;
  }
  const got = (given[5] === -1 ? broken(given[0], given[1], given[2], given[3], given[6]) : run(...given)).join(' ');
  const status = given[5] === -1 ? 'broken' : output.split(' ')[0];
  kinds[status] = (kinds[status] || 0) + 1;
  compared += output.split(' ').length - 1;
  if (given[5] === -1) {                                    // held, broken, refused with the state as before
    const words = output.split(' '), half = words.length/3, again = stays(given) ? '0' : '-15';
    if (words[0] !== '0' || words[half] !== '0' || words[2*half] !== again) { failed++; console.error(`${input}\n  statuses`, words[0], words[half], words[2*half]); }
  }
  if (got === output) passed++;
  else { failed++; console.error(`${input}\n  native ${output.slice(0, 200)}\n  wasm   ${got.slice(0, 200)}`); }
}
/* Two ways to the same motion: the double pendulum in angles and as rods, the top in angles and as a quaternion */
const end = (i, on, h, n) => {
  const [status] = run(i, on, 8, 0, 0, 0, h);
  if (status !== 1) failed++, console.error('scene', i, 'did not end:', status);
  return [...numbers.subarray(x.race_end(1)/8, x.race_end(1)/8 + n)];
};
const agree = (what, a, b, least) => {
  const apart = Math.max(...a.map((v, i) => Math.abs(v - b[i])));
  if (least < 0.01) failed++, console.error(what, 'did not move', a, b);
  if (apart < 1e-12) passed++; else { failed++; console.error(what, 'differ by', apart); }
  return apart.toExponential(1);
};
const q = end(scene('pendulum'), 1, 0.02, 2), rods = end(scene('rods'), 7, 0.02, 4);
const apart = agree('the double pendulum in angles and as rods', [Math.sin(q[0]), -Math.cos(q[0]), Math.sin(q[0]) + Math.sin(q[1]), -Math.cos(q[0]) - Math.cos(q[1])], rods, Math.abs(rods[0] - 1));
const swung = end(frame, spare, 0.02, 8), braced = agree('a frame with and without its redundant diagonal', end(frame, 15, 0.02, 8), swung, Math.abs(swung[7] + 0.6));
/* tilt, precession and spin as a quaternion: turns about z, x and z */
const [tilt, turn, spin] = end(scene('top'), 1, 0.01, 3), e = end(quaternion, 5, 0.0025, 4), c = Math.cos(tilt/2), s = Math.sin(tilt/2);
const half = [c*Math.cos((turn + spin)/2), s*Math.cos((turn - spin)/2), s*Math.sin((turn - spin)/2), c*Math.sin((turn + spin)/2)];
const sign = Math.sign(half[0]*e[0] + half[1]*e[1] + half[2]*e[2] + half[3]*e[3]);
const tops = agree('the top in angles and as a quaternion', half.map(v => sign*v), e, Math.abs(turn));
/* A coin whose tilt is steady: the spin that goes with a tilt and a rate of turning, and the circle of its centre */
const W = 1.5, sine = Math.sin(Math.PI/3), cosine = Math.cos(Math.PI/3), about = (W*W*sine*cosine/4 - 9.81*cosine)/(1.5*sine*W);
numbers.set([60, W, about - W*cosine, 0], x.parameters()/8);
const began = x.world_open(1, scene('coin'), 3, 8, 0, 0, 0) || x.world_advance(1, 0.05, 200), coin = [0, 1, 2, 3].map(i => x.world_number(1, 30, i)), far = -about/W;
if (began) failed++, console.error('the coin:', began);
const steady = agree('a coin on its circle', coin, [far*Math.sin(10*W), far*(1 - Math.cos(10*W)), 10*W, Math.PI/3], 1);
if (!(kinds[1] > 200 && kinds.broken > 3)) { failed++; console.error('too few runs came to their end:', kinds); }
console.log(`playground: ${compared} numbers of ${kinds[1]} runs to the bit, ${kinds.broken} broken constraints; rods and angles ${apart} apart, quaternion and angles ${tops}, a frame with and without a redundant rod ${braced}, a coin off its circle by ${steady}`);
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
