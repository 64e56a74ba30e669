#!/usr/bin/env bash
# place.sh install|uninstall ROOT PREFIX: puts files below ROOT (DESTDIR, or nothing) and takes them
# away again. `install` reads lines of three fields from standard input, between tabs:
#
#   644|755      FILE of the sources    PATH, absolute, without ROOT
#   link         TARGET                 PATH
#
# What was placed, and which folders had to be made for it, is kept in share/ambulo/manifest below
# the prefix: `uninstall` removes these files, and these folders as far as they are empty, and
# nothing else. An install over an earlier one removes what only that one had.
# Neither install -D nor GNU options: BSD and macOS have other tools.
set -eu
action=$1 root=$2 prefix=$3
manifest=$root$prefix/share/ambulo/manifest
tab=$(printf '\t')
umask 022

# makes a folder and those above it; the new ones are written down, outer ones first
folder() {
  case $1 in '' | /) return ;; esac
  [ ! -d "$root$1" ] || return 0
  folder "$(dirname "$1")"
  mkdir "$root$1"
  printf 'folder\t%s\n' "$1" >>"$list"
}

remove_file() { rm -f "$root$1"; }
# folders that were made, inner ones first
remove_folders() {
  local at paths=()
  while IFS=$tab read -r kind at; do
    [ "$kind" != folder ] || paths=("$at" ${paths[@]+"${paths[@]}"})
  done <"$1"
  for at in ${paths[@]+"${paths[@]}"}; do rmdir "$root$at" 2>/dev/null || true; done
}

case $action in
install)
  list=$(mktemp)
  trap 'rm -f "$list"' EXIT
  [ ! -f "$manifest" ] || grep "^folder$tab" "$manifest" >"$list" || true
  [ -z "$root" ] || mkdir -p "$root"
  folder "$prefix/share/ambulo"
  while IFS=$tab read -r mode source path; do
    folder "$(dirname "$path")"
    # a new file in the place of the old one: a running program keeps its own
    rm -f "$root$path"
    if [ "$mode" = link ]; then
      ln -s "$source" "$root$path"
    else
      cp "$source" "$root$path"
      chmod "$mode" "$root$path"
    fi
    printf 'file\t%s\n' "$path" >>"$list"
  done
  if [ -f "$manifest" ]; then
    grep "^file$tab" "$manifest" | grep -vxFf "$list" | while IFS=$tab read -r _ path; do
      remove_file "$path"
    done || true
  fi
  cp "$list" "$manifest"
  chmod 644 "$manifest"
  ;;
uninstall)
  if [ ! -f "$manifest" ]; then
    echo "nothing is installed below $root$prefix (no share/ambulo/manifest)" >&2
    exit 1
  fi
  list=$(mktemp)
  trap 'rm -f "$list"' EXIT
  cp "$manifest" "$list"
  while IFS=$tab read -r kind path; do
    [ "$kind" != file ] || remove_file "$path"
  done <"$list"
  remove_file "$prefix/share/ambulo/manifest"
  remove_folders "$list"
  ;;
*)
  echo "place.sh: '$action'; expected install or uninstall" >&2
  exit 2
  ;;
esac
