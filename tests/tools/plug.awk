# plug.awk: awk -f plug.awk CHAPTER gvi.h: gvi.h with a chapter plugged in.  CHAPTER says where, in lines "@ place   text":
# the name of a function of the switchboard, whose body then begins with the text; TYPES, before gvi__private; gvi__private, a
# field; GVI__CHAPTERS, before it in its enum; GVI__CHAPTERS |, behind it.  The file itself comes before the switchboard.
FNR == NR {
    if ($1 == "@") {
        place = $2
        text = $0
        sub(/^@ +[^ ]+ +/, "", text)
        if (text ~ /^\| +\|/) { place = place "|"; sub(/^\| +/, "", text) }
        line[place] = text
        ++wanted
    }
    next
}
function put(place, indent) {
    if (place in line) { print indent line[place]; delete line[place]; ++found }
}
/^struct gvi__private \{/ { put("TYPES", "") }
/^    GVI__CHAPTERS = 0/ { put("GVI__CHAPTERS", "    ") }
/^\/\* -+ SWITCHBOARD/ { print "#include \"" substr(ARGV[1], match(ARGV[1], /[^\/]*$/)) "\"\n"; board = 1 }
{ print }
/^    int                 has_velocity;/ { put("gvi__private", "    ") }
/^    GVI__CHAPTERS = 0/ { put("GVI__CHAPTERS|", "    ") }
board && match($0, /gvi__place_[a-z_]+\(/) && /^[A-Za-z]/ { name = substr($0, RSTART, RLENGTH - 1) }
board && /^\{/ { put(name, "    ") }
END { exit found != wanted }
