# stack.awk: awk -v roots="f g" -f stack.awk CALLS
# CALLS has lines "frame FUNCTION BYTES", "call FUNCTION FUNCTION" and "jump FUNCTION FUNCTION", a
# call that comes last, when the frame is gone; a function without a frame is a library's, and
# __indirect_call a callback.  Prints the deepest stack of the roots, the deepest from which a
# callback and a library function are called (their own stack comes on top of it), and the
# deepest chain with its frames, 0 where the frame is gone.
$1 == "frame" { if ($3 + 0 >= frame[$2] + 0) frame[$2] = $3 + 0 }
($1 == "call" || $1 == "jump") && !(($1, $2, $3) in seen) {
    seen[$1, $2, $3] = 1
    callees[$2] = callees[$2] " " $3
    held[$2] = held[$2] " " ($1 == "call")
}

function most(a, b) { return a > b ? a : b }

function walk(f,    list, held_by, n, i, g, base) {
    if (f in done) return
    if (f in open) { print "recursion through " f > "/dev/stderr"; exit 1 }
    open[f] = 1
    own[f] = frame[f]
    callback[f] = library[f] = 0
    n = split(callees[f], list, " ")
    split(held[f], held_by, " ")
    for (i = 1; i <= n; ++i) {
        g = list[i]
        base = held_by[i]*frame[f]
        if (g == "__indirect_call") callback[f] = most(callback[f], base)
        else if (!(g in frame)) library[f] = most(library[f], base)
        else {
            walk(g)
            if (base + own[g] > own[f]) { own[f] = base + own[g]; below[f] = base; next_in[f] = g }
            if (callback[g]) callback[f] = most(callback[f], base + callback[g])
            if (library[g]) library[f] = most(library[f], base + library[g])
        }
    }
    done[f] = 1
}

END {
    n = split(roots, root, " ")
    for (i = 1; i <= n; ++i) {
        f = root[i]
        if (!(f in frame)) { print "no function " f > "/dev/stderr"; exit 1 }
        walk(f)
        if (own[f] > deepest) { deepest = own[f]; first = f }
        from_callback = most(from_callback, callback[f])
        from_library = most(from_library, library[f])
    }
    for (f = first; f != ""; f = next_in[f]) chain = chain " " f " " (f in next_in ? below[f] : frame[f])
    print deepest, from_callback + 0, from_library + 0 chain
}
