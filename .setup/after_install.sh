#!/usr/bin/env bash
# after_install.sh DESTDIR PREFIX LIBDIR: says what a user of the new installation has to know, and
# nothing where DESTDIR is set: that is a package.
set -u
[ -z "$1" ] || exit 0
prefix=$2 libdir=$3
echo "installed below $prefix; 'make uninstall PREFIX=$prefix' takes it away again"
case :$PATH: in *:"$prefix/bin":*) ;; *)
  echo "  the program:  export PATH=$prefix/bin:\$PATH"
  ;;
esac
case :$(pkg-config --variable pc_path pkg-config 2>/dev/null):${PKG_CONFIG_PATH:-}: in *:"$libdir/pkgconfig":*) ;; *)
  echo "  the library:  export PKG_CONFIG_PATH=$libdir/pkgconfig:\$PKG_CONFIG_PATH"
  ;;
esac
if command -v zsh >/dev/null 2>&1 &&
  ! zsh -f -c 'print -l $fpath' | grep -qxF "$prefix/share/zsh/site-functions"; then
  echo "  zsh completes:  fpath=($prefix/share/zsh/site-functions \$fpath)   # in .zshrc, before compinit"
fi
echo "  programs that are linked by pkg-config find it at run time (rpath), and so do those of CMake"
echo "  where they are built; for others"
if [ "$(id -u)" = 0 ] && { [ "$prefix" = /usr ] || grep -qsxF "$libdir" /etc/ld.so.conf /etc/ld.so.conf.d/*.conf; }; then
  if command -v ldconfig >/dev/null 2>&1 && ldconfig; then
    echo "  the loader knows it now (ldconfig was run)"
    exit 0
  fi
fi
echo "  'ldconfig' as root, where $libdir is one of the loader's folders, or LD_LIBRARY_PATH=$libdir"
