# Every way to break a source file of the library by one sign, factor or comparison: file, line, column, length of what is
# replaced, replacement, separated by tabs. Comments, strings, headings of loops, descriptions of parameters and records of
# effects are left alone.

function mutant(at, length_, by) {
  printf "%s\t%d\t%d\t%d\t%s\n", FILENAME, FNR, at, length_, by
}

# Every place of an operator, which clang-format has put between blanks.
function operators(text, i, n, part) {
  for (i = 1; i <= n_swaps; i++) {
    split(swaps[i], part, "~")
    for (n = 1; (at = index(substr(text, n), " " part[1] " ")) > 0; n += at)
      mutant(n + at, length(part[1]), part[2])
  }
}

# A minus before a name, a bracket or a number goes.
function signs(text, i) {
  for (i = 2; i < length(text); i++)
    if (substr(text, i, 1) == "-" && substr(text, i + 1, 1) ~ /[A-Za-z0-9(.]/ && substr(text, i - 1, 1) ~ /[ ({]/)
      mutant(i, 1, "")
}

# Constants grow by a hundredth; one that is no real number does not compile then, and is dropped.
function constants(text, i, from, word) {
  for (i = 1; i <= length(text); i++) {
    if (substr(text, i) !~ /^(PNEU_C\()?[0-9]/ || substr(text, i - 1, 1) ~ /[A-Za-z0-9_.]/)
      continue
    from = i
    match(substr(text, i), /^(PNEU_C\([^)]*\)|[0-9.]+(e-?[0-9]+)?)/)
    word = substr(text, from, RLENGTH)
    i += RLENGTH - 1
    if (word !~ /^(PNEU_C\()?[0.]+\)?$/ && substr(text, i + 1, 1) !~ /[A-Za-z0-9_.]/)
      mutant(from, length(word), "(PNEU_C(1.01) * " word ")")
  }
}

# Where the expression that begins at i ends: before a comma or semicolon that is not in brackets; 0 if it runs on.
function end_of(text, i, depth, c) {
  for (depth = 0; i <= length(text); i++) {
    c = substr(text, i, 1)
    depth += (c ~ /[([{]/) - (c ~ /[])}]/)
    if (depth == 0 && (c == "," || c == ";"))
      return i - 1
    if (depth < 0)
      return 0
  }
  return 0
}

# What is assigned, added or returned grows by a hundredth.
function values(text, i, last) {
  for (i = 1; i < length(text); i++) {
    if (substr(text, i) !~ /^([+*-]?= |return )/ || substr(text, i - 1, 1) != " ")
      continue
    match(substr(text, i), /^([+*-]?= |return )/)
    i += RLENGTH
    last = end_of(text, i)
    if (last > 0 && substr(text, i, last - i + 1) !~ /(^|= )(0|NULL|PNEU_[A-Z_]+)$/)
      mutant(i, last - i + 1, "PNEU_C(1.01) * (" substr(text, i, last - i + 1) ")")
  }
}

# The line with all that is no code blanked out, so that columns stay.
function code(text, out, i, two, c, quoted) {
  out = ""
  for (i = 1; i <= length(text); i++) {
    two = substr(text, i, 2)
    c = substr(text, i, 1)
    if (!in_comment && !quoted && two == "/*")
      in_comment = 1
    if (!in_comment && c == "\"")
      quoted = !quoted
    out = out (in_comment || quoted || c == "\"" ? "_" : c)
    if (in_comment && two == "*/") {
      in_comment = 0
      out = out "_"
      i++
    }
  }
  return out
}

BEGIN {
  n_swaps = split("+~- -~+ *~/ /~* +=~-= -=~+= *=~/= <~>= <=~> >~<= >=~< ==~!= !=~== <~<= <=~< >~>= >=~> &&~|| ||~&&", swaps, " ")
}

FNR == 1 { in_comment = in_table = 0 }

{
  line = code($0)
  if (line ~ /^static const pneu_param_info|^const pneu_effect |^(typedef )?enum|^typedef struct|^#/)
    in_table = 1
  if (!in_table && line ~ /^[ {]/ && line !~ /^ *for \(/) {
    operators(line)
    signs(line)
    constants(line)
    values(line)
  }
  if (line ~ /;$/ || (line ~ /^#/ && line !~ /\\$/))
    in_table = 0
}
