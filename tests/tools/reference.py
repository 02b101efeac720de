#!/usr/bin/env python3
"""reference.py [gvi.h] >docs/reference.md: one heading for each public function, type, macro and status of gvi.h,
with its comment.  --names: those names, one a line."""
import re, sys

arguments = [a for a in sys.argv[1:] if a != "--names"]
text = open(arguments[0] if arguments else "gvi.h").read()
version = re.search(r'#define GVI_VERSION "(.*)"', text).group(1)
opening = text[:text.index("/* Macros that programs")]
public = text[text.index("#define GVI_VERSION"):text.index("#endif /* GVI_H */")]


def flush(lines):
    """Without the indentation that all lines after the first share."""
    depth = min((len(l) - len(l.lstrip()) for l in lines if l.strip()), default=0)
    return [l[depth:].rstrip() for l in lines]


def options():
    """The macros of OPTIONS: a name and what is said of it; (title, text)."""
    found = []
    part = opening[opening.index("\n   OPTIONS"):opening.index("/* ------", opening.index("\n   OPTIONS"))]
    for line in part.split("\n")[1:]:
        for m in re.finditer(r"(GVI_[A-Z_]+(?:\([^)]*\))?(?: GVI_[A-Z_]+\([^)]*\))*)(?: +\[([^\]]*)\])?  +((?:(?! {2,}GVI_).)*)", line):
            if not line.startswith("     GVI_"):
                break
            found.append([m.group(1), (m.group(3).strip() + (" (%s)" % m.group(2) if m.group(2) else "")).strip()])
        if line.startswith("     GVI_SQRT"):
            found.append([line.strip(), ""])
        elif found and line.startswith(" "*20):
            found[-1][1] += " " + line.strip()
    for title, said in found:
        where = re.search(r" \((all together|one file|that file|everywhere)\)", said)
        yield title, (said.replace(where.group(0), "") + "; defined in " + {"one file": "one source file", "that file": "the same file",
               "everywhere": "every file"}[where.group(1)] if where else said)


class Entry:
    def __init__(self, name, code, comment):
        self.name, self.code, self.comment, self.shared = name, code, comment, None


types, functions, macros, statuses = [], [], [], []
comment, group = [], None
lines = public.split("\n")
k = 0
while k < len(lines):
    line = lines[k]
    if line.startswith("/* -----") or line.startswith("/* ----"):
        comment = []
    elif line.startswith("/*"):
        block = [line[2:]]
        while "*/" not in lines[k]:
            k += 1
            block.append(lines[k])
        block[-1] = block[-1][:block[-1].rindex("*/")]
        comment = flush(["   " + block[0].strip()] + block[1:])
    elif re.match(r"typedef (enum|struct) gvi_[a-z]\w* \{", line):
        block = [line]
        while not lines[k].startswith("}"):
            k += 1
            block.append(lines[k])
        types.append(Entry(block[0].split()[2], block, comment))
        comment = []
    elif re.match(r"(typedef [^;{]*|GVI_DEF )", line) and not re.search(r"gvi__", line):
        block = [line]
        while ";" not in lines[k]:
            k += 1
            block.append(lines[k])
        name = re.search(r"\b(gvi_\w+)(\(|;)", " ".join(block)).group(1)
        (functions if line.startswith("GVI_DEF") else types).append(
            Entry(name, [b.replace("GVI_DEF ", "", 1) if i == 0 else b[8:] if line.startswith("GVI_DEF") else b
                         for i, b in enumerate(block)], comment))
        if types and types[-1].comment is comment:
            comment = []
    elif re.match(r"#define GVI_(?!_|NO_|DEF|REAL|EFFECTS|UNROLL|VERSION)[A-Z_]+", line):
        name = re.match(r"#define (GVI_\w+)", line).group(1)
        if name not in [m.name for m in macros]:
            head = re.match(r"#define (GVI_\w+(?:\([^)]*\))?)(.*)", line)
            note = re.search(r"/\* (.*?)\s*\*/", line)
            macros.append(Entry(name, [head.group(1)], [note.group(1)] if note else comment))
            comment = []
    k += 1

# a status: its number, and all that is said of it up to the next
status = next(t for t in types if t.name == "gvi_status")
for line in status.code:
    m = re.match(r"\s+(GVI_\w+)\s*=\s*(-?\d+),?\s*(?:/\*(.*))?", line)
    if m:
        statuses.append(Entry(m.group(1), [m.group(2)], [(m.group(3) or "").replace("*/", "").strip()]))
    elif statuses and not line.startswith(("typedef", "}")):
        statuses[-1].comment[0] += " " + line.replace("*/", "").strip()

# one comment for several functions: an item for each, or all of it at the first
for i, f in enumerate(functions):
    first = next(g for g in functions if g.comment is f.comment)
    f.lead = first
    items, current = {}, None
    for line in f.comment:
        m = re.match(r"  (gvi_\w+)  +(.*)", line)
        if m:
            current = m.group(1)
            items[current] = [m.group(2)]
        elif current and line.startswith("     "):
            items[current].append(line.strip())
        elif line.strip():
            current = None
    f.items = items


def sentence(words):
    """With a capital, unless it begins with a symbol, and a full stop."""
    capital = re.match(r"(?!sizeof)([a-z]{2,}|a)[ ,:]", words)
    return (words[:1].upper() if capital else words[:1]) + words[1:].rstrip(".") + "."


def escaped(line):
    return re.sub(r"([*<])", r"\\\1", line.replace("&", "&amp;"))


