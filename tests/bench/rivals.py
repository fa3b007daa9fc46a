#!/usr/bin/env python3
"""SciPy and CasADi beside the stepper and CVODE, in one process.

  rivals.py LIBBENCH.so VENV RESULTS SCRATCH PROGRAMS [quick]

Installs both from PyPI into VENV at the first time, loads what is timed as a shared library, and hands it the rivals as
functions (tests/bench/contender.h); it races them with its own. Ends with status 3 where the rivals cannot be had.

SciPy   solve_ivp with LSODA; right-hand side, Jacobian and event functions are the library's own, compiled; events as
        solve_ivp finds them, then a new start. Fits are those of least_squares.
CasADi  the same equations as symbols, CVODES with exact derivatives. Its integrators find no events: it is given their
        times, which favours it; and it does not fit, because events move with the parameters.
"""
import ctypes
import os
import subprocess
import sys
import time
from pathlib import Path

PACKAGES = ["numpy", "scipy", "casadi"]


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
        print(f"bench: no rivals: {error}", file=sys.stderr)
        sys.exit(3)
    if Path(sys.prefix).resolve() != Path(folder).resolve():
        os.environ["OMP_NUM_THREADS"] = os.environ.get("OMP_NUM_THREADS", str(os.cpu_count()))
        os.execv(python, [str(python), *sys.argv])


if __name__ == "__main__":
    if len(sys.argv) < 6:
        sys.exit(__doc__)
    in_venv(sys.argv[2])

import casadi as ca  # noqa: E402
import numpy as np  # noqa: E402
import scipy  # noqa: E402
from scipy.integrate import solve_ivp  # noqa: E402
from scipy.optimize import least_squares  # noqa: E402

LIB = ctypes.CDLL(str(Path(sys.argv[1]).absolute()), mode=os.RTLD_LOCAL)
REAL_P = ctypes.POINTER(ctypes.c_double)
NAN = float("nan")


class Case(ctypes.Structure):
    """bench_case"""

    _fields_ = [
        ("model", ctypes.c_void_p),
        ("n", ctypes.c_int),
        ("duration", REAL_P),
        ("command", REAL_P),
        ("rows", ctypes.c_size_t),
        ("spacing", ctypes.c_double),
    ]


SIMULATE = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.POINTER(Case), ctypes.c_double, REAL_P, REAL_P)
FIT = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_void_p, ctypes.c_double, REAL_P)
RATES = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.POINTER(Case))


class Contender(ctypes.Structure):
    """bench_contender"""

    _fields_ = [("name", ctypes.c_char_p), ("simulate", SIMULATE), ("fit", FIT), ("rates", RATES)]


class ParamInfo(ctypes.Structure):
    """pneu_param_info"""

    _fields_ = [
        ("name", ctypes.c_char_p),
        ("unit", ctypes.c_char_p),
        ("lower", ctypes.c_double),
        ("upper", ctypes.c_double),
        ("value", ctypes.c_double),
        ("neutral", ctypes.c_double),
        ("shape", ctypes.c_int),
        ("meaning", ctypes.c_char_p),
    ]


VOID = ctypes.c_void_p
for name, result, arguments in [
    ("bench_value", ctypes.c_double, [VOID, ctypes.c_char_p]),
    ("bench_stride", ctypes.c_int, []),
    ("bench_modes", ctypes.c_int, [ctypes.POINTER(Case), ctypes.c_int, REAL_P, ctypes.POINTER(ctypes.c_int)]),
    ("bench_fit_task", ctypes.POINTER(Case), [VOID]),
    ("bench_fit_apply", ctypes.c_int, [VOID, REAL_P]),
    ("bench_fit_residuals", ctypes.c_double, [VOID, REAL_P, REAL_P, REAL_P]),
    ("pneu_input_default", None, [VOID, VOID]),
    ("pneu_state_rest", ctypes.c_int, [VOID, ctypes.c_double, ctypes.c_double, ctypes.c_double, VOID, VOID]),
    ("pneu_settle", None, [VOID] * 3),
    ("pneu_pack", ctypes.c_int, [VOID] * 3),
    ("pneu_unpack", None, [VOID] * 3),
    ("pneu_scales", None, [VOID] * 2),
    ("pneu_rhs", ctypes.c_int, [VOID] * 5),
    ("pneu_jacobian", ctypes.c_int, [VOID] * 6),
    ("pneu_events", ctypes.c_int, [VOID] * 5),
    ("pneu_switch", None, [VOID, VOID, ctypes.c_int, VOID]),
]:
    getattr(LIB, name).restype = result
    getattr(LIB, name).argtypes = arguments

