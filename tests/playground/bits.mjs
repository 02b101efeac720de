// bits.mjs NATIVE WASM - every run of native.c again in WebAssembly: the same statuses, counts and
// bits of the state.  A NaN is a NaN.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';

const [native, wasm] = process.argv.slice(2);
const module = new WebAssembly.Module(readFileSync(wasm)), imports = WebAssembly.Module.imports(module);
const { exports: x } = new WebAssembly.Instance(module, {});
x._initialize?.();
const numbers = new Float64Array(x.memory.buffer), one = new DataView(new ArrayBuffer(8));
const bits = v => { one.setFloat64(0, v === v ? v : NaN); return v === v ? one.getBigUint64(0).toString(16).padStart(16, '0') : '7ff8000000000000'; };

function run(scene, on, degree, rule, tolerance, method, parameter) {
  for (let i = 0; i < 3; i++) numbers[x.parameters()/8 + i] = x.scene_number(scene, 33, i);
  let status = x.world_open(1, scene, on, degree, rule, tolerance, 0);
  if (!status) status = x.race_begin(1, method, parameter, x.scene_number(scene, 3, 0)/4);
  while (!status) status = x.race_steps(1, 1000);
  const out = [status];
  if (status !== 1) return out;
  const n = x.scene_number(scene, 0, 0);
  out.push(bits(x.race_number(1, 1)), bits(x.race_number(1, 0)));
  const q = x.race_end(1)/8;
  for (let i = 0; i < n; i++) out.push(bits(numbers[q + i]));
  for (let i = 0; i < n; i++) out.push(bits(x.world_number(1, method ? 43 : 31, method ? n + i : i)));
  out.push(bits(x.world_number(1, method ? 42 : 20, 0)));
  return out;
}

let passed = 0, failed = 0, compared = 0;
const kinds = {};
if (imports.length) { console.error('the program imports', imports); failed++; }
for (const line of execFileSync(native, { encoding: 'utf8', maxBuffer: 1 << 26 }).trim().split('\n')) {
  const [input, output] = line.split(': '), got = run(...input.split(' ').map(Number)).join(' ');
  const status = output.split(' ')[0];
  kinds[status] = (kinds[status] || 0) + 1;
  compared += output.split(' ').length - 1;
  if (got === output) passed++;
  else { failed++; console.error(`${input}\n  native ${output.slice(0, 200)}\n  wasm   ${got.slice(0, 200)}`); }
}
if (!(kinds[1] > 200)) { failed++; console.error('too few runs came to their end:', kinds); }
console.log(`playground: ${compared} numbers of ${kinds[1]} runs to the bit`);
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
