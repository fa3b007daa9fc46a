#!/bin/sh
# All figures on one page, each with the first line of the script that draws it: gallery.sh > results/GALLERY.md
set -eu
echo "# Gallery"
echo
echo "Made by \`make gallery\` from what is in this folder; a figure is drawn by the script of its name in [study/figures](../study/figures)."
for script in study/figures/*.gp; do
  name=$(basename "$script" .gp)
  [ -e "results/$name.svg" ] || continue
  words=$(sed -n '1s/^# *//p' "$script")
  printf '\n## %s\n\n![%s](%s.svg)\n' "$name" "$words" "$name"
  printf '\n%s\n' "$words"
done
printf '\n## closeloop on measured sets\n'
for figure in results/measured/*/residual.svg; do
  set=$(basename "$(dirname "$figure")")
  sentence=$(sed -n 's/^[[:space:]]*"sentence":[[:space:]]*"\(.*\)",$/\1/p' "results/measured/$set/report.json" | head -n 1)
  verdict=$(awk -F ' *[|] *' -v link="($set/report.json)" 'index($2, link) && !done { print $10; done = 1 }' results/measured/REPORT.md)
  printf '\n### %s\n\n![%s: what the declared and the completed model leave](measured/%s/residual.svg)\n\n%s\n' "$set" "$set" "$set" "$sentence"
  printf '\nJudged by what the bench repeats and by the runs held out ([report](measured/REPORT.md)): %s.\n' "$verdict"
done
