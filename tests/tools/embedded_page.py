#!/usr/bin/env python3
"""embedded_page.py FOLDER [--record]: the tables of docs/embedded.md against FOLDER/{boards, firmware, size, chapters,
cost}.txt, which the commands of these names have printed.  Prints each row that differs, and ends with 1 if any does;
with --record it puts the new row into the page.  Figures in sentences are printed at the end, to be read."""
import re
import sys

PAGE = 'docs/embedded.md'
folder, record = sys.argv[1], '--record' in sys.argv
page = open(PAGE).read().split('\n')
printed = {name: open(f'{folder}/{name}.txt').read().split('\n')
           for name in ('boards', 'firmware', 'size', 'chapters', 'cost')}
differs, missing, read = 0, [], []


def commas(x):
    return re.sub(r'\d+', lambda m: f'{int(m[0]):,}', x)


def cells(line):
    return [x.strip() for x in line.strip().strip('|').split('|')]


def put(label, new, under=''):
    """the first row with these first cells below the line that begins with `under` gets the cells `new`"""
    global differs
    start = next((i for i, x in enumerate(page) if x.startswith(under)), None)
    for i in range(start or 0, len(page)):
        if page[i].startswith('|') and cells(page[i])[:len(label)] == label:
            row = ('| ' + ' | '.join(label + new) + ' |').replace('|  |', '| |', 1 if label[0] == '' else 0)
            if row != page[i]:
                differs += 1
                print('-', page[i] + '\n+', row)
            page[i] = row
            return
    missing.append(' | '.join(label))


def span(values):
    low, high = min(values), max(values)
    return commas(str(low)) if low == high else f'{low:,} to {high:,}'


def boards():
    rows = [cells(x) for x in printed['boards'] if x.startswith('|')][1:]
    for board in dict.fromkeys(r[0] for r in rows):
        for name, of in (('explicit', ['explicit']), ('positions, velocities, momenta', ['positions', 'velocities', 'momenta'])):
            mine = [r for r in rows if r[0] == board and r[1] in of]
            if not any(x.startswith(f'| {board} | explicit') for x in page):
                continue
            figures = [span([int(r[k]) for r in mine]) for k in (2, 3, 4, 5)]
            label = [board if name == 'explicit' else '', name]
            put(label, figures + [mine[0][6].replace('with the macros', 'chosen')], f'| {board} | explicit')


def firmware():
    for line in printed['firmware']:
        m = re.match(r' *(\w+)-libm-m4f +(\d+) +(\d+) +(\d+)', line)
        if m:
            put([f'`{m[1]}.c`'], [commas(x) for x in m.groups()[1:]], '| bytes, Cortex-M4F in float')


def size():
    names = {'step, all chapters': 'all chapters', 'explicit': '`GVI_CORE`, `GVI_ONLY_EXPLICIT`', 'core': '`GVI_CORE`',
             'core, momenta': 'core and momenta', 'core, clock': 'core, momenta and clock',
             'core, newton': "core and Newton's method", 'core, constraints': 'core and constraints'}
    board = ''
    for line in printed['size']:
        if re.match(r'(Cortex|RISC|AVR|RAM)', line):
            board = line.split(',')[0]
        m = re.match(r' +(.+?) {2,}(\d+) +(\d+) +(\d+) +(\d+) +(\d+)', line)
        if board == 'Cortex-M4F' and m and m[1] in names:
            put([names[m[1]]], [commas(x) for x in m.groups()[1:]], '| Cortex-M4F, float, `-Os`: init')
        m = re.match(r' +(.+?) +(\d+) \( *\d+\)', line)
        if board == 'RAM' and m and any(x.startswith(f'| {m[1].replace(": ", ", ")} |') for x in page):
            put([m[1].replace(': ', ', ')], [commas(m[2])], '| | `gvi_size`')


def chapters():
    for row in (cells(x) for x in printed['chapters'] if x.startswith('|')):
        if row[0].startswith('`GVI_NO'):
            put([row[0]], [commas(x) for x in row[1:3]], '| chapter |')
        elif row[0] in ('everything', 'core'):
            read.append(f'{row[0]}: {commas(row[1])}')


def cost():
    """sections of cost-embedded by type; of the last table those rows that the page has"""
    parts, kind, part = {}, '', ''
    for line in printed['cost']:
        m = re.match(r'Cortex-M\w+, (float|double)', line)
        kind = m[1] if m else kind
        if re.match(r'[a-z]+ (of|with) ', line) or line.startswith('| steps') or line.startswith('| scene'):
            part = cells(line)[0].split(';')[0]
        if line.startswith('|'):
            parts.setdefault((kind, part), []).append(cells(line))
    start = next(i for i, x in enumerate(page) if x.startswith('| scene, type'))
    for line in page[start + 2:]:
        if not line.startswith('| '):
            break
        row = cells(line)
        scene, kind = row[0].split(', ')
        found = [r for r in parts[kind, 'scene'] if r[:2] == [scene, row[1]]]
        if len(found) != 1:
            missing.append(' | '.join(row[:2]))
            continue
        new = found[0][1:]
        new[1:3] = new[1].replace(' by hand', ''), new[2].replace('v given', '`mass.velocity`')
        put(row[:2], new[1:], line[:40])


boards(), firmware(), size(), chapters(), cost()
for name in missing:
    print('no such row:', name)
print('\n'.join(read))
print('\n'.join(x for x in printed['firmware'] + printed['size'] if re.match(r' +(arm-own|m4f: stepper)', x)))
if record:
    open(PAGE, 'w').write('\n'.join(page))
print(f'embedded-page: {differs} rows differ{", recorded" if record else ""}, {len(missing)} not found')
sys.exit(bool(missing or differs and not record))
