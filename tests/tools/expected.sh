#!/bin/sh
# expected.sh FILE: the output that the opening comment of FILE shows: what stands
# five columns in, between a line "   prints" (or "   prints, ...") and the end of the comment.
awk '/\*\// { exit }
     shown  { sub(/^     /, ""); lines[++n] = $0; if ($0 != "") last = n }
     /^   prints(,.*)?$/ { shown = 1 }
     END { for (i = 1; i <= last; ++i) if (i > 1 || lines[i] != "") print lines[i] }' "$1"
