#!/usr/bin/env python3
"""Whether two report.json of one log say the same: same_report.py HERE THERE.

Prints verdict, what was found and how far fitted values and errors are apart; exits 1 where verdict, condition or found
differ, or a fitted value by more than NEAR. What a search tried on its way is not compared.
"""
import json
import sys

NEAR = 0.5  # of half its 95 % interval; a fit stops at a tolerance, which the last digit of a sum moves


def names(answer):
    return [answer["verdict"], answer["condition"]] + sorted(found["effect"] for found in answer["found"])


def fitted_off_by(here, there):
    """The largest difference of a fitted value, in half its 95 % interval."""
    most = 0
    for name, value in here["parameters"].items():
        low, high = value["ci95"]
        if high > low:
            most = max(most, abs(there["parameters"][name]["value"] - value["value"]) / ((high - low) / 2))
    return most


def errors_off_by(here, there):
    """The largest relative difference of an error on the logs that were fitted."""
    return max(abs(there["error"][part][channel]["rmse"] / value["rmse"] - 1)
               for part in ("before", "after") for channel, value in here["error"][part].items())


def main():
    here, there = (json.load(open(path, encoding="utf-8")) for path in sys.argv[1:3])
    if names(here) != names(there):
        sys.exit(f"{names(here)} here, {names(there)} there")
    fitted = fitted_off_by(here, there)
    print(f"{', '.join(names(here))}; fitted values to {fitted:.1e} of half an interval, errors to {errors_off_by(here, there):.1e}")
    sys.exit(fitted > NEAR)


main()
