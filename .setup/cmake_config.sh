#!/usr/bin/env bash
# cmake_config.sh VERSION PREFIX LIBDIR LIBS FOLDER: what find_package(ambulo) reads, into FOLDER:
# ambulo-config.cmake and ambulo-config-version.cmake, for LIBDIR/cmake/ambulo. LIBS: linker options of
# what the static library needs.
#
# Places are seen from the file itself, so that an installation may be moved; only where the libraries
# are outside the prefix is the folder of the headers written out.
set -eu
version=$1 prefix=$2 libdir=$3 libs=$4 folder=$5
case $libdir in
"$prefix"/*)
  up=$(echo "${libdir#"$prefix"/}" | awk -F / '{ for (i = 1; i <= NF; i++) if ($i != "") printf "/.." }')
  include="\${_ambulo_lib}$up/include"
  ;;
*) include=$prefix/include ;;
esac
# one list item an option
items=$(echo "$libs" | tr -s ' ' ';' | sed 's/^;//; s/;$//')

cat >"$folder/ambulo-config.cmake" <<END
# find_package(ambulo $version) gives
#   ambulo::ambulo         the shared library
#   ambulo::ambulo_static  libambulo.a with what it needs
get_filename_component(_ambulo_lib "\${CMAKE_CURRENT_LIST_DIR}/../.." REALPATH)
get_filename_component(_ambulo_include "$include" REALPATH)

if(NOT TARGET ambulo::ambulo)
  find_library(_ambulo_shared NAMES ambulo PATHS "\${_ambulo_lib}" NO_DEFAULT_PATH NO_CACHE)
  if(_ambulo_shared)
    add_library(ambulo::ambulo SHARED IMPORTED)
    set_target_properties(ambulo::ambulo PROPERTIES
      IMPORTED_LOCATION "\${_ambulo_shared}"
      INTERFACE_INCLUDE_DIRECTORIES "\${_ambulo_include}")
  endif()
  unset(_ambulo_shared)
endif()
if(NOT TARGET ambulo::ambulo_static)
  add_library(ambulo::ambulo_static STATIC IMPORTED)
  set_target_properties(ambulo::ambulo_static PROPERTIES
    IMPORTED_LOCATION "\${_ambulo_lib}/libambulo.a"
    INTERFACE_LINK_LIBRARIES "$items"
    INTERFACE_INCLUDE_DIRECTORIES "\${_ambulo_include}")
endif()
unset(_ambulo_lib)
unset(_ambulo_include)
END

# before 1.0 each minor version may change the interface
cat >"$folder/ambulo-config-version.cmake" <<END
set(PACKAGE_VERSION "$version")
if(PACKAGE_VERSION VERSION_LESS PACKAGE_FIND_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
else()
  string(REGEX REPLACE "^([0-9]+\\\\.[0-9]+).*" "\\\\1" _ambulo_series "$version")
  set(_ambulo_wanted "\${PACKAGE_FIND_VERSION_MAJOR}.\${PACKAGE_FIND_VERSION_MINOR}")
  if(NOT PACKAGE_FIND_VERSION OR PACKAGE_FIND_VERSION_COUNT LESS 2 OR _ambulo_series STREQUAL _ambulo_wanted
     OR (PACKAGE_FIND_VERSION_MAJOR GREATER 0 AND "$version" MATCHES "^\${PACKAGE_FIND_VERSION_MAJOR}\\\\."))
    set(PACKAGE_VERSION_COMPATIBLE TRUE)
  else()
    set(PACKAGE_VERSION_COMPATIBLE FALSE)
  endif()
  if(PACKAGE_FIND_VERSION STREQUAL PACKAGE_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
  endif()
endif()
END
