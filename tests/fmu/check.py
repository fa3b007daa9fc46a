#!/usr/bin/env python3
"""Exported FMUs by FMPy: valid, and the same answers as without an FMU.

  check.py VENV SCRATCH NATIVE CC      NATIVE: tests/fmu/native, built

Installs FMPy from PyPI into VENV at the first time; ends with status 3 where that cannot be.
"""
import contextlib
import ctypes
import io
import os
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

PACKAGES = ["FMPy==0.3.32", "numpy==2.4.6"]


def in_venv(folder):
    """Go on in the virtual environment, which is made if it is not there."""
    python = Path(folder).absolute() / "bin" / "python"
    ready = Path(folder) / "ready"
    try:
        if not ready.exists():
            subprocess.run([sys.executable, "-m", "venv", folder], check=True, stdout=subprocess.DEVNULL)
            subprocess.run([python, "-m", "pip", "install", "--quiet", *PACKAGES], check=True)
            ready.touch()
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"absent: FMPy: {error}", file=sys.stderr)
        sys.exit(3)
    if Path(sys.prefix).resolve() != Path(folder).resolve():
        os.execv(python, [str(python), *sys.argv])


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    in_venv(sys.argv[1])

import numpy as np  # noqa: E402
from fmpy import extract, read_model_description, simulate_fmu  # noqa: E402
from fmpy.fmi1 import FMICallException  # noqa: E402
from fmpy.fmi2 import FMU2Model, FMU2Slave  # noqa: E402
from fmpy.fmi3 import FMU3Model, FMU3Slave  # noqa: E402
from fmpy.validation import validate_fmu  # noqa: E402

SCRATCH = Path(sys.argv[2]).absolute()
NATIVE = sys.argv[3]
CC = sys.argv[4]
VERSIONS = (2, 3)
WANTED = 1e-6  # of stroke
WANTED_WARMTH = 1e-5  # of absolute temperature, which changes by 1e4 K/s when a chamber begins to fill
KINDS = ("ModelExchange", "CoSimulation")
TOLERANCE = {"ModelExchange": 5e-10, "CoSimulation": 1e-10}
# FMPy's CVode may take 500 steps between two outputs: one in two is compared.
INTERVAL = {"ModelExchange": 0.005, "CoSimulation": 0.01}
COMMANDS = np.array(
    [(0, 0), (0.5, 0), (0.5, 1), (15.5, 1), (15.5, -1), (40, -1)], dtype=[("time", np.float64), ("u", np.float64)]
)

EFFECTS = """effects = { chamber_leak = { leak_area = "0.02 mm^2"; }; dead_time = { dead_time = "0.0237 s"; };
  transducer_lag = { transducer_time = "0.01 s"; }; heat_transfer = { film_resistance = "0.5 K/W"; };
  stribeck_friction = { stribeck_excess = "0.05"; stribeck_velocity = "20 mm/s"; }; spring_hysteresis = { hysteresis_force = "60 N"; };
  pressure_lag = { pressure_time = "0.02 s"; }; position_bias = { position_bias = "0.1 mm"; };
  vent_restriction = { vent_restriction = "0.15"; }; };\n"""
LUGRE = """effects = { presliding = { presliding_length = "0.05 mm"; }; connecting_tube = { tube_resistance = "1e7 Pa.s/kg"; };
  stop_compliance = { stop_compliance = "1e-8 m/N"; }; };\n"""
LAGS = """effects = { chamber_leak = { leak_area = "0.02 mm^2"; }; transducer_lag = { transducer_time = "0.01 s"; };
  heat_transfer = { film_resistance = "0.5 K/W"; }; pressure_lag = { pressure_time = "0.02 s"; }; };\n"""
STICK_SLIP = 'effects = { stribeck_friction = { stribeck_excess = "0.3"; }; };\n'
POSITIONER = """positioner = { gain = 20; dead_band = "1 %"; };
effects = { chamber_leak = { leak_area = "0.02 mm^2"; }; };\n"""
TERMS = """unlisted = (
  { equation = "friction"; argument = "x"; from = "0 mm"; to = "20 mm"; values = [ 0, 60, 150, 60, 0 ]; unit = "N"; },
  { equation = "force"; argument = "t"; from = "0 s"; to = "7 s"; values = [ 120, 80, 0, 40 ]; unit = "N"; } );\n"""

failed = 0
FOLDERS = {}


def check(what, good, figure=""):
    """One line for each check."""
    global failed
    failed += not good
    print(f"{'ok    ' if good else 'WRONG '} {what}{': ' if figure else ''}{figure}")


def refused(call, *arguments, **named):
    """Whether a call returns an error."""
    try:
        call(*arguments, **named)
    except FMICallException:
        return True
    return False


def alike(a, b):
    """Whether two lists of values are the same but for rounding."""
    return np.allclose(a, b, rtol=1e-9, atol=1e-12)


# ---- Models, FMUs, references ----


def model(name, actuator="r1-400", gas="isothermal", flow="paper", more=""):
    """A model file in SCRATCH."""
    text = Path(f"study/actuators/{actuator}.cfg").read_text()
    text = text.replace('gas = "isothermal"', f'gas = "{gas}"').replace('flow = "paper"', f'flow = "{flow}"')
    path = SCRATCH / f"{name}.cfg"
    path.write_text(text + more)
    return path


def export(path, version, name=None):
    fmu = SCRATCH / f"{name or path.stem}-{version}.fmu"
    subprocess.run(["./export-fmu", path, "--fmi", str(version), "--out", fmu], check=True)
    return str(fmu)


def native(path, tolerance=1e-10, log=()):
    out = subprocess.run([NATIVE, path, str(tolerance), *log], check=True, capture_output=True, text=True).stdout
    return np.array([[float(cell) for cell in line.split(",")] for line in out.splitlines()])


def stroke_of(fmu):
    return next(float(v.start) for v in read_model_description(fmu).modelVariables if v.name == "stroke")


def standard(fmu, kind):
    """The standard experiment, at the times of the reference."""
    with contextlib.redirect_stdout(None):  # it warns of inputs that keep their start values
        result = simulate_fmu(
            fmu,
            fmi_type=kind,
            start_time=0,
            stop_time=30.5,
            output_interval=INTERVAL[kind],
            relative_tolerance=TOLERANCE[kind],
            input=COMMANDS,
            record_events=False,
            output=["shown_position", "shown_pressure", "shown_temperature", "mode"],
        )
    return result[:: round(0.01 / INTERVAL[kind])]


