# From callgrind's profile with line numbers to lines of: count, function, file of the function, file of the line, line.
function name(text) {
    if (match(text, /^\([0-9]+\)/)) {
        id = substr(text, RSTART, RLENGTH)
        rest = substr(text, RLENGTH + 2)
        if (rest != "") names[kind, id] = rest
        return names[kind, id]
    }
    return text
}
/^fl=/ { kind = "file"; own = name(substr($0, 4)); next }
/^f[ie]=/ { kind = "file"; file = name(substr($0, 4)); next }
/^fn=/ { kind = "fn"; current = name(substr($0, 4)); sub(/\x27[0-9]+$/, "", current); file = own; next }
/^cf[il]=/ { kind = "file"; name(substr($0, 5)); next }
/^cfn=/ { kind = "fn"; name(substr($0, 5)); next }
/^calls=/ { getline; place($1); next } # what the callee cost: not ours
/^[0-9+*-][0-9]* [0-9]+$/ {
    place($1)
    print $2, current, own, file, line
}
function place(text) {
    if (text == "*") return
    line = text ~ /^[+-]/ ? line + text : text
}
