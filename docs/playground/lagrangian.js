/* lagrangian.js - what is typed as L or H: to operations for own.h, and to C for lagrangian.h.

   lagrange(text) gives { names, n, q, v, momenta, kind, steps, length, draw, rods, force, holds, rolls, end, timed, c }, or
   throws an Error that names line and column.  The text: name = value or expression; L = ... or H = ...; x(0) = value
   makes x a coordinate, whose velocity in L is vx or x' (of q1: v1), and whose momentum in H is px (of q1: p1), in v of
   the result; kind = MASS says what L is, where it looks simpler near the start; Fx = ... is a force on it; 0 = ... a constraint, or a rolling one where it has velocities; end = value;
   draw = (x, y) (x, y), (x, y): what stands together is joined.  2 x, sin^2(x), ½ m ẋ², x_1 are read as on paper. */
const MATHS = { __proto__: null, sqrt: Math.sqrt, exp: Math.exp, log: Math.log, sin: Math.sin, cos: Math.cos, tan: Math.tan, atan: Math.atan };
const KINDS = ['', 'POTENTIAL', 'LINEAR', 'MASS', 'MASS_LINEAR', 'GENERAL'];
const SIGNS = '?+-*/^';                                  /* their numbers, and after them MATHS: own.h */
const N = c => ['number', c], EXP = a => ['exp', a];
const MADE_OF = { __proto__: null,                                        /* by the others */
  sinh: a => ['/', ['-', EXP(a), ['/', N(1), EXP(a)]], N(2)],
  cosh: a => ['/', ['+', EXP(a), ['/', N(1), EXP(a)]], N(2)],
  tanh: a => ['-', N(1), ['/', N(2), ['+', EXP(['*', N(2), a]), N(1)]]],
  asin: a => ['atan', ['/', a, ['sqrt', ['-', N(1), ['*', a, a]]]]],
  acos: a => ['-', N(Math.PI / 2), ['asin', a]],
};
const ALSO = { __proto__: null, ln: 'log', arcsin: 'asin', arccos: 'acos', arctan: 'atan', '√': 'sqrt' };
const GREEK = 'alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho sigma sigma tau upsilon phi chi psi omega'.split(' ');
const plain = a => a.normalize('NFKD');                  /* ẋ is x and a dot, ₁ is 1, ϕ is φ */
const spelled = name => plain(name).replace(/[\u0307\u0308'’′_]/g, '').replace(/[\u03b1-\u03c9]/g, c => GREEK[c.charCodeAt() - 945]).replace(/[\u0391-\u03a9]/g, c => GREEK[c.charCodeAt() - 913].replace(/./, a => a.toUpperCase()));
const rate = letter => name => /^q\d*$/.test(name) ? name.replace('q', letter) : letter + name;
const speedOf = rate('v'), momentumOf = rate('p');

function lagrange(text) {
  let at = 0, fresh = true;                              /* fresh: the next token is on another line than the last */
  const stop = (what, where = at) => {
    const lines = text.slice(0, where).split('\n');
    throw Error(`Line ${lines.length}, column ${lines.pop().length + 1}: ${what}.`);
  };
  const seen = re => {                                   /* the next token, if it is of this kind */
    const [space] = /^(\s|(#|%|\/\/).*)*/.exec(text.slice(at));
    at += space.length;
    fresh ||= space.includes('\n');
    return (re.exec(text.slice(at)) || [])[0];
  };
  const take = re => { const word = seen(re); if (word) at += word.length, fresh = false; return word; };
  const NAME = /^(\p{L}[\p{L}\d\u2080-\u2089_\u0307\u0308]*|√)/u, MARKED = RegExp(NAME.source + "['’′]*", 'u');
  let read = new Set(), kind = 0;                        /* names on this line */
  /* a name as C has it: x', ẋ and xdot are the velocity of x */
  function word() {
    const typed = take(MARKED) || '', marks = plain(typed).replace(/[^\u0307\u0308'’′]/g, '').replace(/\u0308/g, "''").length, bare = spelled(typed), stem = bare.replace(/^(.+)dot(\d*)$/, '$1$2');
    const name = ALSO[bare] || (marks || stem !== bare ? speedOf(stem) : bare);
    if (name && !/^[a-z][a-z\d]*$/i.test(name)) stop(`${typed} is no name here: letters are a to z and Greek`, at - typed.length);
    if (marks > 1) stop(`${typed} is a second derivative: the equations have those, L and H do not`, at - typed.length);
    if (name) read.add(name);
    return name;
  }
  const found = () => seen(/^./) ? `"${seen(/^(\w+|.)/u)}"` : 'the end';
  const SQUARE = 'brackets are ( and ), coordinates q1 and q2, not q[0] and q[1]';
  const need = (sign, why) => take(RegExp('^\\' + sign)) || stop(`"${sign}" is missing before ${found()}${why || ''}`);

  function noFunction(name, place) {
    if (/^(f?abs|sign|min|max|floor)$/.test(name)) stop(`${name} has a kink, and L and H have to be smooth; sqrt(x^2 + 0.01) is`, place);
    stop(`${name} is not a function; there are ${[...Object.keys(MATHS), ...Object.keys(MADE_OF)].join(', ')}, pow and ^; what has a line of its own stands without (), and a product has *`, place);
  }
  /* [sign or function, operands], ['number', value] or ['name', name, before a bracket?, place] */
  function atom() {
    const part = take(/^[\u00bc-\u00be\u2153-\u215e]/), number = !part && take(/^(\d+\.?\d*|\.\d+)(e[+-]?\d+)?/i);
    if (part) return ['/', ...plain(part).split('\u2044').map(a => N(+a))];
    if (number) return N(+number);
    if (take(/^\(/)) { const inside = sum(); need(')'); return inside; }
    seen(/^./);
    const place = at, name = word();
    if (!name) stop({ '[': SQUARE, '{': SQUARE, '|': '|x| has a kink, and L and H have to be smooth', '\\': "LaTeX is not read: a velocity is x', a root sqrt(x), a fraction a/b" }[text[at]] || `a number, a name or "(" belongs here, not ${found()}`);
    if (!MATHS[name] && !MADE_OF[name] && name !== 'pow') {
      if (take(/^\(\s*t\s*\)/)) return ['name', name, , place];
      if (seen(/^\(\s*[\p{L}\d][^()+*/\u2212-]*\)/u)) noFunction(name, place);
      return ['name', name, !!seen(/^\(/), place];
    }
    const typed = text.slice(place, at), raised = take(/^(\^|\*\*)/) ? [N(+must(/^-?\d+/, 'a whole number belongs here'))] : raisedBy();
    if (!seen(/^\(/)) stop(`${typed} needs parentheses: ${typed}(${seen(MARKED) || 'x'})`, place);
    need('(');
    const inside = sum();
    if (name !== 'pow') return need(')'), raised ? ['^', [name, inside], raised[0]] : [name, inside];
    need(',', ': pow takes two');
    const power = sum();
    need(')');
    return ['^', inside, power];
  }
  const must = (re, why) => take(re) || stop(`${why}, not ${found()}`);
  const raisedBy = () => { const sign = take(/^\u207b?[\u2070\u00b9\u00b2\u00b3\u2074-\u2079]+/); return sign && [N(+plain(sign).replace('\u2212', '-'))]; };
  function power() {
    const base = atom(), raised = raisedBy();
    return raised ? ['^', base, raised[0]] : take(/^(\^|\*\*)/) ? ['^', base, signed()] : base;
  }
  const minus = () => (take(/^[+\u2212-]/) || '').replace('\u2212', '-');
  function signed() {
    const sign = minus();
    return sign === '-' ? ['-', N(0), signed()] : sign ? signed() : power();
  }
  /* what stands beside it on the same line is a factor, unless it begins a line of its own, as x(0) = does */
  const beside = () => seen(/^./) && !fresh && /^[\p{L}√(½]/u.test(text.slice(at)) && !/^\p{L}[\p{L}\w\u2080-\u2089\u0307\u0308]*['’′]*\s*(\([^()]*\)\s*)?:?=/u.test(text.slice(at)) && '*';
  function product() {
    let left = signed(), below = 0;                      /* the line: the place behind a / */
    for (;;) {
      const given = take(/^[*/\u00b7\u00d7\u22c5\u2217]/), sign = given ? given.replace(/[^*/]/, '*') : beside();
      if (!sign) return left;
      const factor = seen(/^(\(|\p{L}[\p{L}\d]*)/u), half = left[0] === '/' && left[1][0] === 'number' && left[2][0] === 'number' && factor === '(';
      if (below && !given && !half && !/\s/.test(text[at - 1])) {
        const a = text.slice(below, at).trim(), b = factor === '(' ? '(...)' : factor;
        stop(`is ${b} below the line? If so, /(${a} ${b}), else /${a}*${b}`);
      }
      below = sign === '/' && at;
      left = [sign, left, signed()];
    }
  }
  function sum() {
    let left = product(), sign;
    while ((sign = minus())) left = [sign, left, product()];
    return left;
  }

  /* the lines */
  const lines = new Map(), uses = new Map(), places = new Map(), points = [], rods = [], rows = [];
  for (take(/^[,;]/); seen(/^./); take(/^[,;]/)) {
    seen(/^./);
    read = new Set();
    const place = at, row = take(/^0(?=\s*=)/) && rows.push(`0 ${rows.length}`), given = row ? rows[row - 1] : word();
    const zero = !row && take(/^\(\s*0\s*\)/), name = given + (zero ? '(0)' : '');
    if (!given) stop(/^\d/.test(text.slice(at)) && /\d,$/.test(text.slice(0, at)) ? 'a number has a point, not a comma' : text[at] === '[' ? SQUARE : `a line begins with a name, not with ${found()}`);
    if (given === 'kind' && seen(/^=\s*[A-Z_]{4,}\b/)) {
      take(/^=/);
      if ((kind = KINDS.indexOf(take(/^\w+/))) < 0) stop(`a kind is ${KINDS.slice(1).join(', ')}`, place);
      continue;
    }
    const of = take(/^\([^()]*\)(?=\s*:?=)/);                /* H(q, p) = ... */
    if (of && !/^[LH]$/.test(given) && !/^\(\s*t\s*\)$/.test(of)) stop(`a line has no arguments: ${given} = ..., and a start is ${given}(0)`, place);
    if (!take(/^:?=/)) stop(lines.size ? `a sign such as * is missing before "${given}", or "=" after it` : `"=" is missing after ${name}`, place);
    if (MATHS[given] || MADE_OF[given] || /^(pow|pi|t)$/.test(given)) stop(`${given} has a meaning of its own: take another name`, place);
    if (places.has(name)) stop(`${name} is given twice`, place);
    places.set(name, place);
    if (name !== 'draw') { read = new Set(); lines.set(name, sum()); uses.set(name, read); continue; }
    do {
      const first = points.length;
      while (seen(/^\(/)) {
        need('(');
        points.push(sum());
        need(',', ': a point is (x, y)');
        points.push(sum());
        need(')');
      }
      if (points.length === first) stop(`a point (x, y) belongs here, not ${found()}`);
      rods.push([first / 2, 1, (points.length - first) / 2]);
    } while (take(/^,/));
  }
  const leads = (a, b, met = new Set()) => [...uses.get(a) || []].some(c => c === b || !met.has(c) && met.add(c) && leads(c, b, met));
  const both = lines.has('L') && lines.has('H'), momenta = lines.has('H') && (!both || leads('H', 'L')), whole = momenta ? 'H' : 'L';
  const [rateOf, otherRate, letter, otherLetter, kindOf] = momenta ? [momentumOf, speedOf, 'p', 'v', 'velocity'] : [speedOf, momentumOf, 'v', 'p', 'momentum'];
  const said = new Set([...uses.values()].flatMap(a => [...a])), takes = momenta ? 'H takes momenta' : 'L takes velocities';
  const started = [...lines.keys()].filter(a => /\)$/.test(a)).map(a => a.slice(0, -3));
  let names = started.filter(a => !started.some(b => b !== a && rateOf(b) === a));
  if (names.length === 2 && names.includes(letter) && !said.has(rateOf(letter))) names = names.filter(a => a !== letter);
  const n = names.length, alone = n === 1 && names[0] !== letter && !lines.has(letter) && letter;      /* p, v of one coordinate */
  if (!n) stop('there is no coordinate: give each its start, such as x(0) = 1');
  for (const a of names) {
    const b = !said.has(rateOf(a)) && names.find(b => b !== a && (otherRate(b) === a || a === letter || a === otherLetter));
    if (b && lines.has(whole)) stop(`${a}(0) is a ${a === letter ? 'start of which coordinate? Write' : kindOf + ', and ' + takes + ':'} ${rateOf(b)}(0)`, places.get(a + '(0)'));
  }
  if (n > 8) stop('there is room for 8 coordinates');
  if (points.length > 24) stop('there is room for 12 points to draw');
  if (rows.length > 4) stop('there is room for 4 constraints', places.get(rows[4]));
  if (!lines.has(whole)) stop('"L = ..." or "H = ..." is missing');
  if (both && !momenta && !leads('L', 'H')) stop('both L and H are given, and either makes the motion: leave one out', places.get('H'));
  if (momenta && kind) stop('kind says what L is, and here is H');
  if (momenta && rows.length) stop('a constraint needs L: with H there is none', places.get(rows[0]));

  /* Operations: the values are t, q, v, then one of each operation. A constant is { c } until one needs it. */
  const values = new Map([['t', 0], ['pi', { c: Math.PI }]]), steps = [], same = new Map(), quick = new Set(), made = [];
  for (const [i, name] of names.entries()) for (const [word, at] of [[name, 1 + i], [rateOf(name), 1 + n + i], ...alone ? [[alone, 1 + n]] : []]) {
    if (lines.has(word)) stop(`${word} is a coordinate or its ${momenta ? 'momentum' : 'velocity'}: take another name`, places.get(word));
    values.set(word, at);
    if (at > n) quick.add(at);
  }
  let timed = false;
  const step = (...key) => {
    const id = key.join(' ');
    if (!same.has(id)) {
      same.set(id, 2 * n + steps.push(key));
      if (key[0] && (quick.has(key[1]) || quick.has(key[2]))) quick.add(same.get(id));
    }
    return same.get(id);
  };
  const slot = a => a.c === undefined ? a : step(0, 0, 0, a.c);
  const call = (name, a) => a.c === undefined ? step(6 + Object.keys(MATHS).indexOf(name), a, 0, 0) : { c: MATHS[name](a.c) };
  /* What may be meant by a name that is not known */
  function unknown(name, place, called) {
    const typed = MARKED.exec(text.slice(place))[0], base = spelled(typed), known = [...lines.keys(), ...names.flatMap(a => [a, rateOf(a)]), 'pi', 't'].filter(a => !/\W/.test(a));
    const apart = RegExp(`^(${known.sort((a, b) => b.length - a.length).join('|')})+$`).test(base) && base.replace(RegExp(known.join('|'), 'g'), '$& ').trim();
    const other = names.find(a => otherRate(a) === name) || name === otherLetter && names[0];
    stop(other ? `${typed} is a ${kindOf}, and ${takes}: ${rateOf(other)}${momenta ? '' : ` or ${other}'`}`
      : name === letter ? `${name} is not known: of which coordinate? ${names.map(rateOf).join(', ')}`
      : name === 'e' ? 'e is not known: write exp(x) for e^x' : names.some(a => 'd' + a === name) ? `${typed} is not known: the derivative of x is x'`
      : apart ? `${typed} is not known; with spaces it is ${apart}`
      : called ? noFunction(name, place) : `${typed} is not known; a coordinate has a start, ${base}(0) = ..., anything else a line of its own`, place);
  }
  function valueOf(name, place, called) {
    timed ||= name === 't';
    if (!values.has(name)) {
      if (!lines.has(name) || name === 'end') unknown(name, place, called);
      values.set(name, null);
      const value = make(lines.get(name));
      if (value.c !== undefined && !isFinite(value.c)) stop(`${name} is no finite number`, places.get(name));
      values.set(name, value);
      made.push(name);
    }
    return values.get(name) ?? stop(`${name} depends on itself`, place);
  }
  function make([kind, left, right, place]) {
    if (kind === 'number') return { c: left };
    if (kind === 'name') return valueOf(left, place, right);
    const a = make(left);
    if (MATHS[kind]) return call(kind, a);
    if (MADE_OF[kind]) return make(MADE_OF[kind](left));
    const b = make(right), both = a.c !== undefined && b.c !== undefined;
    if (both) return { c: { '+': a.c + b.c, '-': a.c - b.c, '*': a.c * b.c, '/': a.c / b.c, '^': a.c ** b.c }[kind] };
    if (kind !== '^') return step(SIGNS.indexOf(kind), slot(a), slot(b), 0);
    return b.c === 2 ? step(3, a, a, 0) : b.c !== undefined ? step(5, a, 0, b.c) : call('exp', step(3, slot(call('log', a)), b, 0));
  }
  const constant = (name, otherwise) => {
    if (!lines.has(name)) return otherwise;
    const { c } = make(lines.get(name));
    return isFinite(c) ? c : stop(`${name} has to be a number: ${c === undefined ? 'it depends on what moves' : 'it is not finite'}`, places.get(name));
  };
  const result = a => a <= 2 * n ? step(3, a, slot({ c: 1 }), 0) : a, length = result(slot(valueOf(whole))) - 2 * n;
  if (momenta && !quick.has(length + 2 * n)) stop(`H depends on no momentum: that of ${names[0]} is ${rateOf(names[0])}`, places.get('H'));
  const used = made.slice(0, -1), forced = names.map(a => n > 1 || lines.has('F' + a) ? 'F' + a : 'F').map(a => lines.has(a) && !used.includes(a) && a);
  for (const a of forced) if (a && momenta) stop(`${a} is a force, and needs L: with H there is none`, places.get(a));
  const force = forced.map(a => a ? slot(valueOf(a)) : -1), at0 = rows.map(a => {
    const value = valueOf(a);
    if (value.c !== undefined || !value) stop('a constraint has to depend on a coordinate', places.get(a));
    return result(value);
  }), hasTime = timed;
  const rolls = rows.filter((a, i) => quick.has(at0[i])), holds = rows.filter(a => !rolls.includes(a)), places0 = list => list.map(a => at0[rows.indexOf(a)]);
  if (lines.has('F') && !values.has('F')) stop(`F acts on no coordinate: a force on ${names[0]} is F${names[0]} = ...`, places.get('F'));
  const q = names.map(a => constant(a + '(0)', 0)), v = names.map(a => constant(rateOf(a) + '(0)', alone ? constant(alone + '(0)', 0) : 0)), end = constant('end', 10);
  if (!(end > 0)) stop('end has to be above 0', places.get('end'));
  for (const name of lines.keys()) if (!/\)$|^end$/.test(name)) valueOf(name);
  if (!points.length) for (let i = 0; i < n - (n > 1); i += 2) {
    points.push(['name', names[i]], n > 1 ? ['name', names[i + 1]] : momenta ? ['name', rateOf(names[0])] : N(0));
    rods.push([i / 2, 1, 1]);
  }
  const draw = points.map(p => slot(make(p)));
  if (!momenta && draw.some(p => quick.has(p))) stop('a picture is of t and coordinates, not of velocities', places.get('draw'));
  if (steps.length > 600) stop('there is room for 600 operations');

  /* C */
  const own = a => /^(t|q|v|p|at|row|user|number|complex|[A-Z_]{3,}|unix|linux|auto|break|case|char|const|continue|default|do|double|else|enum|extern|float|for|goto|if|inline|int|long|register|restrict|return|short|signed|sizeof|static|struct|switch|typedef|union|unsigned|void|volatile|while|asm|typeof)$/.test(a) ? a + '_' : a;
  const bare = ([kind, left, right]) => kind === 'number' || kind !== 'name' && bare(left) && (!right || bare(right));
  const met = new Set();
  /* level: 1 of a sum, 2 of a product, 3 of what binds more; whole numbers among themselves would divide as such */
  function C([kind, left, right], level, real = true) {
    const within = (inner, text) => level > inner ? `(${text})` : text;
    if (kind === 'number') return left + (real && Number.isInteger(left) && left < 1e21 ? '.0' : '');
    if (kind === 'name') return left === 'pi' ? String(Math.PI) : left === 't' ? left : (met.add(left), own(left));
    if (MATHS[kind] || MADE_OF[kind]) return `${kind}(${C(left, 0)})`;
    const a = l => C(left, l, bare(right)), b = l => C(right, l, bare(left));
    if (kind === '^') return left[0] === 'name' && right[1] === 2 ? within(2, a(3) + '*' + a(3)) : `pow(${a(0)}, ${b(0)})`;
    if (kind === '-' && left[0] === 'number' && !left[1]) return within(1, '-' + C(right, 2));
    return /[+-]/.test(kind) ? within(1, `${a(1)} ${kind} ${b(2)}`) : within(2, a(2) + kind + b(3));
  }
  const fold = line => line.replace(/(.{45,68}?) ([+-]) /g, '$1\n            $2 ');
  /* what `ends` need, in order: lines, and q and v from `at` */
  const body = (ends, of, type, at) => {
    met.clear();
    const rows = ends.map(([head, name]) => head + C(lines.get(name), 0));
    for (const name of of.reverse()) if (met.has(name)) {
      const { c } = values.get(name);
      rows.unshift(c === undefined ? `const ${type} ${own(name)} = ${C(lines.get(name), 0)}` : `const double ${own(name)} = ${c}`);
    }
    const inputs = names.flatMap((a, i) => [[a, `${at}q[${i}]`], ...[rateOf(a), alone].map(b => [b, `${at}${letter}[${i}]`])]).filter(([a]) => met.has(a)).map(([a, b]) => `${own(a)} = ${b}`);
    if (at && rows.some(row => /\bt\b/.test(row))) inputs.push('t = *at->t');
    if (inputs.length) rows.unshift(`const ${type} ` + inputs.join(', '));
    return rows.map(l => `    ${fold(l)};\n`).join('');
  };
  let c = `${momenta ? 'HAMILTONIAN' : 'LAGRANGIAN'}(own, ${n})\n{\n${body([['return ', whole]], used, 'number', '')}}`;
  const acting = forced.flatMap((a, i) => a ? [[`at->f[${i}] += `, a]] : []);
  if (acting.length) c += `\n\nGVI_POINTS(force, ${n}, v, f)(const gvi_points *at, void *user)\n{\n${body(acting, [...made], 'double', 'at->')}    return (void)user, 0;\n}`;
  for (const [name, list] of [['HOLDS(holds', holds], ['ROLLS(rolls', rolls]])
    if (list.length) c += `\n\n${name}, ${n}, ${list.length})\n{\n${body(list.map((a, i) => [`row[${i}] = `, a]), [...made], 'number', '')}}`;
  return { names, q, v, momenta, kind, n, steps, length, draw, rods, force: acting.length ? force : [], holds: places0(holds), rolls: places0(rolls), end, timed: hasTime, c };
}
