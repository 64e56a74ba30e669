#!/usr/bin/env bash
# Brings the files of a walk that was measured, and of the models it was measured with, into a folder:
# fetch_opensim.sh FOLDER. They are not part of this project: the walk of one person of 85 kg (inverse
# kinematics of markers, adjusted to the forces of plates; Rajagopal and others 2016), the model scaled
# to that person and OpenSim's own inverse dynamics come from opensim-core (Apache 2.0), the model
# Rajagopal2016.osim, and two more that tests/import compares with OpenSim, from opensim-models (no licence
# file). One commit each, with checksums.
#
# By curl from GitHub, or, without a network, from clones: OPENSIM_CORE and OPENSIM_MODELS name them.
set -u
folder=${1:?a folder}
mkdir -p "$folder" || exit 1
core=0435b081dc383498e217f92ca63bb97616145c14
models=20a888b9655e73fb84963d6e03eee3752cf6074b
walking=OpenSim/Examples/Moco/example3DWalking

fetch() { # REPOSITORY COMMIT PATH CLONE SHA256
  local file part
  file=$folder/$(basename "$3")
  part=$file.part
  echo "$5  $file" | sha256sum -c --status 2>/dev/null && return
  if [ -n "$4" ]; then
    git -C "$4" show "$2:$3" >"$part" || return 1
  else
    curl -fsSL --retry 2 -o "$part" "https://raw.githubusercontent.com/$1/$2/$3" || return 1
  fi
  echo "$5  $part" | sha256sum -c --status || {
    echo "$3 is not what it was at $2" >&2
    return 1
  }
  mv "$part" "$file"
}
while read -r repository commit path clone sum; do
  [ "$clone" != - ] || clone=
  fetch "$repository" "$commit" "$path" "$clone" "$sum" || exit 1
done <<END
opensim-org/opensim-models $models Models/Rajagopal/Rajagopal2016.osim ${OPENSIM_MODELS:--} 3f5c5f23e486073f2ad2aa4a4967ffe2fcdd582b1e355512bc54f70c36376bf4
opensim-org/opensim-models $models Models/Gait2392_Simbody/gait2392_millard2012muscle.osim ${OPENSIM_MODELS:--} 9c28e8043cde59bb1354342d6f3ce0ca6a0ea416f08695c0db5387e46a8d464c
opensim-org/opensim-models $models Models/Gait10dof18musc/gait10dof18musc.osim ${OPENSIM_MODELS:--} 5131d69cd1fc934ab367bf5984b374acdb8a7d50e043ae21701019bab0f0222e
opensim-org/opensim-core $core $walking/coordinates.sto ${OPENSIM_CORE:--} 981e94b5d7bb6fcae403a381fee8c3011533d8c683b17460096b400d20044cdb
opensim-org/opensim-core $core $walking/subject_walk_scaled.osim ${OPENSIM_CORE:--} 806ad1b248c6b2bc48ab43b58865915d1664e144b4ff6846457d80adacc23ce5
opensim-org/opensim-core $core $walking/grf_walk.mot ${OPENSIM_CORE:--} 372d59855f80d7de81303cb7d3a5c5878ef8e0cb82a53a27cfce44e93357e42c
opensim-org/opensim-core $core $walking/grf_walk.xml ${OPENSIM_CORE:--} 3c5313d5680c52fd130a0ed86620472fe3c576a5a9599ed08a53652b84dd82e6
opensim-org/opensim-core $core $walking/id_walk.sto ${OPENSIM_CORE:--} 5eabf736a0f239b24eed4725289b5217b30d7fa0d88ad6f0f994cb33bdfd4515
END
echo "a measured walk, and models, are in $folder"
