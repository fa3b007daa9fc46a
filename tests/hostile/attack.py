"""Rigs, logs and lists of a stranger against the programs; prints how each came out and what is wrong, a line each.

attack.py PROGRAMS FOLDER N [SEED]   PROGRAMS: a folder with closeloop, simulate and export-fmu, with sanitizers or without
Pages with hostile names in them are left in FOLDER, listed in FOLDER/pages.
"""
import collections
import csv
import html.parser
import json
import os
import random
import re
import shutil
import stat
import subprocess
import sys
import xml.etree.ElementTree
import zipfile

LINES = 30  # of a list
BUDGET = 2  # [s] of CPU for a line
PATIENCE = 600  # [s] after which a program hangs

# ---- What strangers call things ----

NAMES = [b"press 2", b"hall 2/press 1", "Drücker №7".encode(), b"=1+1", b"+1", b"-1+cmd", b"@SUM(A1)", b"\t=1", b"=cmd|' /C calc'!A0",
         b'"quoted"', b"it's", b"`touch hit`", b"$(touch hit)", b"%n%s%n", b"<svg onload=window.hit=1>",
         b"<img src=x onerror=window.hit=1>", b"</script><script>window.hit=1</script>", b"</title><script>window.hit=1</script>",
         b"\"><script>window.hit=1</script>", b"' onmouseover='window.hit=1", b"\" autofocus onfocus=window.hit=1 x=\"",
         b"javascript:window.hit=1", b"a\nb", b"a\r\n=1+1", "\u202egpj.exe".encode(), "\u2066turned".encode(), b"../../up", b"/etc/passwd",
         b"..", b".", b"\\\\host\\share", b"\xff\xfe", b"caf\xe9", b"\xc0\xaf", b"\xed\xa0\x80", b"*/ int x; /*", b"a\\", b"{{rig}}",
         b"{{{script}}}", b"]]>", b"<!--", b"&lt;script&gt;", b"';system('touch hit');'", b"| touch hit", b"< touch hit", b"-rf",
         b"--batch", b"n" * 255, "ü".encode() * 60, b"\x1b]0;hit\x07", b"\x7f", b"nan", b"<!-- rows -->", b"index.html", b"batch.csv"]

RIG = b"""actuator = { name = %s; area = "400 cm^2"; dead_volume = "0.002 dm^3"; stroke = "20 mm"; spring_rate = "400 kN/m";
  spring_preload = "10 mm"; moving_mass = "2 kg"; dry_friction = "480 N"; viscous_friction = "500 N.s/m"; damping = "1000 N.s/m"; };
transducer = { fill_area = "0.893 mm^2"; vent_area = "0.893 mm^2"; };
supply = { pressure = "400 kPa"; temperature = "298.15 K"; };
noise = { pressure = "0.3 kPa"; position = "0.02 mm"; };
inputs = [ "p" ];
"""
PIECES = [b'@include "/etc/passwd"\n', b"actuator = { area = -1; };\n", b"fit = ( \"orifice_area\", \"fill_area\" );\n", b"\x00",
          b"log = { delimiter = \"\\x01\"; };\n", b"log = { columns = ( \"- [\\\"]\" ); };\n", b"supply = { pressure = 1e400; };\n",
          b"effects = { chamber_leak = { leak_area = \"1 m\"; }; };\n", b"unlisted = ( { } );\n", b"}" * 50, b"{" * 500, b"(" * 5000,
          b"noise = { pressure = \"nan Pa\"; };\n", b"ambient = { pressure = \"0x10 Pa\"; };\n", b"/*", b"\"", b"9" * 400,
          b"log = { skip_lines = 2147483647; };\n", b"fit_per_log = ( \"area\" );\n", b"log = { name = { x = \"%n [m]\"; }; };\n"]
CELLS = [b"nan", b"1e999", b"-1e308", b"", b"=1+1", b"%s%n", b"0x1p3", b"1" * 200, b"\xff", b"\"", b"1,1", b"-0", b"1e-400", b"inf"]

rng = random.Random()
count = collections.Counter()
wrong = []


def expect(good, words):
    if not good:
        wrong.append(words)


def quoted(name):
    """A name as a string of libconfig."""
    return b'"' + b"".join(b"\\x%02x" % c if c < 32 or c in b'"\\' else bytes([c]) for c in name) + b'"'


