#!/usr/bin/env python3
"""Computes every digit of the verification that is called independent, and compares it with what the cases hold.

    python3 regenerate.py              # all, in about a quarter of an hour
    python3 regenerate.py --quick      # those that take seconds, in about a minute
    python3 regenerate.py helix andrews  # programs by name
    python3 regenerate.py --list
    python3 regenerate.py --write      # also writes digits.toml, which the project's tests compare with the cases

The exit code is 1 where a case differs from what is computed by more than its `uncertainty` and the error found here.
Needs mpmath, SciPy and NumPy (requirements.txt); nothing of Lissom."""

import argparse
import sys
import time
import tomllib
from pathlib import Path

from mpmath import mp, mpf

HERE = Path(__file__).parent
CASES = HERE.parent
# Programs that take more than some ten seconds each.
LONG = {"bend_45", "helix", "princeton", "lee", "arch", "right_angle", "misaligned", "governor", "andrews"}
MODULES = ["cantilevers", "planar", "buckling", "four_bar", "rigid", "closed_loops", "closed_forms", "rotor"]


class Rows:
    """What the programs computed, beside what the cases say."""

    def __init__(self):
        self.found = []
        self.failures = 0
        self.cases = {}

    def case(self, name):
        if name not in self.cases:
            self.cases[name] = tomllib.loads((CASES / name / "case.toml").read_text())
        return self.cases[name]

    def row(self, case, name, kind="quantity"):
        rows = [row for row in self.case(case).get(kind, []) if row["name"] == name]
        if len(rows) != 1:
            raise LookupError(f"{case}: {len(rows)} rows `{name}`")
        return rows[0]

    def note(self, words):
        """Something computed that no case holds."""
        print(f"  {words}", flush=True)

    def add(self, case, name, pairs):
        """Values with error estimates for the entries of a row, in their order."""
        row = self.row(case, name)
        held = [entry[2] for entry in row["entries"]] if "entries" in row else [row["reference"]]
        if len(held) != len(pairs):
            raise LookupError(f"{case}, `{name}`: {len(held)} entries, {len(pairs)} computed")
        scale = row.get("scale", max(abs(v) for v in held))
        uncertainty = row.get("uncertainty", self.case(case).get("uncertainty"))
        self.compare(case, name, held, pairs, scale, uncertainty)

    def refinement(self, case, name, pairs):
        """The exact values of a study of convergence."""
        held = self.row(case, name, "refinement")["reference"]
        self.compare(case, name, held, pairs, max(abs(v) for v in held), self.case(case)["uncertainty"])

    def table(self, case, file, columns, values):
        """A reference curve: instants and pairs for `columns`."""
        lines = [line for line in (CASES / case / file).read_text().splitlines() if line and line[0] != "#"]
        held, pairs = [], []
        by_time = {float(line.split(",")[0]): [float(v) for v in line.split(",")] for line in lines}
        for instant, found in values.items():
            nearest = min(by_time, key=lambda t: abs(t - instant))
            if abs(nearest - instant) > 1e-9 * max(1.0, abs(instant)):
                raise LookupError(f"{case}/{file} has no instant {instant}")
            held += [by_time[nearest][column] for column in columns]
            pairs += found
        rows = [row for row in self.case(case)["curve"] if row.get("file") == file]
        scale = rows[0].get("scale", max(abs(v) for v in held))
        uncertainty = rows[0].get("uncertainty", self.case(case).get("uncertainty"))
        self.compare(case, file, held, pairs, scale, uncertainty, keep=False)

    def instants(self, case, file):
        """Those of a reference curve."""
        lines = (CASES / case / file).read_text().splitlines()
        return [float(line.split(",")[0]) for line in lines if line and line[0] != "#"]

    def compare(self, case, name, held, pairs, scale, uncertainty, keep=True):
        worst, error = mpf(0), mpf(0)
        for index, (reference, (value, own)) in enumerate(zip(held, pairs)):
            # A case holds doubles.
            worst = max(worst, abs(mpf(reference) - value) / scale)
            error = max(error, mpf(own) / scale)
            if keep:
                self.found.append([case, name, index, toml_number(value, 17), toml_number(own, 2)])
        allowed = mpf(uncertainty) + error + mpf(10) ** -15
        good = worst <= allowed
        self.failures += not good
        print(
            f"  {case}, {name}: {len(pairs)} values, own error {mp.nstr(error, 2)}, differs from the case by "
            f"{mp.nstr(worst, 2)}{'' if good else '  FAILS: more than ' + mp.nstr(allowed, 2)}",
            flush=True,
        )


def toml_number(value, digits):
    """A number as TOML reads it."""
    text = mp.nstr(mpf(value), digits, min_fixed=-4, max_fixed=17, show_zero_exponent=False)
    return text if "." in text or "e" in text else text + ".0"


def programs():
    import importlib

    found = {}
    for module in map(importlib.import_module, MODULES):
        for program in module.PROGRAMS:
            found[program.__name__] = program
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="programs; all if none is given")
    parser.add_argument("--list", action="store_true", help="only print the programs")
    parser.add_argument("--quick", action="store_true", help="leave out what takes more than seconds")
    parser.add_argument("--write", action="store_true", help="write digits.toml")
    arguments = parser.parse_args()
    known = programs()
    if arguments.list:
        for name, program in known.items():
            long = "long " if name in LONG else ""
            print(f"{name:20} {long:5}{(program.__doc__ or '').splitlines()[0]}")
        return 0
    unknown = [name for name in arguments.names if name not in known]
    if unknown:
        print(f"no program {', '.join(unknown)}; --list prints their names", file=sys.stderr)
        return 2
    rows = Rows()
    wanted = arguments.names or [name for name in known if not (arguments.quick and name in LONG)]
    for name in wanted:
        began = time.perf_counter()
        print(name, flush=True)
        known[name](rows)
        print(f"  {time.perf_counter() - began:.1f} s", flush=True)
    if arguments.write:
        write(rows)
    return 1 if rows.failures else 0


def write(rows):
    """The digits, in place of those of the programs that ran."""
    path = HERE / "digits.toml"
    kept = {}
    if path.exists():
        for row in tomllib.loads(path.read_text()).get("row", []):
            pairs = [(repr(value), repr(error)) for value, error in zip(row["values"], row["errors"])]
            kept[row["case"], row["row"]] = pairs
    for key in {(case, name) for case, name, *_ in rows.found}:
        kept[key] = []
    for case, name, _, value, error in rows.found:
        kept[case, name].append((value, error))
    lines = ["# Made by `python3 regenerate.py --write`; do not edit. What the cases hold, computed without Lissom."]
    for (case, name), pairs in sorted(kept.items()):
        values, errors = zip(*pairs)
        lines += ["", "[[row]]", f'case = "{case}"', f'row = "{name}"']
        lines += [f"values = [{', '.join(values)}]", f"errors = [{', '.join(errors)}]"]
    path.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    sys.exit(main())
