# Sums the output of lines.awk, or of qemu/run.sh, by phase of a frame: total, vertex, cull, setup, span, clear, resolve, helpers; and the total of
# the functions of raster/ alone.
# vertex: the vertex stage. cull: transforms, instances and clusters that are dropped. setup: faces from clusters to sides and
# gradients. span: rows and pixels. helpers: the compiler's functions for what the machine has no instruction for, and copies.
# A line counts for the file that it stands in, wherever it was inlined; those of fixed.h for the function's.
# frames: how many; small: the lines of fill/small.h that are spans, FIRST-LAST; thumb: those of assembly in fill/, "/FILE LINE;..."
BEGIN { split(small, range, "-") }
function phase(fn, file, line) {
    if (fn ~ /^(frame_fill_words|tile_clear|shade_clear|zbuffer_clear)$/ || fn ~ /memset/) return "clear"
    if (file ~ /fill\/small\.h$/) return line + 0 >= range[1] + 0 && line + 0 <= range[2] + 0 ? "span" : "setup"
    if (match(file, /\/[a-z_]*_thumb[a-z_0-9]*\.c$/) && file ~ /fill\//) return index(thumb, substr(file, RSTART) " " line ";") ? "span" : "setup"
    if (file ~ /geometry\/vertex(_thumb1?)?\.[ch]$/) return "vertex"
    if (file ~ /geometry\/(cull|transform|wide|vector|camera)\.[ch]$/) return "cull"
    if (file ~ /fill\/(span\.h|textured\.[ch]|textured_rows_sse2\.h|triangle\.c|polygon\.c|active\.[ch])$/ || file ~ /surface\/(surface|texel|texture_fetch|light|fog|fog_stage)\.[ch]$/ || file ~ /frame\/shade\.c$/ || file ~ /layer\//) return "span"
    if (file ~ /resolve\//) return "resolve"
    if (file ~ /raster\//) return "setup"
    return "helpers"
}
{
    file = $4 ~ /raster\/(.*\/)?(fixed|tuile|features|pixel)\.h$/ ? $3 : $4
    cost[phase($2, file, $5)] += $1
    total += $1
    if ($3 ~ /raster\//) ours += $1
}
END {
    printf "%.0f %.0f %.0f %.0f %.0f %.0f %.0f %.0f %.0f\n", total / frames, cost["vertex"] / frames, cost["cull"] / frames,
        cost["setup"] / frames, cost["span"] / frames, cost["clear"] / frames, cost["resolve"] / frames, cost["helpers"] / frames, ours / frames
}