def as_file(name):
    """A name that a file can have, or the nearest to it."""
    name = name.replace(b"/", b"-").replace(b"\0", b"")[:200]
    return b"x" if name in (b"", b".", b"..") else name


def cell(name, quotes=0.8):
    """A name as a cell of a list, mostly in quotes."""
    return b'"' + name.replace(b'"', b'""') + b'"' if rng.random() < quotes or b'"' in name or b"," in name else name


def is_plain(name):
    """Whether a rig may be called so."""
    try:
        return not re.search("[\x00-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]", name.decode())
    except UnicodeDecodeError:
        return False


def mutated(data):
    """Bytes lost, doubled, changed, or put in."""
    data = bytearray(data)
    for _ in range(rng.randint(1, 12)):
        at = rng.randrange(len(data) + 1)
        kind = rng.randrange(4)
        if kind == 0:
            del data[at:at + rng.randint(1, 40)]
        elif kind == 1:
            data[at:at] = rng.choice(PIECES + CELLS + NAMES)
        elif kind == 2 and at < len(data):
            data[at] = rng.randrange(256)
        else:
            data[at:at] = data[at:at + rng.randint(1, 60)]
    return bytes(data)


# ---- Files ----

def write(path, data):
    with open(path, "wb") as file:
        file.write(data)


def make_rig(path, sound):
    rig = RIG % quoted(rng.choice([n for n in NAMES if is_plain(n) and len(n) < 64] if sound else NAMES))
    if sound:
        return write(path, rig)
    kind = rng.randrange(4)
    if kind == 0:
        rig = rig + rng.choice(PIECES)
    elif kind == 1:
        rig = re.sub(rb'"[0-9.]+ ', b'"' + rng.choice([b"1e308", b"-1", b"0", b"nan", b"1e-320", b"9" * 30]) + b" ", rig,
                     count=rng.randint(1, 9))
    else:
        rig = mutated(rig)
    return write(path, rig)


def make_log(path, sound, good):
    if sound:
        return write(path, good)
    kind = rng.randrange(8)
    if kind == 0:
        return os.mkfifo(path)
    if kind == 1:
        return os.symlink(rng.choice(["/dev/zero", "/dev/null", "/dev/full", ".", "nowhere", "/proc/self/mem"]), path)
    if kind == 2:
        write(path, b"t [s],u [1],p [kPa]\n")
        return os.truncate(path, rng.choice([2 << 30, 1 << 40, 64 << 20]))
    if kind == 3:
        return write(path, b"t [s]," + b",".join([rng.choice([b"- [1]", b"p [kPa]"])] * 1000) + b"\n")
    rows = good.split(b"\n")
    if kind == 4:
        rows[0] = rng.choice([b"t [s],u [1],p [" + rng.choice(NAMES) + b"]", b"t [s],t [s],u [1]", b"t [s],u [bar],p [kPa]", rows[1]])
    if kind == 5:
        for _ in range(9):
            at = rng.randrange(1, len(rows))
            rows[at] = b",".join(rng.choice(CELLS) if rng.random() < 0.4 else c for c in rows[at].split(b","))
    good = b"\n".join(rows)
    return write(path, mutated(good) if kind > 5 else good)


def make_list(folder, good):
    """A list with its rigs and logs, of which one line is sound but for its names."""
    rows = [b"name,rig,log,holdout"]
    for i in range(LINES):
        sound = i % 8 == 0
        rig, log = b"r%d-" % i + as_file(rng.choice(NAMES)) + b".cfg", b"l%d-" % i + as_file(rng.choice(NAMES)) + b".csv"
        make_rig(folder + b"/" + rig, sound or rng.random() < 0.5)
        make_log(folder + b"/" + log, sound, good)
        name = rng.choice([n for n in NAMES if possible(cell(n, 1))] if sound or rng.random() < 0.9 else NAMES)
        good_cells = [cell(n.replace(b"\n", b""), 1 if sound else 0.8) for n in (name + b" %d" % i, rig, log)]
        rows.append(b",".join(good_cells + [good_cells[2] if rng.random() < 0.2 else b""]))
        count["rigs"] += 1
        count["logs"] += 1
    count["lists"] += 1
    if rng.random() < 0.1:
        return mutated(b"\n".join(rows))
    # a list with a line that cannot be is refused whole
    return b"\n".join(r for r in rows if r == rows[0] or possible(r)) + b"\n"


