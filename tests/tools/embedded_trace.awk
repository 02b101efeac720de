# embedded_trace.awk LIST COUNTS TRACE: instructions and cycles of one step, from qemu's trace of single
# instructions (-singlestep -d exec,nochain), with the disassembly LIST beside it and what SysTick counted in
# COUNTS; fails if the two differ.  A step is what runs from the first instruction of by_gvi or by_hand_step
# to its return.  Cycles: Arm, Cortex-M4 technical reference manual (100166), tables of instructions, without
# wait states.  The lower figure refills the pipeline in one cycle after a branch and overlaps loads and
# stores with what follows, the upper one takes three cycles and two.  Functions are those left by inlining.

function registers(list,   n, i, parts, ends) {
    gsub(/[{} ]/, "", list)
    n = split(list, parts, ",")
    for (i = n; i > 0; --i) if (split(parts[i], ends, "-") == 2) n += substr(ends[2], 2) - substr(ends[1], 2)
    return n
}

function price(at, op, rest,   n) {
    low[at] = high[at] = 1
    if (op ~ /^(vdiv|vsqrt)/) low[at] = high[at] = 14
    else if (op ~ /^(vmla|vmls|vnmla|vnmls|vfma|vfms|vfnma|vfnms)/) low[at] = high[at] = 3
    else if (op ~ /^(push|pop|ldm|stm|vldm|vstm|vpush|vpop)/)
        low[at] = high[at] = 1 + registers(substr(rest, index(rest, "{")))*(rest ~ /{d/ ? 2 : 1)
    else if (op ~ /^(vldr|vstr)/) low[at] = high[at] = rest ~ /^d/ ? 3 : 2
    else if (op ~ /^(ldrd|strd)/) low[at] = high[at] = 3
    else if (op ~ /^(ldr|str)/) high[at] = 2
    else if (op ~ /^(sdiv|udiv)/) { low[at] = 2; high[at] = 12 }
}

function end_of_step(   f) {
    if (++steps <= 3) return
    all += n
    lower += step_low
    upper += step_high
    if (n > worst) worst = n
    for (f in mine) by[f] += mine[f]
}

FILENAME == ARGV[1] && /^ *[0-9a-f]+:\t/ {
    split($0, part, "\t")
    at = part[1]
    gsub(/[ :]/, "", at)
    at = substr("00000000" at, length(at) + 1)
    if (before != "") next_of[before] = at
    before = at
    price(at, part[3], part[4])
    next
}
FILENAME == ARGV[2] && $1 == "row" { scene = $2; setting = $3; most = $6 }
FILENAME != ARGV[3] || !/^Trace/ { next }

{
    split($0, part, "/")
    at = part[2]
    if (inside && at != next_of[was]) { step_low += 1; step_high += 3 }
    if (inside && at == back) { inside = 0; end_of_step() }
    if (!inside && ($NF == "by_gvi" || $NF == "by_hand_step")) {
        inside = 1
        back = next_of[was]
        n = step_low = step_high = 0
        for (f in mine) delete mine[f]
    }
    if (inside) {
        ++n
        ++mine[$NF]
        step_low += low[at]
        step_high += high[at]
    }
    was = at
}

END {
    steps -= 3
    if (steps < 1) { print "no steps in the trace"; exit 1 }
    printf "scene %d, setting %d: %.0f instructions a step, %d at most; ", scene, setting, all/steps, worst
    printf "%.0f to %.0f cycles, %.2f to %.2f each\n", lower/steps, upper/steps, lower/all, upper/all
    for (k = 0; k < 8; ++k) {
        top = ""
        for (f in by) if (top == "" || by[f] > by[top]) top = f
        if (top == "") break
        printf "    %-28s %5.1f %%\n", top, 100*by[top]/all
        delete by[top]
    }
    if (worst - most > 8 || most - worst > 8) { print "SysTick counted " most " at most"; exit 1 }
}
