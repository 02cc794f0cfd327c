#!/usr/bin/env bash
# debian.sh BUILD SCRATCH: the Debian package of an existing build, unpacked elsewhere, runs, and depends on what it is linked with.
set -euo pipefail
build=$1 scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$scratch" > "$scratch/cpack.log" || { cat "$scratch/cpack.log"; exit 1; }
packages=("$scratch"/*.deb)
if [ ${#packages[@]} -ne 1 ]; then
  echo "expected one package, found: ${packages[*]}"
  exit 1
fi
depends=$(dpkg-deb --field "${packages[0]}" Depends)
for library in libc6 libdeal.ii libhdf5; do
  if ! grep -q "$library" <<< "$depends"; then
    echo "the package does not depend on $library: $depends"
    exit 1
  fi
done
maintainer=$(dpkg-deb --field "${packages[0]}" Maintainer)
if [ -z "$maintainer" ] || [[ $maintainer == *@localhost* ]]; then
  echo "the package's maintainer has no name, or an address that does not exist: '$maintainer'"
  exit 1
fi
dpkg-deb --extract "${packages[0]}" "$scratch/root"
if [ -e "$scratch/root/usr/include" ]; then
  echo "headers are for programs of one's own, not in this package"
  exit 1
fi
share=$scratch/root/usr/share
gzip -dc "$share/man/man1/breccia.1.gz" > "$scratch/page.1"
grep -q '^\.TH' "$scratch/page.1"
grep -q 'link.*test' "$scratch/page.1" # its hyphens are escaped
bash -n "$share/bash-completion/completions/breccia"
grep -q 'link-test' "$share/bash-completion/completions/breccia"
head -n 1 "$share/zsh/vendor-completions/_breccia" | grep -q '^#compdef breccia'
"$scratch/root/usr/bin/breccia" --version
"$scratch/root/usr/bin/breccia" link-test --help > "$scratch/help.txt"
grep -q -- --law "$scratch/help.txt"
rm -rf "$scratch"
