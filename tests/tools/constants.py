#!/usr/bin/env python3
"""constants.py [--all | --numbers]: numbers of judgement in the chapters of gvi.h (PART II) that have no name, by line, and how
many there are.  Left out: 0, 1, 2 and a half; indices; what says how long an array, a lane, a table of modes or an int is; and
factors of formulas, which FORMULAS lists with what they are from.  --all: those of formulas as well.  --numbers: LINE:NUMBER
of each, for tolerances.sh, which halves and doubles it."""
import re, sys

FORMULAS = [   # a text in the line; what its numbers are
    (r"4\*dial->top|8\*s \+ 4|2\*\(i/n\) \+ 3|2\*\(j/n\) \+ 3", "norms of Legendre polynomials"),
    (r"power \*= 4", "Romberg's scheme: halves of a difference of even order"),
    (r"/3;", "the mode of a parabola"),
    (r"power \*= \(gvi_real\)2\.56", "Richardson's scheme: (8/5)^2, differences of even order"),
    (r"distance < within/4", "what a line misses, twice as far"),
    (r"4\*e\) \+ 8\*mantissa|k/4\) - 1|4\*octave", "four rungs an octave"),
    (r"DIG > 24", "where two steps are kept: gvi__layout"),
    (r"0\.7390851", "any time"),
    (r"GVI__MAX/4", "GVI__MAX and it have a sum"),
    (r"3\*16\*60", "LU against steps of 60 iterations: gvi__newton_follows"),
    (r"most = 4\*entry", "twice as large, squared"),
    (r"GVI__MANY\*3/2", "by velocities h in place of h^2"),
    (r"pieces\*3/2", "to 3 h/2"),
    (r"top [<>]=? |top == |st->s == 3|s < 3|st->s < 3|degree = |k < 6|k < 5|l < 3", "how many modes or terms there are"),
]
STRUCTURE = r"gvi__take|GVI__UNROLL|GVI__LOOP|GVI__LANES|0x7FFF|0x4001|R == 8|R % 8|i \+ 8|i \+= 8|a \+= 6|6\*j|m < 6|k == 11|3\*nn|7\*m|j < 6|5\*n|^#|^enum|^GVI__KERNEL"


def main(every, bare):
    text = open("gvi.h").read()
    start, end = text.index("PART II: CHAPTERS\n"), text.index("#endif /* GVI_IMPLEMENTATION */")
    code = re.sub(r"/\*.*?\*/", lambda m: re.sub(r"[^\n]", " ", m.group()), "/* " + text[start:end], flags=re.S)
    code = re.sub(r'//[^\n]*|"(\\.|[^"\\\n])*"', "", code)
    count = 0
    for number, line in enumerate(code.split("\n"), text[:start].count("\n") + 1):
        if re.search(STRUCTURE, line.strip()):
            continue
        numbers = re.findall(r"(?<![\w.\[])(?:\d+\.\d+|\d+)(?![\w.\]])", re.sub(r"\[[^\]]*\]", "", line))
        numbers = [n for n in numbers if n not in ("0", "1", "2", "0.5")]
        why = next((what for pattern, what in FORMULAS if re.search(pattern, line)), "")
        if numbers and (every or not why):
            count += len(numbers)
            if bare:
                print("\n".join("%d:%s" % (number, n) for n in numbers))
                continue
            print("%6d  %-12s %s%s" % (number, " ".join(numbers), line.strip(), "   <- " + why if why else ""))
    if not bare:
        print("constants: %d without a name" % count)


main("--all" in sys.argv, "--numbers" in sys.argv)
