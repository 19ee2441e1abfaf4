# The program on a Debian that has nothing else: the steps of docs/install.md. docs/images.md says how it is used.
#   docker build --tag chironomia .
FROM debian:12
COPY . /chironomia
WORKDIR /chironomia
RUN tools/install_packages \
    && tools/build release programs man \
    && cmake --install build/release --prefix /usr/local \
    && rm -rf /chironomia /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["chironomia"]
CMD ["--help"]
