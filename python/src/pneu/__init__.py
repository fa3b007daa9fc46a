"""Is a pneumatic actuator as its sheet says, and what does its model lack?

>>> rig = pneu.Rig.read("rig.cfg")
>>> answer = pneu.closeloop(rig, "fit.csv", holdout="holdout.csv")
>>> print(answer)

Units stand in the names of columns ("p [kPa]") and in the texts of a rig file, in any form that UDUNITS-2 reads.
"""

from __future__ import annotations

import html
import io
import json
import os
import threading
from pathlib import Path
from typing import Any, Callable, Iterable, Optional, Union

import pandas as pd

from . import _files
from ._library import DataError, Error, NumericalError, Texts, UsageError, WorldError, call, ffi, lab, take, text_of
from ._library import version as __version__

__all__ = ["Answer", "DataError", "Error", "Log", "NumericalError", "Rig", "UsageError", "WorldError", "closeloop", "read",
           "simulate"]


class Rig:
    """What is declared of an actuator, as the text of a rig file.

    Attributes:
        text: the rig file.
        name: what messages call it.
    """

    def __init__(self, text: str, name: str = "rig.cfg"):
        self.text = text
        self.name = name

    @classmethod
    def read(cls, path: Union[str, os.PathLike]) -> Rig:
        """Read a rig file.

        Raises:
            DataError: there is none, or it is no text.
        """
        try:
            return cls(_files.load(path).decode(), os.path.basename(path))
        except UnicodeDecodeError as error:
            raise DataError(f"{path}: expected text in UTF-8") from error

    @classmethod
    def from_sheet(cls, log: LogLike, **sheet: str) -> Rig:
        """Draft the rig of a log from the words of a data sheet; the rest is derived from the log or a default.

        Args:
            log: the log that the rig is for, which says what can be fitted.
            sheet: keys of a rig file or words of a sheet with their units: area="400 cm2", stroke="20 mm",
                bench_set="0.2..1.0 bar", Kv="0.1", ...

        Returns:
            A rig file in which each line has a comment on where its value comes from.

        Raises:
            UsageError: a word that is none.
            DataError: the log cannot be read, or the sheet contradicts itself.
        """
        given = Texts([read(log)._named()])
        words = [ffi.new("char[]", f"{key}={value}".encode()) for key, value in sheet.items()]
        out = ffi.new("char **")
        call(lab.lab_api_draft, given.array, ffi.new("char *[]", words or [ffi.NULL]), len(words), out)
        return cls(take(out[0]))

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Write the rig file."""
        Path(path).write_text(self.text, encoding="utf-8")

    def __repr__(self) -> str:
        return f"Rig({self.name!r})"

    def __str__(self) -> str:
        return self.text

    def _named(self):
        return self.name, self.text.encode()


class Log:
    """A log as text, in any form that closeloop reads.

    Attributes:
        data: the text, as bytes.
        name: what messages call it.
    """

    def __init__(self, data: bytes, name: str):
        self.data = data
        self.name = name

    def to_frame(self) -> pd.DataFrame:
        """The table, for a log with commas and one line of names; columns as they are named there."""
        return pd.read_csv(io.BytesIO(self.data), comment="#", skipinitialspace=True)

    def __repr__(self) -> str:
        return f"Log({self.name!r}, {len(self.data)} bytes)"

    def _named(self):
        return self.name, self.data


LogLike = Union[str, os.PathLike, pd.DataFrame, Log]


def read(source: LogLike, name: Optional[str] = None) -> Log:
    """Read a log.

    Args:
        source: path of a file that a logger wrote (CSV in any dialect, .gz, .xlsx, Parquet, MAT, HDF5, TDMS, MDF), or a
            frame with a row for each instant and columns named with units: "t [s]", "u [1]", "p [kPa]", "x [mm]".
        name: what messages call it; by default that of the file.

    Raises:
        DataError: there is no such file, or it needs a package that is not installed.
    """
    if isinstance(source, Log):
        return Log(source.data, name or source.name)
    if isinstance(source, pd.DataFrame):
        return Log(_files.csv_of_frame(source), name or "frame")
    name = name or os.path.basename(source)
    return Log(_files.csv_of(name, _files.load(source)), name)


def _named_apart(kind: str, logs) -> list:
    """Logs of one name get a number each."""
    if isinstance(logs, (str, os.PathLike, pd.DataFrame, Log)):
        logs = [logs]
    read_in = [read(log) for log in logs]
    names = [log.name for log in read_in]
    return [(f"{kind} {i + 1}: {log.name}" if names.count(log.name) > 1 or log.name == "frame" else log.name, log.data)
            for i, log in enumerate(read_in)]


def simulate(rig: Rig, log: Optional[LogLike] = None) -> pd.DataFrame:
    """What a model predicts.

    Args:
        rig: the model.
        log: what drives it, and the instants of the rows; None: 15 s of filling and 15 s of venting.

    Returns:
        A frame with columns "t [s]", "u [1]", and those of "p [kPa]", "x [mm]", "T [K]" that the log measures (both of
        the first two where it measures nothing).

    Raises:
        DataError: rig or log is at fault.
        NumericalError: the model cannot be followed.
    """
    given = Texts([rig._named()] + ([] if log is None else [read(log)._named()]))
    out = ffi.new("char **")
    call(lab.lab_api_simulate, given.array, ffi.NULL if log is None else given.array + 1, out)
    return pd.read_csv(io.StringIO(take(out[0])))


class Answer:
    """What closeloop answers.

    Attributes:
        sentence: the answer in words.
        report: all of it, as in report.json.
        html: the page.
        model: the completed model.
        residual: measured and predicted, row by row.
    """

    def __init__(self, sentence: str, report: dict, page: str, model: Rig, residual: pd.DataFrame):
        self.sentence = sentence
        self.report = report
        self.html = page
        self.model = model
        self.residual = residual

    @property
    def verdict(self) -> str:
        """ "effect", "none", "unlisted" or "undecided"."""
        return self.report["verdict"]

    @property
    def condition(self) -> str:
        """ "as declared", "deviates" or "cannot tell"; with a baseline "unchanged", "changed" or "cannot tell"."""
        return self.report["condition"]

    @property
    def found(self) -> list[str]:
        """Names of the effects that are missing from the declared model."""
        return [found["effect"] for found in self.report["found"]]

    def to_frame(self) -> pd.DataFrame:
        """Every parameter that was fitted: value, unit, and the ends of its 95 % interval."""
        rows = {
            name: {"value": p["value"], "unit": p["unit"], "low": p["ci95"][0], "high": p["ci95"][1]}
            for name, p in self.report["parameters"].items()
        }
        return pd.DataFrame.from_dict(rows, orient="index", columns=["value", "unit", "low", "high"])

    def save(self, folder: Union[str, os.PathLike]) -> None:
        """Write report.html, report.json, model.cfg and residual.csv into a folder, which is made."""
        into = Path(folder)
        into.mkdir(parents=True, exist_ok=True)
        (into / "report.html").write_text(self.html, encoding="utf-8")
        (into / "report.json").write_text(json.dumps(self.report, indent=1), encoding="utf-8")
        self.model.save(into / "model.cfg")
        self.residual.to_csv(into / "residual.csv", index=False)

    def __str__(self) -> str:
        return self.sentence

    def __repr__(self) -> str:
        return f"Answer({self.verdict!r}, found={self.found})"

    def _repr_html_(self) -> str:
        """In a notebook: the page in a frame of its own."""
        return f'<iframe srcdoc="{html.escape(self.html)}" style="width:100%;height:45em;border:0"></iframe>'


def _wait_for(work: Callable[[], None]) -> None:
    """Do it in a thread of its own, so that Ctrl-C arrives here and ends it."""
    failure: list[BaseException] = []
    done = threading.Event()

    def run():
        try:
            work()
        except BaseException as error:  # handed to the caller
            failure.append(error)
        finally:
            done.set()

    threading.Thread(target=run).start()
    try:
        while not done.wait(0.1):
            pass
    except BaseException:
        while not done.wait(0.1):
            lab.lab_api_stop()
        raise
    if failure:
        raise failure[0]


def closeloop(rig: Rig, logs: Union[LogLike, Iterable[LogLike]], holdout: Union[LogLike, Iterable[LogLike]] = (),
              baseline: Union[LogLike, Iterable[LogLike]] = (), *, budget: float = 60, alpha: float = 0.01,
              progress: Optional[Callable[[str], Any]] = None) -> Answer:
    """Fit the declared model, trace the residual to an effect that it lacks, add it, and judge.

    Args:
        rig: what is declared.
        logs: of the rig, to fit.
        holdout: logs to judge the completed model on, which it has not seen.
        baseline: logs of the rig as it was, to say what has changed since.
        budget: seconds of CPU, > 0, after which the best answer so far is given.
        alpha: chance of naming anything when nothing is missing, 0 < alpha <= 0.5.
        progress: told what is being done, in words.

    Raises:
        DataError: rig or logs are at fault.
        UsageError: an argument is out of its range.
        NumericalError: the declared model cannot be followed.
        KeyboardInterrupt: after Ctrl-C, within seconds.
    """
    for name, value, most in (("budget", budget, float("inf")), ("alpha", alpha, 0.5)):
        if not 0 < value <= most:
            raise UsageError(f"{name}: expected more than 0 and at most {most:g}, found {value!r}")
    given = [Texts([rig._named()])] + [
        Texts(_named_apart(kind, some)) for kind, some in (("log", logs), ("held out", holdout), ("baseline", baseline))]

    @ffi.callback("void(void *, const char *)")
    def on_progress(_, what):
        if progress:
            progress(text_of(what))

    request = ffi.new("lab_api_request *", {
        "rig": given[0].array[0],
        "log": given[1].array, "n_logs": given[1].n,
        "holdout": given[2].array, "n_holdout": given[2].n,
        "baseline": given[3].array, "n_baseline": given[3].n,
        "alpha": alpha, "budget": budget, "on_progress": on_progress})
    out = ffi.new("lab_api_answer *")
    _wait_for(lambda: call(lab.lab_api_closeloop, request, out))
    answer = Answer(text_of(out.sentence), json.loads(text_of(out.json)), text_of(out.html),
                    Rig(text_of(out.model), "model.cfg"), pd.read_csv(io.StringIO(text_of(out.residual)), comment="#"))
    lab.lab_api_free_answer(out)
    return answer
