#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A container image of weft out of Debian packages, without a base image:  bash cmake/image.sh [BUILD] [OUT]
#   BUILD   a built tree (build/release); its package is made with cpack
#   OUT     where the image goes (weft-image.tar)
# Debian's packages come from where this machine's apt has them, or from WEFT_MIRROR (a line of sources.list, or
# file:///…, for machines without a network). With buildah the image is an OCI archive (podman load, docker load,
# skopeo copy); without it, the file system in a tar (podman import, docker import). Needs mmdebstrap; root is not needed.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(realpath "${1:-$root/build/release}")
out=$(realpath -m "${2:-weft-image.tar}")
command -v mmdebstrap > /dev/null || { echo "image.sh: mmdebstrap is missing: apt-get install mmdebstrap" >&2; exit 2; }
[ -f "$build/CPackConfig.cmake" ] || { echo "image.sh: $build is not a built tree: cmake --preset release && cmake --build --preset release" >&2; exit 2; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

(cd "$scratch" && cpack -G DEB --config "$build/CPackConfig.cmake" -B "$scratch/packages" > "$scratch/cpack.log") || { cat "$scratch/cpack.log" >&2; exit 1; }
deb=$(ls "$scratch"/packages/weft_*.deb)
# What the package depends on, by name: the shell and its tools are among the essential packages anyhow.
needs=$(dpkg-deb --field "$deb" Depends | tr ',' '\n' | sed 's/(.*//; s/|.*//; s/ //g' | paste -sd,)
mkdir "$scratch/in"
cp "$deb" "$scratch/in/weft.deb"

# Manuals, translations and the like are left out; licences stay.
mmdebstrap --quiet --variant=essential --hook-dir=/usr/share/mmdebstrap/hooks/merged-usr --include="usr-is-merged,$needs" \
  --dpkgopt='path-exclude=/usr/share/man/*' --dpkgopt='path-exclude=/usr/share/locale/*' --dpkgopt='path-exclude=/usr/share/info/*' \
  --dpkgopt='path-exclude=/usr/share/doc/*' --dpkgopt='path-include=/usr/share/doc/*/copyright' \
  --customize-hook="copy-in $scratch/in/weft.deb /tmp" --customize-hook='chroot "$1" dpkg --install /tmp/weft.deb' \
  --customize-hook='rm -rf "$1"/tmp/weft.deb "$1"/var/cache/* "$1"/var/log/*; mkdir -p "$1"/work' \
  --customize-hook='chroot "$1" weft --version' \
  bookworm "$scratch/root.tar" ${WEFT_MIRROR:+"$WEFT_MIRROR"}

if command -v buildah > /dev/null; then
  export STORAGE_DRIVER=vfs BUILDAH_ISOLATION=chroot
  store=(buildah --root "$scratch/store" --runroot "$scratch/run")
  if container=$("${store[@]}" from scratch 2> "$scratch/buildah.log") &&
    "${store[@]}" add "$container" "$scratch/root.tar" / > /dev/null 2>> "$scratch/buildah.log" &&
    "${store[@]}" config --workingdir /work --entrypoint '["weft"]' --cmd --help "$container" 2>> "$scratch/buildah.log" &&
    "${store[@]}" commit --quiet "$container" "oci-archive:$out:weft" > /dev/null 2>> "$scratch/buildah.log"; then
    echo "$out: OCI archive, $(($(stat -c %s "$out") >> 20)) MB packed, $(($(stat -c %s "$scratch/root.tar") >> 20)) MB unpacked; podman load -i $out"
    exit 0
  fi
  echo "image.sh: buildah does not run here: $(tail -1 "$scratch/buildah.log")" >&2
fi
mv "$scratch/root.tar" "$out"
echo "$out: file system, $(($(stat -c %s "$out") >> 20)) MB; podman import --change 'ENTRYPOINT [\"weft\"]' $out weft"
