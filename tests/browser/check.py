"""Looks at the pages of closeloop in a headless Chromium; prints what is wrong, a line each.

check.py report FOLDER...   report.html of folders that closeloop wrote
check.py index FILE         index.html of a batch
check.py hostile LIST       pages with names that try to be code, a path a line; what such a name runs sets window.hit
"""
import collections
import csv
import html
import json
import os
import re
import subprocess
import sys
import tempfile

from chromium import Browser, Failure, Page

WIDTHS = (360, 390, 800, 1440, 1600)
ENOUGH = 4.5  # WCAG 2, AA: contrast of text
wrong = []


def expect(good, words):
    if not good:
        wrong.append(words)


# ---- What every page owes ----

# Text whose contrast with what is behind it is too low; large and bold text is held to the same number as small text.
CONTRAST = """
(() => {
  const numbers = c => (c.match(/[\\d.]+/g) || []).map(Number);
  const over = (top, below) => { const a = top.length > 3 ? top[3] : 1; return [0, 1, 2].map(i => top[i] * a + below[i] * (1 - a)); };
  const light = c => { const [r, g, b] = c.map(v => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const behind = e => { const stack = [];
    for (; e; e = e.parentElement) { const c = numbers(getComputedStyle(e).backgroundColor); if (c.length === 3 || c[3] > 0) stack.unshift(c); }
    return stack.reduce((below, top) => over(top, below), [255, 255, 255]); };
  const bad = {};
  let n = 0;
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const e = walker.currentNode.parentElement;
    if (!walker.currentNode.data.trim() || e.closest("script, style, option") || !e.getClientRects().length) continue;
    const text = numbers(getComputedStyle(e).color), below = behind(e);
    const [x, y] = [light(over(text, below)), light(below)].sort((a, b) => b - a), ratio = (x + 0.05) / (y + 0.05);
    n++;
    if (ratio < %g) bad[walker.currentNode.data.trim().slice(0, 40)] = ratio.toFixed(2);
  }
  return { n, bad };
})()""" % ENOUGH

# Tables that run out of their place, and switches of a figure that do.
CLIPPED = """[...document.querySelectorAll(".wide, .keys")].filter(e => e.scrollWidth > e.clientWidth + 1)
  .map(e => (e.getAttribute("aria-label") || e.textContent.trim().slice(0, 40)) + " by " + (e.scrollWidth - e.clientWidth) + " px")"""

# Faults of structure that a screen reader would stumble over.
STRUCTURE = """
(() => {
  const faults = [], all = s => [...document.querySelectorAll(s)];
  if (!document.documentElement.lang) faults.push("no lang");
  for (const s of ["main", "header", "footer", "h1"]) if (all(s).length !== 1) faults.push(all(s).length + " of " + s);
  let last = 0;
  for (const h of all("h1, h2, h3, h4")) {
    const level = Number(h.tagName[1]);
    if (level > last + 1) faults.push("heading " + h.textContent + " skips a level");
    last = level;
  }
  for (const t of all("table")) if (!t.caption || !t.caption.textContent.trim()) faults.push("a table without a caption");
  for (const h of all("th")) if (!h.scope) faults.push("th without scope: " + h.textContent);
  for (const s of all("main [role=img]")) if (!/\\d/.test(s.getAttribute("aria-label"))) faults.push("a figure without numbers in words");
  for (const c of all("main canvas")) if (!c.closest("[role=img]")) faults.push("a canvas without a role");
  const ids = all("[id]").map(e => e.id);
  if (new Set(ids).size !== ids.length) faults.push("an id is there twice");
  for (const a of all("a[href^='#']")) if (!document.getElementById(a.hash.slice(1))) faults.push("no target: " + a.hash);
  for (const i of all("input, select, button")) {
    const named = i.getAttribute("aria-label") || (i.labels && [...i.labels].map(l => l.textContent).join("")) || i.textContent;
    if (!named.trim()) faults.push("a control without a name: " + i.outerHTML.slice(0, 60));
  }
  for (const e of all("[src], link, iframe, object, embed, base")) faults.push("from outside: " + e.outerHTML.slice(0, 60));
  return faults;
})()"""