def slips_in(mode):
    return np.count_nonzero(np.diff((mode == 1).astype(int)) == 1)


def deviation(result, reference, stroke):
    return np.abs(result["shown_position"] - reference[:, 2]).max() / stroke


class Instance:
    """An FMU with its functions under one name for both versions, by names of variables."""

    def __init__(self, fmu, kind="CoSimulation", token=None):
        self.description = read_model_description(fmu)
        self.version = int(self.description.fmiVersion[0])
        folder = FOLDERS.setdefault(fmu, SCRATCH / (Path(fmu).stem + ".folder"))
        if not folder.exists():  # never over a library that is loaded
            extract(fmu, str(folder))
        self.reference = {v.name: v.valueReference for v in self.description.modelVariables}
        interface = self.description.coSimulation if kind == "CoSimulation" else self.description.modelExchange
        make = {
            (2, "CoSimulation"): FMU2Slave,
            (2, "ModelExchange"): FMU2Model,
            (3, "CoSimulation"): FMU3Slave,
            (3, "ModelExchange"): FMU3Model,
        }[self.version, kind]
        self.fmu = make(
            guid=token or self.description.guid,
            instanceName="test",
            unzipDirectory=str(folder),
            modelIdentifier=interface.modelIdentifier,
        )
        self.fmu.instantiate()

    def initialize(self, tolerance=1e-10, **values):
        if self.version == 2:
            self.fmu.setupExperiment(tolerance=tolerance, startTime=0.0)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(tolerance=tolerance, startTime=0.0)
        self.set(**values)
        self.fmu.exitInitializationMode()
        return self

    def set(self, **values):
        for name, value in values.items():
            name = name.replace("__", ".")
            (self.fmu.setReal if self.version == 2 else self.fmu.setFloat64)([self.reference[name]], [value])

    def get(self, *names):
        references = [self.reference[name] for name in names]
        return (self.fmu.getReal if self.version == 2 else self.fmu.getFloat64)(references)

    def slope(self, name, value, order=1):
        """FMI 2 alone."""
        one = (ctypes.c_uint * 1)(self.reference[name]), 1, (ctypes.c_int * 1)(order), (ctypes.c_double * 1)(value)
        self.fmu.fmi2SetRealInputDerivatives(self.fmu.component, *one)

    def step(self, t, h):
        self.fmu.doStep(currentCommunicationPoint=t, communicationStepSize=h)

    def run(self, t, end, n):
        """n equal steps; what is seen at the end."""
        for i in range(n):
            self.step(t + (end - t) * i / n, (end - t) / n)
        return self.get("pressure", "temperature", "position", "velocity")

    def save(self):
        return self.fmu.getFMUState() if self.version == 3 else self.fmu.getFMUstate()

    def restore(self, state):
        (self.fmu.setFMUState if self.version == 3 else self.fmu.setFMUstate)(state)

    def serialize(self, state):
        return self.fmu.serializeFMUState(state) if self.version == 3 else self.fmu.serializeFMUstate(state)

    def deserialize(self, content):
        return self.fmu.deserializeFMUState(content) if self.version == 3 else self.fmu.deSerializeFMUstate(content)

    def forget(self, state):
        (self.fmu.freeFMUState if self.version == 3 else self.fmu.freeFMUstate)(state)

    def whole(self, name):
        return (self.fmu.getInteger if self.version == 2 else self.fmu.getInt32)([self.reference[name]])[0]

    def update(self):
        """What an importer does at an event of model exchange, but for entering event mode.  Returns: next time, or None"""
        event = (self.fmu.newDiscreteStates if self.version == 2 else self.fmu.updateDiscreteStates)()
        self.fmu.enterContinuousTimeMode()
        return event[5] if event[4] else None

    def step_done(self, t, **values):
        """The end of an integrator's step.  Returns: whether it asks for event mode"""
        self.fmu.setTime(t)
        self.set(**values)
        return bool(self.fmu.completedIntegratorStep()[0])

    def derivative(self, unknown, seeds):
        """Along seeds by name, of unknowns by name."""
        refs = [self.reference[n] for n in unknown], [self.reference[n] for n in seeds]
        if self.version == 2:
            return self.fmu.getDirectionalDerivative(*refs, list(seeds.values()))
        return self.fmu.getDirectionalDerivative(unknowns=refs[0], knowns=refs[1], seed=list(seeds.values()), nSensitivity=len(unknown))

    def put(self, names, values):
        """Continuous states by name, in their order."""
        self.fmu.setContinuousStates((ctypes.c_double * len(names))(*values), len(names))

    def close(self):
        self.fmu.freeInstance()


# ---- Checks ----


def on_bristles(mode, reference):
    """Where a stem rests on bristles, which never stick: whether it slides up or down is rounding there."""
    up, down = 2, 3
    rests = np.abs(np.gradient(reference[:, 2], reference[:, 0])) < 1e-6
    return rests & np.isin(mode, (up, down)) & np.isin(reference[:, 4], (up, down))


def check_agreement():
    cases = [
        (f"{actuator} {gas} {flow}", model(f"{actuator}-{gas}-{flow}", actuator, gas, flow))
        for actuator in ("r1-400", "37-13")
        for gas in ("isothermal", "energy")
        for flow in ("paper", "choked")
    ]
    cases += [
        ("several effects", model("effects", flow="choked", more=EFFECTS)),
        ("LuGre friction, tube, soft stops", model("lugre", flow="iso6358", more=LUGRE)),
        ("stick and slip", model("slips", flow="choked", more=STICK_SLIP)),
        ("free terms", model("terms", gas="polytropic", flow="choked", more=TERMS)),
    ]
    worst = {}
    for name, path in cases:
        reference = native(path)
        for version in VERSIONS:
            fmu = export(path, version)
            problems = validate_fmu(fmu)
            check(f"{name}, FMI {version}: valid", not problems, "; ".join(problems))
            for kind in KINDS:
                what = f"{name}, FMI {version}, {kind}"
                result = standard(fmu, kind)
                error = deviation(result, reference, stroke_of(fmu))
                warmth = np.abs(result["shown_temperature"] / reference[:, 3] - 1).max()
                check(f"{what}: temperature", warmth <= WANTED_WARMTH, f"{warmth:.1e} of itself")
                wrong = np.count_nonzero((result["mode"] != reference[:, 4]) & ~on_bristles(result["mode"], reference))
                check(f"{what}: modes", wrong <= 2, f"{wrong} of {len(reference)} rows differ")
                if name == "stick and slip" and kind == "ModelExchange":
                    # each slip begins where the last one ended: errors grow a thousandfold, those of CVODE without an FMU too
                    alone = native(path, TOLERANCE[kind], ["cvode"])
                    usual = np.abs(alone[:, 2] - reference[:, 2]).max() / stroke_of(fmu)
                    slips, wanted = slips_in(result["mode"]), slips_in(reference[:, 4])
                    check(f"{what}: as CVODE without an FMU", error <= 1.5 * usual, f"{error:.1e} and {usual:.1e} of stroke")
                    check(f"{what}: every slip", slips == wanted > 100, f"{slips} of {wanted}")
                else:
                    check(what, error <= WANTED, f"{error:.1e} of stroke")
                    worst[version, kind] = max(error, worst.get((version, kind), 0))
    for (version, kind), error in sorted(worst.items()):
        print(f"worst FMI {version} {kind}: {error:.1e} of stroke")


