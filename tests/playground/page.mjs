// page.mjs PAGE BUILD - what a person does with the playground, in a headless Chromium
//
// Screenshots of the page in light, dark and on a phone go to BUILD; look at them after a change.
import { execFileSync } from 'node:child_process';
import { createRequire } from 'node:module';
import { statSync, writeFileSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [file, build] = process.argv.slice(2).map(p => resolve(p));
const { chromium } = createRequire(join(build, 'x.js'))('playwright-core');
const url = pathToFileURL(file).href;
const profile = mkdtempSync(join(tmpdir(), 'playground-'));
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
         '--disable-component-update', '--disable-sync', `--crash-dumps-dir=${profile}`],
});

let passed = 0, failed = 0;
const check = (what, ok, seen = '') => { if (ok) passed++; else { failed++; console.error(`FAILED ${what}`, seen); } };
const complaints = [];

async function visit(hash = '', options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 1400 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(240000);                          // against hanging alone: the machine may be busy
  page.on('console', m => { if (['error', 'warning'].includes(m.type())) complaints.push(m.text()); });
  page.on('pageerror', e => complaints.push(e.message));
  page.on('request', r => { if (!r.url().startsWith('file:') && !r.url().startsWith('data:') && !r.url().startsWith('blob:')) complaints.push('a request to the network: ' + r.url()); });
  await page.goto(url + hash);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  return page;
}
const leave = page => page.context().close();
const total = (page, effect) => page.evaluate(e => Number(document.querySelector(`tr[data-effect=${e}]`).dataset.total), effect);
/* Whether it comes true. */
const soon = (page, what, arg) => page.waitForFunction(what, arg, { timeout: 30000 }).then(() => true, () => false);
/* Switches an effect off.  The page writes its counters three times a second, 0 a step for what is off: the
   counts when it does, and a second later, when it has counted on for the other. */
async function still(page, effect, other) {
  const counts = async () => [await total(page, effect), await total(page, other)];
  const shows = zero => soon(page, ([e, zero]) => zero === (document.querySelector(`tr[data-effect=${e}] td:nth-child(2)`).textContent === '0'), [effect, zero]);
  const acted = await shows(false);
  await page.click(`tr[data-effect=${effect}] input`);
  const zero = await shows(true), [held, going] = await counts();
  await page.waitForTimeout(1000);
  const goes = await soon(page, ([e, n]) => Number(document.querySelector(`tr[data-effect=${e}]`).dataset.total) > n, [other, going]);
  const then = await total(page, effect);
  return { ok: acted && zero && then === held && held > 0, goes, zero, held, then };
}
/* The plots are drawn now and then: up to time t, which many frames have led to. */
const plotted = (page, t) => page.waitForFunction(t => window.gvi.live.t > t && Number(/over (\S+) of time/.exec(document.querySelector('#stability').getAttribute('aria-label'))[1]) > t, t);
const chosen = page => page.getAttribute('#formulation', 'data-formulation');
const measured = page => page.waitForFunction(() => document.querySelector('#cost').dataset.left === '0' && document.querySelector('#here'));
/* The point of the present setting, once it is measured. */
async function here(page) {
  const found = await page.waitForFunction(() => {
    const ring = document.querySelector('#here'), { set } = window.gvi, kicks = /verlet|kicks/.test(set.rule);
    const p = [...document.querySelectorAll('.point')].find(q => q.dataset.id === [0, kicks ? 1 : set.degree, set.rule, set.tol, set.h].join(' '));
    if (!ring || !p || document.querySelector('#cost').dataset.left === undefined || +document.querySelector('#cost').dataset.height !== document.querySelector('#cost').clientHeight) return null;
    return { ...p.dataset, x: +ring.getAttribute('cx'), y: +ring.getAttribute('cy'), width: document.querySelector('#cost').clientWidth, height: document.querySelector('#cost').clientHeight };
  });
  return found.jsonValue();
}
/* Its cost, once it has been timed three times. */
const costs = async page => (await page.waitForFunction(() => {
  const { set, problems } = window.gvi, { points } = problems.get(JSON.stringify([set.scene, set.on, set.p]));
  const p = points.find(q => q.id === [0, set.degree, set.rule, set.tol, set.h].join(' '));
  return p && p.seen > 1 && { time: p.time, work: p.work };
})).jsonValue();
const put = (page, selector, value) => page.evaluate(([s, v]) => { const e = document.querySelector(s); e.value = v; e.dispatchEvent(new Event('input', { bubbles: true })); e.dispatchEvent(new Event('change', { bubbles: true })); }, [selector, value]);

