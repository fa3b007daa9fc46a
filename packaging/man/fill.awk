# A page of the manual from its source: "@TABLE name" gives way to what the program TABLES says, and lines of text are
# broken before column 80, as mandoc -T lint wants them; roff joins them again.
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
/^@TABLE / {
  command = TABLES " " $2
  rows = 0
  while ((command | getline line) > 0) { give(line); rows++ }
  if (close(command) || rows == 0) exit 1
  next
}
{ give($0) }
