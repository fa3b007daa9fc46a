# Bytes by origin in a linker map of GNU ld: core code, core variables, code of the compiler's libraries, their variables.
# The program itself (count.o and its board) is left out; with link-time optimisation the core is an object of its own.
function origin(file) { return file ~ /\/lib(m|c|gcc|m_nano|c_nano)\.a\(/ ? "library" : file ~ /(count|board_cortex)\.o$/ ? "program" : "core" }
function kind(section) { return section ~ /^\.(text|rodata|ARM)/ ? "code" : section ~ /^\.(data|bss)/ ? "variables" : "" }
/^Linker script and memory map/ { on = 1 }
!on { next }
/^ [.A-Z][^ ]*$/ { section = $1; next }
/^ [.A-Z*][^ ]* +0x/ { section = $1; file = $4; size = $3 }
/^ +0x[0-9a-f]+ +0x[0-9a-f]+ / { file = $3; size = $2 }
/^ .*0x[0-9a-f]+ +0x[0-9a-f]+ [^ ]+\.(o|a\(.*\))$/ && kind(section) { sum[origin(file), kind(section)] += hex(size) }
function hex(text,    i, value) {
  text = tolower(substr(text, 3))
  for (i = 1; i <= length(text); i++) value = 16 * value + index("0123456789abcdef", substr(text, i, 1)) - 1
  return value
}
END { print sum["core", "code"] + 0, sum["core", "variables"] + 0, sum["library", "code"] + 0, sum["library", "variables"] + 0 }
