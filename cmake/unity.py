#!/usr/bin/env python3
"""Writes the unity files of all targets: sources that can be compiled together, included by their paths within the project.

    cmake/unity.py SIZE FOLDER     FOLDER/targets.txt: one line per target, its name and its sources; written: FOLDER/TARGET/NUMBER.cpp

Reading the headers takes half of a compiler's time; files that are compiled together read them once. A file goes into the first group in which no other file
declares or includes one of its local names (what stands in an unnamed namespace, constants, aliases, macros), or a namespace that hides one whose name it uses.
A group holds SIZE files at most; large files count as several, so that no group keeps one processor busy while others have ended.
"""
import functools
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LARGE = 12000  # characters of a source that counts as one file; a longer one counts as several


def without_comments(text):
    text = re.sub(r'R"(\w*)\(.*?\)\1"', '""', text, flags=re.S)
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', " ", text, flags=re.S)


def declared(statement):
    """Names that one statement at namespace scope declares."""
    statement = re.sub(r"^(?:\s*template\s*<.*?>(?=\s*\w))+", "", statement.strip(), flags=re.S)
    found = re.match(r"(?:struct|class|union|enum(?:\s+class)?)\s+(\w+)", statement) or re.match(r"using\s+(\w+)\s*=", statement)
    if found:
        return {found.group(1)}
    found = re.match(r"using\s+(?!namespace\b)(?:\w*::)+(\w+)\s*;", statement)
    if found:
        return {found.group(1)}
    if re.match(r"using\b|static_assert\b|friend\b|[A-Z_]+\s*\(", statement):  # the last ones are macros
        return set()
    call = re.match(r"[^=({]*?(\w+)\s*(?=[=({\[;])", statement)
    names = {call.group(1)} if call else set()
    if not re.match(r"[^={]*\(", statement):
        names |= set(re.findall(r",\s*(\w+)\s*(?=[={\[])", statement))
    return names


def names_of(text):
    """Names that a source or header declares for itself, and those that it declares for whoever includes it."""
    text = without_comments(text)
    local, public = set(re.findall(r"^\s*#\s*define\s+(\w+)", text, flags=re.M)), set()
    local |= set(re.findall(r"^\s*namespace\s+(\w+)\s*=", text, flags=re.M))
    text = re.sub(r"^\s*#[^\n]*", "", text, flags=re.M)
    scopes, start = [], 0  # of each open brace: "unnamed", "namespace" or "other"

    def note(statement):
        own = re.match(r"\s*(?:static\b|const\b|constexpr\b|using\s+\w+\s*=)", statement)
        own = own or "unnamed" in scopes and not re.match(r"\s*using\b", statement)
        (local if own else public).update(declared(statement))

    for place in (sign.start() for sign in re.finditer(r"[{};]", text)):
        outside = "other" not in scopes
        if text[place] == "{":
            before = text[start:place].strip()
            if outside and re.fullmatch(r"(?:inline\s+)?namespace", before):
                scopes.append("unnamed")
            elif outside and re.match(r"(?:inline\s+)?namespace\b", before):
                scopes.append("namespace")
            else:
                if outside:
                    note(before + "{")
                scopes.append("other")
                continue
            start = place + 1
        elif text[place] == "}":
            if scopes and scopes.pop() != "other" or "other" not in scopes and not re.match(r"\s*[,;)]", text[place + 1:place + 40]):
                start = place + 1
        elif outside:
            note(text[start:place + 1])
            start = place + 1
    return local, public


class Source:
    """What decides which sources may be compiled together: `local`, names that it declares for itself; `seen`, all names that it or what it includes declares
    at namespace scope; `namespaces` that are seen; `qualifiers`, names before :: in their text; `opened`, namespaces of which it uses all."""

    def __init__(self, name):
        with open(os.path.join(ROOT, name)) as stream:
            text = stream.read()
        self.name, self.weight = name, 1 + len(text) // LARGE
        local, public = names_of(text)
        self.local, self.seen = local, local | public
        self.namespaces = declared_namespaces(text)
        self.qualifiers = qualifiers(text)
        self.opened = set(re.findall(r"^\s*using namespace ([\w:]+)", text, flags=re.M))
        for header in includes(text):
            names, namespaces, before = included(header)
            self.seen |= names
            self.namespaces |= namespaces
            self.qualifiers |= before

    def disturbs(self, other):
        opened = self.opened and other.opened and self.opened != other.opened
        hidden = {name.rsplit("::", 1)[-1] for name in self.namespaces - other.namespaces}
        return opened or self.local & other.seen or hidden & other.qualifiers


def includes(text):
    return re.findall(r'^#include "([^"]+)"', text, flags=re.M)


def declared_namespaces(text):
    return set(re.findall(r"^namespace ([\w:]+) \{", text, flags=re.M))


def qualifiers(text):
    return set(re.findall(r"(?<![\w:])(\w+)::", without_comments(text)))


@functools.cache
def included(header):
    """Names and namespaces that a header and what it includes declare, and qualifiers that they use."""
    path = os.path.join(ROOT, header)
    if not os.path.exists(path):
        return set(), set(), set()
    with open(path) as stream:
        text = stream.read()
    found = set().union(*names_of(text)), declared_namespaces(text), qualifiers(text)
    for inner in includes(text):
        found = tuple(mine | more for mine, more in zip(found, included(inner)))
    return found


def groups(files, size):
    made = []
    for source in map(Source, files):
        for group in made:
            if source.weight + sum(other.weight for other in group) <= size and not any(
                    source.disturbs(other) or other.disturbs(source) for other in group):
                group.append(source)
                break
        else:
            made.append([source])
    return [[source.name for source in group] for group in made]


def write(folder, files):
    """Makes a folder hold these texts by name and nothing else; what is the same already stays untouched, so that it is not compiled again."""
    os.makedirs(folder, exist_ok=True)
    for name in set(os.listdir(folder)) - set(files):
        os.remove(os.path.join(folder, name))
    for name, text in files.items():
        path = os.path.join(folder, name)
        if not os.path.exists(path) or open(path).read() != text:
            with open(path, "w") as stream:
                stream.write(text)


def main():
    size, folder = int(sys.argv[1]), sys.argv[2]
    with open(os.path.join(folder, "targets.txt")) as stream:
        targets = [line.split() for line in stream]
    for target, *sources in targets:
        made = groups(sorted(sources), size)
        write(os.path.join(folder, target), {f"{k:02}.cpp": "".join(f'#include "{name}"\n' for name in group) for k, group in enumerate(made, 1)})


if __name__ == "__main__":
    main()