def check_loop():
    """A dead time has three states in the loop of a positioner, each with a name, and none without; there it can be set."""
    names = {}
    for version in VERSIONS:
        for loop in ("positioner = { gain = 20; };\n", ""):
            fmu = export(model(f"late-{len(loop)}", more=loop + "effects = { dead_time = { dead_time = \"0.03 s\"; }; };\n"), version)
            problems = validate_fmu(fmu)
            check(f"a late loop, FMI {version}: valid", not problems, "; ".join(problems))
            names[loop] = [v.name for v in read_model_description(fmu).modelVariables if v.name.startswith("dead_time.")]
        loop, alone = names.values()
        check(f"a late loop, FMI {version}: states", len(loop) == 4 and len(set(loop)) == 4 and alone == ["dead_time.dead_time"],
              " ".join(loop + alone))


# Models driven by pressure, by position or by both: study files, and the R1-400 with more to it.
PUMPED = """effects = { heat_transfer = { film_resistance = "0.5 K/W"; }; stribeck_friction = { stribeck_excess = "0.05";
  stribeck_velocity = "20 mm/s"; }; presliding = { presliding_length = "0.05 mm"; }; dead_time = { dead_time = "0.05 s"; }; };\n"""
RECORDS = (
    ("soft-bellows-pressure-position", "soft-bellows-pressure-position/16067V.txt"),
    ("printed-cylinder-o-ring", "printed-cylinder-friction-leak/friction/O-ring257_3bar.csv"),
    ("tube-fill", "tube-fill-vent-pneuact/Fig6_data/tube_l3_p4_start.csv"),
    ("tube-vent", "tube-fill-vent-pneuact/Fig6_data/tube_l3_p4_end.csv"),
    ("damadics-servomotor-static-step", "damadics-servomotor-static-step/static_hysteresis_fig5.csv"),
)
LOOP = "study/schedules/pressure-loop.csv"


def turns(t, low, high, period):
    """A line up and down between two values, with a rest at either end."""
    return low + (high - low) * np.clip(1.5 - 2.5 * np.abs((t / period + 0.9) % 2 - 1), 0, 1)


def driven_model(path, name, inputs=None):
    """A model file without what concerns its log alone, and other inputs if asked for."""
    text = Path(path).read_text()
    text = text[: text.find("\nlog = {") + 1 or None]
    text = "".join(line for line in text.splitlines(True) if not line.startswith(("fit ", "noise ")))
    if inputs:
        text = "".join(line for line in text.splitlines(True) if not line.startswith("inputs "))
        text += f"inputs = ( {inputs} );\n"
    out = SCRATCH / f"{name}.cfg"
    out.write_text(text)
    return out


def driven_cases():
    """Names, model files and logs: times, command, supply, pressure [kPa], position [mm]."""
    t = np.arange(0, 401) * 0.05
    command = np.sign(np.sin(t / 2 + 0.1)) * (np.abs(np.sin(t / 2 + 0.1)) > 0.5)
    for name, low, high in (("damadics-servomotor-static-step", 0, 140), ("soft-bellows-pressure-position", 0, 60)):
        yield name, driven_model(f"study/measured/{name}.cfg", name), (t, command, 400, turns(t, low, high, 7), None)
    for seal in ("o-ring", "x-ring", "napn"):
        path = driven_model(f"study/measured/printed-cylinder-{seal}.cfg", seal)
        yield f"printed cylinder, {seal}", path, (t, command, 400, turns(t, 0, 500, 9), turns(t, 5, 45, 4))
    for name in ("tube-fill", "tube-vent"):
        yield name, driven_model(f"study/measured/{name}.cfg", name), (t / 10, command, 300, 0 * t, 0 * t + 500)
    loop = np.genfromtxt(LOOP, delimiter=",", comments="#", skip_header=4)
    slow = np.arange(0, 1086.0)
    path = driven_model("study/schedules/r1-400-pressure.cfg", "loop")
    yield "pressure-loop.csv", path, (slow, 0 * slow, 400, np.interp(slow, *loop.T), None)
    for gas in ("isothermal", "energy"):
        for flow in ("paper", "choked"):
            path = driven_model(model(f"driven-{gas}-{flow}", gas=gas, flow=flow), f"driven-{gas}-{flow}", '"u", "x"')
            yield f"driven stem {gas} {flow}", path, (t, command, 400, 0 * t, turns(t, 2, 18, 1.3))
    path = driven_model(model("pumped", flow="choked", more=PUMPED), "pumped", '"u", "x"')
    yield "driven stem, effects", path, (t, command, 400, 0 * t, turns(t, 3, 21, 1.3))
    path = model("dead-band", flow="choked", more=POSITIONER)
    yield "dead band of a positioner", path, (t, 0.5 + 0.3 * command, 400, None, None)


def write_log(path, columns):
    """A log of what is not None."""
    t, *_ = columns
    words = ("t [s]", "sp [1]" if path.stem == "dead-band" else "u [1]", "ps [kPa]", "p [kPa]", "x [mm]")
    there = [(word, c + 0 * t) for word, c in zip(words, columns) if c is not None]
    rows = [",".join(word for word, _ in there)]
    rows += [",".join(f"{value:.17g}" for value in row) for row in zip(*(c for _, c in there))]
    path.write_text("\n".join(rows) + "\n")


