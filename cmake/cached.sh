#!/bin/sh
# Runs a compiler through ccache. Clang writes the folder's name into a precompiled header, so that no object that uses it would be found in the cache of
# another folder; beside it goes a checksum of what it was compiled from, by which ccache knows it (CCACHE_PCH_EXTSUM, see .ci/setup.sh).
ccache "$@" || exit
case " $* " in *" -emit-pch "*) ;; *) exit 0 ;; esac
while [ $# -gt 1 ]; do
  case $1 in
    -o) header=$2 ;;
    -MF) headers=$2 ;;
  esac
  shift
done
sed 's/^[^:]*://; s/\\$//' "$headers" | xargs cat | sha256sum >"$header.sum"