def possible(row):
    """Whether the name of a line can be that of a folder, as far as a look tells."""
    try:
        name = next(csv.reader([row.decode()], strict=True))[0].strip()
    except (UnicodeDecodeError, csv.Error, StopIteration, IndexError):
        return False
    return not (re.search(r"[/\\\x00-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]", name) or name.startswith((".", "batch.", "#")) or
                len(name.encode()) > 127 or b"\r" in row or name == "")


# ---- What was written ----

class Strict(html.parser.HTMLParser):
    """Collects what a page could run."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.scripts, self.runs, self.links, self.inside = [], [], [], False
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.inside = tag == "script"
        if self.inside:
            self.scripts.append("")
        if tag in ("iframe", "object", "embed", "base", "link", "img"):
            self.runs.append(tag)
        for name, value in attrs:
            if name.startswith("on") or name in ("src", "srcdoc", "action", "formaction", "autofocus"):
                self.runs.append(name)
            if name in ("href", "xlink:href"):
                self.links.append(value or "")

    handle_startendtag = handle_starttag

    def handle_endtag(self, _tag):
        self.inside = False

    def handle_data(self, data):
        if self.inside:
            self.scripts[-1] += data


own_scripts = {}  # of index.html and report.html, but for the readings


def check_page(path, kind):
    with open(path, encoding="utf-8", errors="strict") as file:
        text = file.read()
    page = Strict(text)
    scripts = [s for s in page.scripts if not s.lstrip().startswith("{\"columns")]
    own = own_scripts.setdefault(kind, scripts)
    expect(scripts == own, f"{path}: another script than the page's own")
    expect(not page.runs, f"{path}: {page.runs}")
    expect(all(re.match(r"#|[^:]*$|https://", link) for link in page.links), f"{path}: links {page.links}")
    expect(not re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]", text), f"{path}: control characters")
    count["pages"] += 1


def check_json(path):
    with open(path, encoding="utf-8", errors="strict") as file:
        json.load(file)
    count["JSON documents"] += 1


def check_table(path):
    """Every line as wide as the header, and no cell that a spreadsheet takes for a formula, but for numbers of our own."""
    with open(path, encoding="utf-8", errors="strict", newline="") as file:
        rows = list(csv.reader(file, strict=True))
    for row in rows:
        expect(len(row) == len(rows[0]), f"{path}: a line of {len(row)} cells")
        for i, text in enumerate(row):
            number = re.fullmatch(r"-?[0-9.]+(e[-+]?[0-9]+)?( .*)?", text) and rows[0][i] not in ("name", "message")
            expect(number or not re.match("[=+\\-@\t\r\uff1d\uff0b\uff0d\uff20]", text), f"{path}: a formula: {text}")
            expect(not re.search("[\x00-\x1f\x7f-\x9f\u202a-\u202e]", text), f"{path}: control characters in a cell")
    count["tables"] += 1
    return rows


# ---- Running ----

def run(folder, *words):
    """A program, in a folder, with all that it may say.  Returns: status, standard error"""
    try:
        done = subprocess.run(words, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, timeout=PATIENCE, check=False)
    except subprocess.TimeoutExpired:
        expect(False, f"{words} in {folder}: hangs")
        return -1, ""
    said = done.stderr.decode("utf-8", "replace")
    expect(not re.search("Sanitizer|runtime error", said), f"{words} in {folder}: {said[-1500:]}")
    expect(0 <= done.returncode <= 4, f"{words} in {folder}: status {done.returncode}, {said[-300:]}")
    try:
        done.stderr.decode("utf-8", "strict")
    except UnicodeDecodeError:
        expect(False, f"{words} in {folder}: a message that is no UTF-8")
    expect(not re.search("[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e]", said), f"{words} in {folder}: control characters: {said[:200]!r}")
    return done.returncode, said


def check_folder(programs, folder, pages):
    """What closeloop wrote about one line."""
    path = os.fsdecode(folder)
    for name in os.listdir(path):
        here = os.path.join(path, name)
        if name.endswith(".json"):
            check_json(here)
        elif name.endswith(".html"):
            check_page(here, "report.html")
            pages.append(here)
        elif name.endswith(".csv"):
            check_table(here)
        elif name == "model.h":
            status, said = run(path, "cc", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I", os.path.abspath("lib"), "-x", "c", "model.h")
            expect(status == 0, f"{here}: {said[:300]}")
        elif name == "model.cfg":
            status, said = run(path, programs + "/simulate", "model.cfg", "--step", "--out", "again.csv")
            expect(status == 0, f"{here}: is not read again: {said}")
            os.remove(os.path.join(path, "again.csv"))
            check_fmu(programs, path)
            count["models read again"] += 1


def check_fmu(programs, folder):
    status, said = run(folder, programs + "/export-fmu", "model.cfg", "--out", "m.fmu")
    expect(status == 0, f"{folder}: no FMU: {said}")
    with zipfile.ZipFile(folder + "/m.fmu") as package:
        for name in package.namelist():
            expect(not name.startswith("/") and ".." not in name, f"{folder}: a path in the FMU: {name}")
            if name.endswith(".xml"):
                xml.etree.ElementTree.fromstring(package.read(name))
                count["XML documents"] += 1
    os.remove(folder + "/m.fmu")


def attack(programs, folder, good, pages):
    """One list, as a batch, and some of its rigs and logs alone."""
    os.mkdir(folder)
    write(folder + b"/list.csv", make_list(folder, good))
    before = set(os.listdir(folder))
    status, said = run(folder, programs + "/closeloop", "--batch", "list.csv", "--out", "out", "--quiet", "--reports", "--no-figures",
                       "--budget", str(BUDGET))
    table = folder + b"/out/batch.csv"
    if os.path.exists(table):
        rows = check_table(table)
        expect(status != -1, said)
        for row in rows[1:]:
            verdict = row[1] if row[1] != "error" else "error: " + ("out of CPU time" if "s of CPU" in row[-1] else "refused")
            count[verdict] += 1
            expect("ended by" not in row[-1], f"{folder}: {row[-1]}")
        check_page(os.fsdecode(folder) + "/out/index.html", "index.html")
        pages.append(os.fsdecode(folder) + "/out/index.html")
        for name in os.listdir(folder + b"/out"):
            if os.path.isdir(folder + b"/out/" + name):
                check_folder(programs, folder + b"/out/" + name, pages)
    else:
        count["list refused"] += 1
        expect(status in (1, 4), f"{folder}: status {status} without a table: {said}")
    for rig in sorted(n for n in before if n.endswith(b".cfg"))[:3]:
        log = next(n for n in sorted(before) if n.startswith(b"l" + rig[1:].split(b"-")[0] + b"-"))
        if stat.S_ISREG(os.lstat(folder + b"/" + log).st_mode) and os.stat(folder + b"/" + log).st_size < 1 << 20:
            status, _ = run(folder, programs + "/simulate", b"./" + rig, b"./" + log, "--out", "predicted")
            count[f"simulate: status {status}"] += 1
        status, _ = run(folder, programs + "/closeloop", b"./" + rig, b"./" + log, "--out", "single", "--no-figures", "--quiet", "--budget", "1")
        count[f"closeloop: status {status}"] += 1
    left = set(os.listdir(folder)) - before - {b"out", b"single", b"predicted"}
    expect(not left, f"{folder}: left behind: {left}")


def main(programs, folder, n, seed):
    rng.seed(seed)
    programs = os.path.abspath(programs)
    folder = os.fsencode(os.path.abspath(folder))
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    write(folder + b"/rig.cfg", RIG.replace(b'inputs = [ "p" ];', b"") % b'"r"')
    step = subprocess.run([programs + "/simulate", "rig.cfg", "--step"], cwd=folder, capture_output=True, check=False).stdout.split(b"\n")
    good = b"\n".join(step[:1] + step[2::80]) + b"\n"
    pages = []
    k = 0
    while count["rigs"] + count["logs"] + count["lists"] < n:
        attack(programs, folder + b"/%d" % k, good, pages)
        k += 1
    expect(not any(b"hit" in files for _, _, files in ((a, b, [f for f in c if f == b"hit"]) for a, b, c in os.walk(folder)) if files),
           "a command was run")
    write(folder + b"/pages", os.fsencode("".join(page + "\n" for page in pages)))
    for what in sorted(count):
        print(f"{count[what]:7d} {what}")
    for line in wrong:
        print("WRONG:", line)
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]) if len(sys.argv) > 4 else 1))
