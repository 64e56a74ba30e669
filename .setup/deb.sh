#!/usr/bin/env bash
# deb.sh BUILD FOLDER: Debian packages of what was built in BUILD, into FOLDER: ambulo (program, manual,
# models), libambulo and the number of its soname, libambulo-dev. `make deb` calls it. Needs dpkg-dev.
#
# Made by dpkg-deb from an install below a folder of its own: no debian/ among the sources. Who builds a
# package is its maintainer: DEBFULLNAME and DEBEMAIL, or what git knows.
set -eu
out=$1 folder=$2
command -v dpkg-shlibdeps >/dev/null && command -v dpkg-deb >/dev/null ||
  { echo 'make deb needs dpkg-deb and dpkg-shlibdeps (apt-get install dpkg-dev)' >&2; exit 1; }
here=$(pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
umask 022
tuple=$(dpkg-architecture -qDEB_HOST_MULTIARCH) arch=$(dpkg-architecture -qDEB_HOST_ARCH)
name=${DEBFULLNAME:-$(git config user.name 2>/dev/null || id -un)}
mail=${DEBEMAIL:-$(git config user.email 2>/dev/null || echo "$(id -un)@$(hostname -f)")}

make --no-print-directory -o all OUT="$out" install DESTDIR="$work/all" PREFIX=/usr \
  LIBDIR="/usr/lib/$tuple"
title=$(sed -n 1p "$work/all/usr/share/man/man1/ambulo.1")
version=$(echo "$title" | sed 's/.*"ambulo \(.*\)".*/\1/') day=$(echo "$title" | awk '{ print $4 }')
soname=$(basename "$(find "$work/all/usr/lib" -type l -name 'libambulo.so.*')")
so=${soname#libambulo.so.}
export SOURCE_DATE_EPOCH
SOURCE_DATE_EPOCH=$(date -u -d "$day" +%s)

# ------------------------------------------------------- which file is whose

lib=usr/lib/$tuple
move() { # PACKAGE PATHS...
  local package=$1 path
  shift
  for path in "$@"; do
    mkdir -p "$work/$package/$(dirname "$path")"
    mv "$work/all/$path" "$work/$package/$path"
  done
}
rm "$work/all/usr/share/ambulo/manifest" # dpkg has its own
rm "$work/all/usr/share/doc/ambulo/LICENSE" # as doc/*/copyright
move "libambulo$so" "$lib/$soname" "$lib/libambulo.so.$version"
move libambulo-dev usr/include "$lib/libambulo.a" "$lib/libambulo.so" "$lib/pkgconfig" "$lib/cmake"
rmdir "$work/all/$lib" "$work/all/usr/lib"
# where the zsh of Debian looks for what packages bring; it does not look into site-functions
mv "$work/all/usr/share/zsh/site-functions" "$work/all/usr/share/zsh/vendor-completions"
mv "$work/all" "$work/ambulo"

strip --remove-section=.comment --remove-section=.note "$work/ambulo/usr/bin/ambulo"
strip --strip-unneeded --remove-section=.comment --remove-section=.note \
  "$work/libambulo$so/$lib/libambulo.so.$version"
strip --strip-debug --remove-section=.comment --remove-section=.note --enable-deterministic-archives \
  "$work/libambulo-dev/$lib/libambulo.a"
chmod 644 "$work/libambulo$so/$lib/libambulo.so.$version"
gzip -9n "$work"/ambulo/usr/share/man/man*/*

# ------------------------------------------------------------ what dpkg asks

needs() { # FILE: "libc6 (>= 2.34), ..."
  mkdir -p "$work/shlibs/debian"
  : >"$work/shlibs/debian/control"
  (cd "$work/shlibs" && dpkg-shlibdeps -O "$1" 2>/dev/null) | sed 's/^shlibs:Depends=//'
}
program=$(needs "$work/ambulo/usr/bin/ambulo")
library=$(needs "$work/libambulo$so/$lib/libambulo.so.$version")
# what libambulo.a is linked with: the package of each -lNAME that pkg-config tells
static=
for option in $(sed -n 's/^Libs.private: //p' "$work/libambulo-dev/$lib/pkgconfig/ambulo.pc"); do
  case $option in
  -lnlopt) static="$static, libnlopt-dev" ;;
  -lyaml) static="$static, libyaml-dev" ;;
  -lopenblas) static="$static, libopenblas-dev" ;;
  -llapack) static="$static, liblapack-dev" ;;
  -lblas) static="$static, libblas-dev" ;;
  -lexpat) static="$static, libexpat1-dev" ;;
  -lz) static="$static, zlib1g-dev" ;;
  -lm | -lpthread | -L*) ;; # libc6-dev, which a compiler brings
  *) echo "deb.sh: no package is known for $option" >&2; exit 1 ;;
  esac
done

# KiB as dpkg-gencontrol counts them: whole ones of each file, one for what else there is. Blocks of the
# file system would differ between machines.
size() { find "$1" -printf '%y %s\n' | awk '{ sum += $1 == "f" ? int(($2 + 1023) / 1024) : 1 } END { print sum }'; }

# what is linked and bundled, with its licences
if command -v python3 >/dev/null; then
  "$here/.setup/sbom.py" "$out/ambulo" "$work/sbom"
else
  echo 'skipped without python3: the list of what is linked and bundled'
fi

mkdir -p "$folder"
for package in ambulo "libambulo$so" libambulo-dev; do
  root=$work/$package
  doc=$root/usr/share/doc/$package
  mkdir -p "$doc" "$root/DEBIAN"
  cp "$here/.setup/debian/copyright" "$doc/copyright"
  [ ! -f "$work/sbom" ] || cp "$work/sbom" "$doc/sbom.cdx.json"
  printf 'ambulo (%s) unstable; urgency=medium\n\n  * Release %s. What changed: CHANGELOG.md of the sources.\n\n -- %s <%s>  %s\n' \
    "$version" "$version" "$name" "$mail" "$(LC_ALL=C date -u -d "$day" '+%a, %d %b %Y %H:%M:%S +0000')" |
    gzip -9n >"$doc/changelog.gz"
  sed "s/@so@/$so/g" "$here/.setup/debian/control" |
    awk -v package="$package" -v RS= '$2 == package' |
    sed "s/@version@/$version/; s/@program@/$program/; s/@library@/$library/; s/@static@/${static#, }/" >"$work/stanza"
  {
    sed -n 1p "$work/stanza"
    [ "$package" = ambulo ] || echo 'Source: ambulo'
    printf 'Version: %s\nArchitecture: %s\nMaintainer: %s <%s>\n' "$version" "$arch" "$name" "$mail"
    printf 'Installed-Size: %s\nPriority: optional\n' "$(size "$root/usr")"
    sed 1d "$work/stanza"
  } >"$root/DEBIAN/control"
  if [ "$package" = "libambulo$so" ]; then
    echo "libambulo $so libambulo$so (>= $version)" >"$root/DEBIAN/shlibs"
    echo 'activate-noawait ldconfig' >"$root/DEBIAN/triggers"
  fi
  (cd "$root" && find usr -type f | LC_ALL=C sort | xargs md5sum) >"$root/DEBIAN/md5sums"
  find "$root" -exec touch -h -d "$day UTC" {} +
  dpkg-deb --root-owner-group -Zxz --build "$root" "$folder/${package}_${version}_$arch.deb"
done
