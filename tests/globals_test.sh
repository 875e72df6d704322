#!/usr/bin/env bash
# globals.sh has to fail on variables, also those of functions and of threads, and not on constants.
set -euo pipefail
globals=$(dirname "$0")/globals.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/core" "$work/api"
# expect <0|1> <source>
expect() {
  rm -f "$work"/core/*
  printf '%s\n' "$2" >"$work/core/x.cpp"
  "${CXX:-c++}" -std=c++20 -O1 -c -o "$work/core/x.o" "$work/core/x.cpp"
  ar rc "$work/core/libx.a" "$work/core/x.o"
  local got=0
  "$globals" "$work" "$work" >/dev/null || got=1
  [[ $got == "$1" ]] || { echo "$2: got $got, not $1"; exit 1; }
}
expect 0 'namespace bahnwerk { extern const int table[2]; const int table[2] = {1, 2}; }'
expect 0 'namespace bahnwerk { extern const char* const names[1]; const char* const names[1] = {"x"}; }'
expect 0 'int made(); namespace bahnwerk { int f() {
  static const int once = made();
  return once; } }'
expect 0 'int* made(); namespace bahnwerk { int f() {
  static int* const once = made();
  return *once; } }'
expect 1 'int made(); namespace bahnwerk { int f() {
  static int count = made();
  return ++count; } }'
expect 1 'const int* made(); namespace bahnwerk { int f() {
  static const int* last = made();
  return *++last; } }'
expect 1 'namespace bahnwerk { int counter; }'
expect 1 'namespace bahnwerk { int counter = 3; }'
expect 1 'namespace bahnwerk { const char* name = "x"; }'
expect 1 'namespace bahnwerk { int count() { static int n = 0; return ++n; } }'
expect 1 'namespace bahnwerk { thread_local int last = 1; int& f() { return last; } }'
expect 1 'int counter;'