def linked(line, own):
    seen = set(own)
    def one(m):
        name = m.group(0)
        if name in seen or name not in links:
            return name
        seen.add(name)
        return "[%s](#%s)" % (name, links[name])
    return re.sub(r"\b(gvi|GVI)_\w+", one, line)


def prose(comment, own):
    """Lines that are indented are code, the rest is text."""
    out, code = [], False
    for line in comment:
        deep = line.startswith("  ") or (code and not line)
        if deep != code:
            if code:
                while out[-1] == "":
                    out.pop()
                out.append("```")
            out += ["", "```c"] if deep else [""]
            code = deep
        out.append(line[2:] if deep else line)
    if code:
        out.append("```")
    body, inside, paragraph = [], False, []
    for line in out:
        if line.startswith("```"):
            inside = not inside
        if line.startswith("```") or inside or not line:
            if paragraph:
                body.append(linked(escaped(" ".join(paragraph)), own))
                paragraph = []
            body.append(line)
        else:
            paragraph.append(line.strip())
    if paragraph:
        body.append(linked(escaped(" ".join(paragraph)), own))
    return re.sub(r"\n{3,}", "\n\n", "\n".join(body)).strip("\n")


option = list(options())
by_option = [re.match(r"GVI_\w+", o[0]).group(0) for o in option]
unroll = Entry("GVI_UNROLL", ["GVI_UNROLL for (int i = 0; i < 6; ++i) ..."], ["In front of a loop of constant length in a "
               "GVI_EACH or GVI_POINTS, which is then unrolled."])
macros = [m for m in macros if m.name not in by_option or m.name == "GVI_SQRT"] + [unroll]
by_option = [n for n in by_option if n not in [m.name for m in macros]]
if "--names" in sys.argv:
    print("\n".join([e.name for e in functions + types + statuses + macros] + by_option))
    sys.exit()

links, count = {}, {}
for name in (["Functions"] + [f.name for f in functions] + ["Statuses"] + [e.name for e in statuses]
             + ["Types"] + [t.name for t in types] + ["Macros"] + [m.name for m in macros] + ["Options"] + by_option):
    anchor = name.lower()
    links[name] = anchor + ("-%d" % count[anchor] if anchor in count else "")
    count[anchor] = count.get(anchor, 0) + 1

put = print
put("# Reference\n")
put("`gvi.h` %s: every public function, status, type and macro, with the header's own comment. `make reference` writes this page "
    "from `gvi.h`; do not edit it. The same on one page: [sheet.md](sheet.md). Numbers in brackets, as [7, ch. 9], are the header's references.\n" % version)
for title, entries in (("Functions", functions), ("Statuses", statuses), ("Types", types), ("Macros", macros)):
    put("**[%s](#%s)**: %s\n" % (title, links[title], " · ".join("[%s](#%s)" % (e.name, links[e.name]) for e in entries)))
put("**[Options](#options)**: %s\n" % " · ".join("[%s](#%s)" % (n, links[n]) for n in by_option))

put("## Functions\n")
for f in functions:
    put("### %s\n\n```c\n%s\n```\n" % (f.name, "\n".join(f.code)))
    if f.name in f.items:
        put(sentence(linked(escaped(" ".join(f.items[f.name])), [f.name])) + "\n")
        common = [line for line in f.comment if not line.startswith("  ")]
        names = list(f.items)
        common = [re.sub("^These (start|ask|interpolate)", r"%s and %s \1" % (", ".join(names[:-1]), names[-1]), line) for line in common]
        if f.lead is f:
            put(prose(common, [f.name]) + "\n")
        elif len(" ".join(common).split()) > 8:
            put("The rest is said with [%s](#%s).\n" % (f.lead.name, links[f.lead.name]))
    elif f.lead is f:
        put(prose(f.comment, [f.name]) + "\n")
    else:
        put("Described with [%s](#%s).\n" % (f.lead.name, links[f.lead.name]))

put("## Statuses\n\n0 or negative. [gvi_why](#gvi_why) says in a sentence what happened and what to do. After a failure the state is as before.\n")
for s in statuses:
    put("### %s\n\n(%s) %s\n" % (s.name, s.code[0], sentence(prose([s.comment[0] or "success"], [s.name]))))

put("## Types\n")
for t in types:
    put("### %s\n" % t.name)
    if t.comment:
        put(prose(t.comment, [t.name]) + "\n")
    if t.name == "gvi_status":
        put("An enumeration of the [statuses](#statuses).\n")
    else:
        put("```c\n%s\n```\n" % "\n".join(l for l in t.code if "gvi__private" not in l))

put("## Macros\n")
for m in macros:
    put("### %s\n\n```c\n%s\n```\n" % (m.name, m.code[0]))
    if m.name == "GVI_EACH":
        put("Described with [GVI_POINTS](#%s).\n" % links["GVI_POINTS"])
    elif m.comment:
        put(sentence(prose(m.comment, [m.name])) + "\n")

put("## Options\n\nMacros that are defined before `gvi.h` is included.\n")
for title, said in option:
    name = re.match(r"GVI_\w+", title).group(0)
    if name in by_option:
        said = "leaves out " + said if name.startswith("GVI_NO_") else said
        put("### %s\n\n%s\n" % (name, sentence(linked(escaped(said), [name]))))

put("## Conventions\n")
part = opening[opening.index("\n   CONVENTIONS\n") + 16:opening.index("   gvi.h does not:")]
for block in re.findall(r"^     (\w+|\w+ )  +(.*(?:\n {10,}.*)*)", part, re.M) or re.findall(r"^   (\w+) +(.*(?:\n {10,}.*)*)", part, re.M):
    put("- **%s**: %s" % (block[0].strip(), linked(escaped(" ".join(block[1].split())), [])))
