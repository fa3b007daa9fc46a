"""closeloop.html in a headless Chromium: prints what is wrong, a line each.

check_web.py page PAGE CLOSELOOP SIMULATE RIG...   layout, keyboard, draft, cancel, faults of input; then each folder RIG
check_web.py rigs PAGE CLOSELOOP SIMULATE RIG...   each folder with rig.cfg, fit.csv and perhaps holdout.csv alone
check_web.py look PAGE FOLDER RIG                  screenshots into FOLDER
What the native programs say of the same files is what the page must say. A rig ends with a line of how near it came.
"""
import json
import os
import subprocess
import sys
import tempfile
import time

from check import CLIPPED, CONTRAST, STRUCTURE
from chromium import Browser, Page

SAME = 1e-9    # a prediction: relative to the largest of its column
NEAR = 0.5     # a fitted value: of half its 95 % interval; a fit stops at a tolerance, which the last digit of a sum moves
FOLLOWED = 2   # error over noise; a model that does not follow the log, as where a stem sticks and slips, has many best fits
WAIT = 600     # [s]
wrong = []


def expect(good, words):
    if not good:
        wrong.append(words)


def give(page, *files):
    """Choose files, as in the dialogue that the browser opens."""
    root = page.call("DOM.getDocument", depth=0)["root"]["nodeId"]
    node = page.call("DOM.querySelector", nodeId=root, selector="#files")["nodeId"]
    page.call("DOM.setFileInputFiles", nodeId=node, files=[os.path.abspath(file) for file in files])
    count = len([file for file in files if not file.endswith(".cfg")])
    wait(page, f"logs.length === {count} && job === null && document.getElementById('rig').value !== ''")


def wait(page, condition, seconds=WAIT):
    end = time.monotonic() + seconds
    while not page.ask(condition):
        if time.monotonic() > end:
            raise TimeoutError(condition)
        time.sleep(0.1)


def run(page):
    page.ask("document.getElementById('run').click()")
    wait(page, "job === null")
    return page.ask("document.getElementById('error').textContent")


# ---- The page itself ----

def look_everywhere(browser, path):
    for width in (360, 800, 1600):
        for dark in (False, True):
            where = f"{path} at {width}, {'dark' if dark else 'light'}"
            with Page(browser, path, width, dark=dark) as page:
                page.ask("document.querySelectorAll('details').forEach(d => d.open = true)")
                wide = page.ask("document.scrollingElement.scrollWidth") - width
                expect(wide <= 0, f"{where}: {wide} px wider than the window")
                found = page.ask(CONTRAST)
                expect(not found["bad"], f"{where}: contrast: {json.dumps(found['bad'])[:300]}")
                for words in page.ask(CLIPPED):
                    expect(False, f"{where}: cut off: {words}")
                for fault in page.ask(STRUCTURE):
                    expect("iframe" in fault, f"{where}: {fault}")
                page.look()
                expect(not page.faults, f"{where}: {page.faults}")


def by_keyboard(browser, path, rig):
    """Tab reaches all that can be used, and Enter runs."""
    with Page(browser, path) as page:
        give(page, f"{rig}/rig.cfg", f"{rig}/fit.csv")
        reached = set()
        for _ in range(40):
            page.key("Tab")
            reached.add(page.ask("document.activeElement.id || document.activeElement.textContent"))
        for name in ("files", "Remove", "sheet-bench_set", "sheet-others", "rig", "draft", "save-rig", "run"):
            expect(name in reached, f"keyboard: Tab does not reach {name}: {reached}")
        page.ask("document.getElementById('run').focus()")
        page.key("Enter", text="\r")
        wait(page, "!document.getElementById('answer').hidden")
        expect(page.ask("document.activeElement.id") == "answer-head", "keyboard: the answer has not the focus")
        expect(page.ask("document.getElementById('report').srcdoc.includes('</html>')"), "there is no report in the frame")
        page.look()
        expect(not page.faults, f"a run: {page.faults}")


def drafts(browser, path, closeloop, rig):
    """The draft is that of --init, with the words of the sheet."""
    sheet = {"bench_set": "0.2..1.0 bar", "stroke": "20 mm", "Kv": "0.1"}
    words = [text for key, value in sheet.items() for text in ("--sheet", f"{key}={value}")]
    native = subprocess.run([closeloop, "--init", "fit.csv", *words], cwd=rig, check=True, capture_output=True, text=True).stdout
    with Page(browser, path) as page:
        give(page, f"{rig}/fit.csv")
        expect("NOT KNOWN" in page.ask("document.getElementById('rig').value"), "draft: a log alone gives none")
        for key, value in sheet.items():
            page.ask(f"{{ const i = document.getElementById('sheet-{key}'); i.value = {json.dumps(value)}; i.dispatchEvent(new Event('change')); }}")
            wait(page, "job === null")
        expect(page.ask("document.getElementById('rig').value") == native, "draft: not that of closeloop --init")
        page.ask("{ const i = document.getElementById('sheet-stroke'); i.value = '20 kg'; i.dispatchEvent(new Event('change')); }")
        wait(page, "job === null")
        expect("kg" in page.ask("document.getElementById('error').textContent"), "draft: a wrong unit is not told")


