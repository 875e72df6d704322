#!/usr/bin/env python3
"""Runs clang-tidy over the sources of one or more folders.

    .ci/tidy.py BUILD FOLDER...            many files together in unity files
    .ci/tidy.py BUILD --plain FOLDER...    every file on its own (slow; shows includes that are missing, too)

BUILD is a configured build folder; its compile_commands.json tells flags. Reading the headers takes three quarters of clang-tidy's time, so the files of a
layer are included into a few unity files. Two files that define the same name cannot stand in one unity file: the compiler names the later one, which
moves on to another. What one file declares hides names of another there, so -Wshadow is the compilers' matter. Exits with 1 where clang-tidy finds
something. A layer in which nothing was found is not looked at again until a file of it, a header that it includes, a flag or a check changes.
"""
import collections
import concurrent.futures
import functools
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MOST_FILES = 40  # of one unity file
CLEAN = os.path.join(os.environ.get("XDG_CACHE_HOME", os.path.expanduser("~/.cache")), "bahnwerk", "tidy")  # an empty file for each clean layer


def sources(build, folders):
    """{layer: [(file, flags)]} from the compilation database."""
    found = collections.defaultdict(list)
    with open(os.path.join(build, "compile_commands.json")) as stream:
        for entry in json.load(stream):
            name = os.path.relpath(entry["file"], ROOT)
            if name.startswith(".") or name.split(os.sep)[0] not in folders:
                continue
            words = shlex.split(entry["command"])
            layer = words[words.index("-o") + 1].split(".dir/")[0].replace("/CMakeFiles/", "/")
            words = words[next(i for i, word in enumerate(words) if word.startswith("-")):]
            flags = [word for i, word in enumerate(words)
                     if word not in ("-o", "-c") and words[i - 1] not in ("-o", "-c")]
            found[layer].append((name, flags))
    return found


@functools.cache
def text_of(name):
    with open(os.path.join(ROOT, name), "rb") as stream:
        return stream.read()


def with_includes(names):
    """The files and all headers of the project that they include."""
    found, left = set(), list(names)
    while left:
        name = left.pop()
        if name not in found and os.path.isfile(os.path.join(ROOT, name)):
            found.add(name)
            left += re.findall(r'^#include "([^"]+)"', text_of(name).decode(), re.M)
    return sorted(found)


@functools.cache
def version():
    return subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout


def key_of(layer, names, flags):
    """What clang-tidy's findings in a layer depend on."""
    key = hashlib.sha256(version() + text_of(".clang-tidy") + text_of(".ci/tidy.py"))
    for word in [layer, *names, *(flag.replace(ROOT, "") for flag in flags)]:
        key.update(word.encode() + b"\0")
    for name in with_includes(names):
        key.update(name.encode() + b"\0" + hashlib.sha256(text_of(name)).digest())
    return os.path.join(CLEAN, key.hexdigest())


def write_unity(build, layer, number, files):
    path = os.path.join(build, "tidy", f"{layer.replace('/', '_')}_{number}.cpp")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as stream:
        stream.writelines(f'#include "{os.path.join(ROOT, name)}"\n' for name in files)
    return path


def clashing(path, flags, files):
    """Files of the unity file in which the compiler finds an error."""
    run = subprocess.run(["clang++", "-fsyntax-only", "-w", "-ferror-limit=0", *flags, path], cwd=ROOT, capture_output=True, text=True)
    if run.returncode == 0:
        return set()
    found = {os.path.relpath(place, ROOT) for place in re.findall(r"^(/[^:\n]+):\d+:\d+: (?:fatal )?error:", run.stderr, re.M)}
    return found & set(files) or {files[-1]}


def settled(build, layer, number, flags, files):
    """Writes a unity file that compiles, or holds one file only; returns it and the files that could not stay."""
    later = []
    while True:
        path = write_unity(build, layer, number, files)
        bad = clashing(path, flags, files) if len(files) > 1 else set()
        if not bad:
            return path, later
        # The first of the files always stays, so that each turn gets somewhere.
        kept = [name for name in files if name not in bad] or files[:1]
        later += [name for name in files if name not in kept]
        files = kept


def tidy(path, flags, plain):
    checks = [] if plain else ["--checks=-bugprone-suspicious-include", "--extra-arg=-Wno-shadow"]
    run = subprocess.run(["clang-tidy", "--quiet", *checks, path, "--", *flags], cwd=ROOT, capture_output=True, text=True)
    return run.returncode, run.stdout + (run.stderr if run.returncode else "")


def check_together(build, layer, entries):
    """clang-tidy's results for the unity files of a layer; files that cannot stay where they are go round again."""
    flags = list(dict.fromkeys(flag for _, flags in entries for flag in joined(flags)))
    flags = [word for flag in flags for word in flag.split("\n")]
    names = sorted(name for name, _ in entries)
    key = key_of(layer, names, flags)
    if os.path.exists(key):
        return []
    results, number = [], 0
    while names:
        count = -(-len(names) // MOST_FILES)
        later = []
        for files in (names[i::count] for i in range(count)):
            path, more = settled(build, layer, number, flags, files)
            results.append(tidy(path, flags, False))
            later += more
            number += 1
        names = sorted(later)
    if not any(code for code, _ in results):
        os.makedirs(CLEAN, exist_ok=True)
        open(key, "w").close()
    return results


def joined(flags):
    """Flags of two words as one."""
    words = iter(flags)
    return [word if word not in ("-isystem", "-I", "-include") else word + "\n" + next(words) for word in words]


def main():
    words = [word for word in sys.argv[1:] if word != "--plain"]
    plain = "--plain" in sys.argv
    build, folders = os.path.abspath(words[0]), words[1:]
    found = sources(build, folders)
    if not found:
        sys.exit(f"{build} knows no source of {' '.join(folders)}")
    by_size = sorted(found.items(), key=lambda item: -len(item[1]))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        if plain:
            files = [entry for _, entries in by_size for entry in entries]
            results = list(pool.map(lambda entry: tidy(os.path.join(ROOT, entry[0]), entry[1], True), files))
        else:
            results = [result for found_here in pool.map(lambda item: check_together(build, *item), by_size) for result in found_here]
    for code, text in results:
        if code:
            print(text)
    print(f"{sum(map(len, found.values()))} files in {len(results)} runs", file=sys.stderr)
    sys.exit(any(code for code, _ in results))


main()