/* ---- it opens ---- */
const bytes = statSync(file).size;
check('under 200 KB in all', bytes < 200000, bytes);
let page = await visit();
/* Other programs may run: a time is divided by how often a loop's CPU time fits into the time it takes. */
const cdp = await page.context().newCDPSession(page);
await cdp.send('Performance.enable', { timeDomain: 'threadTicks' });
const spent = async name => (await cdp.send('Performance.getMetrics')).metrics.find(m => m.name === name).value;
async function alone(time) {
  const before = await spent('ThreadTime');
  const loop = await page.evaluate(() => { const begin = performance.now(); while (performance.now() - begin < 300); return performance.now() - begin; });
  return time/Math.max(1, loop/1000/(await spent('ThreadTime') - before));
}
let ready = Infinity;
for (let k = 0; k < 3 && ready >= 1000; k++) {
  if (k) await page.reload(), await page.waitForFunction(() => document.documentElement.dataset.ready);
  ready = Math.min(ready, Math.round(await alone(Number(await page.evaluate(() => document.documentElement.dataset.ready)))));
}
check('first frame under a second', ready < 1000, ready);
check('the planet is the first scene', (await page.textContent('#scene-title')) === 'Planet');
const drawn = () => page.evaluate(() => { const c = document.querySelector('#canvas'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; let n = 0; for (let i = 3; i < d.length; i += 4) n += d[i] > 0; return n; });
check('something is drawn', (await drawn()) > 1000);
/* A slice and its picture have to fit into a frame of 60 a second, in CPU time. */
const before = await spent('ScriptDuration');
const moving = await page.evaluate(() => new Promise(done => { let n = 0, worst = 0, last = performance.now(); const begin = last; const f = () => { const t = performance.now(); worst = Math.max(worst, t - last); last = t; n++; if (t - begin < 2000) requestAnimationFrame(f); else done({ n, worst }); }; requestAnimationFrame(f); }));
const took = 1000*(await spent('ScriptDuration') - before)/moving.n;
const worst = await alone(moving.worst);
check('a slice fits into a frame, none freezes the page', took > 1 && took < 1000/60 && worst < 300, [took, worst]);
const pace = `${took.toFixed(1)} ms of CPU a frame`;

/* ---- effects: what is off costs nothing ---- */
await page.click('tr[data-effect=drag] input');
check('drag reads v: velocities', (await chosen(page)) === 'velocities');
const dear = await costs(page);
check('drag is evaluated', (await total(page, 'drag')) > 0);
const dragless = await still(page, 'drag', 'gravity');
check('without it: positions', (await chosen(page)) === 'positions');
check('and the page says why', /constant mass, effects read only t and q/.test(await page.textContent('#formulation')));
check('its counter stands still', dragless.ok, dragless);
check('the others go on', dragless.goes, dragless);
check('what is off shows 0 a step', dragless.zero, dragless);
const cheap = await costs(page);
check('and its cost falls', cheap.time < dear.time && cheap.work < dear.work, [cheap, dear]);
await page.click('tr[data-effect=clock] input');
check('a clock: momenta', (await chosen(page)) === 'momenta');
await page.click('tr[data-effect=clock] input');

/* ---- accuracy: a point where it should be ---- */
for (const degree of [8, 4, 3]) {
  await put(page, '#degree', degree);
  const p = await here(page);
  const error = await page.evaluate(degree => {                /* the same by hand, in a world of its own */
    const { x, set, problems } = window.gvi, numbers = new Float64Array(x.memory.buffer), n = x.scene_number(set.scene, 0, 0);
    [...set.p, 0, 0, 0, 0].slice(0, 4).forEach((v, i) => { numbers[x.parameters() / 8 + i] = v; });
    x.world_open(2, set.scene, set.on, degree, 0, 0, 0);
    x.race_begin(2, 0, set.h, x.scene_number(set.scene, 3, 0));
    while (!x.race_steps(2, 1000));
    const q = x.race_end(2) / 8, reference = problems.get(JSON.stringify([set.scene, set.on, set.p])).reference;
    return Math.max(...reference.map((v, i) => Math.abs(v - numbers[q + i])));
  }, degree);
  check(`degree ${degree}: the error of the point`, Number(p.error) === error, [p.error, error]);
  const y = 24 + (p.height - 24 - 40)*(2 - Math.log10(error))/18;
  check(`degree ${degree}: its height in the plot`, Math.abs(p.y - y) < 0.6, [p.y, y]);
  check(`degree ${degree}: inside the plot`, p.x >= 50 && p.x <= p.width - 14, p.x);
}
check('each position left a point', (await page.evaluate(() => [3, 4, 8].every(d => document.querySelector(`.point[data-degree="${d}"][data-h="0.02"]`)))));
check('rivals are there', await page.evaluate(() => [1, 2, 3].every(m => document.querySelectorAll(`.point[data-method="${m}"]`).length >= 4)));
await put(page, '#want', -10);
check('a cheapest setting is named', await soon(page, () => /Cheapest setting so far for an error of 10⁻¹⁰ AU: degree \d+/.test(document.querySelector('#cheapest').textContent)), await page.textContent('#cheapest'));
check('cost in evaluations', await soon(page, () => /evaluations/.test(document.querySelector('#cost').textContent)));
await page.click('#by-time');
check('in time, too', await soon(page, () => /time of the run/.test(document.querySelector('#cost').textContent)));
await page.click('#by-work');

/* ---- bad input ---- */
for (const [selector, bad, words, good] of [['#degree-n', 99, /memory too small|is not|bad argument/, 8], ['#h-n', 0, /h is 0/, 0.02], ['#h-n', 'nonsense', /h is 0|bad argument/, 0.02], ['#degree-n', 0, /degree is not 1 or more/, 8]]) {
  await put(page, selector, bad);
  check(`${selector} ${bad}: the library's words`, words.test(await page.textContent('#alert-text')) && await page.isVisible('#alert'), await page.textContent('#alert-text'));
  await put(page, selector, good);
  check(`${selector} ${good}: alive again`, !(await page.isVisible('#alert')));
}
await page.selectOption('#rule', 'verlet');
check('kicks: explicit', (await chosen(page)) === 'explicit');
await page.click('tr[data-effect=drag] input');
check('kicks with a force that reads v: refused in words', /kicks are for constant mass/.test(await page.textContent('#alert-text')), await page.textContent('#alert-text'));
await page.click('tr[data-effect=drag] input');
await page.selectOption('#rule', 'gauss');
check('and back', (await chosen(page)) === 'positions');

/* ---- the dial ---- */
await page.selectOption('#dial', '1e-8');
check('by the dial: the step cannot be set', await page.isDisabled('#h'));
await page.waitForFunction(() => / steps in .* a run/.test(document.querySelector('#dial-out').textContent));
check('steps and time of a run are given', /^[\d,]+ steps in [\d.]+ [mµ]?s a run$/.test(await page.textContent('#dial-out')), await page.textContent('#dial-out'));
await measured(page);
check('the dial has points of its own', await page.evaluate(() => [...document.querySelectorAll('.point')].filter(p => / dial /.test(p.dataset.id)).length > 0));
await page.selectOption('#dial', '0');
check('and back to one step', !(await page.isDisabled('#h')));

/* ---- playback ---- */
await page.click('#restart');
if (!(await page.evaluate(() => document.querySelector('#play').classList.contains('paused')))) await page.click('#play');
await page.click('#restart');
for (let k = 0; k < 40; k++) await page.click('#step');
check('forty steps', (await page.textContent('#stepped')) === '40', await page.textContent('#stepped'));
await put(page, '#speed', 4);
await page.click('#reverse');
await page.waitForFunction(() => /back at the start/.test(document.querySelector('#from-start').textContent));
check('backwards to the start', Number(await page.getAttribute('#from-start', 'data-off')) < 1e-13, await page.textContent('#from-start'));
await page.evaluate(() => document.activeElement.blur());
await page.keyboard.press('ArrowRight');
await page.waitForTimeout(400);
check('the arrow key steps', (await page.textContent('#stepped')) === '1', await page.textContent('#stepped'));
const seen = await page.evaluate(() => document.querySelector('#canvas').toDataURL());
const box = await (await page.$('#canvas')).boundingBox();
await page.mouse.move(box.x + 100, box.y + 100);
await page.mouse.down();
await page.mouse.move(box.x + 200, box.y + 140, { steps: 4 });
await page.mouse.up();
check('a drag turns the picture', await soon(page, seen => seen !== document.querySelector('#canvas').toDataURL(), seen));

/* ---- stability ---- */
await page.click('#break');
await put(page, '#speed', 4);
await page.waitForFunction(() => window.gvi.live.t > 4 || !document.querySelector('#alert').hidden);
const lost = () => page.evaluate(() => { const m = /gvi.h ([^ ,]+)/.exec(document.querySelector('#stability').getAttribute('aria-label')); return Number(m[1].replace('−', '-')); });
if (!(await page.isVisible('#alert'))) await plotted(page, 4);
check('a fixed step breaks at the encounter', (await page.isVisible('#alert')) || (await lost()) > 1e-3, await lost());
await page.click('#clock');
await page.click('#fast');
await plotted(page, 32);
check('the clock keeps the energy', (await lost()) < 1e-11, await lost());

/* ---- a constraint that breaks ---- */
await page.click('#scenes button[data-scene=rods]');
await plotted(page, 2);
const gap = () => page.evaluate(() => Number((/Constraint: gvi.h ([^ ,]+?)[.,]? /.exec(document.querySelector('#stability').getAttribute('aria-label') + ' ') || [])[1]?.replace('−', '-')));
for (let k = 0; k < 100 && Number.isNaN(await gap()); k++) await page.waitForTimeout(100);     // until the label is written
check('the rods hold, to rounding', (await gap()) < 1e-14, await gap());
const reach = () => page.evaluate(() => { const n = i => window.gvi.x.world_number(0, 30, i); return Math.hypot(n(2) - n(0), n(3) - n(1)); });
check('a rod of 1 m', Math.abs((await reach()) - 1) < 1e-14, await reach());
const broken = await still(page, 'lower-rod', 'upper-rod');
check('a broken rod: its counter stands still', broken.ok && broken.goes, broken);
check('and the bob flies off', await soon(page, () => { const n = i => window.gvi.x.world_number(0, 30, i); return Math.hypot(n(2) - n(0), n(3) - n(1)) > 1.5; }), await reach());
await page.screenshot({ path: join(build, 'broken.png'), fullPage: true });
await page.click('tr[data-effect=lower-rod] input');
check('it cannot be mounted there', /^gvi_switch.*lower rod/.test(await page.textContent('#alert-text')), await page.textContent('#alert-text'));
await page.click('#restart');
check('but at the start', !(await page.isVisible('#alert')) && Math.abs((await reach()) - 1) < 1e-14);

await page.click('#scenes button[data-scene=frame]');
await page.waitForFunction(() => window.gvi.live.t > 0.5);
const spare = await still(page, 'second-diagonal', 'diagonal');
const shape = () => page.evaluate(() => { const n = i => window.gvi.x.world_number(0, 30, i); return Math.abs(Math.hypot(n(6) - n(2), n(7) - n(3)) - 1); });
check('a redundant rod off: the frame keeps its shape', spare.ok && spare.goes && (await shape()) < 1e-14, [spare, await shape()]);
await page.click('tr[data-effect=second-diagonal] input');
check('it can be mounted again', !(await page.isVisible('#alert')) && (await shape()) < 1e-14, await page.textContent('#alert-text'));
for (const rod of ['diagonal', 'second-diagonal']) await page.click(`tr[data-effect=${rod}] input`);
check('without both the frame folds', await soon(page, () => { const n = i => window.gvi.x.world_number(0, 30, i); return Math.abs(Math.hypot(n(6) - n(2), n(7) - n(3)) - 1) > 0.1; }), await shape());

await page.click('#scenes button[data-scene=quaternion]');
await page.waitForFunction(() => window.gvi.live.t > 0.1);
const free = await still(page, 'unit-length', 'gravity');
check('a free quaternion: its counter stands still', free.ok && free.goes && (await chosen(page)) === 'momenta', free);
await page.click('tr[data-effect=unit-length] input');
check('it can be held again, to rounding', (await soon(page, n => Number(document.querySelector('tr[data-effect=unit-length]').dataset.total) > n, free.held)) && !(await page.isVisible('#alert')) && (await page.evaluate(() => window.gvi.x.world_number(0, 22, 0))) < 1e-15);

/* ---- a coin that rolls ---- */
await page.click('#scenes button[data-scene=coin]');
await plotted(page, 2);
check('the coin does not slip', (await page.evaluate(() => window.gvi.x.world_number(0, 22, 0))) < 1e-14 && (await gap()) < 1e-14, await gap());
/* on ice no force acts sideways: the momentum of the centre stays */
const speeds = () => page.evaluate(() => { const { x } = window.gvi, p = i => x.world_number(0, 31, i); return [p(0), p(1)]; });
await page.click('tr[data-effect=rolling] input');
const [slid, later] = [await speeds(), await page.waitForTimeout(600).then(speeds)];
check('without rolling its centre goes straight on', Math.hypot(...slid) > 0.5 && slid.every((p, i) => Math.abs(p - later[i]) < 1e-12), [slid, later]);
await page.click('tr[data-effect=rolling] input');
check('it cannot roll again while it slips', /^gvi_switch.*rolling/.test(await page.textContent('#alert-text')), await page.textContent('#alert-text'));
await page.click('#restart');
check('but from the start', !(await page.isVisible('#alert')));

/* ---- the address ---- */
await page.click('#scenes button[data-scene=charge]');
await page.click('tr[data-effect=electric-field] input');
await put(page, '#h-n', 0.4);
await put(page, '#p0', 0.7);
await put(page, '#degree', 6);
const shared = await page.evaluate(() => location.hash);
await leave(page);
page = await visit(shared);
const got = await page.evaluate(() => ({ title: document.querySelector('#scene-title').textContent, ...window.gvi.set }));
check('a shared address opens as it was', got.title === 'Charged particle' && got.h === 0.4 && got.degree === 6 && got.p[0] === 0.7 && got.on === 7, [shared, got]);
await leave(page);
for (const hash of ['#scene=nonsense', '#degree=99', '#h=0', '#h=-1e999&degree=x', '#scene=top&p=a,b&rule=none', '#%E0%A4%A', '#tol=-5', '#scene=kepler&p=1']) {
  page = await visit(hash);
  const said = await page.textContent('#alert-text'), quiet = hash === '#%E0%A4%A';
  check(`${hash}: words`, quiet || (said.length > 20 && await page.isVisible('#alert')), said);
  await page.click('#scenes button[data-scene=eight]');
  await page.waitForTimeout(300);
  check(`${hash}: alive`, (await page.textContent('#scene-title')) === 'Figure eight' && (await chosen(page)) === 'positions' && !(await page.isVisible('#alert')));
  await leave(page);
}

page = await visit('#scene=eight');
await page.evaluate(() => { location.hash = '#scene=no-such-scene'; });
check('an address typed later is read, too', await soon(page, () => /no-such-scene.*is not one of the scenes/.test(document.querySelector('#alert-text').textContent)), await page.textContent('#alert-text'));
check('an unknown scene: no button that would not help', await page.evaluate(() => document.querySelector('#halve').hidden && document.querySelector('#alert-clock').hidden));
const saving = page.waitForEvent('download');
await page.click('#save');
const picture = await saving;
check('a picture is saved', /^\w+\.png$/.test(picture.suggestedFilename()) && statSync(await picture.path()).size > 5000, picture.suggestedFilename());
check('the energy is seen as a curve', await soon(page, () => /L/.test(document.querySelector('#trace path:last-child').getAttribute('d'))));
await page.evaluate(() => { location.hash = '#scene=arm&degree=5'; });
check('and another', (await soon(page, () => window.gvi.set.degree === 5)) && (await page.textContent('#scene-title')) === 'Robot arm');
await leave(page);

/* ---- every scene; what it writes compiles and says the same ---- */
const programs = {};
page = await visit();
for (const name of await page.evaluate(() => [...document.querySelectorAll('#scenes button')].map(b => b.dataset.scene))) {
  await page.click(`#scenes button[data-scene=${name}]`);
  await measured(page);
  const state = await page.evaluate(() => ({ alert: !document.querySelector('#alert').hidden, points: document.querySelectorAll('.point[data-method="0"]').length, label: document.querySelector('#cost').getAttribute('aria-label'), code: document.querySelector('#code').textContent, reference: window.gvi.problems.get(JSON.stringify([window.gvi.set.scene, window.gvi.set.on, window.gvi.set.p])).reference }));
  check(`${name}: runs and is measured`, !state.alert && state.points > 8 && state.reference, { ...state, code: '' });
  programs[name] = state;
}
for (const name of ['kepler', 'pendulum', 'rods', 'frame', 'quaternion', 'net', 'pythagoras', 'coin']) {
  const source = join(build, `${name}.c`), binary = join(build, name);
  writeFileSync(source, programs[name].code);
  try {
    execFileSync(process.env.CC || 'cc', ['-O0', '-ffp-contract=off', '-Wall', '-I.', '-Iexamples', '-Idocs/playground', source, '-o', binary, '-lm'], { stdio: ['ignore', 'inherit', 'inherit'] });
    const out = execFileSync(binary, { encoding: 'utf8' }), q = [...out.matchAll(/= (\S+)$/gm)].slice(-programs[name].reference.length).map(m => Number(m[1]));
    const off = Math.max(...q.map((v, i) => Math.abs(v - programs[name].reference[i])));
    check(`${name}: the C says the same`, /^ok/.test(out) && (name === 'pythagoras' || off < 1e-7), [off, out.slice(0, 60)]);
  } catch (e) { check(`${name}: the C compiles`, false, e.message); }
}

/* ---- the visitor's own L or H ---- */
await page.click('#scenes button[data-scene=own]');
check('own: the box and the C are there', (await page.isVisible('#typed')) && (await page.isVisible('#code')));
const compiled = {};
for (const example of await page.evaluate(() => [...document.querySelector('#examples').options].map(o => o.value))) {
  await page.selectOption('#examples', example);
  await measured(page);
  const ran = await page.evaluate(() => ({ wrong: document.querySelector('#wrong').className, alert: !document.querySelector('#alert').hidden, points: document.querySelectorAll('.point[data-method="0"]').length, rivals: document.querySelectorAll('.point[data-method="3"]').length, error: +document.querySelectorAll('.point')[0].dataset.error,
    code: document.querySelector('#code').textContent, reference: window.gvi.problems.get(JSON.stringify([window.gvi.set.scene, window.gvi.set.on, window.gvi.set.p])).reference }));
  check(`own, ${example}: runs and is measured`, !ran.wrong && !ran.alert && ran.points > 8 && (/^0 = /m.test(await page.inputValue('#typed')) ? !ran.rivals : ran.rivals >= 3) && ran.reference, { ...ran, code: '' });
  compiled[example] = ran;
}
writeFileSync(join(build, 'gvi.c'), '#define GVI_IMPLEMENTATION\n#include "gvi.h"\n');
execFileSync(process.env.CC || 'cc', ['-O1', '-ffp-contract=off', '-I.', '-c', join(build, 'gvi.c'), '-o', join(build, 'gvi.o')]);
for (const [example, { code, reference }] of Object.entries(compiled)) {
  const source = join(build, 'own.c'), binary = join(build, 'own');
  writeFileSync(source, code.replace('#define GVI_IMPLEMENTATION\n', ''));
  try {
    execFileSync(process.env.CC || 'cc', ['-O0', '-ffp-contract=off', '-std=c99', '-Wall', '-Wextra', '-Werror', '-I.', '-Iexamples', source, join(build, 'gvi.o'), '-o', binary, '-lm'], { stdio: ['ignore', 'inherit', 'inherit'] });
    const out = execFileSync(binary, { encoding: 'utf8' }), q = [...out.matchAll(/= (\S+)$/gm)].slice(-reference.length).map(m => Number(m[1]));
    check(`own, ${example}: the C says the same`, /^ok/.test(out) && Math.max(...q.map((v, i) => Math.abs(v - reference[i]))) < 1e-7, [q, reference]);
  } catch (e) { check(`own, ${example}: the C compiles`, false, e.message); }
}
const said = what => soon(page, w => new RegExp(w).test(document.querySelector('#wrong').textContent), what);
const goes = async () => soon(page, t => window.gvi.live.t > t, await page.evaluate(() => window.gvi.live.t));
await page.selectOption('#examples', 'a planet');
for (const [typed, words] of [['L = vx^2/2 - k*x\nx(0) = 1', '^Line 1, column 14: k is not known'], ['L = 2\nx', '^Line 2, column 1: .* missing before "x"'], ['x(0) = 1\nL = vx^2 - abs(x)', '^Line 2, column 12: abs has a kink'],
  ['L = vx^2/2 + y\nx(0) = 1, y(0) = 0', 'no kinetic energy in y and is linear in it.*as a line 0 = ...\\.$'], ["L = x y' - y x'\nx(0) = 1, y(0) = 1", 'of first order; type H = ... in its place\\.$'], ['L = vx^2/2 - px\nx(0) = 1', 'px is a momentum, and L takes velocities'],
  ["H = x'^2/2\nx(0) = 1", "^Line 1, column 5: x' is a velocity, and H takes momenta: px"], ['H = px^2/2\n0 = x\nx(0) = 0', '^Line 2, column 1: a constraint needs L'], ['H = p^2/2 + log(x)\nx(0) = 0', '^H is not finite at the start'], ['H = p^2/2 + sqrt(x^2)\nx(0) = 0', '^dH/dx is not finite at the start']]) {
  await page.fill('#typed', typed);
  check(`own, ${JSON.stringify(typed)}: words`, await said(words), await page.textContent('#wrong'));
  check(`own, ${JSON.stringify(typed)}: what ran before goes on`, (await page.evaluate(() => document.querySelector('#wrong').className === 'bad')) && await goes());
}
await page.fill('#typed', 'L = vx^2/2 - 2*x^2\nx(0) = 1\nend = 8');
check('own, an oscillator: it runs', (await said("L is v'Mv/2")) && (await chosen(page)) === 'positions' && await goes());
const swing = await page.evaluate(() => { const { x, set } = window.gvi; new Float64Array(x.memory.buffer).fill(0, x.parameters()/8, x.parameters()/8 + 4); x.world_open(2, set.scene, 1, 8, 0, 0, 0); x.world_advance(2, 0.125, 64); return x.world_number(2, 30, 0) - Math.cos(16); });
check('own, an oscillator: its cosine', Math.abs(swing) < 1e-13, swing);
const link = await page.evaluate(() => location.hash);
await page.fill('#typed', 'H = p²/2 - cos(q)\nq(0) = 1, p(0) = 1');
check('own, a pendulum as H: it runs', (await said("^H: q' = dH/dp, p' = -dH/dq")) && (await chosen(page)) === 'momenta' && await goes(), await page.textContent('#wrong'));
await plotted(page, 3);
check('own, as H: its energy is level, and in the plot', (await lost()) < 1e-14 && /energy off by/.test(await page.textContent('#readout')) && await page.evaluate(() => document.querySelectorAll('#stability path').length >= 2), await lost());
check('own, as H: it goes on from its momentum', await page.evaluate(() => { const p = () => window.gvi.x.world_number(0, 31, 0), before = [window.gvi.x.world_number(0, 30, 0), p()], d = document.querySelector('#degree'); window.gvi.live.playing = false; d.value = 5; d.dispatchEvent(new Event('input', { bubbles: true })); return Math.abs(window.gvi.x.world_number(0, 30, 0) - before[0]) + Math.abs(p() - before[1]) < 1e-14; }));
await page.selectOption('#rule', 'lobatto');
check('own, as H: another rule is refused in words', /for H the rule is Gauss/.test(await page.textContent('#alert-text')), await page.textContent('#alert-text'));
await page.selectOption('#rule', 'gauss');
await page.fill('#typed', "L = x'^2/2 (1 + h^2) - 9.81 exp(-(x - 50)^2)\nh = -2 (x - 50) exp(-(x - 50)^2)\nx(0) = 0, x'(0) = 25");
check('own, a bump: it stops, and says what to add', await soon(page, () => /as it was near the start; add the line kind = MASS\./.test(document.querySelector('#alert-text').textContent)), await page.textContent('#alert-text'));
await page.fill('#typed', `${await page.inputValue('#typed')}\nkind = MASS`);
check('own, a bump: with the line it passes', (await said("M\\(t,q\\)")) && await soon(page, () => window.gvi.x.world_number(0, 30, 0) > 60) && /L.kind = LAGRANGIAN_MASS;/.test(await page.textContent('#code')));
await page.fill('#typed', "L = θ'²/2 + cos(θ)\nFθ = -0.5 θ'\nθ(0) = 1");
check('own, a force: its row, and the energy falls', await soon(page, () => document.querySelectorAll('#rows tr').length === 2 && /changed by/.test(document.querySelector('#energy-word').textContent) && window.gvi.live.t > 3 && Number(document.querySelector('#energy').textContent) > 0.1),
  await page.textContent('#readout'));
check('own, a force: its C, and nothing covers it', /GVI_POINTS\(force, 1, v, f\)[^]*at->f\[0\] \+= \(-0.5\)\*vtheta/.test(await page.textContent('#code')) && await page.evaluate(() => document.querySelector('#copy').getBoundingClientRect().bottom <= document.querySelector('#code').getBoundingClientRect().top), await page.textContent('#code'));
for (const [hash, works] of [[link, true], ['#scene=own&L=nonsense', false], ['#scene=own', true]]) {
  const other = await visit(hash), seen = await other.evaluate(() => [document.querySelector('#scene-title').textContent, document.querySelector('#typed').value, document.querySelector('#alert').hidden]);
  check(`own, a shared address: ${works ? 'as it was' : 'words'}`, (seen[0] === 'Your L or H') === works && seen[2] === works && (hash !== link || /2\*x\^2/.test(seen[1])), seen);
  await leave(other);
}
await page.click('#scenes button[data-scene=kepler]');
check('own: another scene hides it', !(await page.isVisible('#typed')) && (await page.evaluate(() => document.querySelector('.price #code-box') !== null)));
await page.click('#scenes button[data-scene=own]');
check('own: and back, as it was', /Fθ/.test(await page.inputValue('#typed')) && (await page.isVisible('#code')) && await goes());
await page.selectOption('#examples', 'a double pendulum');
await measured(page);

/* ---- every change of scene: what is said is of this scene ---- */
const names = await page.evaluate(() => [...document.querySelectorAll('#scenes button')].map(b => b.dataset.scene));
for (const from of names) for (const to of names) {
  if (from === to) continue;
  const said = await page.evaluate(async ([from, to]) => {
    const frames = n => new Promise(done => { const f = () => n-- > 0 ? requestAnimationFrame(f) : done(); f(); });
    const $ = s => document.querySelector(s);
    $(`#scenes button[data-scene=${from}]`).click();
    await frames(2);
    $(`#scenes button[data-scene=${to}]`).click();
    if (to !== 'net') $('#h-n').value = window.gvi.set.h * (1 + 0.01 * Math.random()), $('#h-n').dispatchEvent(new Event('change'));
    delete $('#cost').dataset.left;                        // until it is drawn again
    while ($('#cost').dataset.left === undefined) await frames(1);
    const here = $('#here') && [...document.querySelectorAll('.point')].find(p => p.getAttribute('cx') === $('#here').getAttribute('cx') && p.getAttribute('cy') === $('#here').getAttribute('cy'));
    return { title: $('#scene-title').textContent, button: $(`#scenes button[data-scene=${to}]`).textContent, alert: !$('#alert').hidden, words: $('#point').textContent, h: window.gvi.set.h, here: !!here };
  }, [from, to]);
  const now = said.words.startsWith('As set now'), h = /h = (\S+?)[,:]/.exec(said.words)?.[1].replace('−', '-');
  check(`${from} to ${to}: its own words`, said.title === said.button && !said.alert && now === said.here && (!now || Math.abs(h/said.h - 1) < 1e-3), said);
}

/* ---- all scenes of effects: each effect off, and all together ---- */
for (const name of names.filter(n => n !== 'own')) {
  await page.click(`#scenes button[data-scene=${name}]`);
  const effects = await page.evaluate(() => [...document.querySelectorAll('#rows tr')].map(r => [r.dataset.effect, r.querySelector('input').checked]));
  for (const [effect, on] of effects) {
    if (!on) continue;
    await page.click(`#scenes button[data-scene=${name}]`);
    await page.click(`tr[data-effect=${effect}] input`);
    check(`${name} without ${effect}: it goes on`, !(await page.isVisible('#alert')) && await soon(page, t => window.gvi.live.t > t, await page.evaluate(() => window.gvi.live.t)), await page.textContent('#alert-text'));
  }
  await page.click(`#scenes button[data-scene=${name}]`);
  for (const [effect, on] of effects) if (on) await page.click(`tr[data-effect=${effect}] input`);
  await page.click('#restart');
  check(`${name} with nothing on: it goes on`, !(await page.isVisible('#alert')) && await soon(page, () => window.gvi.live.t > 0), await page.textContent('#alert-text'));
  check(`${name} with nothing on: no evaluations`, (await page.evaluate(() => document.querySelectorAll('#rows tr.off').length)) === effects.length && (await page.evaluate(k => [...Array(k)].every((_, e) => window.gvi.x.world_number(0, 3, e) === 0), effects.length)));
  /* by hand: with a constant mass the motion is straight */
  const off = await page.evaluate(() => {
    const { x, set } = window.gvi, n = x.scene_number(set.scene, 0, 0), h = set.h;
    new Float64Array(x.memory.buffer).set([...set.p, 0, 0, 0, 0].slice(0, 4), x.parameters()/8);
    if (x.world_open(2, set.scene, 0, set.degree, 0, 0, 0) || x.world_advance(2, h, 10)) return NaN;
    return Math.max(...[...Array(n)].map((_, i) => Math.abs(x.world_number(2, 30, i) - x.world_number(2, 32, i) - 10*h*x.world_number(2, 33, i))));
  });
  check(`${name} with nothing on: ${/pendulum|top|arm|quaternion|coin/.test(name) ? 'it turns' : 'straight on'}`, /pendulum|top|arm|quaternion|coin/.test(name) ? off === off : off < 1e-13, off);
}
await page.click('#scenes button[data-scene=kepler]');
for (const effect of ['gravity', 'oblateness']) await page.click(`tr[data-effect=${effect}] input`);
await measured(page);
check('free: its cost is none', await soon(page, () => /As set now: .*, 0 evaluations/.test(document.querySelector('#point').textContent)) && /nothing is evaluated/.test(await page.textContent('#cheapest')), await page.textContent('#point'));
writeFileSync(join(build, 'free.c'), await page.textContent('#code'));
try {
  execFileSync(process.env.CC || 'cc', ['-O0', '-Wall', '-Werror', '-I.', '-Iexamples', '-Idocs/playground', join(build, 'free.c'), '-o', join(build, 'free'), '-lm'], { stdio: ['ignore', 'inherit', 'inherit'] });
  check('free: the C runs', /^ok/.test(execFileSync(join(build, 'free'), { encoding: 'utf8' })));
} catch (e) { check('free: the C compiles', false, e.message); }

/* ---- the settings one meets first keep the energy level.  N steps, each off by eps (T + |V|) at most and
   independent of the others, are off by sqrt(N) of that, and twice as far once on the way.  |V| is what E = T + V leaves: E itself may be near 0. ---- */
for (const name of names.filter(n => !/pythagoras|pendulum|rods|arm|net|own/.test(n))) {           // chaotic or driven
  const { most, bound } = await page.evaluate(async name => {
    document.querySelector(`#scenes button[data-scene=${name}]`).click();
    const { x, set } = window.gvi, span = x.scene_number(set.scene, 3, 0), n = x.scene_number(set.scene, 0, 0);
    new Float64Array(x.memory.buffer).set([...set.p, 0, 0, 0, 0].slice(0, 4), x.parameters()/8);
    x.world_open(2, set.scene, set.on, set.degree, 0, 0, 0);
    const E = x.world_number(2, 20, 0), T = [...Array(n)].reduce((sum, _, i) => sum + x.world_number(2, 33, i)*x.world_number(2, 31, i)/2, 0);
    let most = 0, steps = 0;
    for (; x.world_number(2, 0, 0) < 16*span; steps++) {
      if (x.world_advance(2, set.h, 1)) return { most: NaN };
      most = Math.max(most, Math.abs(x.world_number(2, 20, 0) - E));
    }
    return { most, bound: 2*Number.EPSILON*Math.sqrt(steps)*(Math.abs(T) + Math.abs(E - T)) };
  }, name);
  check(`${name}: its energy is level`, most < bound, [most, bound]);
}

/* ---- for all ---- */
const nameless = await page.evaluate(() => [...document.querySelectorAll('button, input, select, canvas, svg[role=img]')].filter(e => !(e.getAttribute('aria-label') || e.textContent.trim() || (e.labels && e.labels.length))).map(e => e.id || e.outerHTML.slice(0, 60)));
check('everything has a name', nameless.length === 0, nameless);
const contrast = await page.evaluate(() => {
  const light = c => { const [r, g, b] = c.match(/[\d.]+/g).map(v => { v /= 255; return v <= 0.03928 ? v/12.92 : ((v + 0.055)/1.055)**2.4; }); return 0.2126*r + 0.7152*g + 0.0722*b; };
  const ratio = (a, b) => { const [x, y] = [light(a), light(b)].sort((p, q) => q - p); return (x + 0.05)/(y + 0.05); };
  const card = getComputedStyle(document.querySelector('.card')).backgroundColor;
  return Math.min(...['.note', 'h2', '.switch small', 'a'].map(s => ratio(getComputedStyle(document.querySelector(s)).color, card)));
});
check('text can be read', contrast > 4.5, contrast);
await leave(page);
page = await visit('', { reducedMotion: 'reduce' });
const at = await page.evaluate(() => window.gvi.live.t);
await page.waitForTimeout(600);
check('less motion: it waits', at === await page.evaluate(() => window.gvi.live.t) && await page.evaluate(() => !window.gvi.live.playing));
await leave(page);
/* The picture, what it costs and the buttons at first sight */
for (const [width, height] of [[1280, 720], [1366, 768], [1920, 1080]]) {
  page = await visit('', { viewport: { width, height } });
  await measured(page);
  await page.waitForTimeout(500);
  const low = await page.evaluate(() => Object.fromEntries(['#canvas', '#play', '#speed', '#cost', '#by-time', '#point', '#cheapest'].map(s => [s, document.querySelector(s).getBoundingClientRect().bottom])));
  check(`${width} x ${height}: seen at first sight`, Object.values(low).every(y => y <= height), low);
  check(`${width} x ${height}: large enough`, await page.evaluate(() => document.querySelector('#canvas').clientHeight >= 340 && document.querySelector('#cost').clientHeight >= 190));
  check(`${width} x ${height}: nothing sticks out`, await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await page.screenshot({ path: join(build, `first-${width}.png`) });
  await page.click('#scenes button[data-scene=own]');
  await measured(page);
  const near = await page.evaluate(() => Object.fromEntries(['#canvas', '#play', '#typed', '#wrong'].map(s => [s, document.querySelector(s).getBoundingClientRect().bottom])));
  check(`${width} x ${height}: own, at first sight`, Object.values(near).every(y => y <= height) && await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), near);
  await page.screenshot({ path: join(build, `own-${width}.png`) });
  await leave(page);
}
page = await visit('', { viewport: { width: 320, height: 640 } });
const narrow = await page.evaluate(() => ['#speed', '#speed-out', '#step'].map(s => document.querySelector(s).getBoundingClientRect()).map(r => [r.left, r.right, r.width]));
check('320 pixels: the speed control is whole', narrow.every(([l, r, w]) => l >= 0 && r <= 308 && w > 20) && narrow[0][2] >= 100, narrow);
await page.click('#scenes button[data-scene=own]');
check('320 pixels: own, nothing sticks out', await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth && document.querySelector('#typed').getBoundingClientRect().right <= 308));
await leave(page);
for (const [name, hash, options] of [['light', '', { colorScheme: 'light', viewport: { width: 1280, height: 1500 } }], ['dark', '#scene=eight', { colorScheme: 'dark', viewport: { width: 1280, height: 1500 } }], ['rods-dark', '#scene=rods', { colorScheme: 'dark', viewport: { width: 1280, height: 1500 } }], ['phone-rods', '#scene=rods', { colorScheme: 'light', viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true }], ['phone', '#scene=top', { colorScheme: 'light', viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true }], ['phone-dark', '#scene=pendulum', { colorScheme: 'dark', viewport: { width: 360, height: 740 }, isMobile: true, hasTouch: true }]]) {
  page = await visit(hash, options);
  await measured(page);
  check(`${name}: nothing sticks out`, await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), await page.evaluate(() => document.documentElement.scrollWidth));
  if (options.hasTouch) { await page.tap('#play'); check(`${name}: a touch pauses`, await page.evaluate(() => !window.gvi.live.playing)); }
  const back = await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).reduce((a, b) => a + +b, 0));
  check(`${name}: its colours`, options.colorScheme === 'dark' ? back < 200 : back > 600, back);
  /* as tall as the page: a full-page picture of a phone would draw the plots at another width */
  await page.setViewportSize({ width: options.viewport.width, height: await page.evaluate(() => document.documentElement.scrollHeight) });
  await page.waitForTimeout(1000);
  await page.screenshot({ path: join(build, `${name}.png`) });
  await leave(page);
}
check('no error on the console, no request', complaints.length === 0, complaints);
await browser.close();
rmSync(profile, { recursive: true, force: true });
console.log(`playground: ${(bytes/1000).toFixed(0)} KB, first frame after ${ready} ms, ${pace} while it measures; screens in ${build}`);
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
