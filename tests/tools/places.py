#!/usr/bin/env python3
"""places.py [gvi.h] >places.svg: which chapter of gvi.h plugs in at which place, read off the declarations in
PLACES and the functions of the SWITCHBOARD.  A dot: that chapter acts at this place; below, at how many."""
import re, sys

text = open(sys.argv[1] if len(sys.argv) > 1 else "gvi.h").read()
head = text.index("- PLACES\n")
places = text[head:text.index("- SCENE */", head)]
board = text[text.index("- SWITCHBOARD\n"):]

# groups: the comments in front of the declarations, up to the first stop
groups, names = [], []
for m in re.finditer(r"/\*(.*?)\*/|\b(gvi__place_\w+)\(", places, re.S):
    if m.group(1):
        comment = " ".join(m.group(1).split())
    elif m.group(2) not in names:
        if not groups or groups[-1][1] != comment:
            groups.append([None, comment, []])
        names.append(m.group(2))
        groups[-1][2].append(m.group(2))
titles = ["set-up", "start", "mass", "solve", "fixed point", "steps", "end of a step", "curve"]
chapters = [("LAGRANGIAN", r"LAGRANGIAN|adds_p"), ("MOMENTA", r"MASS\(|MOMENTA|momenta_"), ("CLOCK", r"CLOCK"),
            ("KICKS", r"KICKS|kicks"), ("NEWTON", r"NEWTON|in(->|\.)newton|gvi__newton"), ("CONSTRAINTS", r"CONSTRAINT|constraint|held_rows"),
            ("ROLLING", r"ROLLING|rolling|NONHOLONOMIC"), ("RULES", r"RULES\(|_RULES|own_rule|GVI_OWN"), ("DIAL", r"DIAL|dial")]

def body(name):
    m = re.search(r"^[^\n;]*\b%s\([^;{]*\)\n\{\n(.*?)^\}" % name, board, re.M | re.S)
    return m.group(1) if m else ""

chapters = [c for c in chapters if any(re.search(c[1], body(n)) for n in names)]
rows = [(group, name) for group in groups for name in group[2]]
left, top, width, line = 190, 92, 62, 17
wide, high = left + width*len(chapters) + 20, top + line*len(rows) + 10*len(groups) + 34
print('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" font-family="sans-serif" font-size="12">' % (wide, high))
print('<rect width="%d" height="%d" fill="#fff"/>' % (wide, high))
for k, (name, _) in enumerate(chapters):
    x = left + width*k + width/2
    print('<text transform="translate(%g %d) rotate(-50)">%s</text>' % (x - 4, top - 8, name.capitalize()))
y, last = top, None
for group, name in rows:
    if group is not last:
        y += 10
        title = titles[groups.index(group)] if groups.index(group) < len(titles) else ""
        print('<text x="8" y="%g" font-weight="bold">%s</text>' % (y + 12, title))
        print('<path d="M8 %g H%d" stroke="#bbb"/>' % (y - 3, wide - 8))
        last = group
    print('<text x="%d" y="%g" text-anchor="end" fill="#333">%s</text>' % (left - 10, y + 12, name[len("gvi__place_"):]))
    for k, (_, words) in enumerate(chapters):
        if re.search(words, body(name)):
            print('<circle cx="%g" cy="%g" r="4.5" fill="#2166ac"/>' % (left + width*k + width/2, y + 8))
    y += line
print('<text x="%d" y="%g" text-anchor="end" font-weight="bold">of %d places</text>' % (left - 10, y + 17, len(rows)))
for k, (_, words) in enumerate(chapters):
    count = sum(bool(re.search(words, body(name))) for _, name in rows)
    print('<text x="%g" y="%g" text-anchor="middle">%d</text>' % (left + width*k + width/2, y + 17, count))
print("</svg>")