def signals(names, reference, every=False):
    """What drives the model, as FMPy has it: two rows where anything jumps or turns, or at all times."""
    t, p, x = reference[:, 0], reference[:, 1], reference[:, 2]
    values = {"pressure": p, "position": x, "u": reference[:, 6], "supply": reference[:, 7]}
    values.update(pressure_rate=reference[:, 8], velocity=reference[:, 9])
    held = ("u", "supply", "pressure_rate", "velocity")
    rows = []
    for i in range(len(t)):
        if i and all(values[n][i] == values[n][i - 1] for n in held) and i + 1 < len(t) and not every:
            continue
        if i:
            rows.append((t[i], *(values[n][i - 1 if n in held else i] for n in names)))
        rows.append((t[i], *(values[n][i] for n in names)))
    return np.array(rows, dtype=[(n, np.float64) for n in ("time", *names)])


def always(t, recorder):
    """For simulate_fmu: record at the ends of all steps."""
    recorder.sample(t, force=True)
    return True


def driven_errors(fmu, kind, reference, **how):
    """Differences of position, pressure and, where it is an output, holding force; in shares of full scale."""
    variables = {v.name: v for v in read_model_description(fmu).modelVariables}
    names = [v.name for v in variables.values() if v.causality == "input" and v.name != "force"]
    first = dict(start_pressure=reference[0, 1], start_position=reference[0, 2], start_temperature=reference[0, 3])
    t = reference[:, 0]
    with contextlib.redirect_stdout(None):
        result = simulate_fmu(
            fmu,
            fmi_type=kind,
            start_time=t[0],
            stop_time=t[-1],
            relative_tolerance=TOLERANCE[kind],
            input=signals(names, reference, "step_finished" in how),
            start_values={n: v for n, v in first.items() if n in variables},
            output=[n for n in ("shown_position", "shown_pressure", "holding_force") if n in variables],
            record_events=False,
            **how,
        )
    if "step_finished" in how:
        result = result[np.searchsorted(result["time"], t - 1e-9 * (1 + t))]
    else:
        result = result[:: round((len(result) - 1) / (len(t) - 1))]
    scale = reference[:, 1].max() + 1e5
    errors = [
        np.abs(result["shown_position"] - reference[:, 2]).max() / float(variables["stroke"].start),
        np.abs(result["shown_pressure"] - reference[:, 1]).max() / scale,
    ]
    if "holding_force" in variables:  # where the inputs turn it has two values
        turns_here = np.any(np.diff(reference[:, 6:], axis=0, prepend=reference[:1, 6:]) != 0, axis=1)
        wrong = np.abs(result["holding_force"] - reference[:, 5]) / (float(variables["area"].start) * scale)
        errors.append(wrong[~turns_here].max())
    return errors


def check_driven():
    """Pressure or position as inputs: the same as without an FMU."""
    worst = {}
    for name, path, columns in driven_cases():
        log = SCRATCH / f"{path.stem}.csv"
        write_log(log, columns)
        reference = native(path, 1e-10, [log])
        for version in VERSIONS:
            fmu = export(path, version)
            problems = validate_fmu(fmu)
            check(f"{name}, FMI {version}: valid", not problems, "; ".join(problems))
            for kind, parts in (("ModelExchange", 10), ("CoSimulation", 1)):  # as for INTERVAL
                how = dict(output_interval=reference[1, 0] / parts)
                errors = driven_errors(fmu, kind, reference, **how)
                check(f"{name}, FMI {version}, {kind}", max(errors) <= WANTED, " ".join(f"{e:.1e}" for e in errors))
                worst[version, kind] = max(*errors, worst.get((version, kind), 0))
    for (version, kind), error in sorted(worst.items()):
        print(f"worst driven FMI {version} {kind}: {error:.1e} of full scale")


def check_measured():
    """The study's files as they are, driven by what was measured, where MEASURED has it."""
    for name, log in RECORDS:
        log = Path(os.environ.get("MEASURED", "nothere")) / log
        if not log.exists():
            print(f"absent: {log}")
            continue
        path = Path(f"study/measured/{name}.cfg")
        reference = native(path, 1e-10, [log])
        for version in VERSIONS:
            fmu = export(path, version)
            for kind in KINDS:
                how = dict(output_interval=(reference[-1, 0] - reference[0, 0]) / 5000, step_finished=always)
                errors = driven_errors(fmu, kind, reference, **how)
                check(f"{name}, {len(reference)} rows, FMI {version}, {kind}", max(errors) <= WANTED, " ".join(f"{e:.1e}" for e in errors))


def check_slopes():
    """What FMI itself has for slopes; and what comes of an input whose slope is not told."""
    path = SCRATCH / "damadics-servomotor-static-step.cfg"
    reference = native(path, 1e-10, [SCRATCH / "damadics-servomotor-static-step.csv"])
    for version, told, wanted in ((2, True, WANTED), (2, False, 0.05), (3, False, 0.05)):
        a = Instance(export(path, version))
        a.initialize(start_position=reference[0, 2], pressure=reference[0, 1])
        worst = 0
        for row, after in zip(reference[:-1], reference[1:]):
            a.set(pressure=row[1])
            if told:
                a.slope("pressure", row[8])
            a.step(row[0], after[0] - row[0])
            worst = max(worst, abs(a.get("shown_position")[0] - after[2]) / 0.04017645)
        what = "by fmi2SetRealInputDerivatives" if told else "untold: held for a step"
        check(f"FMI {version}: slope of pressure {what}", worst <= wanted, f"{worst:.1e} of stroke")
        if told:
            check("slope of an output, slope of a slope: refused", refused(a.slope, "shown_pressure", 1.0) and refused(a.slope, "pressure", 1.0, 2))
    for gas in ("energy", "isothermal"):
        check_jump(SCRATCH / f"driven-{gas}-choked.cfg")
    for version in VERSIONS:
        a = Instance(export(path, version)).initialize(pressure=0.5e5, pressure_rate=1e4)
        a.step(0.0, 1.0)
        once = a.get("shown_pressure")[0]
        a.step(1.0, 1.0)
        again = a.get("shown_pressure")[0]
        check(f"FMI {version}: what is not set anew begins anew", np.allclose([once, again], 0.6e5, rtol=1e-12), f"{once} {again}")
        check(f"FMI {version}: a pressure below vacuum: refused", refused(a.set, pressure=-2e5))


