# The names of the functions that a header declares, one a line: a declaration begins at the margin, members of structs and lines of
# macros and of comments do not.
/^[a-z].*[ *]pneu_[a-z0-9_]+\(/ && !/^typedef/ {
  match($0, /pneu_[a-z0-9_]+\(/)
  print substr($0, RSTART, RLENGTH - 1)
}
