# What the checks of programs share, to be sourced: `wrong` counts the complaints, and the last command's output is in $folder/out
# and $folder/err.
wrong=0

complain() {
  echo "$*"
  wrong=$((wrong + 1))
}

# expect STATUS WHAT COMMAND...
expect() {
  status=$1
  what=$2
  shift 2
  "$@" >"$folder/out" 2>"$folder/err"
  got=$?
  [ "$got" -eq "$status" ] || complain "$what: expected status $status, got $got: $(cat "$folder/err")"
}

# expect_words STATUS TEXT COMMAND...: exit status, and a message on stderr that contains TEXT
expect_words() {
  wanted=$1
  words=$2
  shift 2
  expect "$wanted" "$*" "$@"
  [ -z "$words" ] || grep -q -- "$words" "$folder/err" || complain "$*: does not say \"$words\": $(cat "$folder/err")"
}