def check_jump(path):
    """A stroke in no time, and a position beyond a stop."""
    for fmu in (export(path, version) for version in VERSIONS):
        start = dict(start_pressure=1e5, position=0.015)
        smooth = Instance(fmu).initialize(velocity=-0.005, **start)
        smooth.step(0.0, 1.0)
        jump = Instance(fmu).initialize(**start)
        jump.set(position=0.01)
        jump.step(0.0, 1.0)
        a, b = (i.get("shown_pressure", "temperature") for i in (smooth, jump))
        check(f"{path.stem}: a jump compresses as a stroke does", np.allclose(a, b, rtol=1e-9, atol=0) and a[0] > 1.5e5, str(b))
        on_stop = Instance(fmu).initialize(position=0.021, velocity=0.001, start_pressure=1e5)
        on_stop.step(0.0, 1.0)
        seen = on_stop.get("shown_position", "shown_pressure")
        check("beyond a stop: on the stop, at rest", seen == [0.02, 1e5], str(seen))
        check("pressure is an output and not to be set", refused(on_stop.set, pressure=1e5))
        for velocity, warnings in ((0.0, 1), (0.1, 0)):
            moved = Instance(fmu, "ModelExchange").initialize(position=0.01, velocity=velocity)
            moved.update()
            with contextlib.redirect_stdout(io.StringIO()) as told:
                moved.step_done(0.01, position=0.011)
                moved.step_done(0.02, position=0.012)
            seen = told.getvalue().count("velocity is 0")
            check(f"position moves, velocity is {velocity}: told {warnings} times", seen == warnings, told.getvalue().strip())
        t, v = next((t, 0.01 / t) for t in np.arange(1, 1000) / 997 if 0.01 + 0.01 / t * t > 0.02)
        ends = Instance(fmu, "ModelExchange").initialize(position=0.01, velocity=v, start_pressure=1e5)
        ends.update()
        ends.fmu.setTime(t)
        rate = ends.get("der(pressure)")[0]
        check("a line that ends on a stop: moves to its end", rate < -1e5, f"{rate:.4g} Pa/s")


def check_names():
    """What is there depends on what drives the model; and so does the token."""
    flow = {"u", "supply", "start_pressure", "start_temperature", "mass_flow", "choked", "der(pressure)"}
    stem = {"force", "start_position", "der(position)", "der(velocity)"}
    driven = {"pressure": {"pressure_rate"}, "position": {"holding_force"}}
    for version in VERSIONS:
        tokens = set()
        for inputs, wanted in (("u", flow | stem), ("p", stem | driven["pressure"]), ("x", flow | driven["position"]), ("x p", driven["pressure"] | driven["position"])):
            listed = ", ".join(f'"{i}"' for i in inputs.split())
            fmu = export(driven_model(SCRATCH / "plain.cfg", inputs.replace(" ", "-") + "-alone", listed), version)
            description = read_model_description(fmu)
            v = {v.name: v for v in description.modelVariables}
            tokens.add(description.guid)
            found = (flow | stem | driven["pressure"] | driven["position"]) & set(v)
            drive = {n for n in ("pressure", "position") if v[n].causality == "input"}
            good = found == wanted and drive == {n for n in driven if driven[n] <= wanted}
            slopes = {n: v[n].derivative.name for n in ("pressure_rate", "velocity") if n in v and v[n].causality == "input"}
            good = good and slopes == {n: m for n, m in (("pressure_rate", "pressure"), ("velocity", "position")) if m in drive}
            absent = [r for r in (1, 2, 3, 4, 5, 6, 7, 11, 12, 13, 21, 23, 24, 25, 29) if r not in {w.valueReference for w in description.modelVariables}]
            a = Instance(fmu).initialize()
            real = a.fmu.getReal if version == 2 else a.fmu.getFloat64
            good = good and all(refused(real, [r]) for r in absent)
            check(f"FMI {version}: variables with inputs {inputs}", good, " ".join(sorted(found)))
        check(f"FMI {version}: four tokens", len(tokens) == 4)


def check_inputs(fmu):
    """Supply and force act as the parameters do of which they take the place, or to which they are added."""
    plain = Instance(fmu).initialize(u=1).run(0, 1, 100)
    pushed = Instance(fmu).initialize(u=1, force=500).run(0, 1, 100)
    built = Instance(fmu).initialize(u=1, external_force=500).run(0, 1, 100)
    check("force is external_force", alike(pushed, built) and pushed[2] < plain[2], f"{plain[2]:.6f} m, {pushed[2]:.6f} m")
    path = model("weak", flow="choked")
    path.write_text(path.read_text().replace('"400 kPa"', '"250 kPa"'))
    weak = Instance(export(path, 3)).initialize(u=1).run(0, 1, 100)
    lowered = Instance(fmu).initialize(u=1, supply=250e3).run(0, 1, 100)
    error = abs(weak[2] - lowered[2]) / 0.02
    check("supply is supply_pressure", error < 1e-8 and lowered[2] < plain[2], f"{error:.1e} of stroke")
    over = Instance(fmu).initialize(u=1.5).run(0, 1, 100)
    check("a command beyond 1 counts as 1", over == plain)


def check_description(fmu):
    """Units in base units, bounds and start values, and what depends on what."""
    description = read_model_description(fmu)
    unit = {u.name: u.baseUnit for u in description.unitDefinitions}
    wanted = {
        "1": (0, 0, 0, 0),
        "m2": (0, 2, 0, 0),
        "N/m": (1, 0, -2, 0),
        "N.s/m": (1, 0, -1, 0),
        "Pa": (1, -1, -2, 0),
        "J/kg/K": (0, 2, -2, -1),
        "kg/s": (1, 0, -1, 0),
        "kg/s/Pa2": (-1, 2, 3, 0),
        "W/K": (1, 2, -3, -1),
    }
    found = {name: (u.kg, u.m, u.s, u.K) for name, u in unit.items() if name in wanted and u}
    check("units in base units", found == wanted, "" if found == wanted else str(found))
    variable = {v.name: v for v in description.modelVariables}
    area = variable["area"]
    seen = (area.causality, area.variability, area.initial, area.unit, float(area.start), float(area.min), float(area.max))
    check("a parameter", seen == ("parameter", "fixed", "exact", "m2", 0.04, 1e-6, 10), str(seen))
    depends = {o.variable.name: o.dependencies for o in description.outputs}
    names = [v.name for v in depends["shown_position"]]
    check("no way from input to position at once", depends["position"] == [variable["position"]] and "u" not in names)
    check("one from input to mass flow", depends["mass_flow"] is None)


