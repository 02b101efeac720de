# firmware.awk: awk -v eps=EPS -f firmware.awk TARGET HOST FLOAT DOUBLE
# Compares two printed trajectories of one type, column by column.  What rounding makes
# of a run is how far the host's float is from its double, in units of float's eps: the
# sine's last bit and every rounding since, carried along.  Both runs are as far from the
# exact one, so they may differ by twice that, and by a unit in the last place of the
# largest number, since what is printed is rounded.  Numbers come from their bits.
function digit(c) { return index("0123456789abcdef", c) - 1 }
function hex(text,    i, x) {
    for (i = 1; i <= length(text); ++i) x = 16*x + digit(substr(text, i, 1))
    return x
}
# sign, exponent of `bits` bits, mantissa
function number(text,    wide, head, sign, exponent, bias, m, size) {
    wide = length(text) == 16
    head = hex(substr(text, 1, wide ? 3 : 8))
    bias = wide ? 1023 : 127
    size = wide ? 2^52 : 2^23
    if (wide) { m = hex(substr(text, 4)); exponent = head }
    else { m = head % 2^23; exponent = int(head/2^23) }
    sign = exponent > 2*bias + 1 ? -1 : 1
    exponent %= 2*bias + 2
    if (exponent == 2*bias + 1) { print "  not a number: " text; bad = 1; return 0 }
    return sign*(exponent ? (m/size + 1)*2^(exponent - bias) : m/size*2^(1 - bias))
}
function abs(x) { return x < 0 ? -x : x }

FNR == 1 { ++file }
/^ [0-9a-f]/ {
    ++rows[file]
    if (NF > columns) columns = NF
    for (i = 1; i <= NF; i += 2) x[file, FNR, i] = number($i)
    fields[file, FNR] = NF
}
END {
    if (file != 4 || rows[1] < 10 || rows[2] != rows[1] || rows[3] != rows[1] || rows[4] != rows[1]) {
        print "  tables that do not agree in length"
        exit 1
    }
    for (i = 1; i <= columns; i += 2) {
        most = grown = large = 0
        for (k = 1; k <= rows[1]; ++k) {
            if (fields[1, k] != columns || fields[2, k] != columns) bad = 1
            d = abs(x[1, k, i] - x[2, k, i])/eps
            g = abs(x[3, k, i] - x[4, k, i])*2^23
            if (d > most) most = d
            if (g > grown) grown = g
            if (abs(x[2, k, i]) > large) large = abs(x[2, k, i])
        }
        allowed = i > 1 ? 2*grown + large : 0          # times are exact: h is a power of 2
        text = text sprintf(" %.1f(%.1f)", most, allowed)
        if (!(most <= allowed)) bad = 1
    }
    print text
    exit bad
}
