# A row for each catalogue on a Cortex-M4F, from size.csv: isothermal chamber, ISO 6358 flow, no effect active.
function thousands(n) { return n < 1000 ? n : sprintf("%d,%03d", n / 1000, n % 1000) }
BEGIN {
  FS = ","
  words["base"] = "none, no free terms"
  words["few"] = "three, no free terms"
  words["all"] = "all, and free terms"
  count = split("base few all", order, " ")
}
NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
$1 == "m4f" && $4 == "isothermal/iso6358" {
  code[$2, $3] = thousands($at["core_code_B"])
  steps[$2, $3] = thousands($at["instructions_mean"])
  memory[$3] = thousands($at["instance_B"])
}
END {
  print "| effects compiled in | code, -Os | code, -O3 -flto | RAM | instructions, -Os | -O3 -flto |"
  print "|---|---|---|---|---|---|"
  for (i = 1; i <= count; i++) {
    c = order[i]
    print "| " words[c] " | " code["small", c] " | " code["fast", c] " | " memory[c] " | " steps["small", c] " | " steps["fast", c] " |"
  }
}
