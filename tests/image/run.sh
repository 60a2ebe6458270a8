#!/usr/bin/env bash
# Builds the image of the Dockerfile without a registry of images, and tries it. Its bases are made of Debian packages and of this
# machine's Rust. As root, on Debian with mmdebstrap and buildah:
#
#     tests/image/run.sh
#
# The program is built without optimisation, as what is tried here is the image. What a second build takes is printed, too.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
export BUILDAH_ISOLATION=chroot
buildah() { command buildah --storage-driver vfs --root "$work/images" --runroot "$work/run" "$@"; }
finish() { buildah rm --all > "$work/log" 2>&1 || true; rm -rf "$work"; }
trap finish EXIT

# A base: its name, its packages, and what else is copied into it.
base() {
    local name=$1 packages=$2 container
    mmdebstrap --quiet --variant=minbase ${packages:+--include="$packages"} bookworm "$work/root.tar"
    container=$(buildah from scratch)
    buildah add --quiet "$container" "$work/root.tar" / > "$work/log"
    if [ "$name" != debian:bookworm-slim ]; then
        buildah copy --quiet "$container" "$(rustc --print sysroot)" /usr/local > "$work/log"
        buildah config --env CARGO_HOME=/usr/local/cargo "$container"
    fi
    buildah commit --quiet --rm "$container" "docker.io/library/$name" > "$work/log"
}
base debian:bookworm-slim ""
base "$(sed -n 's/^FROM \(rust:[^ ]*\).*/\1/p' Dockerfile)" gcc,libc6-dev

build() {
    buildah build --pull-never --layers --network host --volume "${CARGO_HOME:-$HOME/.cargo}/registry:/usr/local/cargo/registry" \
        --env CARGO_PROFILE_RELEASE_OPT_LEVEL=0 --tag voussoir . > "$work/log" 2>&1 || { tail -n 40 "$work/log"; exit 1; }
}
time build
# A change of a source leaves the layer of the dependencies as it is.
time build
grep -c 'Using cache' "$work/log"

image=$(buildah from --pull-never voussoir)
run() { buildah run --network host --user 10001 "$image" -- "$@"; }
run voussoir --version
VOUSSOIR_BIND=127.0.0.1:18099
buildah run --network host --env VOUSSOIR_BIND=$VOUSSOIR_BIND --user 10001 "$image" -- voussoir serve --log warn &
for _ in $(seq 50); do
    buildah run --network host --env VOUSSOIR_BIND=$VOUSSOIR_BIND "$image" -- voussoir health && break
    sleep 0.2
done
curl --fail --silent --show-error --data-binary @cases/first-arch/request.json -H 'content-type: application/json' \
    -H 'prefer: wait=30' "http://$VOUSSOIR_BIND/v1/jobs"
kill %1
wait %1 || true
buildah mount "$image" | xargs -I{} sh -c 'ls -l {}/usr/local/bin/voussoir; du -sh {}'
