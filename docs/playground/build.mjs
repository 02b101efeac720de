// build.mjs WASM OUT - puts style, script and the compressed program into the page
import { readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url)), read = name => readFileSync(join(here, name), 'utf8');
/* Without comments of a line and indentation, but for that of the program which the page writes. */
const bare = name => read(name).replace(/^ *\/\*.*\*\/\n/gm, '').split(/(return `\/\*[^]*?\n`;)/)
  .map((part, i) => i % 2 ? part : part.replace(/^ +/gm, '')).join('').trim();
const [wasm, out] = process.argv.slice(2);
const packed = gzipSync(readFileSync(wasm), { level: 9 });
packed[9] = 255;                                         // "operating system": the same on all
const page = read('page.html').replace('/*STYLE*/', () => bare('style.css'))
  .replace('/*WASM*/', () => packed.toString('base64')).replace('/*SCRIPT*/', () => bare('page.js'));
writeFileSync(out, page);
console.log(`${out}: ${(page.length/1000).toFixed(1)} KB, of them ${(packed.length*4/3/1000).toFixed(1)} KB the program`);
if (page.length > 200000) { console.error('more than 200 KB'); process.exit(1); }
