# A text as an array of strings of C, which ends with NULL: a line each, long ones in parts. Its name is that of the file:
# page.css is page_css.
# SPDX-License-Identifier: MIT
function put(text, end) {
  gsub(/["\\]/, "\\\\&", text)
  gsub(/\?/, "\\?", text)
  print "\"" text end "\","
}
NR == 1 {
  name = FILENAME
  sub(".*/", "", name)
  gsub(/[^A-Za-z0-9]/, "_", name)
  print "static const char *const " name "[] = {"
}
{
  for (; length($0) > 1000; $0 = substr($0, 1001)) put(substr($0, 1, 1000), "")
  put($0, "\\n")
}
END { print "NULL};" }
