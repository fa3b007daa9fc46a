"""Files that loggers write, as a log that the library reads.

Text is handed on as it is: the library reads any logger's. Files of other kinds become CSV by pandas and friends.
"""

import gzip
import io
from pathlib import Path

import pandas as pd

from ._library import DataError


def _excel(data: bytes) -> pd.DataFrame:
    return pd.read_excel(io.BytesIO(data))


def _parquet(data: bytes) -> pd.DataFrame:
    return pd.read_parquet(io.BytesIO(data))


def _vectors(items) -> pd.DataFrame:
    """The longest vectors of a file, which are the log."""
    vectors = {name: value.ravel() for name, value in items if value.dtype.kind in "fiub" and value.size > 1}
    rows = max((len(v) for v in vectors.values()), default=0)
    return pd.DataFrame({name: v for name, v in vectors.items() if len(v) == rows})


def _matlab(data: bytes) -> pd.DataFrame:
    from scipy.io import loadmat

    def leaves(prefix, value):
        for name in value.dtype.names or ():
            yield from leaves(name, value[name].item())
        if not value.dtype.names:
            yield prefix, value

    found = loadmat(io.BytesIO(data))
    return _vectors(leaf for name, value in found.items() if not name.startswith("__") for leaf in leaves(name, value))


def _hdf5(data: bytes) -> pd.DataFrame:
    import h5py

    found = {}
    with h5py.File(io.BytesIO(data)) as file:
        file.visititems(lambda name, item: found.update({name.split("/")[-1]: item[()]}) if hasattr(item, "dtype") else None)
    return _vectors(found.items())


def _tdms(data: bytes) -> pd.DataFrame:
    from nptdms import TdmsFile

    channels = [channel for group in TdmsFile.read(io.BytesIO(data)).groups() for channel in group.channels()]
    unit = {channel.name: channel.properties.get("unit_string") for channel in channels}
    frame = pd.DataFrame({channel.name: channel[:] for channel in channels})
    return frame.rename(columns={name: f"{name} [{u}]" for name, u in unit.items() if u})


def _mdf(data: bytes) -> pd.DataFrame:
    from asammdf import MDF

    with MDF(io.BytesIO(data)) as file:
        frame = file.to_dataframe(use_display_names=False)
        unit = {name: file.get(name, group=file.whereis(name)[0][0]).unit for name in frame.columns}
    frame = frame.rename(columns={name: f"{name} [{u}]" for name, u in unit.items() if u})
    return frame.rename_axis("t [s]").reset_index()


# By how a file begins: what it is, what reads it, what has to be installed for that.
_kinds = (
    (b"PK\x03\x04", "an Excel workbook", _excel, "openpyxl"),
    (b"PAR1", "Parquet", _parquet, "pyarrow"),
    (b"MATLAB 5.0 MAT-file", "a MATLAB file", _matlab, "scipy"),
    (b"MATLAB 7.3 MAT-file", "a MATLAB file of version 7.3", _hdf5, "h5py"),
    (b"\x89HDF", "HDF5", _hdf5, "h5py"),
    (b"TDSm", "TDMS", _tdms, "npTDMS"),
    (b"MDF     ", "MDF", _mdf, "asammdf"),
)


def csv_of(name: str, data: bytes) -> bytes:
    """What a file holds, as text."""
    if data.startswith(b"\x1f\x8b"):
        return csv_of(name, gzip.decompress(data))
    for begin, kind, read, package in _kinds:
        if data.startswith(begin):
            try:
                return csv_of_frame(read(data))
            except ImportError as missing:
                raise DataError(f"{name}: this is {kind}; to read it: pip install {package}") from missing
    return data


def csv_of_frame(frame: pd.DataFrame) -> bytes:
    """A frame whose columns are named as in a log, "p [kPa]"; a named index is the first of them."""
    return frame.to_csv(index=frame.index.name is not None).encode()


def load(path) -> bytes:
    try:
        return Path(path).read_bytes()
    except OSError as error:
        raise DataError(f"{path}: cannot be read: {error.strerror}") from error