def look_everywhere(browser, path):
    """Widths, light and dark, with a script and without: no complaint, nothing wider than the window, contrast."""
    for width in WIDTHS:
        for dark in (False, True):
            where = f"{path} at {width}, {'dark' if dark else 'light'}"
            with Page(browser, path, width, dark=dark) as page:
                # against the width asked for: a telephone's window grows with what is in it
                wide = page.ask("document.scrollingElement.scrollWidth") - width
                expect(wide <= 0, f"{where}: {wide} px wider than the window")
                page.ask("document.querySelectorAll('details').forEach(d => d.open = true)")
                for words in page.ask(CLIPPED):
                    expect(False, f"{where}: cut off: {words}")
                found = page.ask(CONTRAST)
                expect(found["n"] > 20, f"{where}: hardly any text")
                expect(not found["bad"], f"{where}: contrast below {ENOUGH}: {json.dumps(found['bad'])[:300]}")
                if width == WIDTHS[0] and not dark:
                    for fault in page.ask(STRUCTURE):
                        expect(False, f"{path}: {fault}")
                page.look()
                expect(not page.faults, f"{where}: {page.faults}")


def tidy(path):
    """HTML Tidy knows HTML 5 well enough to see what is not closed, unknown or empty where it must not be."""
    said = subprocess.run(["tidy", "-quiet", "-errors", "--drop-empty-elements", "no", "--show-info", "no", path],
                          capture_output=True, text=True, check=False).stderr
    for line in said.splitlines():
        expect(False, f"{path}: {line}")


# ---- report.html ----

def words_of(page):
    return page.ask("document.body.innerText.replace(/\\s+/g, ' ')")


def without_script(browser, path):
    with Page(browser, path) as page:
        sentence = page.ask("document.querySelector('h1').textContent")
    with Page(browser, path, script=False) as page:
        # a page without scripts is asked through the document, not by running one in it
        root = page.call("DOM.getDocument", depth=0)["root"]["nodeId"]
        source = html.unescape(page.call("DOM.getOuterHTML", nodeId=root)["outerHTML"])
        expect(sentence in re.sub("<[^>]*>", "", source), f"{path}: without script, no sentence")
        expect('type="range"' not in source, f"{path}: without script, a slider that does nothing")
        words = find(page, root, "#figure-response noscript p")
        expect(height_of(page, words) > 10, f"{path}: without script, no words in place of the curves")
        said = page.call("DOM.getOuterHTML", nodeId=words)["outerHTML"]
        expect(re.search(r"runs from .*rms error", said), f"{path}: without script, no numbers of the curves: {said}")
        expect('href="response.svg"' in said, f"{path}: without script, no drawing in place of the curves")
        expect(height_of(page, find(page, root, "#figure-response label")) == 0, f"{path}: without script, switches that do nothing")
        expect(height_of(page, find(page, root, "#parameters td")) > 10, f"{path}: without script, no table")


def find(page, root, selector):
    return page.call("DOM.querySelector", nodeId=root, selector=selector)["nodeId"]


def height_of(page, node):
    try:
        return page.call("DOM.getBoxModel", nodeId=node)["model"]["height"]
    except Failure:  # it takes no room
        return 0


# What is on a canvas: red, green, blue, alpha of each pixel.
PIXELS = """(c => { const context = new OffscreenCanvas(c.width, c.height).getContext("2d", { willReadFrequently: true });
  context.drawImage(c, 0, 0);
  return context.getImageData(0, 0, c.width, c.height).data; })"""

