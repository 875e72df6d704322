#!/usr/bin/env python3
"""Writes the manual page (packed) and the shells' completions from what the program says with --help.

    describe.py man|bash|zsh PROGRAM OUT
"""
import gzip
import os
import re
import subprocess
import sys
from dataclasses import dataclass, field


@dataclass
class Option:
    names: list  # "-h", "--help"; of a positional its name
    value: str  # placeholder, empty for a switch
    choices: list
    default: str
    variable: str
    text: str


@dataclass
class Command:
    name: str
    summary: str
    options: list = field(default_factory=list)
    positionals: list = field(default_factory=list)
    commands: list = field(default_factory=list)  # (name, summary)
    footer: str = ""


# One blank alone separates a head that ends with its variable at the text's column.
LINE = re.compile(r"^  (?P<head>\S.*?)(?:(?:  +|(?<=\)) )(?P<text>\S.*))?$")


def parse_option(head, text):
    variable = re.search(r" \(Env:(\w+)\)", head)
    head = re.sub(r" \(Env:\w+\)| REQUIRED| (Needs|Excludes): \S+", "", head)
    names, _, value = head.partition(" ")
    choices = re.search(r"\{([^}]*)\}", value)
    default = re.search(r"=([^=\]]*)$", value)
    word = re.match(r"HOST:PORT|\w*", value)[0]
    return Option(names.split(","), word, choices[1].split(",") if choices else [], default[1] if default else "",
                  variable[1] if variable else "", text or "")


def parse_help(text, name):
    lines = text.splitlines()
    command, section, pending = Command(name, lines[0]), "", None
    target = {"Options:": command.options, "Positionals:": command.positionals}
    for line in lines[1:]:
        if line.startswith("Usage:"):
            continue
        if line.endswith(":") and not line.startswith(" "):
            section = line
        elif section and line.startswith("      ") and pending is not None:
            pending.text = (pending.text + " " + line.strip()).strip()
        elif section and line.startswith("  "):
            head, words = LINE.match(line).group("head", "text")
            if section == "Subcommands:":
                pending = None
                command.commands.append((head, words or ""))
            else:
                pending = parse_option(head, words)
                target[section].append(pending)
        elif line.strip():
            section, pending = "", None
            command.footer = (command.footer + " " + line.strip()).strip()
    return command


def ask(program, *words):
    return subprocess.run([program, *words, "--help"], check=True, capture_output=True, text=True).stdout


def describe(program):
    top = parse_help(ask(program), "bahnwerk")
    return top, [parse_help(ask(program, name), name) for name, _ in top.commands]


def below(program, commands):
    """The commands of commands: key add."""
    return [parse_help(ask(program, command.name, name.split(",")[0]), "%s %s" % (command.name, name.split(",")[0]))
            for command in commands for name, _ in command.commands]


# Manual page: roff [man(7)]


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def roff_option(option):
    head = ", ".join("\\fB%s\\fR" % roff(name) for name in option.names)
    if option.value:
        head += " \\fI%s\\fR" % roff("|".join(option.choices) or option.value)
    notes = [note for note in (option.default and "default %s" % option.default,
                               option.variable and "environment %s" % option.variable) if note]
    return ".TP\n%s\n%s%s\n" % (head, roff(option.text), roff(" (%s)" % ", ".join(notes)) if notes else "")


def man(program):
    top, commands = describe(program)
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
    page = ['.TH BAHNWERK 1 "" "bahnwerk %s" "User Commands"\n' % version,
            ".SH NAME\nbahnwerk \\- %s\n" % roff(top.summary.split(": ", 1)[-1].rstrip(".")),
            ".SH SYNOPSIS\n.B bahnwerk\n.I COMMAND\n[\\fIOPTIONS\\fR]\n",
            ".SH DESCRIPTION\n%s\n" % roff(top.footer), ".SH OPTIONS\n", *map(roff_option, top.options)]
    for command in commands + below(program, commands):
        words = "".join(" \\fI%s\\fR" % roff(each.names[0].upper()) for each in command.positionals)
        page += [".SH %s\n" % roff(command.name.upper()), ".B bahnwerk %s\n[\\fIOPTIONS\\fR]%s\n.PP\n" % (command.name, words),
                 roff(command.summary) + "\n", *map(roff_option, command.positionals), *map(roff_option, command.options)]
        page += [".PP\n%s\n" % roff(command.footer)] if command.footer else []
    page += [".SH FILES\n.TP\n.I /etc/default/bahnwerk\nsettings of the packaged service\n",
             ".TP\n.I /var/lib/bahnwerk\nits jobs and results\n",
             ".SH SEE ALSO\n.I /usr/share/doc/bahnwerk/operations.md\n"]
    return "".join(page)


