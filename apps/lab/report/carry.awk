# A text as strings of C, one after the other with a comma: a line each, long ones in parts.
# SPDX-License-Identifier: MIT
function put(text, end) {
  gsub(/["\\]/, "\\\\&", text)
  gsub(/\?/, "\\?", text)
  print "\"" text end "\","
}
{
  for (; length($0) > 1000; $0 = substr($0, 1001)) put(substr($0, 1, 1000), "")
  put($0, "\\n")
}