# Pixels of a figure that have a colour of the page's style, on all its canvases.
COLOURED = """((figure, name) => {
  const pixels = %s;
  const probe = document.body.appendChild(document.createElement("i"));
  probe.style.color = `var(--f-${name})`;
  const want = getComputedStyle(probe).color.match(/\\d+/g).map(Number);
  probe.remove();
  let n = 0;
  for (const c of document.querySelectorAll(`#${figure} canvas`)) {
    const d = pixels(c);
    for (let i = 0; i < d.length; i += 4)
      n += d[i] === want[0] && d[i + 1] === want[1] && d[i + 2] === want[2] && d[i + 3] === 255;
  }
  return n; })""" % PIXELS
HUE = {"measured": "wide", "before": "vermillion", "after": "blue", "band": "sand", "sheet": "orange", "found": "green", "baseline": "purple"}


def drawn(browser, path):
    """A canvas for each panel, as wide as its place also when that changes, and something on it."""
    with Page(browser, path, 1440, 1200) as page:
        panels, canvases = page.ask("""[Object.values(JSON.parse(document.getElementById("curves").textContent).panels).flat().length,
          document.querySelectorAll(".panels canvas").length]""")
        expect(panels == canvases and panels >= 5, f"{path}: {canvases} canvases for {panels} panels")
        blank = page.ask(f"""[...document.querySelectorAll(".panels canvas")].filter(c => !{PIXELS}(c).some(v => v > 0)).length""")
        expect(blank == 0, f"{path}: {blank} canvases are blank")
        for width in (390, 1000):
            page.call("Emulation.setDeviceMetricsOverride", width=width, height=1000, deviceScaleFactor=1, mobile=False)
            page.ask("new Promise(r => setTimeout(r, 300))")
            off = page.ask("""Math.max(...[...document.querySelectorAll(".panels canvas")].map(c =>
              Math.abs(c.getBoundingClientRect().width - c.closest(".panels > *").clientWidth)))""")
            expect(off < 1, f"{path}: made {width} wide, a panel is {off} px off its place")
            wide = page.ask("document.scrollingElement.scrollWidth")
            expect(wide <= width, f"{path}: made {width} wide, the page is {wide}")
        page.look()
        expect(not page.faults, f"{path}: {page.faults}")


def switches(browser, path):
    """Every switch by mouse and by keyboard."""
    with Page(browser, path, 1600, 1200) as page:
        keys = page.ask("[...document.querySelectorAll('[data-key]')].map(i => [i.id, i.dataset.key, i.closest('figure').id])")
        expect(len(keys) >= 5, f"{path}: {len(keys)} switches")
        for key, name, figure in keys:
            pixels = f"""new Promise(r => requestAnimationFrame(() => r({COLOURED}("{figure}", "{HUE[name]}"))))"""
            seen = page.ask(pixels)
            expect(seen > 0, f"{path}: nothing is drawn that {key} could switch")
            at = page.ask(f"""(() => {{ const l = document.querySelector("label[for={key}]"); l.scrollIntoView({{block: "center"}});
              const b = l.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})()""")
            page.click(*at)
            expect(page.ask(pixels) == 0, f"{path}: {key} does not switch off by a click")
            page.key("Tab")  # focus shows where the keyboard is in use
            page.ask(f"document.getElementById('{key}').focus()")
            expect(page.ask(f"getComputedStyle(document.querySelector('label[for={key}]')).outlineStyle") == "solid",
                   f"{path}: {key} does not show that it has the focus")
            page.key(" ", "Space", " ")
            expect(page.ask(pixels) == seen, f"{path}: {key} does not switch on by the keyboard")
        page.look()
        expect(not page.faults, f"{path}: {page.faults}")


NUMBER = r"[-\u2212]?\d+(?:\.\d+)?"


def shown(text):
    """A number as it is shown, and half a unit of its last digit."""
    decimals = len(text.split(".")[1]) if "." in text else 0
    return float(text.replace("\u2212", "-")), 0.5001 * 10.0 ** -decimals


def agrees(text, value):
    number, slack = shown(text)
    return abs(number - value) <= slack + 1e-9 * abs(value)


