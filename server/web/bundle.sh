#!/bin/sh
# bundle.sh FOLDER: bundles the modules and the style of pages into it. Each page has one file, so that it loads in one request; space.js is loaded by those
# that draw in space, descriptions_de.js by the form in German. The same sources give the same bytes.
set -eu
cd "$(dirname "$0")"
mkdir -p "$1"
rm -f "$1"/*
esbuild plain.ts jobs.ts job.ts new.ts compare.ts space.ts descriptions_de.ts style.css --bundle --minify --format=esm --target=es2020 \
  --legal-comments=eof --alias:three=/usr/share/javascript/three/build/three.module.js --log-level=warning --outdir="$1"
cp favicon.svg pictures/*.svg "$1"