PARAMETERS = """area dead_volume swept_ratio stroke spring_rate spring_preload moving_mass dry_friction viscous_friction
damping external_force fill_area vent_area supply_pressure supply_temperature ambient_pressure ambient_temperature
gas_constant heat_ratio polytropic_index gas flow""".split()


def values(model):
    """Parameters and laws of a model, by name."""
    return {name: LIB.bench_value(model, name.encode()) for name in PARAMETERS}


def stretches(case):
    """(command, begin, end) of each."""
    begin = 0.0
    for i in range(case.n):
        yield case.command[i], begin, begin + case.duration[i]
        begin += case.duration[i]


def grid(case):
    return np.arange(case.rows) * case.spacing


# ---- SciPy ----


class World:
    """State and input of a run, and the library's functions of the packed vector, by pointers made once."""

    def __init__(self, model):
        self.model = model
        self.stride = LIB.bench_stride()
        self.room = np.zeros((8 + self.stride, self.stride))
        self.input, self.state = np.zeros(64), np.zeros(512)
        self.y, self.rate, self.g = np.zeros(self.stride), np.zeros(self.stride), np.zeros(self.stride)
        self.jac, self.scale = np.zeros((self.stride, self.stride)), np.zeros(self.stride)
        at = lambda array: array.ctypes.data  # noqa: E731
        self.pointers = model, at(self.state), at(self.input)
        self.at_y, self.at_rate, self.at_g, self.at_jac = at(self.y), at(self.rate), at(self.g), at(self.jac)
        LIB.pneu_input_default(model, at(self.input))
        ambient = LIB.bench_value(model, b"ambient_temperature")
        LIB.pneu_state_rest(model, 0.0, ambient, 0.0, at(self.input), at(self.state))
        LIB.pneu_scales(model, at(self.scale))

    def command(self, u):
        self.input[0] = u
        LIB.pneu_settle(self.model, self.pointers[2], self.pointers[1])

    def pack(self):
        self.n = LIB.pneu_pack(self.model, self.pointers[1], self.at_y)
        return self.y[: self.n].copy()

    def unpack(self, y):
        self.y[: self.n] = y
        LIB.pneu_unpack(self.model, self.at_y, self.pointers[1])

    def switch(self, which):
        LIB.pneu_switch(self.model, self.pointers[2], which, self.pointers[1])

    def functions(self):
        """Right-hand side, Jacobian and event functions for the present mode."""
        n, y, rate, jac, g = self.n, self.y[: self.n], self.rate[: self.n], self.jac[: self.n, : self.n], self.g
        model, state, command = self.pointers
        at_y, at_rate, at_jac, at_g = self.at_y, self.at_rate, self.at_jac, self.at_g
        c_rhs, c_jacobian, c_events = LIB.pneu_rhs, LIB.pneu_jacobian, LIB.pneu_events

        def rhs(_, now):
            y[:] = now
            c_rhs(model, state, command, at_y, at_rate)
            return rate

        def jacobian(_, now):
            y[:] = now
            c_rhs(model, state, command, at_y, at_rate)
            c_jacobian(model, state, command, at_y, at_rate, at_jac)
            return jac

        def event(which):
            def function(_, now):
                y[:] = now
                c_events(model, state, command, at_y, at_g)
                return g[which]

            function.terminal, function.direction = True, 1
            return function

        return rhs, jacobian, [event(i) for i in range(c_events(model, state, command, at_y, at_g))]


