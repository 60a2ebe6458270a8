FROM rust:1-slim-bookworm AS build
WORKDIR /build
# .dockerignore lets through what a build needs.
COPY . .
RUN cargo build --release --locked --bin voussoir

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
