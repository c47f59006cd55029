#!/usr/bin/env bash
# Installs the Debian package of a build on a bare Debian of the release that this machine runs, from the
# sources that this machine uses, and does the main jobs there as an ordinary user; then the same with what
# that user unpacks into the own home, the package gone.
#
#   tests/package_bare.sh CPACK BUILD_FOLDER [ROOT]
#
# ROOT: a bare system made before by debootstrap; otherwise one is made and removed. Exit 77 where there is
# no root, no debootstrap or no source of packages.
set -uo pipefail
cpack=$1 build=$2 root=${3:-}
scratch=$(mktemp -d)
trap 'rm -rf --one-file-system "$scratch"' EXIT
fail() {
  echo "FAILED: $*" >&2
  tail -n 20 "$scratch/log" >&2
  exit 1
}
skip() {
  echo "skipped: $*"
  exit 77
}
[ "$(id -u)" -eq 0 ] || skip "not root"
if [ -z "$root" ]; then
  command -v debootstrap >/dev/null || skip "no debootstrap"
  release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
  mirror=$(apt-get indextargets --format '$(REPO_URI) $(CODENAME)' 'Created-By: Packages' |
    awk -v release="$release" '$2 == release { print $1; exit }')
  [ -n "$mirror" ] || skip "no source of packages of this release"
  root=$scratch/root
  debootstrap --variant=minbase "$release" "$root" "$mirror" >"$scratch/log" 2>&1 || fail "debootstrap"
fi
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }

(cd "$build" && "$cpack" -G DEB -B "$scratch/package") >"$scratch/log" 2>&1 || fail "no package was made"
package=$(ls "$scratch"/package/*.deb)
cp "$package" "$root/tmp/driftscope.deb"
cp /etc/resolv.conf "$root/etc/resolv.conf"
{ inside apt-get update && inside apt-get install -y --reinstall --no-install-recommends /tmp/driftscope.deb; } >"$scratch/log" 2>&1 ||
  fail "the package is not installed with what it depends on"
inside id lab >/dev/null 2>&1 || inside useradd -m lab

cat >"$root/tmp/smoke.sh" <<'SMOKE'
prefix=$1 PATH=$1/bin:$PATH
cd "$(mktemp -d)" || exit 1
[ "$(command -v driftscope)" = "$prefix/bin/driftscope" ] || { echo "found $(command -v driftscope)"; exit 1; }
configs=$prefix/share/driftscope/configs
expect() {  # EXIT CODE, COMMAND...
  wanted=$1; shift
  "$@" >said 2>&1; got=$?
  [ $got -eq "$wanted" ] || { echo "exit $got, expected $wanted: $*"; cat said; exit 1; }
}
expect 0 driftscope --version
expect 0 driftscope check $configs/cheap.toml
for format in csv h5 mat; do
  expect 0 driftscope simulate $configs/cheap.toml -o r.$format
  expect 0 driftscope identify $configs/cheap.toml r.$format -o identified.$format
  [ -s identified.$format/report.html ] || { echo "no report of r.$format"; exit 1; }
done
expect 0 driftscope run $configs/cheap.toml --runs 128 -o study --progress none
expect 0 driftscope verify study --sample 100%
for format in csv json hdf5; do expect 0 driftscope export study --format $format; done
expect 2 driftscope no-such-command
expect 3 driftscope check no-such-study.toml
expect 4 driftscope identify $configs/cheap.toml said -o broken
expect 6 driftscope run $configs/cheap.toml --runs 128 -o /study  # nobody but root may write there
expect 7 driftscope status .
rm -rf "$PWD"
SMOKE
inside su lab -c 'sh /tmp/smoke.sh /usr' >"$scratch/log" 2>&1 || fail "an ordinary user's job"
echo "bare Debian: $(inside driftscope --version | head -n 1), $(du -k "$package" | cut -f1) kB"

inside dpkg --remove driftscope >"$scratch/log" 2>&1 || fail "the package is not removed"
(cd "$build" && "$cpack" -G TGZ -B "$scratch/archive") >"$scratch/log" 2>&1 || fail "no archive was made"
cp "$scratch"/archive/*.tar.gz "$root/tmp/driftscope.tar.gz"
inside su lab -c 'mkdir -p ~/own && tar -xzf /tmp/driftscope.tar.gz -C ~/own --strip-components=1 && sh /tmp/smoke.sh ~/own' \
  >"$scratch/log" 2>&1 || fail "an ordinary user's job with an own prefix"
echo "the same without the package, from $(inside su lab -c 'echo ~/own')"