def check_parameters(fmu):
    """What is set before initialisation ends counts, as in a file; later it is refused, and changes nothing."""
    path = model("leak", flow="choked", more='effects = { chamber_leak = { leak_area = "0.05 mm^2"; }; };\n')
    built = Instance(export(path, 3)).initialize(u=1).run(0, 1, 100)
    found = Instance(fmu).initialize(u=1, chamber_leak__leak_area=0.05e-6).run(0, 1, 100)
    check("an effect switched on by its parameter", alike(built, found))
    a = Instance(fmu)
    plain = Instance(fmu).initialize(u=1).run(0, 1, 100)
    check("out of bounds: refused", refused(a.set, area=-1.0))
    check("NaN: refused", refused(a.set, area=float("nan")) and refused(a.set, u=float("nan")))
    a.initialize(u=1)
    for name in ("area", "chamber_leak__leak_area", "start_position", "pressure", "time"):
        check(f"{name} after initialisation: refused", refused(a.set, **{name: 0.01}))
    check("nothing came of it", a.run(0, 1, 100) == plain)
    check("an unknown reference: refused", refused(a.fmu.getReal if a.version == 2 else a.fmu.getFloat64, [77777]))
    late = Instance(fmu)
    check("stop before start: refused", refused(late.initialize, start_position=1.0))
    names = set(a.reference)
    check("no parameter of the recorder", not any(name.startswith("channel_skew") for name in names))
    check("no effect with a state that is not there", not any(name.startswith("presliding") for name in names))
    check("another token: refused", refused_instance(fmu))
    middle = Instance(fmu).initialize(start_position=0.01, start_pressure=0.2e6).get("position", "pressure", "velocity")
    check("start values", middle == [0.01, 0.2e6, 0.0], str(middle))


def refused_instance(fmu):
    try:
        Instance(fmu, token="{0}")
    except Exception:
        return True
    return False