def cancels(browser, path, rig):
    """Cancel ends a run at once, and the next run is whole; a file can be dropped; one that is no log is told."""
    with Page(browser, path) as page:
        give(page, f"{rig}/rig.cfg", f"{rig}/fit.csv")
        page.ask("document.getElementById('run').click()")
        wait(page, "document.getElementById('status').textContent.includes('s)')")
        page.ask("document.getElementById('cancel').click()")
        expect(page.ask("document.getElementById('status').textContent") == "Cancelled.", "cancel: not told")
        expect(page.ask("job === null && !document.getElementById('run').disabled"), "cancel: the page is not ready again")
        expect(run(page) == "", "cancel: the next run fails")
        page.ask("""{ const data = new DataTransfer(); data.items.add(new File(['t [s],u [1],p [kPa]\\n0,0,zero\\n'], 'torn.csv'));
          document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true })); }""")
        wait(page, "logs.length === 2")
        expect("torn.csv:2" in run(page), "a torn log: its line is not told")
        page.look()
        expect(not page.faults, f"cancel: {page.faults}")


# ---- The same as the native programs ----

def native_answer(closeloop, rig, folder):
    holdout = ["--holdout", f"{rig}/holdout.csv"] if os.path.exists(f"{rig}/holdout.csv") else []
    begun = time.monotonic()
    subprocess.run([closeloop, f"{rig}/rig.cfg", f"{rig}/fit.csv", *holdout, "--out", folder, "--threads", "1", "--quiet",
                    "--no-figures"], check=True, stdout=subprocess.DEVNULL)
    with open(f"{folder}/report.json", encoding="utf-8") as file:
        return json.load(file), time.monotonic() - begun


def names(answer):
    return sorted(found["effect"] for found in answer["found"])


def off_by(here, there):
    """The largest difference of a fitted value, in half its 95 % interval."""
    most = 0
    for name, value in there["parameters"].items():
        low, high = value["ci95"]
        if name not in here["parameters"]:
            return float("inf")
        if high > low:
            most = max(most, abs(here["parameters"][name]["value"] - value["value"]) / ((high - low) / 2))
    return most


def is_followed(answer):
    return all(error["in_noise"] < FOLLOWED for error in answer["error"]["after"].values())


def errors_off_by(here, there):
    most = 0
    for part in ("before", "after"):
        for channel, value in there["error"][part].items():
            most = max(most, abs(here["error"][part][channel]["rmse"] / value["rmse"] - 1))
    return most


def numbers(csv):
    return [[float(cell) for cell in line.split(",")] for line in csv.strip().split("\n")[1:]]


def predictions_off_by(page, simulate, rig):
    """The largest difference of a prediction, of the largest value of its column."""
    native = numbers(subprocess.run([simulate, f"{rig}/rig.cfg", f"{rig}/fit.csv"], check=True, capture_output=True, text=True).stdout)
    text = page.ask("new Promise(done => start('simulate', found => done(found.prediction)))")
    here = numbers(text)
    expect(len(here) == len(native), f"{rig}: {len(here)} rows of prediction, {len(native)} by simulate")
    most = 0
    for mine, theirs in zip(zip(*here), zip(*native)):
        scale = max(map(abs, theirs)) or 1
        most = max(most, max(abs(a - b) for a, b in zip(mine, theirs)) / scale)
    return most


def same_as_native(browser, path, closeloop, simulate, rig):
    with tempfile.TemporaryDirectory() as folder:
        there, native = native_answer(closeloop, rig, folder)
    name = os.path.basename(rig.rstrip("/"))
    with Page(browser, path) as page:
        give(page, *[f"{rig}/{file}" for file in ("rig.cfg", "fit.csv", "holdout.csv") if os.path.exists(f"{rig}/{file}")])
        begun = time.monotonic()
        fault = run(page)
        seconds = time.monotonic() - begun
        if fault:
            expect(False, f"{name}: {fault}")
            return
        here = json.loads(page.ask("answer.json"))
        prediction = predictions_off_by(page, simulate, rig)
        page.look()
        expect(not page.faults, f"{name}: {page.faults}")
    for key in ("verdict", "condition"):
        expect(here[key] == there[key], f"{name}: {key} {here[key]}, native {there[key]}")
    expect(names(here) == names(there), f"{name}: found {names(here)}, native {names(there)}")
    fitted = off_by(here, there)
    expect(fitted < NEAR or not is_followed(there), f"{name}: a fitted value is {fitted:.2g} of half its interval away from the native one")
    expect(prediction < SAME, f"{name}: a prediction differs by {prediction:.2g}")
    print(f"{name:16} {here['verdict']:10} predictions {prediction:.1e}, errors {errors_off_by(here, there):.1e}, fitted values {fitted:.1e} "
          f"of half an interval; {seconds:.1f} s, native {native:.1f} s", flush=True)


# ---- To look at ----

def look(browser, path, folder, rig):
    for width in (360, 1600):
        for dark in (False, True):
            with Page(browser, path, width, dark=dark) as page:
                shot = f"{folder}/web-{width}-{'dark' if dark else 'light'}"
                page.screenshot(shot + "-empty.png")
                give(page, f"{rig}/fit.csv", f"{rig}/holdout.csv")
                run(page)
                time.sleep(1)
                page.screenshot(shot + ".png")


def main():
    what, path, *rest = sys.argv[1:]
    browser = Browser()
    try:
        if what == "look":
            look(browser, path, *rest)
            return
        closeloop, simulate, *rigs = map(os.path.abspath, rest)
        if what == "page":
            look_everywhere(browser, path)
            by_keyboard(browser, path, rigs[0])
            drafts(browser, path, closeloop, rigs[0])
            cancels(browser, path, rigs[0])
        for rig in rigs:
            same_as_native(browser, path, closeloop, simulate, rig)
    finally:
        browser.close()
    for words in wrong:
        print("FAILED  web:", words)
    sys.exit(1 if wrong else 0)


main()