def until_event(world, begin, end, tol, times, p, x):
    """Up to an event or the end; fills in the samples.  Returns: where it stopped"""
    start = world.pack()
    rhs, jacobian, events = world.functions()
    run = solve_ivp(rhs, (begin, end), start, "LSODA", rtol=2.3e-14, atol=tol * world.scale[: world.n], jac=jacobian,
                    events=events, dense_output=times is not None)
    if run.status < 0:
        raise ArithmeticError(run.message)
    if times is not None:
        inside = (times >= begin) & (times <= run.t[-1])
        if inside.any():
            samples = run.sol(times[inside])
            p[inside] = samples[0]
            x[inside] = samples[-2] if world.moving() else world.state[2]
    world.unpack(run.y[:, -1])
    if run.status == 1:
        world.switch(next(i for i, t in enumerate(run.t_events) if len(t)))
    return run.t[-1]


World.moving = lambda self: self.n > 1 + (LIB.bench_value(self.model, b"gas") != 0)


def lsoda(case, tol, p, x):
    world = World(case.model)
    times = grid(case) if x is not None else None
    started = time.perf_counter()
    for u, begin, end in stretches(case):
        world.command(u)
        while begin < end - 1e-12:
            begin = until_event(world, begin, end, tol, times, p, x)
    return time.perf_counter() - started


def fit_by_scipy(fit, tol, theta):
    case = LIB.bench_fit_task(fit).contents
    p, x, r = np.zeros(case.rows), np.zeros(case.rows), np.zeros(2 * case.rows)

    def residuals(now):
        at = np.ascontiguousarray(now)
        LIB.bench_fit_apply(fit, at.ctypes.data_as(REAL_P))
        lsoda(case, tol, p, x)
        LIB.bench_fit_residuals(fit, *(a.ctypes.data_as(REAL_P) for a in (p, x, r)))
        return r.copy()

    started = time.perf_counter()
    theta[:] = least_squares(residuals, theta.copy(), diff_step=1e-3, ftol=1e-6, xtol=1e-6).x
    return time.perf_counter() - started


def rates_by_scipy(case, calls=2000):
    world = World(case.model)
    world.command(1.0)
    y = world.pack()
    rhs = world.functions()[0]
    started = time.perf_counter()
    for i in range(calls):
        y[0] = 4e5 * i / calls
        rhs(0.0, y)
    return (time.perf_counter() - started) / calls


# ---- CasADi ----

LOWER, STUCK, UP, DOWN, UPPER = range(5)  # enum pneu_mode
BLEND = 5e-4  # PNEU_BLEND


def flow(m, area, p_up, T_up, p_down):
    """Mass flow from up to down, as lib/flow.c has it."""
    w = 1 - p_down / p_up
    z = w / BLEND
    blended = BLEND**0.5 * z * (1.40625 + z**2 * (-0.5625 + 0.15625 * z**2))
    psi = ca.if_else(w < BLEND, blended, ca.sqrt(ca.fmax(w, BLEND)))
    gain = (2 / m["gas_constant"]) ** 0.5
    if m["flow"] == 1:
        gamma = m["heat_ratio"]
        critical = (2 / (gamma + 1)) ** (gamma / (gamma - 1))
        most = (gamma / m["gas_constant"]) ** 0.5 * (2 / (gamma + 1)) ** ((gamma + 1) / (2 * (gamma - 1)))
        gain = (2 * gamma / ((gamma - 1) * m["gas_constant"])) ** 0.5
        sub = ca.fmin(w, 1 - critical)
        e = ca.expm1((1 - 1 / gamma) * ca.log1p(-sub))
        part = ca.if_else(ca.fabs(sub) < 1e-12, 1 - 1 / gamma, -e / sub)
        psi = ca.if_else(w > 1 - critical, most / gain, psi * (1 - sub) / (1 + e) * ca.sqrt(part))
    return area * p_up * gain * psi / ca.sqrt(T_up)


