"""The package as its users have it, from the project's root; closeloop and simulate of PROGRAMS say the same."""

import gzip
import json
import os
import re
import signal
import subprocess
import threading
from pathlib import Path

import pandas as pd
import pytest

import pneu

FOLDER = Path("study/guides/leak")
PROGRAMS = Path(os.environ.get("PROGRAMS", ".")).resolve()


@pytest.fixture(scope="module")
def rig():
    return pneu.Rig.read(FOLDER / "rig.cfg")


@pytest.fixture(scope="module")
def answer(rig):
    return pneu.closeloop(rig, FOLDER / "fit.csv", holdout=FOLDER / "holdout.csv")


def program(tmp_path, name, *arguments):
    subprocess.run([PROGRAMS / name, *arguments, "--quiet"], check=True, capture_output=True, cwd=".")
    return tmp_path


def test_version__is_that_of_the_header_and_the_package():
    header = Path("lib/pneu.h").read_text()
    numbers = [re.search(rf"PNEU_VERSION_{part} (\d+)", header)[1] for part in ("MAJOR", "MINOR", "PATCH")]
    assert pneu.__version__ == ".".join(numbers)
    assert f'version = "{pneu.__version__}"' in Path("python/pyproject.toml").read_text()


def test_closeloop__same_files__same_report_as_the_program(tmp_path, answer):
    program(tmp_path, "closeloop", FOLDER / "rig.cfg", FOLDER / "fit.csv", "--holdout", FOLDER / "holdout.csv", "--no-figures",
            "--out", tmp_path)
    want = json.loads((tmp_path / "report.json").read_text())
    got = dict(answer.report)
    for report in (want, got):
        report.pop("timing")
    assert got == want
    assert answer.model.text == (tmp_path / "model.cfg").read_text()
    assert answer.verdict == "effect" and answer.found == ["chamber_leak"] and answer.condition == "as declared"
    assert "The chamber leaks" in str(answer)


def test_answer__frames_and_page(tmp_path, answer):
    frame = answer.to_frame()
    leak = frame.loc["chamber_leak.leak_area"]
    assert leak["low"] < leak["value"] < leak["high"] and leak["unit"] == "m2"
    assert len(answer.residual) == len(pneu.read(FOLDER / "fit.csv").to_frame())
    assert answer._repr_html_().startswith("<iframe") and "&lt;/html&gt;" in answer._repr_html_()
    answer.save(tmp_path / "answer")
    assert sorted(p.name for p in (tmp_path / "answer").iterdir()) == ["model.cfg", "report.html", "report.json", "residual.csv"]


def test_simulate__log_and_step__as_the_program(tmp_path, rig):
    for given, arguments in ((FOLDER / "fit.csv", (FOLDER / "fit.csv",)), (None, ("--step",))):
        program(tmp_path, "simulate", FOLDER / "rig.cfg", *arguments, "--out", tmp_path / "s.csv")
        pd.testing.assert_frame_equal(pneu.simulate(rig, given), pd.read_csv(tmp_path / "s.csv"))


def test_from_sheet__words_of_a_sheet__stand_in_the_rig():
    drafted = pneu.Rig.from_sheet(FOLDER / "fit.csv", area="400 cm2", bench_set="0.2..1.0 bar")
    assert 'area = "400 cm2"; // sheet' in drafted.text and "from fit.csv" in drafted.text
    assert len(pneu.simulate(drafted)) == 3051
    with pytest.raises(pneu.UsageError, match="nearest"):
        pneu.Rig.from_sheet(FOLDER / "fit.csv", aera="400 cm2")


def test_errors__say_what_and_where(rig):
    with pytest.raises(pneu.DataError, match="nowhere.csv"):
        pneu.closeloop(rig, "nowhere.csv")
    with pytest.raises(pneu.DataError, match="area") as caught:
        pneu.simulate(pneu.Rig("actuator = {\n aera = 1;\n};\n"))
    assert caught.value.status == 1 and "rig.cfg:2" in caught.value.text
    with pytest.raises(pneu.UsageError, match="alpha"):
        pneu.closeloop(rig, FOLDER / "fit.csv", alpha=2)
    with pytest.raises(pneu.UsageError, match="logs"):
        pneu.closeloop(rig, [])


def test_closeloop__progress_and_ctrl_c(rig):
    told = []
    signal.signal(signal.SIGINT, signal.default_int_handler)  # which a parent in the background had ignored

    def interrupt(what):
        told.append(what)
        if len(told) == 2:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        pneu.closeloop(rig, FOLDER / "fit.csv", progress=interrupt)
    assert told[0] == "reading"
    assert threading.active_count() == 1


def _as_written(kind, frame, path):
    if kind == "gz":
        path.write_bytes(gzip.compress(frame.to_csv(index=False).encode()))
    elif kind == "xlsx":
        frame.to_excel(path, index=False)
    elif kind == "parquet":
        frame.to_parquet(path)
    elif kind == "mat":
        pytest.importorskip("scipy.io").savemat(path, {"log": {"t": frame.iloc[:, 0], "p": frame.iloc[:, 2]}, "by": "bench"})
    elif kind == "h5":
        with pytest.importorskip("h5py").File(path, "w") as file:
            file["log/t"], file["log/p"], file["gain"] = frame.iloc[:, 0], frame.iloc[:, 2], 2.0
    elif kind == "tdms":
        tdms = pytest.importorskip("nptdms")
        with tdms.TdmsWriter(str(path)) as writer:
            writer.write_segment([tdms.ChannelObject("log", name.split(" [")[0], frame[name].to_numpy(float),
                                                     {"unit_string": name.split("[")[1][:-1]}) for name in frame])
    elif kind == "mf4":
        mdf = pytest.importorskip("asammdf")
        signals = [mdf.Signal(frame[name].to_numpy(float), frame.iloc[:, 0].to_numpy(float), name=name.split(" [")[0],
                              unit=name.split("[")[1][:-1]) for name in frame.columns[1:]]
        with mdf.MDF() as file:
            file.append(signals)
            file.save(path)


@pytest.mark.parametrize("kind", ["gz", "xlsx", "parquet", "mat", "h5", "tdms", "mf4"])
def test_read__files_that_benches_write__same_numbers(tmp_path, kind):
    pytest.importorskip({"xlsx": "openpyxl", "parquet": "pyarrow", "mf4": "asammdf"}.get(kind, "pandas"))
    want = pneu.read(FOLDER / "fit.csv").to_frame().head(50)
    path = tmp_path / f"log.{kind}"
    _as_written(kind, want, path)
    got = pneu.read(path).to_frame()
    names = ["t", "p"] if kind in ("mat", "h5") else list(want.columns)
    assert sorted(got.columns) == sorted(names)
    source = {"t": want.columns[0], "p": want.columns[2]}
    for name in names:
        assert got[name].tolist() == pytest.approx(want[source.get(name, name)].tolist())


def test_read__frame__is_a_log(rig):
    frame = pneu.read(FOLDER / "fit.csv").to_frame()
    pd.testing.assert_frame_equal(pneu.simulate(rig, frame), pneu.simulate(rig, FOLDER / "fit.csv"))
    by_time = frame.set_index(frame.columns[0])
    pd.testing.assert_frame_equal(pneu.simulate(rig, by_time), pneu.simulate(rig, frame))


def test_notebook__runs():
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    book = nbformat.read("python/examples/leak.ipynb", as_version=4)
    nbclient.NotebookClient(book, timeout=300, resources={"metadata": {"path": "."}}).execute()
    said = "".join(out.get("text", "") for cell in book.cells for out in cell.get("outputs", []))
    assert "The chamber leaks" in said
