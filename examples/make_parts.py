#!/usr/bin/env python3
"""Writes the part files in examples/parts: G-code, DXF and job documents of our own making.

    python3 examples/make_parts.py            writes them all
    python3 examples/make_parts.py --check    writes nothing; exit code 1 if a file differs from what would be written
    python3 examples/make_parts.py --list     also prints the size of every file and the length of its cuts

Plain Python 3, standard library only. The same files, bit for bit, on every run: no clock, random numbers of fixed seeds, and all
numbers are rounded to a fixed count of decimals. The parts are in examples/generator, one module each.
"""
import argparse
import pathlib
import sys

sys.dont_write_bytecode = True

from generator import blades, bracket, fine_sheet, gear, lettering, machines, pocket, sheet, thread

FOLDER = pathlib.Path(__file__).resolve().parent / "parts"
FILES = {
    "laser.json": machines.laser,
    "mill.json": machines.mill,
    "bracket.ngc": bracket.gcode,
    "bracket.dxf": bracket.dxf,
    "gear.ngc": gear.gcode,
    "gear.dxf": gear.dxf,
    "sheet.ngc": sheet.gcode,
    "sheet.dxf": sheet.dxf,
    "lettering.ngc": lettering.gcode,
    "lettering.dxf": lettering.dxf,
    "blades.json": blades.job,
    "blades.ngc": blades.gcode,
    "thread.ngc": thread.gcode,
    "pocket.json": pocket.job,
    "fine_sheet.json": fine_sheet.job,
}


def main():
    parser = argparse.ArgumentParser(description="Writes the part files in examples/parts.")
    parser.add_argument("--check", action="store_true", help="compare only")
    parser.add_argument("--list", action="store_true", help="print sizes and lengths of the cuts")
    options = parser.parse_args()
    different = []
    for name, make in FILES.items():
        text, cut_length = make()
        data = text.encode("ascii")
        path = FOLDER / name
        if options.list:
            print(f"{name:14} {len(data):8} bytes {cut_length:14.6f} mm cut")
        if options.check:
            if not path.exists() or path.read_bytes() != data:
                different.append(name)
        else:
            FOLDER.mkdir(exist_ok=True)
            path.write_bytes(data)
    for name in different:
        print(f"examples/parts/{name} is not what this script writes", file=sys.stderr)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