# Completions


def values(option):
    """What completes an option's value or a positional: words, or "file"."""
    if option.choices:
        return option.choices
    return "file" if option.value in ("FILE", "DIR") or option.text.startswith("job document") else []


def bash(program):
    top, commands = describe(program)
    out = ["# bash completion of bahnwerk", "_bahnwerk() {",
           "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}",
           '  COMPREPLY=()',
           "  if ((COMP_CWORD == 1)); then",
           '    mapfile -t COMPREPLY < <(compgen -W "%s" -- "$current")'
           % " ".join([name for name, _ in top.commands] + [name for option in top.options for name in option.names]),
           "    return", "  fi", "  case ${COMP_WORDS[1]}:$before in"]
    for command in commands:
        for option in command.options:
            given = values(option)
            pattern = "|".join("%s:%s" % (command.name, name) for name in option.names)
            words = "-f" if given == "file" else '-W "%s"' % " ".join(given)
            if given:
                out.append('    %s) mapfile -t COMPREPLY < <(compgen %s -- "$current"); return ;;' % (pattern, words))
            elif option.value:
                out.append("    %s) return ;;" % pattern)
    out += ["  esac", "  case ${COMP_WORDS[1]}:$current in"]
    for command in commands:
        names = " ".join(name for option in command.options for name in option.names)
        out.append('    %s:-*) mapfile -t COMPREPLY < <(compgen -W "%s" -- "$current") ;;' % (command.name, names))
        if any(values(each) == "file" for each in command.positionals):
            out.append('    %s:*) mapfile -t COMPREPLY < <(compgen -f -- "$current") ;;' % command.name)
    out += ["  esac", "}", "complete -o filenames -F _bahnwerk bahnwerk", ""]
    return "\n".join(out)


def zsh(program):
    quote = lambda text: text.replace("'", "'\\''").replace("[", "(").replace("]", ")").replace(":", "\\:")
    top, commands = describe(program)
    out = ["#compdef bahnwerk", "", "_bahnwerk() {", "  local -a commands=("]
    out += ["    '%s:%s'" % (name, quote(summary)) for name, summary in top.commands]
    out += ["  )", "  if ((CURRENT == 2)); then", "    _describe command commands", "    return", "  fi", "  case $words[2] in"]
    for command in commands:
        out.append("    %s)" % command.name)
        specs = []
        for option in command.options:
            given = values(option)
            action = "" if not option.value else ":%s:%s" % (quote(option.value), "_files" if given == "file" else "(%s)" % " ".join(given))
            specs += ["'%s[%s]%s'" % (name, quote(option.text), action) for name in option.names]
        for place in command.positionals:
            specs.append("':%s:%s'" % (place.names[0], "_files" if values(place) == "file" else "( )"))
        out += ["      shift words; ((CURRENT--))", "      _arguments \\", *["        %s \\" % spec for spec in specs[:-1]], "        %s" % specs[-1], "      ;;"]
    out += ["  esac", "}", "", '_bahnwerk "$@"', ""]
    return "\n".join(out)


if __name__ == "__main__":
    form, binary, out = sys.argv[1:]
    text = {"man": man, "bash": bash, "zsh": zsh}[form](os.path.abspath(binary))
    with open(out, "wb") as file:
        file.write(gzip.compress(text.encode(), mtime=0) if form == "man" else text.encode())
