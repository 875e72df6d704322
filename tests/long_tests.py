#!/usr/bin/env python3
"""Fails where a pattern of LONG in a CMakeLists.txt of tests/ names no test: a test that was renamed would run under sanitizers, for minutes.

    tests/long_tests.py ROOT
"""
import fnmatch
import pathlib
import re
import sys


def tests_of(folder, words):
    """Names of the tests in the sources that a bahnwerk_tests(...) compiles, as GoogleTest prints them; of an instantiated test the first one."""
    names, patterns = set(), ["**/*.cpp"]
    if "FLAT" in words:
        below = words[words.index("WITH") + 1 : words.index("LINK")] if "WITH" in words else []
        patterns = ["*.cpp", *(f"{name}/*.cpp" for name in below)]
    for path in (path for pattern in patterns for path in folder.glob(pattern)):
        text = path.read_text()
        names |= {f"{suite}.{test}" for suite, test in re.findall(r"TEST(?:_F)?\(\s*(\w+),\s*(\w+)", text)}
        for prefix, suite in re.findall(r"INSTANTIATE_TEST_SUITE_P\(\s*(\w+),\s*(\w+)", text):
            names |= {f"{prefix}/{suite}.{test}/0" for test in re.findall(rf"TEST_P\(\s*{suite},\s*(\w+)", text)}
    return names


def main():
    root, wrong = pathlib.Path(sys.argv[1]), []
    for lists in (root / "tests").glob("**/CMakeLists.txt"):
        for name, words in re.findall(r"^bahnwerk_tests\((\w+)([^)]*)\)", lists.read_text(), flags=re.M):
            names = tests_of(lists.parent, words.split())
            patterns = words.partition(" LONG ")[2].partition(" WITHOUT ")[0].split()
            wrong += [f"{lists.relative_to(root)}: no test of {name} is called {p}" for p in patterns if not any(fnmatch.fnmatchcase(n, p) for n in names)]
    print("\n".join(wrong))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