def exchange(m, area, p, T, p_other, T_other):
    """Inflow, its temperature times it, and outflow of a chamber."""
    into = ca.if_else(p_other > p, flow(m, area, p_other, T_other, p), 0)
    out = ca.if_else(p_other > p, 0, flow(m, area, p, T, p_other))
    return into, into * T_other, out


def equations(m, mode, u):
    """States in units of their full scale, parameters (duration, position at rest), rates over the duration."""
    thermal, moving = m["gas"] != 0, mode in (UP, DOWN)
    scale = [m["supply_pressure"] + m["ambient_pressure"]]
    scale += [m["ambient_temperature"]] if thermal else []
    scale += [m["stroke"], 100 * m["stroke"]] if moving else []
    y, parameters = ca.SX.sym("y", len(scale)), ca.SX.sym("q", 2)
    state = y * ca.DM(scale)
    p, T = state[0] + m["ambient_pressure"], state[1] if thermal else m["ambient_temperature"]
    x, v = (state[-2], state[-1]) if moving else (parameters[1], 0)
    swept = m["area"] * m["swept_ratio"]
    volume = m["dead_volume"] + swept * x
    into = heat = out = 0
    if u > 0:
        into, heat, out = exchange(m, u * m["fill_area"], p, T, m["supply_pressure"] + m["ambient_pressure"],
                                   m["supply_temperature"])
    elif u < 0:
        into, heat, out = exchange(m, -u * m["vent_area"], p, T, m["ambient_pressure"], m["ambient_temperature"])
    R = m["gas_constant"]
    if thermal:
        g = m["polytropic_index"]
        p_dot = g * (R * (heat - T * out) - p * swept * v) / volume
        rates = [p_dot, T * (p_dot / p + swept * v / volume - R * T * (into - out) / (p * volume))]
    else:
        rates = [(R * T * (into - out) - p * swept * v) / volume]
    if moving:
        force = (p - m["ambient_pressure"]) * m["area"] - m["spring_rate"] * (x + m["spring_preload"])
        drag = (m["viscous_friction"] + m["damping"]) * v + (1 if mode == UP else -1) * m["dry_friction"]
        rates += [v, (force - m["external_force"] - drag) / m["moving_mass"]]
    return y, parameters, parameters[0] * ca.vertcat(*rates) / ca.DM(scale), np.array(scale)


def modes(case, room=256):
    """(begin, end, mode, command) of each stretch in one mode."""
    begin, mode = np.zeros(room), np.zeros(room, dtype=np.int32)
    n = LIB.bench_modes(case, room, begin.ctypes.data_as(REAL_P), mode.ctypes.data_as(ctypes.POINTER(ctypes.c_int)))
    if n < 0:
        raise ArithmeticError("no events to be given")
    ends = np.append(begin[1:n], sum(end - start for _, start, end in stretches(case)))
    for i in range(n):
        u = next(u for u, start, end in stretches(case) if begin[i] < end)
        if ends[i] > begin[i] + 1e-9:
            yield begin[i], ends[i], mode[i], u


KEPT = {}


def integrator(m, mode, u, tol, at):
    """CVODES over one mode.  In: at  shares of the duration to sample at, None: its end alone"""
    key = tuple(m.values()), mode, u, tol, at if at is None else tuple(at)
    if key not in KEPT:
        y, parameters, rates, scale = equations(m, mode, u)
        options = {"abstol": tol, "reltol": 1e-14, "max_num_steps": 1000000, "disable_internal_warnings": True}
        problem = {"x": y, "p": parameters, "ode": rates}
        KEPT[key] = ca.integrator("run", "cvodes", problem, 0, 1 if at is None else list(at), options), scale
    return KEPT[key]


