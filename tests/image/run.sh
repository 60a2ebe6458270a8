#!/usr/bin/env bash
# Builds the image of the Dockerfile without a registry of images, and tries it. Its bases are made of Debian packages and of this
# machine's Rust. As root, on Debian with mmdebstrap and buildah:
#
#     tests/image/run.sh
#
# The program is built without optimisation, as what is tried here is the image. It is built twice, the second time after a change of
# a source that changes nothing of the program: the layer of the dependencies has to be taken as it was, and the program has to be the
# same. Needs 10 GB in the temporary folder (30 where overlays cannot be mounted).
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
export BUILDAH_ISOLATION=chroot
# Where overlays cannot be mounted, each layer is a copy of all below it.
driver=overlay
storage() { command buildah --storage-driver "$driver" --root "$work/images" --runroot "$work/run" "$@"; }
storage info > "$work/log" 2>&1 || driver=vfs
buildah() { storage "$@"; }
finish() {
    buildah rm --all > "$work/log" 2>&1 || true
    # What is mounted would be in the way.
    umount --quiet "$work"/images/overlay "$work"/images || true
    rm -rf "$work"
}
trap finish EXIT

# A base: its name, its packages, and what else is copied into it.
base() {
    local name=$1 packages=$2 container
    mmdebstrap --quiet --variant=minbase ${packages:+--include="$packages"} bookworm "$work/root.tar"
    container=$(buildah from scratch)
    buildah add --quiet "$container" "$work/root.tar" / > "$work/log"
    if [ "$name" != debian:bookworm-slim ]; then
        tar --directory "$(rustc --print sysroot)" --exclude ./share --create . > "$work/rust.tar"
        buildah add --quiet "$container" "$work/rust.tar" /usr/local > "$work/log"
        buildah config --env CARGO_HOME=/usr/local/cargo "$container"
    fi
    buildah commit --quiet --rm "$container" "docker.io/library/$name" > "$work/log"
}
base debian:bookworm-slim ""
base "$(sed -n 's/^FROM \(rust:[^ ]*\).*/\1/p' Dockerfile)" gcc,libc6-dev

# The sources, in a folder where they can be changed.
mkdir "$work/sources"
git ls-files -z | xargs -0 cp --parents --target-directory "$work/sources"

build() {
    buildah build --format docker --pull-never --layers --network host --volume "${CARGO_HOME:-$HOME/.cargo}/registry:/usr/local/cargo/registry" \
        --env CARGO_PROFILE_RELEASE_OPT_LEVEL=0 --tag voussoir "$work/sources" > "$work/log" 2>&1 || { tail -n 40 "$work/log"; exit 1; }
}
# The sum of the program in the image as it is now.
sum() {
    local container folder
    container=$(buildah from --pull-never voussoir)
    folder=$(buildah mount "$container")
    sha256sum < "$folder/usr/local/bin/voussoir"
    buildah rm "$container" > "$work/log"
}

echo 'built from nothing'
time build
first=$(sum)
echo '// The end.' >> "$work/sources/src/main.rs"
echo 'built after a change of a source'
time build
grep --after-context 2 'RUN set -eu; mkdir' "$work/log" | grep --quiet 'Using cache' || { echo 'the dependencies were built again'; exit 1; }
[ "$first" = "$(sum)" ] || { echo 'the same sources gave another program'; exit 1; }
echo "the layer of the dependencies was taken as it was; the program is the same: ${first%% *}"

image=$(buildah from --pull-never voussoir)
export VOUSSOIR_BIND=127.0.0.1:18099
run() { buildah run --network host --env VOUSSOIR_BIND=$VOUSSOIR_BIND --user 10001 "$image" -- "$@"; }
run voussoir --version
run voussoir serve --log warn &
for _ in $(seq 50); do
    run voussoir health && break
    sleep 0.2
done
curl --fail --silent --show-error --data-binary @cases/first-arch/request.json -H 'content-type: application/json' \
    -H 'prefer: wait=30' "http://$VOUSSOIR_BIND/v1/jobs" | grep --only-matching '"status":"successful"'
kill %1
wait %1 || true
folder=$(buildah mount "$image")
ls -l "$folder/usr/local/bin/voussoir"
du -sh "$folder"
