#!/usr/bin/env python3
"""Writes a part program as shops have them, of any size, to standard output.

    python3 examples/make_programs.py carving            lettering carved with a V-shaped tool
    python3 examples/make_programs.py spiral             tangent arcs in the plane
    python3 examples/make_programs.py scan --size 5000   a surface as measured, milled in the XZ plane
    python3 examples/make_programs.py clearing --seed 7  pockets cleared ring by ring

The same program, bit for bit, for the same kind, seed and size. They are too large to be kept: tests/bench/programs.py
plans them. Plain Python 3, standard library only.
"""
import argparse
import sys

sys.dont_write_bytecode = True

from generator import carving, clearing, scan, spiral

KINDS = {"carving": carving, "spiral": spiral, "scan": scan, "clearing": clearing}


def main():
    parser = argparse.ArgumentParser(description="Writes a part program to standard output.")
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", type=int, help="strokes, arcs or lines; default: that of a usual program")
    options = parser.parse_args()
    kind = KINDS[options.kind]
    sys.stdout.write(kind.gcode(options.seed, options.size or kind.SIZE))


if __name__ == "__main__":
    main()
