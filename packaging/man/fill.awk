# A page of the manual from its source: "@TABLE name" gives way to what the program TABLES says, "@FUNCTIONS name ..." to what the
# file HEADER declares, and lines of text are broken before column 80, as mandoc -T lint wants them; roff joins them again.
function wrap(text,    n, word, i, line) {
  n = split(text, word, " ")
  line = word[1]
  for (i = 2; i <= n; i++)
    if (length(line) + length(word[i]) < 79) line = line " " word[i]
    else { print line; line = word[i] }
  print line
}
function give(text) {
  if (text ~ /^\.Bd -literal/) literal = 1
  if (text ~ /^\.Ed/) literal = 0
  if (literal || text ~ /^\./ || length(text) < 80) print text
  else wrap(text)
}
# "type *name(one, two);", which may go over lines
function declare(name,    line, more, type, n, i, argument, short) {
  while ((getline line < HEADER) > 0 && line !~ "^[a-z].*[ *]" name "\\(")
    ;
  while (line !~ /;$/ && (getline more < HEADER) > 0) { sub(/^ */, " ", more); line = line more }
  close(HEADER)
  if (!match(line, name "\\(")) exit 1
  type = substr(line, 1, RSTART - 1)
  sub(/ $/, "", type)
  print ".Ft " (type ~ / / ? "\"" type "\"" : type)
  n = split(substr(line, RSTART + RLENGTH, length(line) - RSTART - RLENGTH - 1), argument, ", ")
  for (i = 1; i <= n; i++) short = short " \"" argument[i] "\""
  if (length(name short) < 76) { print ".Fn " name short; return }
  print ".Fo " name
  for (i = 1; i <= n; i++) print ".Fa \"" argument[i] "\""
  print ".Fc"
}
/^@TABLE / {
  command = TABLES " " $2
  rows = 0
  while ((command | getline line) > 0) { give(line); rows++ }
  if (close(command) || rows == 0) exit 1
  next
}
/^@FUNCTIONS / { for (word = 2; word <= NF; word++) declare($word); next }
{ give($0) }
