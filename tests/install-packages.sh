#!/bin/sh
# install-packages.sh KIND... - install those packages of packages.txt that are missing, saying so.
# Needs root, or sudo. Does nothing, quickly, when all are there.
set -eu
here=$(dirname "$0")
want=
for kind in "$@"; do
  want="$want $(sed -n "s/^$kind: *//p" "$here/packages.txt")"
done
missing=
for p in $want; do
  case $(dpkg-query -W -f '${Status}' "$p" 2>/dev/null || true) in
    *" installed") ;;
    *) case " $missing " in *" $p "*) ;; *) missing="$missing $p" ;; esac ;;
  esac
done
[ -n "$missing" ] || exit 0
echo "meshgen needs these Debian packages, installing them with apt-get:$missing"
sudo=
if [ "$(id -u)" -ne 0 ]; then
  if command -v sudo >/dev/null 2>&1; then
    sudo=sudo
  else
    echo "not root and no sudo here; as root, type: apt-get install$missing" >&2
    exit 3
  fi
fi
export DEBIAN_FRONTEND=noninteractive
$sudo apt-get update -qq
# shellcheck disable=SC2086
$sudo apt-get install -y -qq --no-install-recommends $missing >/dev/null