def plan(case, tol, sampled):
    """Everything that need not be timed: stretches with their integrators."""
    m, times = values(case.model), grid(case)
    for begin, end, mode, u in modes(case):
        inside = (times >= begin) & (times <= end) if sampled else None
        shares = np.append((times[inside] - begin) / (end - begin), 1.0) if sampled else None
        if sampled and len(shares) > 1 and shares[-2] >= 1.0:
            shares = shares[:-1]
        if sampled and shares[0] == 0.0:
            inside[np.argmax(inside)] = False
            shares = shares[1:]
        yield (end - begin, mode, inside, *integrator(m, mode, u, tol, shares))


def cvodes(case, tol, p, x):
    model = values(case.model)
    steps = list(plan(case, tol, x is not None))
    thermal = model["gas"] != 0
    now = [0.0, model["ambient_temperature"]] if thermal else [0.0]
    position, rest = 0.0, len(now)
    started = time.perf_counter()
    for duration, mode, inside, run, scale in steps:
        moving = mode in (UP, DOWN)
        position = 0.0 if mode == LOWER else model["stroke"] if mode == UPPER else position
        start = np.array(now[:rest] + ([position, 0.0] if moving else [])) / scale
        path = run(x0=start, p=[duration, position])["xf"].full() * scale[:, None]
        now = list(path[:, -1])
        if inside is not None and inside.any():
            p[inside] = path[0, : inside.sum()]
            x[inside] = path[-2, : inside.sum()] if moving else position
        position = now[-2] if moving else position
    return time.perf_counter() - started


def rates_by_casadi(case, calls=20000):
    y, parameters, rates, scale = equations(values(case.model), UP, 1.0)
    function = ca.Function("rates", [y, parameters], [rates])
    buffer, evaluate = function.buffer()
    at, given, out = np.array([0.5] * len(scale)), np.array([1.0, 0.01]), np.zeros(len(scale))
    buffer.set_arg(0, memoryview(at))
    buffer.set_arg(1, memoryview(given))
    buffer.set_res(0, memoryview(out))
    started = time.perf_counter()
    for i in range(calls):
        at[0] = 0.8 * i / calls
        evaluate()
    return (time.perf_counter() - started) / calls


# ---- The race ----


def array(pointer, n):
    return np.ctypeslib.as_array(pointer, (n,)) if pointer and n else None


def guarded(function, *arguments):
    """A rival that fails has no time; why, is told once."""
    try:
        return function(*arguments)
    except (ArithmeticError, RuntimeError, ValueError, StopIteration) as error:
        print(f"bench: {function.__name__}: {str(error)[:200]}", file=sys.stderr)
        return NAN


def contender(name, simulate, fit, rates):
    def run(case, tol, p, x):
        task = case.contents
        return guarded(simulate, task, tol, array(p, task.rows), array(x, task.rows))

    return Contender(
        name.encode(),
        SIMULATE(run),
        FIT(lambda f, tol, theta: guarded(fit, f, tol, array(theta, 4))) if fit else FIT(),
        RATES(lambda case: guarded(rates, case.contents)),
    )


def main():
    _, _, results, scratch, programs, *quick = sys.argv[1:]
    rivals = (Contender * 2)(
        contender(f"SciPy {scipy.__version__} LSODA", lsoda, fit_by_scipy, rates_by_scipy),
        contender(f"CasADi {ca.__version__} CVODES", cvodes, None, rates_by_casadi),
    )
    LIB.bench_run.argtypes = [ctypes.c_char_p] * 3 + [ctypes.c_int, ctypes.POINTER(Contender), ctypes.c_int]
    return LIB.bench_run(results.encode(), scratch.encode(), programs.encode(), len(quick), rivals, len(rivals))


if __name__ == "__main__":
    sys.exit(main())
