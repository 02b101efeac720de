// build.mjs WASM OUT - puts style and the compressed script and program into the page
import { readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url)), read = name => readFileSync(join(here, name), 'utf8');
/* Four octets as five characters from "(" on, without "<" and "\\"; zeros in front make their number one of fours. */
const characters = octets => {
  const all = Buffer.concat([Buffer.alloc(-octets.length & 3), octets]);
  let out = '';
  for (let k = 0; k < all.length; k += 4)
    for (let v = all.readUInt32BE(k), by = 85**4; by >= 1; by /= 85) {
      const c = 40 + Math.floor(v/by)%85;
      out += String.fromCharCode(c + (c > 59) + (c > 90));
    }
  return out;
};
/* Without comments on lines of their own and at the end of one, and without indentation, but for that of programs. */
const bare = name => read(name).replace(/^ *\/\*[^]*?\*\/\n/gm, '').split(/(return `\/\*[^]*?\n`;|const EXAMPLES[^]*?\n};)/)
  .map((part, i) => i % 2 ? part : part.replace(/^ +| +\/\/ .*$/gm, '')).join('').trim();
const [wasm, out] = process.argv.slice(2);
const script = Buffer.from(bare('lagrangian.js') + '\n' + bare('page.js')), length = Buffer.alloc(4);
length.writeUInt32BE(script.length);
const packed = gzipSync(Buffer.concat([length, script, readFileSync(wasm)]), { level: 9 });
packed[9] = 255;                                         // "operating system": the same on all
const page = read('page.html').replace('/*STYLE*/', () => bare('style.css')).replace('/*PACKED*/', () => characters(packed));
writeFileSync(out, page);
console.log(`${out}: ${(page.length/1000).toFixed(1)} KB, of them ${(packed.length/800).toFixed(1)} KB script and program`);
if (page.length > 200000) { console.error('more than 200 KB'); process.exit(1); }
