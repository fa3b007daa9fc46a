#!/bin/sh
# The packages of `make deb` in a fresh Debian: install, run the README's examples, build a user, remove.
#   check_deb.sh PACKAGES      as root; the system is made by debootstrap in a folder below TMPDIR, and removed afterwards
# SUITE: which Debian (bookworm); MIRROR: where from (that of this system).
set -eu
packages=$1
: "${SUITE:=bookworm}"
[ "$(id -u)" -eq 0 ] || { echo "check_deb: debootstrap needs root" >&2; exit 1; }
mirror=${MIRROR:-$(sed -n 's/^URIs: *//p; s/^deb  *\(\[[^]]*\] *\)\{0,1\}\([a-z]*:[^ ]*\).*/\2/p' \
  /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | grep -v security | head -n 1)}

scratch=$(mktemp -d)
root=$scratch/root
log=$scratch/log
trap 'rm -rf "$scratch"' EXIT

wrong() {
  tail -n 30 "$log" >&2
  echo "check_deb: $1" >&2
  exit 1
}

debootstrap --variant=minbase "$SUITE" "$root" "$mirror" >"$log" 2>&1 || wrong "debootstrap"

# inside COMMAND...: in the fresh system, where nothing of this one is seen
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }

# engineer COMMAND: as somebody without rights
engineer() { inside su engineer -c "cd; $1" >"$log" 2>&1; }

# apt reaches its mirror the way that this system's does
cp /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
apt-config dump Acquire::http::Proxy | grep . >"$root/etc/apt/apt.conf.d/proxy" || rm -f "$root/etc/apt/apt.conf.d/proxy"
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages"
inside sh -c 'apt-get update -q && apt-get install -q -y --no-install-recommends /packages/*.deb' >"$log" 2>&1 ||
  wrong "apt-get install"

# The bench's commands of the README, in a folder of one's own
inside useradd -m engineer
cat >"$root/home/engineer/bench.sh" <<'BENCH'
set -eu
study=/usr/share/pneu/study
simulate $study/actuators/r1-400.cfg --step >step.csv
export-fmu $study/actuators/r1-400.cfg -o r1-400.fmu
[ -s r1-400.fmu ]
[ "$(wc -l <step.csv)" -eq 3052 ]
printf 'effects = { chamber_leak = { leak_area = "0.05 mm^2"; }; };\n' | cat $study/actuators/r1-400.cfg - >leaky.cfg
printf 'fit = ("spring_rate");\nnoise = { pressure = "0.3 kPa"; position = "0.02 mm"; };\n' |
  cat $study/actuators/r1-400.cfg - >rig.cfg
simulate leaky.cfg --step | awk 'NR == 1 || NR % 10 == 0' >log.csv
simulate rig.cfg log.csv >predicted.csv
closeloop rig.cfg log.csv --quiet --out answer | tee said
grep -q chamber_leak said
grep -q 'new uPlot' answer/report.html
printf 'name,rig,log,holdout\na,rig.cfg,log.csv,\n' >fleet.csv
closeloop --batch fleet.csv --out fleet --quiet
grep -q chamber_leak fleet/batch.csv
sweep hypotheses.cfg --quiet --no-figures
[ -s results/REPORT.md ]
BENCH
engineer 'sh bench.sh' || wrong "the README's commands"
cat "$log"
inside ldd /usr/bin/closeloop >"$log"
grep -q 'not found' "$log" && wrong "a library is missing"

# What is only recommended draws the figures of the study
inside apt-get install -q -y --no-install-recommends gnuplot-nox >"$log" 2>&1 || wrong "gnuplot"
engineer 'sweep hypotheses.cfg --quiet && [ -s results/hypotheses.svg ] && [ -s results/fig15.svg ]' || wrong "the study's figures"

# The README's program, by pkg-config; an example of the packages; the manual
inside apt-get install -q -y --no-install-recommends gcc libc6-dev pkg-config make man-db >"$log" 2>&1 || wrong "gcc"
awk '/^```c$/{on=1;next} /^```$/{on=0} on' README.md >"$root/home/engineer/example.c"
engineer 'cc -std=c90 -pedantic-errors -Wall -Wextra example.c $(pkg-config --cflags --libs pneu) -o example && ./example' ||
  wrong "the README's program"
engineer 'cp -R /usr/share/doc/libpneu-doc/examples/pkg-config . && make -s -C pkg-config && pkg-config/strokes' ||
  wrong "the packaged example"
tail -n 1 "$log"
for page in closeloop sweep simulate export-fmu '3 libpneu' '3 pneu' '5 pneu-rig'; do
  # shellcheck disable=SC2086
  [ "$(inside man $page 2>"$log" | wc -l)" -gt 40 ] || wrong "man $page"
done

inside apt-get purge -q -y libpneu0 libpneu-dev libpneu-doc pneu-tools >"$log" 2>&1 || wrong "purge"
left=$(inside find /usr /etc /var /opt -xdev \( -name '*pneu*' -o -name '*closeloop*' \) -not -path '/var/log/*' \
  -not -path '/var/cache/man/*')
[ -z "$left" ] || wrong "purge leaves $left"
echo "check_deb: installed, run and purged in a fresh $SUITE"
