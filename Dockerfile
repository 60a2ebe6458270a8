# syntax=docker/dockerfile:1
# Whoever publishes images pins the two bases by digest, as in rust:1.95-slim-bookworm@sha256:... Digests are known to registries
# only: where there is none none can be looked up, so none is written here.
FROM rust:1.95-slim-bookworm AS build
WORKDIR /build
# The same sources give the same program: no time and no path of this machine is in it.
ENV SOURCE_DATE_EPOCH=0 CARGO_INCREMENTAL=0 \
    RUSTFLAGS="--remap-path-prefix=/build=. --remap-path-prefix=/usr/local/cargo=cargo"
# Dependencies first: this layer is built again only when they change. Cargo asks that every target of the manifest is there.
COPY Cargo.toml Cargo.lock build.rs ./
RUN set -eu; mkdir -p src benches tests/it tests/load; touch src/lib.rs; \
    for target in $(sed -n 's/^path = "\(.*\)"/\1/p; /^\[\[bench\]\]/,/^$/s/^name = "\(.*\)"/benches\/\1.rs/p' Cargo.toml); \
    do echo 'fn main() {}' > $target; done; \
    cargo build --release --locked --features postgres --bin voussoir
# .dockerignore lets through what a build needs. What was there before is older than it looks to cargo.
COPY . .
RUN touch src/lib.rs src/main.rs && cargo build --release --locked --features postgres --bin voussoir

FROM debian:bookworm-slim
RUN useradd --system --no-create-home --uid 10001 voussoir
COPY --from=build /build/target/release/voussoir /usr/local/bin/voussoir
USER 10001
ENV VOUSSOIR_BIND=0.0.0.0:8080
EXPOSE 8080
HEALTHCHECK --interval=10s --timeout=5s --start-period=2s CMD ["voussoir", "health"]
STOPSIGNAL SIGTERM
ENTRYPOINT ["voussoir"]
CMD ["serve"]
