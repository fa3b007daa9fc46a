"""The functions of apps/lab/api/api.h, called one at a time."""

import os
import threading
from importlib import resources

import cffi

_here = resources.files(__package__)
# Read by UDUNITS when the first unit is.
os.environ.setdefault("UDUNITS2_XML_PATH", str(_here / "units" / "udunits2.xml"))

ffi = cffi.FFI()
ffi.cdef("""
typedef struct { int status; char text[1024]; } lab_error;
typedef struct { const char *name; const void *data; size_t size; } lab_text_given;
typedef struct {
  lab_text_given rig;
  const lab_text_given *log, *holdout, *baseline;
  int n_logs, n_holdout, n_baseline;
  double alpha, min_gain, budget;
  void (*on_progress)(void *context, const char *what);
  void *context;
} lab_api_request;
typedef struct { char *sentence, *json, *html, *model, *residual; } lab_api_answer;
int lab_api_closeloop(const lab_api_request *request, lab_api_answer *answer, lab_error *error);
void lab_api_free_answer(lab_api_answer *answer);
void lab_api_stop(void);
int lab_api_simulate(const lab_text_given *rig, const lab_text_given *log, char **csv, lab_error *error);
int lab_api_draft(const lab_text_given *log, const char *const *sheet, int n, char **rig, lab_error *error);
void lab_api_free(char *text);
const char *lab_api_version(void);
""")
lab = ffi.dlopen(str(_here / "libpneulab.so"))
version = ffi.string(lab.lab_api_version()).decode()

_turn = threading.Lock()


class Error(Exception):
    """A call failed.

    Attributes:
        status: what the exit status of the programs would be: 1 the data or the rig file is at fault, 2 the call is,
            3 a numerical failure, 4 the outside world (no memory, stopped).
        text: one sentence that says what to do.
    """

    status = 0

    def __init__(self, text: str):
        super().__init__(text)
        self.text = text


class DataError(Error, ValueError):
    """The log or the rig file is at fault: name, line, what was expected, what was found."""

    status = 1


class UsageError(Error, TypeError):
    """The call is at fault."""

    status = 2


class NumericalError(Error, ArithmeticError):
    """The model could not be followed: when, and in which state."""

    status = 3


class WorldError(Error, OSError):
    """No memory, or the call was stopped."""

    status = 4


_errors = {kind.status: kind for kind in (DataError, UsageError, NumericalError, WorldError)}


class Texts:
    """Texts as the library takes them. Keeps what they point to alive."""

    def __init__(self, named):
        self._kept = [(ffi.new("char[]", name.encode()), ffi.from_buffer(data)) for name, data in named]
        self.n = len(self._kept)
        self.array = ffi.new("lab_text_given[]", max(self.n, 1))
        for place, (name, data) in zip(self.array, self._kept):
            place.name, place.data, place.size = name, data, len(data)


def call(function, *arguments):
    """Call a function of the library with an error behind the arguments, in turn.

    Raises:
        Error: what the library said.
    """
    error = ffi.new("lab_error *")
    with _turn:
        status = function(*arguments, error)
    if status:
        raise _errors[status](ffi.string(error.text).decode(errors="replace"))


def text_of(pointer) -> str:
    return ffi.string(pointer).decode()


def take(pointer) -> str:
    """A text that the library made, which is freed."""
    text = text_of(pointer)
    lab.lab_api_free(pointer)
    return text
