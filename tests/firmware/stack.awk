# Most bytes of stack that a function and what it calls can use.
#   awk -v root=pneu_step -f stack.awk *.su DISASSEMBLY        (gcc -fstack-usage, objdump -d of the linked program)
# Frames: what the function's own instructions push and subtract, or what the compiler says where that is more.
# Calls: every branch to another function's start. A call through a pointer may reach every function that nothing calls
# directly, but for those of the board. A function that calls itself, directly or through others, is an error; through a pointer it is taken not to.
function registers(list,    n, i, part, ends, count) {
  n = split(list, part, /, */)
  for (i = 1; i <= n; i++) {
    if (split(part[i], ends, "-") == 2) {
      gsub(/[^0-9]/, "", ends[1]); gsub(/[^0-9]/, "", ends[2]); count += ends[2] - ends[1] + 1
    } else count++
  }
  return count
}
function inside(line) { match(line, /\{.*\}/); return substr(line, RSTART + 1, RLENGTH - 2) }
function number(line) { match(line, /#-?[0-9]+/); return substr(line, RSTART + 1, RLENGTH - 1) + 0 }
function find_recursion(f,    i, g) {
  mark[f] = 1
  for (i = 1; i <= calls[f]; i++) {
    g = call[f, i]
    if (mark[g] == 1) { print "recursion: " name[f] " and " name[g] > "/dev/stderr"; failed = 1 }
    if (!(g in mark)) find_recursion(g)
  }
  mark[f] = 2
}
function deepest(f,    i, g, here, most) {
  if (f in done) return done[f]
  open[f] = 1
  most = 0
  for (i = 1; i <= calls[f]; i++) {
    g = call[f, i]
    if (g in open) continue
    here = deepest(g); if (here > most) { most = here; next_of[f] = g }
  }
  for (i = 1; pointer[f] && i <= targets; i++) {
    g = target[i]
    if (g in open) continue
    here = deepest(g); if (here > most) { most = here; next_of[f] = g }
  }
  delete open[f]
  return done[f] = frame[f] + most
}
FILENAME ~ /\.su$/ { n = split($1, part, ":"); fn = part[n]; sub(/\..*/, "", fn); if ($2 > said[fn]) said[fn] = $2; next }
/^[0-9a-f]+ <.*>:$/ { at = $1; sub(/^0+/, "", at); name[at] = substr($2, 2, length($2) - 3); order[++functions] = at; next }
/\tpush\t|stmdb\tsp!/ { frame[at] += 4 * registers(inside($0)) }
/\tvpush\t/ { frame[at] += ($0 ~ /\{d/ ? 8 : 4) * registers(inside($0)) }
/\tsub(w|\.w)?\tsp, / { frame[at] += number($0) }
/\tstr(d)?(\.w)?\t.*\[sp, #-[0-9]+\]!/ { frame[at] -= number(substr($0, index($0, "[sp"))) }
/\tblx\tr/ { pointer[at] = 1 }
/\tbx\tr[0-9]/ { pointer[at] = 1 }
/\tb(l|\.n|\.w|lx)?\t[0-9a-f]+ <[^+]*>/ {
  match($0, /\t[0-9a-f]+ </); to = substr($0, RSTART + 1, RLENGTH - 3)
  if (to != at) { call[at, ++calls[at]] = to; called[to] = 1 }
}
END {
  for (i = 1; i <= functions; i++) {
    f = order[i]; base = name[f]; sub(/\..*/, "", base)
    if (said[base] > frame[f] && !(base in many)) frame[f] = said[base]
    if (!(f in called) && name[f] !~ /^board_/) { target[++targets] = f }
    if (name[f] == root) start = f
  }
  if (!start) { print "no " root > "/dev/stderr"; exit 1 }
  for (i = 1; i <= functions; i++) if (!(order[i] in mark)) find_recursion(order[i])
  print deepest(start)
  if (path) for (f = start; f; f = next_of[f]) printf "%6d %s\n", frame[f], name[f] > "/dev/stderr"
  exit failed
}
