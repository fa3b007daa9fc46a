"""Whether two zip files hold the same files: same_files.py ONE.zip OTHER.zip"""
import sys
import zipfile

one, other = (zipfile.ZipFile(path) for path in sys.argv[1:3])
names = sorted(one.namelist())
assert names == sorted(other.namelist()), set(names) ^ set(other.namelist())
assert len(names) > 50, "an FMU has its sources inside"
for name in names:
    assert one.read(name) == other.read(name), name