# what a channel is called on the page, in which unit, and as how many of those the table's unit counts
CHANNELS = {"Pressure p": ("p", "kPa", 1e-3), "Position x": ("x", "mm", 1e3), "Force force": ("force", "N", 1),
            "Temperature T": ("T", "K", 1)}
CURVES = {"measured": "{} [", "declared": "{}_before [", "completed": "{}_after ["}


def rows_of(folder):
    with open(os.path.join(folder, "residual.csv"), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def row_at(rows, said):
    """The row of residual.csv that "run 2, t = 1.25 s" names."""
    run = re.search(r"run (\d+)", said)
    time = re.search(r"t = (" + NUMBER + ")", said).group(1)
    for row in rows:
        if (not run or row["run [1]"] == run.group(1)) and agrees(time, float(row["t [s]"])):
            return row
    return None


def cell(row, begin):
    name = next((n for n in row if n.startswith(begin)), None)
    return float(row[name]) if name and row[name] else None


def compare_reading(path, rows, figure, spans):
    """Every number that is shown against the table.  Returns: how many"""
    row = row_at(rows, spans[0])
    expect(row is not None, f"{path}: no row at {spans[0]}")
    n = 0
    for span in spans[1:] if row else []:
        name, told = span.split(": ", 1)
        if name.split(",")[0] not in CHANNELS:
            continue
        key, unit, scale = CHANNELS[name.split(",")[0]]
        if figure == "residual":
            stage = "after" if "completed" in name else "before"
            value = cell(row, f"{key}_residual_{stage} [")
            number = re.search(NUMBER, told).group(0)
            expect(value is not None and agrees(number, value), f"{path}: {spans[0]}, {span}: the table has {value}")
            n += 1
            continue
        expect(told.endswith(" " + unit), f"{path}: {span}: expected {unit}")
        for label, column in CURVES.items():
            match = re.search(re.escape(label) + " (" + NUMBER + ")", told)
            if match:
                value = cell(row, column.format(key))
                expect(value is not None and agrees(match.group(1), scale * value),
                       f"{path}: {spans[0]}, {span}: the table has {value}")
                n += 1
    return n


SPANS = "[...document.querySelectorAll('#figure-%s .reading span')].map(s => s.textContent)"


def box_of(page, figure):
    """Where the last panel of a figure has its curves: left, top, width, height."""
    return page.ask(f"""(() => {{ const s = [...document.querySelectorAll("#figure-{figure} .u-over")].pop(); s.scrollIntoView({{block: "center"}});
      const b = s.getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; }})()""")


def pointing(browser, folder):
    """By mouse and by the slider's keys: the values shown are those of residual.csv."""
    path = os.path.join(folder, "report.html")
    rows = rows_of(folder)
    numbers = 0
    with Page(browser, path, 1600, 1400) as page:
        for figure in ("response", "residual"):
            box = box_of(page, figure)
            for share in (0.1, 0.13, 0.29, 0.5, 0.77, 0.96):
                page.mouse("mouseMoved", box[0] + share * box[2], box[1] + 0.6 * box[3])
                numbers += compare_reading(path, rows, figure, page.ask(SPANS % figure))
                other = "residual" if figure == "response" else "response"
                expect(page.ask(SPANS % figure)[:1] == page.ask(SPANS % other)[:1], f"{path}: {other} does not follow {figure}")
        slider = "document.querySelector('#figure-response input[type=range]')"
        page.ask(slider + ".focus()")
        page.key("Home")
        first = page.ask(SPANS % "response")
        page.key("ArrowRight")
        second = page.ask(SPANS % "response")
        expect(first[0] != second[0], f"{path}: the arrow key does not move on")
        numbers += compare_reading(path, rows, "response", second)
        expect(page.ask(slider + ".getAttribute('aria-valuetext')").startswith(second[0]), f"{path}: a screen reader is not told")
        switched_off(page, path)
        zoom(page, path)
        page.look()
        expect(not page.faults, f"{path}: {page.faults}")
    expect(numbers >= 20, f"{path}: only {numbers} numbers were read by pointing")


def zoom(page, path):
    """A drag in one figure shows a part of the axis in that and in the other; a double click all of it."""
    def said_at(figure, share):
        box = box_of(page, figure)
        page.mouse("mouseMoved", box[0] + share * box[2], box[1] + 0.4 * box[3])
        return page.ask(SPANS % figure)[0]

    whole, from_, to = said_at("residual", 0.01), said_at("response", 0.3), said_at("response", 0.5)
    box = box_of(page, "response")
    page.mouse("mouseMoved", box[0] + 0.3 * box[2], box[1] + 0.4 * box[3])
    page.mouse("mousePressed", box[0] + 0.3 * box[2], box[1] + 0.4 * box[3], button="left", clickCount=1)
    page.mouse("mouseMoved", box[0] + 0.5 * box[2], box[1] + 0.4 * box[3], button="left", buttons=1)
    page.mouse("mouseReleased", box[0] + 0.5 * box[2], box[1] + 0.4 * box[3], button="left", clickCount=1)
    for figure in ("response", "residual"):
        said = [said_at(figure, 0.0), said_at(figure, 0.999)]
        expect(all(abs(time_of(a) - time_of(b)) < 0.02 * abs(time_of(from_)) for a, b in zip(said, (from_, to))),
               f"{path}: a drag from {from_} to {to} has {figure} from {said[0]} to {said[1]}")
    box = box_of(page, "response")
    for count in (1, 2):
        for kind in ("mousePressed", "mouseReleased"):
            page.mouse(kind, box[0] + 0.4 * box[2], box[1] + 0.4 * box[3], button="left", clickCount=count)
    expect(said_at("residual", 0.01) == whole, f"{path}: a double click does not show all")


def time_of(said):
    return float(re.search(r"t = (" + NUMBER + ")", said).group(1).replace("\u2212", "-"))


def switched_off(page, path):
    page.ask("document.getElementById('response-measured').click()")
    spans = page.ask(SPANS % "response")
    expect(not any("measured" in s for s in spans), f"{path}: what is switched off is still read")
    page.ask("document.getElementById('response-measured').click()")
    spans = page.ask(SPANS % "response")
    expect(any("measured" in s for s in spans), f"{path}: what is switched on again is not read")


def all_axes(browser, path):
    """The slider of every figure, along every axis it has, says something."""
    with Page(browser, path) as page:
        said = page.ask("""[...document.querySelectorAll("figure")].map(f => {
          const slider = f.querySelector("input[type=range]"), select = f.querySelector("select");
          if (!slider) return null;
          return (select ? [...select.options].map(o => o.value) : [""]).map(axis => {
            if (select) { select.value = axis; select.dispatchEvent(new Event("change")); }
            slider.value = 1;
            slider.dispatchEvent(new Event("input"));
            return f.id + " " + f.querySelector(".reading").textContent; }); }).filter(s => s).flat()""")
        expect(len(said) >= 3, f"{path}: {len(said)} axes to read along")
        for text in said:
            expect(re.search(r" = " + NUMBER + ".*: .*" + NUMBER, text), f"{path}: nothing to read: {text}")


def colours_of(pdf, number):
    """How many pixels of a page have which colour."""
    head, _, data = subprocess.run(["pdftoppm", "-r", "120", "-f", str(number), "-l", str(number), pdf], capture_output=True,
                                   check=True).stdout.partition(b"\n255\n")
    expect(head.startswith(b"P6") and data, f"{pdf}: no picture of page {number}")
    return collections.Counter(data[i:i + 3] for i in range(0, len(data), 3))


def printed(browser, path):
    """Two pages with curves, in the colours of paper even from a dark screen."""
    with tempfile.TemporaryDirectory() as folder, Page(browser, path, dark=True) as page:
        pdf = os.path.join(folder, "report.pdf")
        page.pdf(pdf)
        told = subprocess.run(["pdfinfo", pdf], capture_output=True, text=True, check=True).stdout
        pages = int(re.search(r"Pages:\s+(\d+)", told).group(1))
        expect(pages == 2, f"{path}: {pages} pages printed")
        expect("A4" in told, f"{path}: not printed on A4")
        text = " ".join(subprocess.run(["pdftotext", pdf, "-"], capture_output=True, text=True, check=True).stdout.split())
        sentence = page.ask("document.querySelector('h1').textContent")
        expect("".join(sentence.split()) in "".join(text.split()), f"{path}: the sentence is not printed")
        for word in ("How certain", "What to do next", "What the log cannot tell", "Parameters", "95 %"):
            expect(word in text, f"{path}: not printed: {word}")
        colours = [colours_of(pdf, number + 1) for number in range(pages)]
        for hue in {b"\xd5\x5e\x00"} | ({b"\x00\x72\xb2"} if "completed model" in text else set()):
            expect(all(c[hue] > 100 for c in colours), f"{path}: a curve is not printed: {[c[hue] for c in colours]} pixels of {hue.hex()}")
        expect(colours[0].most_common(1)[0][0] == b"\xff\xff\xff", f"{path}: the paper is not white")
        expect("double-click" not in text, f"{path}: what only works on a screen is printed")


def report(browser, folder):
    path = os.path.join(folder, "report.html")
    expect(os.path.getsize(path) < 0.4e6, f"{path}: {os.path.getsize(path)} bytes")
    look_everywhere(browser, path)
    tidy(path)
    without_script(browser, path)
    drawn(browser, path)
    switches(browser, path)
    pointing(browser, folder)
    all_axes(browser, path)
    printed(browser, path)


# ---- index.html ----

NAMES = "[...document.querySelectorAll('#lines tbody th')].map(t => t.textContent)"


def plain(text):
    return html.unescape(re.sub("<.*?>", "", text))


def rows_in_file(path):
    """Name, verdict and error before of each row, as they stand in the file."""
    with open(path, encoding="utf-8") as file:
        return [(plain(m.group(1)), plain(m.group(2)).split("\t"))
                for m in re.finditer(r'<tr><th scope="row">(.*?)</th>(.*)</tr>', file.read().replace("</td><td>", "\t"))]


def index(browser, path):
    look_everywhere(browser, path)
    tidy(path)
    rows = rows_in_file(path)
    with Page(browser, path, 1600, 1000) as page:
        expect(page.ask(NAMES)[:50] == [name for name, _ in rows][:50], f"{path}: not in the order of the file")
        expect(page.ask("document.getElementById('count').textContent") == f"{len(rows)} of {len(rows)} lines", f"{path}: counts are off")
        timing = time_index(page, path, rows)
        filters(page, path, rows)
        page.look()
        expect(not page.faults, f"{path}: {page.faults}")
        print(f"{path}: {len(rows)} rows, {os.path.getsize(path) / 1e6:.1f} MB, ready in {page.seconds:.2f} s of CPU, " + timing)
    with Page(browser, path, script=False) as page:
        root = page.call("DOM.getDocument", depth=0)["root"]["nodeId"]
        source = page.call("DOM.getOuterHTML", nodeId=root)["outerHTML"]
        expect(source.count("<tr>") == len(rows) + 1, f"{path}: without script, {source.count('<tr>') - 1} of {len(rows)} rows")
        box = page.call("DOM.getBoxModel", nodeId=find(page, root, "#lines tbody tr"))["model"]
        expect(box["height"] > 0, f"{path}: without script, the rows are hidden")


# An action, until the frame that shows it.
SHOWN = "new Promise(done => { %s; requestAnimationFrame(() => setTimeout(done)); })"


def time_index(page, path, rows):
    actions = {"sort": "document.querySelectorAll('#lines thead button')[5].click()",
               "sort by name": "document.querySelectorAll('#lines thead button')[0].click()",
               "search": "document.getElementById('search').value = 'leak'; document.getElementById('search').dispatchEvent(new Event('input'))",
               "reset": "document.querySelector('#controls [type=reset]').click()"}
    told = []
    for name, action in actions.items():
        before = page.computed()
        page.ask(SHOWN % action)
        seconds = page.computed() - before
        told.append(f"{name} {1e3 * seconds:.0f} ms")
        expect(seconds < 1.0, f"{path}: {name} takes {seconds:.2f} s of CPU")
    expect(page.seconds < 1 + len(rows) / 2000, f"{path}: {page.seconds:.1f} s of CPU until it is there")
    return ", ".join(told)


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def filters(page, path, rows):
    # by error, largest first, by a click; smallest first by the keyboard
    errors = sorted((number(cells[4]) for _, cells in rows if number(cells[4]) is not None), reverse=True)
    column = "[...document.querySelectorAll('#lines tbody tr')].map(r => r.cells[5].textContent).filter(t => t).map(Number)"
    page.ask("document.querySelectorAll('#lines thead button')[5].scrollIntoView()")
    at = page.ask("(() => { const b = document.querySelectorAll('#lines thead button')[5].getBoundingClientRect(); return [b.x + 5, b.y + b.height / 2]; })()")
    page.click(*at)
    expect(page.ask(column)[:100] == errors[:100], f"{path}: not sorted by error")
    expect(page.ask("document.querySelectorAll('#lines thead th')[5].getAttribute('aria-sort')") == "descending", f"{path}: aria-sort")
    page.ask("document.querySelectorAll('#lines thead button')[5].focus()")
    page.key("Enter", "Enter", "\r")
    expect(page.ask(column)[:100] == errors[::-1][:100], f"{path}: not sorted the other way by the keyboard")
    page.ask("document.querySelector('#controls [type=reset]').click()")
    page.ask("new Promise(r => setTimeout(r, 50))")
    # verdict
    for verdict in sorted({cells[0] for _, cells in rows}):
        page.ask(f"""(() => {{ const v = document.getElementById("verdict"); v.value = "{verdict}"; v.dispatchEvent(new Event("input")); }})()""")
        names = [name for name, cells in rows if cells[0] == verdict]
        expect(page.ask(NAMES) == names[:200] or page.ask(NAMES)[:200] == names[:200], f"{path}: filter {verdict}")
    page.ask("document.querySelector('#controls [type=reset]').click()")
    page.ask("new Promise(r => setTimeout(r, 50))")
    # search for a whole name
    page.ask("document.getElementById('search').focus()")
    page.call("Input.insertText", text=rows[-1][0])
    expect(rows[-1][0] in page.ask(NAMES), f"{path}: {rows[-1][0]} is not found")
    page.ask("document.querySelector('#controls [type=reset]').click()")
    page.ask("new Promise(r => setTimeout(r, 50))")


# ---- Names that try to be code ----

# Whatever waits for an event gets it.
PROVOKE = """
  for (const e of document.querySelectorAll("*"))
    for (const kind of ["load", "error", "focus", "mouseover", "toggle", "animationend"]) e.dispatchEvent(new Event(kind))"""
LINKS = """[...document.querySelectorAll("a, area")].map(a => a.protocol).filter(p => p !== "file:" && p !== "https:")"""


def hostile(browser, listed):
    with open(listed, encoding="utf-8") as file:
        paths = file.read().splitlines()
    expect(paths, f"{listed}: no page")
    for path in paths:
        with Page(browser, path) as page:
            page.ask(PROVOKE)
            expect(page.ask("typeof window.hit") == "undefined", f"{path}: a name was run")
            expect(not page.ask(LINKS), f"{path}: links {page.ask(LINKS)}")
            page.look()
            expect(not page.faults, f"{path}: {page.faults}")
    print(f"{len(paths):7d} pages opened in a browser")


def main(kind, paths):
    browser = Browser()
    try:
        for path in paths:
            {"report": report, "index": index, "hostile": hostile}[kind](browser, path)
    finally:
        browser.close()
    for line in wrong:
        print(line)
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
