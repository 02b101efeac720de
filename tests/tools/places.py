#!/usr/bin/env python3
"""places.py [gvi.h] >places.svg: which chapter of gvi.h plugs in at which place, read off the declarations behind
the comments "PLACES of ..." and the functions that define them.  A dot: that chapter acts at this place; below, at
how many."""
import re, sys

text = open(sys.argv[1] if len(sys.argv) > 1 else "gvi.h").read()

# groups: a title, and the names declared from its comment to the next blank line
groups = []
for m in re.finditer(r"/\* PLACES of (the |a )?([^:,]*)[:,].*?\*/\n(.*?)\n\n", text, re.S):
    names = re.findall(r"\b(gvi__place_\w+)\(", m.group(3))
    groups.append((m.group(2), list(dict.fromkeys(names))))
names = [name for _, group in groups for name in group]

chapters = [("LAGRANGIAN", r"LAGRANGIAN|adds_p"), ("MOMENTA", r"MASS\(|MOMENTA|momenta_"), ("CLOCK", r"CLOCK"),
            ("KICKS", r"KICKS|kicks"), ("NEWTON", r"NEWTON|in(->|\.)newton|gvi__newton"), ("CONSTRAINTS", r"CONSTRAINT|constraint|held_rows"),
            ("ROLLING", r"ROLLING|rolling|NONHOLONOMIC"), ("RULES", r"RULES\(|_RULES|own_rule|GVI_OWN"), ("DIAL", r"DIAL|dial")]

# a definition in the switchboard; or of a chapter, which is then all that acts: the "#ifndef GVI_NO_..." around it
def body(name):
    m = re.search(r"^[^\n;]*\b%s\([^;{]*\)\n\{\n(.*?)^\}" % name, text, re.M | re.S)
    if not m or m.start() > text.index("- SWITCHBOARD\n"):
        return m.group(1) if m else ""
    opened = []
    for line in text[:m.start()].splitlines():
        if line.startswith("#if"): opened.append(line)
        if line.startswith("#endif"): opened.pop()
    return next((line for line in reversed(opened) if line.startswith("#ifndef GVI_NO_")), "")

chapters = [c for c in chapters if any(re.search(c[1], body(n)) for n in names)]
rows = [(group, name) for group in groups for name in group[1]]
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
        print('<text x="8" y="%g" font-weight="bold">%s</text>' % (y + 12, group[0]))
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
