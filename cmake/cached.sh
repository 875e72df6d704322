#!/bin/sh
# Runs a compiler through ccache. Clang writes the folder's name into a precompiled header: it is never taken from the cache, and beside it goes a checksum of
# what it was compiled from, by which ccache finds the objects that use it in any folder (CCACHE_PCH_EXTSUM, see .ci/setup.sh). Paths that -Xclang passes on
# become relative for the same reason: ccache leaves them as they are.
case " $* " in
  *" -emit-pch "*)
    "$@" || exit
    while [ $# -gt 1 ]; do
      case $1 in
        -o) header=$2 ;;
        -MF) headers=$2 ;;
      esac
      shift
    done
    sed 's/^[^:]*://; s/\\$//' "$headers" | xargs cat | sha256sum >"$header.sum"
    exit
    ;;
esac
left=$# before=
while [ "$left" -gt 0 ]; do
  word=$1
  shift
  [ "$before" != -Xclang ] || word=${word#"$PWD"/}
  set -- "$@" "$word"
  before=$word left=$((left - 1))
done
exec ccache "$@"
