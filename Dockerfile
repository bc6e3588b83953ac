# The program in an image: `docker build -t kinemark .`, and docs/install.md says how it is run. The program is static, so it runs alone
# beside a shell for scripts of a course.
FROM rust:1.95-bookworm AS built
RUN apt-get update -qq && apt-get install -y -qq --no-install-recommends musl-tools && rm -rf /var/lib/apt/lists/*
WORKDIR /source
COPY . .
# for the toolchain that rust-toolchain.toml selects, which is known here only
RUN rustup target add x86_64-unknown-linux-musl
RUN cargo build --release --locked --package kinemark --target x86_64-unknown-linux-musl

FROM debian:bookworm-slim
COPY --from=built /source/target/x86_64-unknown-linux-musl/release/kinemark /usr/local/bin/kinemark
# the caller's files are mounted here; the program needs no user of its own
WORKDIR /work
USER 65534:65534
ENTRYPOINT ["kinemark"]
