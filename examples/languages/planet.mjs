// planet.mjs - the planet of the README in JavaScript: node planet.mjs planet.wasm; see planet.c
//
// prints
//
// ok: q = -0.602737580 0.799997002
import { readFile } from 'node:fs/promises';

let x;
const numbers = (address, count) => new Float64Array(x.memory.buffer, address, count);
const text = address => {
  const bytes = new Uint8Array(x.memory.buffer, address);
  return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
};

// q and f are the library's own memory: coordinate i at point k is [i*stride + k]
function force(count, stride, qAt, fAt) {
  const q = numbers(qAt, 2*stride), f = numbers(fAt, 2*stride);
  for (let k = 0; k < count; ++k) {
    const d2 = q[k]*q[k] + q[stride + k]*q[stride + k], w = -1/(d2*Math.sqrt(d2));
    f[k] += w*q[k];
    f[stride + k] += w*q[stride + k];
  }
  return 0;
}

x = (await WebAssembly.instantiate(await readFile(process.argv[2]), { scene: { force } })).instance.exports;
x._initialize();
numbers(x.start_values(), 4).set([0.4, 0, 0, 2]);
let status = x.begin();
for (let k = 0; k < 10000 && status === 0; ++k) status = x.step(0.1);
const [a, b] = numbers(x.q(), 2);
console.log(`${text(x.why())}: q = ${a.toFixed(9)} ${b.toFixed(9)}`);
