# lib/pneu.h as Doxygen wants it. The header keeps its own plain comments:
#   /* What it is.
#    * In:      name  meaning                 and so Out:, In/out:, Returns:, Error: ..., each over one line or several
#    * Returns: what comes back. */
# Here each becomes documentation of what follows: In and Out become \param where they name an argument of the function
# below, Returns becomes \return, other sections a paragraph. A comment behind a declaration documents that; one between
# dashes is the heading of a group; declarations without a comment of their own share the one above.

{ line[NR] = $0 }

# ---- What is below a comment ----

# The names of a declaration's arguments: argument[].  Returns: the function's name, "" if it is none
function read_declaration(at,    text, name, part, n, i) {
  text = ""
  for (; at <= NR && line[at] !~ /^$/; at++) {
    text = text " " line[at]
    if (line[at] ~ /;/) break
  }
  delete argument
  if (text !~ /^ *[a-z][a-zA-Z_ ]*[ *]pneu_[a-z0-9_]+\(/ || text ~ /^ *typedef/) return ""
  name = text
  sub(/\(.*/, "", name)
  sub(/.*[ *]/, "", name)
  sub(/^[^(]*\(/, "", text)
  sub(/\);.*/, "", text)
  n = split(text, part, ",")
  for (i = 1; i <= n; i++) {
    gsub(/\[[^]]*\]/, "", part[i])
    sub(/.*[ *]/, "", part[i])
    argument[part[i]] = 1
  }
  return name
}

# ---- Comments ----

# Arguments that a text begins with, "set, p  meaning" or "y": as Doxygen wants a list of them; `rest` is what follows.
# Returns: "" where there is none, or where one of them has been documented.
function leading_arguments(text,    names, name) {
  names = ""
  rest = text
  while (match(rest, /^(, )?[a-zA-Z_0-9]+/)) {
    name = substr(rest, 1, RLENGTH)
    sub(/^, /, "", name)
    if (!(name in argument) || (name in documented)) break
    names = names (names == "" ? "" : ",") name
    rest = substr(rest, RLENGTH + 1)
  }
  if (rest !~ /^(  .*|,.*| [([].*|\.)?$/) return ""
  sub(/^[, .]+/, "", rest)
  return names
}

# A line within the section that is open.
function give_line(text,    names, n, part, i) {
  names = section in direction ? leading_arguments(text) : ""
  if (names == "") {
    if (begins && section != "Returns") print " * \\par " section
    print " * " (begins && section == "Returns" ? "\\return " : "") text
  } else {
    print " * \\param[" direction[section] "] " names " " (rest == "" ? "set" : rest)
    n = split(names, part, ",")
    for (i = 1; i <= n; i++) documented[part[i]] = 1
  }
  begins = 0
}

# A line of a comment: sections may begin at its start or within it.
function give_text(text,    word, before, at) {
  while (match(text, /(^|[.)a-z]  ?)(In|Out|In\/out|Returns|Error|Method|Omits|Domain|Source): +/)) {
    before = substr(text, 1, RSTART - 1)
    word = substr(text, RSTART, RLENGTH)
    text = substr(text, RSTART + RLENGTH)
    if (match(word, /^[.)a-z] +/)) {
      before = before substr(word, 1, 1)
      word = substr(word, RLENGTH + 1)
    }
    if (before != "") give_line(before)
    sub(/: +/, "", word)
    section = word
    begins = 1
    print " *"
  }
  sub(/^ +/, "", text)
  # two spaces after a semicolon part arguments on one line
  while (section in direction && (at = index(text, ";  "))) {
    give_line(substr(text, 1, at - 1))
    text = substr(text, at + 3)
  }
  give_line(text)
}

# A block of comment, lines first..last, as documentation of what follows.
function give_block(first, last,    i, text, columns) {
  section = ""
  begins = 0
  delete documented
  for (i = first; i <= last; i++) {
    text = line[i]
    sub(/^ *\/?\*\/?/, "", text)
    sub(/ *\*\/ *$/, "", text)
    gsub(/Eq\. /, "Eq.\\&nbsp;", text) # ends no sentence
    if (i == first) {
      printf "/**"
      if (is_head) printf " \\file"
      print ""
    }
    # the head of the file: "  Units      SI. ..."
    if (is_head && match(text, /^   ?[A-Z][a-z]+(  +| terms +)/)) {
      columns = substr(text, 1, RLENGTH)
      gsub(/^ +| +$/, "", columns)
      print " * \\li \\b " columns ": " substr(text, RLENGTH + 1)
    } else if (line[last + 1] ~ /^#define .*_LIST/ && text ~ /^    /) {
      print " *\n * \\verbatim\n" text "\n \\endverbatim" # heads of the columns
    } else {
      sub(/^ /, "", text)
      if (text == "") section = ""
      give_text(text)
    }
  }
  print " */"
}

# ---- The file ----

END {
  direction["In"] = "in"
  direction["Out"] = "out"
  direction["In/out"] = "in,out"
  is_head = 1
  shared = ""
  for (i = 1; i <= NR; i++) {
    if (match(line[i], /^\/\* ---- .* ---- \*\/$/)) {
      heading = line[i]
      gsub(/^\/\* ---- | ---- \*\/$/, "", heading)
      sub(/[:;].*/, "", heading)
      slug = tolower(heading)
      gsub(/[^a-z]+/, "_", slug)
      if (in_group) print "/** @} */"
      print "/** \\defgroup " slug " " heading
      print " * @{ */"
      in_group = 1
      shared = ""
    } else if (line[i] ~ /^\/\* clang-format/) {
      print ""
    } else if (line[i] ~ /^\/\*/) {
      for (last = i; line[last] !~ /\*\//; last++) ;
      shared = read_declaration(last + 1)
      give_block(i, last)
      is_head = 0
      i = last
    } else if (line[i] ~ /[;,{] +\/\* .* \*\/( \\)?$/ || line[i] ~ /^ .* \/\* .* \*\/$/) {
      sub(/\/\* /, "/**< ", line[i])
      print line[i]
    } else {
      if (line[i] ~ /^#ifdef __cplusplus/ && in_group && line[i + 1] == "}") {
        print "/** @} */"
        in_group = 0
      }
      # a second declaration under one comment
      if (shared != "" && line[i] ~ /^[a-z]/ && line[i - 1] !~ /^(\/| )\*|\*\/$/ && (name = read_declaration(i)) != "" && name != shared)
        print "/** \\copybrief " shared "\n * See " shared "(). */"
      if (line[i] == "") shared = ""
      print line[i]
    }
  }
}
