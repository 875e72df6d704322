# Sourced: a Debian 12 made of packages, in a folder.

# make_debian_root DIR [packages…]: the smallest one. Comes from where this machine's packages come from.
make_debian_root() {
  local dir=$1 uri
  shift
  command -v debootstrap >/dev/null || fail "debootstrap is missing: apt-get install debootstrap"
  uri=$(grep -hm1 -oP '^(URIs:|deb)\s+\K\S+' /etc/apt/sources.list.d/*.sources /etc/apt/sources.list 2>/dev/null | head -n 1 || true)
  mkdir -p "$dir"
  debootstrap --variant=minbase --include="ca-certificates$(printf ',%s' "$@" | sed 's/^,$//')" bookworm "$dir" "${uri:-http://deb.debian.org/debian}" >"$dir.log" 2>&1 ||
    { tail -3 "$dir.log" >&2; fail "debootstrap could not make a Debian. The whole log: $dir.log"; }
  rm -f "$dir.log"
}

# use_own_sources DIR: packages come from where this machine's come from, with its settings and certificates.
use_own_sources() {
  local dir=$1
  rm -rf "$dir/etc/apt/sources.list" "$dir/etc/apt/sources.list.d" "$dir/usr/local/share/ca-certificates"
  cp -rL /etc/apt/sources.list.d "$dir/etc/apt/"
  [ ! -f /etc/apt/sources.list ] || cp /etc/apt/sources.list "$dir/etc/apt/"
  cp -r /etc/apt/apt.conf.d/. "$dir/etc/apt/apt.conf.d/"
  rm -f "$dir"/etc/apt/apt.conf.d/*packagekit* "$dir"/etc/apt/apt.conf.d/*appstream*
  cp -r /usr/local/share/ca-certificates "$dir/usr/local/share/"
  cp -r /etc/ssl/certs/. "$dir/etc/ssl/certs/"
  cp -L /etc/resolv.conf /etc/hosts "$dir/etc/"
}

# slim_debian_root DIR: without documentation, translations and caches, also of what is installed later, as Debian's slim images are.
slim_debian_root() {
  local dir=$1
  cat >"$dir/etc/dpkg/dpkg.cfg.d/slim" <<'CFG'
path-exclude /usr/share/doc/*
path-include /usr/share/doc/*/copyright
path-exclude /usr/share/groff/*
path-exclude /usr/share/info/*
path-exclude /usr/share/linda/*
path-exclude /usr/share/lintian/*
path-exclude /usr/share/locale/*
path-exclude /usr/share/man/*
CFG
  find "$dir/usr/share/doc" -mindepth 2 ! -name copyright ! -type d -delete
  rm -rf "$dir"/usr/share/{groff,info,linda,lintian,locale,man}/* "$dir"/var/lib/apt/lists/* "$dir"/var/cache/apt/* "$dir"/var/cache/debconf/*-old "$dir"/var/log/*
  find "$dir/usr/share/doc" -mindepth 1 -type d -empty -delete
  rm -f "$dir/etc/apt/sources.list"
  printf 'Types: deb\nURIs: http://deb.debian.org/%s\nSuites: %s\nComponents: main\nSigned-By: /usr/share/keyrings/debian-archive-keyring.gpg\n\n' \
    debian "bookworm bookworm-updates" debian-security bookworm-security >"$dir/etc/apt/sources.list.d/debian.sources"
}
