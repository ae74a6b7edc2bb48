# Shared by the scripts that count.
# count OUT PROGRAM ARGUMENTS...: runs the bench under callgrind. OUT/run.txt has what it printed, OUT/callgrind.out the profile of all
# calls of bench_frame. Returns its exit code; when that is 1, with what was said.
count() {
    count_out=$1
    shift
    count_code=0
    valgrind --tool=callgrind --callgrind-out-file="$count_out/callgrind.out" --collect-atstart=no --toggle-collect=bench_frame \
        --dump-line=yes "$@" >"$count_out/run.txt" 2>"$count_out/valgrind.txt" || count_code=$?
    grep '^hash ' "$count_out/run.txt" >"$count_out/hash.txt" || true
    [ $count_code != 1 ] || { cat "$count_out/run.txt"; grep -v '^==[0-9]*==' "$count_out/valgrind.txt"; } >&2
    return $count_code
}

# figure OUT NAME: the number behind NAME in what the bench printed.
figure() {
    awk -v name="$2" '{ for (i = 1; i < NF; i++) if ($i == name) { print $(i + 1); exit } }' "$1/run.txt"
}