def check_state(fmu):
    """FMU state: a step repeated is the same to the bit, in the instance and in another one."""
    a = Instance(fmu).initialize(u=1)
    a.run(0, 0.31, 31)
    state = a.save()
    first = a.run(0.31, 0.6, 29)
    a.restore(state)
    check(f"FMI {a.version}: back to a state", a.run(0.31, 0.6, 29) == first)
    content = a.serialize(state)
    b = Instance(fmu)
    b.restore(b.deserialize(content))
    check(f"FMI {a.version}: a state written and read by another instance", b.run(0.31, 0.6, 29) == first, f"{len(content)} bytes")
    check(f"FMI {a.version}: half a state: refused", refused(b.deserialize, content[: len(content) // 2]))
    b = Instance(fmu)
    no = 0
    for at in range(len(content) - 24576 - 64, len(content) - 24576, 4):  # before the commands that are kept: their number
        damaged = content[:at] + b"\xff\xff\xff\x7f" + content[at + 4 :]
        if refused(b.deserialize, damaged):
            no += 1
        else:
            b.restore(b.deserialize(damaged))
            refused(b.step, 0.31, 0.01)
    check(f"FMI {a.version}: a state damaged where it counts: refused", no >= 2, f"{no} of 16")
    a.forget(state)
    a.close()
    b.close()


def check_instances(fmu):
    """Instances side by side are as alone."""
    force = (0.0, 300.0, 900.0)
    alone = [Instance(fmu).initialize(u=1, force=f).run(0, 0.5, 50) for f in force]
    together = [Instance(fmu).initialize(u=1, force=f) for f in force]
    for i in range(50):
        for c in together:
            c.step(0.5 * i / 50, 0.5 / 50)
    seen = [c.get("pressure", "temperature", "position", "velocity") for c in together]
    check("three instances in turn", seen == alone)


def check_steps(fmu):
    """The answer does not depend on the communication step; a dead time is kept to the instant."""
    for path in (Path(fmu), Path(export(model("delay", flow="choked", more='effects = { dead_time = { dead_time = "33 ms"; }; };\n'), 3))):
        even = Instance(str(path)).initialize(u=1).run(0, 2, 200)
        random = np.random.default_rng(1)
        uneven = Instance(str(path)).initialize(u=1)
        edges = np.sort(np.concatenate(([0, 2], random.uniform(0, 2, 37))))
        for t, end in zip(edges[:-1], edges[1:]):
            uneven.step(t, end - t)
        one = Instance(str(path)).initialize(u=1)
        one.step(0.0, 2.0)
        at = [even[2], uneven.get("position")[0], one.get("position")[0]]
        spread = (max(at) - min(at)) / 0.02
        check(f"{path.stem}: 200, 38 and 1 steps", spread < 1e-8, f"{spread:.1e} of stroke")


def check_room():
    """More commands within a dead time than there is room for: refused, and the instance as before."""
    path = model("room", more='effects = { dead_time = { dead_time = "2 s"; }; };\n')
    for version in VERSIONS:
        a = Instance(export(path, version)).initialize(u=0)
        n = 0
        while n < 1500:
            a.set(u=0.1 + n % 2)
            if refused(a.step, n * 1e-3, 1e-3):
                break
            n += 1
        a.set(u=0.1 + (n - 1) % 2)  # the command before
        check(f"FMI {version}: too many commands within the dead time", n == 1024 and not refused(a.step, n * 1e-3, 1e-3), str(n))


def check_ramp():
    """A set pressure that runs, through a dead time: as it is in model exchange, in steps in co-simulation, whose answers
    for two lengths of step are extrapolated to none."""
    path = model("ramp", more='effects = { dead_time = { dead_time = "0.05 s"; }; };\n')
    path.write_text(path.read_text().replace("fill_area", 'proportional_band = "20 kPa"; fill_area', 1))
    t = np.arange(0, 3001) * 0.001
    signal = np.array(list(zip(t, 200e3 + 50e3 * np.sin(2 * t))), dtype=COMMANDS.dtype)
    for version in VERSIONS:
        fmu = export(path, version)
        x = []
        for kind, h in (("ModelExchange", 0.001), ("CoSimulation", 0.001), ("CoSimulation", 0.0005)):
            with contextlib.redirect_stdout(None):
                result = simulate_fmu(
                    fmu,
                    fmi_type=kind,
                    start_time=0,
                    stop_time=3,
                    output_interval=h,
                    relative_tolerance=1e-8,
                    input=signal,
                    record_events=False,
                    output=["position"],
                )
            x.append(result["position"][:: round(0.01 / h)])
        error = np.abs(x[0] - (2 * x[2] - x[1])).max() / 0.02
        check(f"FMI {version}: a set pressure that runs, delayed", error < 1e-5, f"{error:.1e} of stroke")


def check_events(fmu):
    """Model exchange, call by call: a push that jumps moves the stem at that event; a command that runs through a dead time
    asks to be stopped at once, and twice in a dead time from then on."""
    a = Instance(fmu, "ModelExchange").initialize(start_position=0.01, start_pressure=0.2e6)
    a.update()
    modes = [a.whole("mode")]
    a.fmu.enterEventMode()
    a.set(force=-2000.0)
    a.update()
    modes.append(a.whole("mode"))
    a.fmu.enterEventMode()
    a.set(force=2000.0)
    a.update()
    modes.append(a.whole("mode"))
    check(f"FMI {a.version}: a force that jumps", modes == [1, 2, 3], str(modes))
    path = model("run", more='effects = { dead_time = { dead_time = "0.05 s"; }; };\n')
    a = Instance(export(path, a.version), "ModelExchange").initialize()
    quiet = a.update() is None and not a.step_done(0.01, u=0.0)
    asked = [a.step_done(0.02, u=0.1)]
    a.fmu.enterEventMode()
    stop = a.update()
    asked += [a.step_done(0.03, u=0.2), a.step_done(0.05, u=0.4)]
    good = quiet and asked == [True, False, True] and stop is not None and abs(stop - 0.045) < 1e-12
    check(f"FMI {a.version}: a running command asks to be stopped", good, f"{asked}, until {stop}")
    a.fmu.enterEventMode()
    a.set(u=-1.0)
    again = a.update()
    check(f"FMI {a.version}: a jump after that acts a dead time later", again is not None and again <= 0.075 + 1e-12, str(again))


def check_derivatives(path):
    """Derivatives by direction of every rate and output, by every state and input: against differences of order 4 through
    the interface, and what can be told by hand."""
    for version in VERSIONS:
        a = Instance(export(path, version), "ModelExchange")
        a.initialize(start_pressure=3e5, start_position=0.01, u=0.4)
        a.update()
        states = [v.derivative.name for v in a.description.modelVariables if v.derivative and v.causality == "local"]
        unknown = [f"der({n})" for n in states] + ["mass_flow", "shown_pressure", "shown_temperature", "shown_position"]
        at = dict(zip(states, [0.1 for _ in states]), pressure=2e5, temperature=310.0, position=0.012, velocity=0.03)
        at = {n: at[n] for n in states} | dict(u=0.4, supply=4e5, force=0.0)
        size = dict.fromkeys(states, 1.0) | dict(pressure=5e5, temperature=300.0, position=0.02, velocity=1.0, u=1.0, supply=5e5, force=1e4)

        def look(values):
            a.put(states, [values[n] for n in states])
            a.set(**{n: values[n] for n in ("u", "supply", "force")})
            return np.array(a.get(*unknown))

        found, wanted = [], []
        for name in at:
            h = 1e-4 * size[name]
            f = [look(at | {name: at[name] + k * h}) for k in (-2, -1, 1, 2)]
            wanted.append((f[0] - 8 * f[1] + 8 * f[2] - f[3]) / 12 * 1e4)
            look(at)
            found.append(np.array(a.derivative(unknown, {name: size[name]})))
        found, wanted = np.array(found), np.array(wanted)
        error = np.abs(found - wanted) / (np.abs(wanted).max(axis=0) + 1e-9)
        check(f"{path.stem}, FMI {version}: derivatives, {error.size} of them", error.max() < 1e-6, f"{error.max():.1e}")
        before = look(at)
        together = np.array(a.derivative(unknown, size))
        error = np.abs(together - found.sum(axis=0)).max() / np.abs(found).max()
        check(f"FMI {version}: of a sum of seeds the sum", error < 1e-8, f"{error:.1e}")
        check(f"FMI {version}: which leave everything as it was", np.array_equal(before, a.get(*unknown)))
        acceleration = [a.derivative(["der(velocity)"], {n: 1.0})[0] for n in ("pressure", "force")]
        check(f"FMI {version}: of acceleration, by hand", np.allclose(acceleration, [0.04 / 2, -1 / 2], rtol=1e-8), str(acceleration))
        a.set(u=1.0)
        end = a.derivative(["mass_flow"], {"u": 1.0})[0]
        if len(states) == 4:  # without a lag of the transducer
            check(f"FMI {version}: by a command fully open", abs(end / a.get("mass_flow")[0] - 1) < 1e-6, f"{end:.4g} kg/s")
        for unknowns, knowns in ((["mode"], ["u"]), (["der(velocity)"], ["mass_flow"]), (["der(velocity)"], ["area"])):
            check(f"FMI {version}: {unknowns[0]} by {knowns[0]}: refused", refused(a.derivative, unknowns, {knowns[0]: 1.0}))
        b = Instance(export(path, version), "ModelExchange")
        b.fmu.setupExperiment(startTime=0.0) if version == 2 else None
        b.fmu.enterInitializationMode()
        b.set(start_pressure=3e5, start_position=0.01)
        value = b.get("der(velocity)")
        first = [b.derivative(["der(velocity)"], {n: 1.0})[0] for n in ("start_pressure", "area", "spring_rate", "force", "area")]
        check(f"FMI {version}: before the start", np.allclose(first, [0.02, 1.5e5, -0.01, -0.5, 1.5e5], rtol=1e-6), str(first))
        check(f"FMI {version}: which leave the model as it was", b.get("der(velocity)") == value)
        still = Instance(export(path, version)).initialize()
        check(f"FMI {version}: at rest nothing follows position", still.derivative(["der(pressure)", "position"], {"position": 1.0}) == [0, 0])


def check_driven_derivatives():
    """Of the force that holds a driven stem."""
    for version in VERSIONS:
        a = Instance(export(SCRATCH / "driven-energy-choked.cfg", version)).initialize(start_pressure=2e5, position=0.01, velocity=0.02)
        found = [a.derivative(["holding_force"], {n: 1.0})[0] for n in ("pressure", "position", "velocity")]
        p, V = 301325.0, 0.04 * 0.01 + 2e-6
        wanted = [0.04, -4e5 - 0.04 * 1.4 * p * 0.04 / V, -1500.0]  # a position that jumps compresses
        check(f"FMI {version}: holding force", np.allclose(found, wanted, rtol=1e-6), f"{found} {wanted}")


def check_life(fmu):
    """Ends and new beginnings in any order."""
    for kind in KINDS:
        a = Instance(fmu, kind)
        check(f"{kind}: terminated before it ran: refused", refused(a.fmu.terminate))
        a.fmu.reset()
        a.initialize(u=1, force=700, area=0.05, start_position=0.002)
        check(f"{kind}: initialised twice: refused", refused(a.fmu.enterInitializationMode))
        if kind == "CoSimulation":
            a.run(0, 0.2, 20)
        a.fmu.terminate()
        check(f"{kind}: terminated twice: refused", refused(a.fmu.terminate))
        a.get("position")
        a.fmu.reset()
        a.initialize(u=1)
        if kind == "CoSimulation":
            fresh = Instance(fmu).initialize(u=1).run(0, 0.5, 50)
            check("after a reset as fresh", a.run(0, 0.5, 50) == fresh)
            check("a step back: refused", refused(a.step, 0.5, -0.1))
            if a.version == 3:  # FMPy does not offer this for FMI 2
                check("event mode in co-simulation: refused", refused(a.fmu.enterEventMode))
        a.fmu.reset()
        a.close()
        for ready in (lambda i: None, lambda i: i.initialize()):
            b = Instance(fmu, kind)
            ready(b)
            b.close()


def check_beyond(fmu):
    """A solver tries a moving stem beyond its stop, where there is no volume: it gets numbers, not an error."""
    a = Instance(fmu, "ModelExchange").initialize(u=-1, start_position=0.01, start_pressure=0)
    (a.fmu.newDiscreteStates if a.version == 2 else a.fmu.updateDiscreteStates)()
    a.fmu.enterContinuousTimeMode()
    n = a.description.numberOfContinuousStates
    x, dx = (ctypes.c_double * n)(), (ctypes.c_double * n)()
    a.fmu.getContinuousStates(x, n)
    x[n - 2], x[n - 1] = -0.001, -0.01
    a.fmu.setContinuousStates(x, n)
    (a.fmu.getDerivatives if a.version == 2 else a.fmu.getContinuousStateDerivatives)(dx, n)
    good = dx[n - 2] == -0.01 and dx[n - 1] != 0 and np.isfinite(list(dx)).all()
    check(f"FMI {a.version}: beyond the stop", good, str(list(dx)))


def built_again(fmu, options, out, more=()):
    """Compile what the FMU lists, in a clean folder.  Returns: that folder"""
    folder = SCRATCH / "again"
    shutil.rmtree(folder, ignore_errors=True)
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
        text = archive.read("modelDescription.xml")
        listed = archive.read("sources/buildDescription.xml") if b'fmiVersion="3.0"' in text else text
    tag = "SourceFile" if b'fmiVersion="3.0"' in text else "CoSimulation/SourceFiles/File"
    root = ElementTree.fromstring(listed)
    names = [str(folder / "sources" / e.get("name")) for e in root.iterfind(f".//{tag}")]
    subprocess.run([CC, "-std=c99", *options, *more, *names, "-lm", "-o", folder / out], check=True)
    return folder


def check_sources(path):
    """Built from the sources inside, an FMU gives the same numbers."""
    for version in VERSIONS:
        fmu = export(path, version)
        before = Instance(fmu).initialize(u=1).run(0, 1, 100)
        binary = next(n for n in zipfile.ZipFile(fmu).namelist() if n.endswith(".so"))
        folder = SCRATCH / "again"
        built_again(fmu, ["-O2", "-fPIC", "-shared", "-Wall", "-Wextra", "-Werror"], binary)
        again = SCRATCH / f"{path.stem}-again-{version}.fmu"
        with zipfile.ZipFile(again, "w") as archive:
            for file in sorted(p for p in folder.rglob("*") if p.is_file()):
                archive.write(file, file.relative_to(folder))
        after = Instance(str(again)).initialize(u=1).run(0, 1, 100)
        error = max(abs(a - b) / (abs(b) + 1e-9) for a, b in zip(after, before))
        check(f"FMI {version}: rebuilt from its sources", error < 1e-9, f"{error:.1e} of each value")


def check_disorder(path, calls=100000, euler=True):
    """Calls in any order, under the sanitizers; then an importer with steps of fixed length."""
    fmu = export(path, 3)
    options = ["-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    folder = built_again(fmu, options, "orders", ["tests/fmu/orders.c"])
    token = read_model_description(fmu).guid
    for seed in ("1", "2"):
        command = [folder / "orders", token, str(calls), seed] + ["2e-6"] * euler
        run = subprocess.run(command, capture_output=True, text=True)
        check(f"{path.stem}: {calls} calls in any order", run.returncode == 0, run.stderr[-2000:].strip() or run.stdout)
    rows = [[float(cell) for cell in line.split(",")] for line in run.stdout.splitlines()]
    if not euler:
        return
    a = Instance(fmu).initialize(u=1)
    worst, t = 0, 0
    for end, position, _ in rows:
        for stop in ([1.0] if t < 1 < end else []) + [end]:
            a.step(t, stop - t)
            t = stop
            if t == 1.0:
                a.set(u=-1)
        worst = max(worst, abs(a.get("position")[0] - position) / 0.02)
    check("forward Euler, 2 us", worst < 1e-4 and len(rows) > 20, f"{worst:.1e} of stroke")


def check_bytes(path):
    """The same model gives the same file, wherever and whenever."""
    for version in VERSIONS:
        first = Path(export(path, version, "first")).read_bytes()
        second = SCRATCH / "second.fmu"
        environment = {**os.environ, "TZ": "Asia/Kathmandu"}
        subprocess.run(["./export-fmu", path, "--fmi", str(version), "--out", second], check=True, env=environment)
        check(f"FMI {version}: the same bytes again", second.read_bytes() == first, f"{len(first)} bytes")
        inside = SCRATCH / "inside.cfg"
        inside.write_bytes(zipfile.ZipFile(second).read("resources/model.cfg"))
        check(f"FMI {version}: the same from the model file inside", Path(export(inside, version)).read_bytes() == first)


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    SCRATCH.mkdir(parents=True)
    plain = model("plain", flow="choked")
    fmus = [export(plain, version) for version in VERSIONS]
    for fmu in fmus:
        check_description(fmu)
        check_inputs(fmu)
        check_parameters(fmu)
        check_state(fmu)
        check_instances(fmu)
        check_steps(fmu)
        check_events(fmu)
        check_life(fmu)
        check_beyond(fmu)
    check_sources(SCRATCH / "plain.cfg")
    check_bytes(plain)
    check_room()
    check_ramp()
    check_agreement()
    check_driven()
    check_loop()
    check_measured()
    check_slopes()
    check_names()
    check_derivatives(model("rates", gas="energy", flow="choked"))
    check_derivatives(model("rates-effects", flow="choked", more=LAGS))
    check_driven_derivatives()
    check_sources(SCRATCH / "terms.cfg")
    check_disorder(SCRATCH / "effects.cfg")
    for driven in ("pumped", "o-ring"):
        check_disorder(SCRATCH / f"{driven}.cfg", euler=False)
    print(f"{failed} wrong")
    sys.exit(failed != 0)


main()
