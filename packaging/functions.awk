# The names of the functions that a header declares, one a line; comments and the lines of macros are left out.
/^#/ { macro = 1 }
macro { macro = /\\$/; next }
{
  line = $0
  while (in_comment || line ~ /\/\*/) {
    if (in_comment) {
      if (!match(line, /\*\//)) { line = ""; break }
      line = substr(line, RSTART + 2)
      in_comment = 0
    } else {
      match(line, /\/\*/)
      before = substr(line, 1, RSTART - 1)
      line = substr(line, RSTART + 2)
      if (!match(line, /\*\//)) { in_comment = 1; line = before; break }
      line = before " " substr(line, RSTART + 2)
    }
  }
  # a declaration begins at the margin; members of structs are indented
  if (line ~ /^[a-z][a-z_ ]*[ *]pneu_[a-z0-9_]+\(/ && line !~ /^typedef/) {
    match(line, /pneu_[a-z0-9_]+\(/)
    print substr(line, RSTART, RLENGTH - 1)
  }
}
