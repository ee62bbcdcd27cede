# The commands of a working day. Each does all it needs, so that on a fresh Debian 12 machine `make demo`
# and `make test` are the only ones to know. JOBS=1 make test builds with one compiler at a time.
# ORACLE=1 make test also compares with LinuxCNC's interpreter, which it installs.
JOBS ?= $(shell nproc)
ORACLE ?= 0
PEERS_BLOCKS ?= 7200
BUILD = cmake --build --parallel $(JOBS)
DEMO_OUT = out/cone

.PHONY: help demo build test laws setup asan fuzz bench peers package format check-format tidy clean
.DEFAULT_GOAL := help

help:
	@echo 'make demo          set up, build, and run the main job: ends with a pass/fail table'
	@echo '                   and $(DEMO_OUT)/report.html'
	@echo 'make test          set up, build, and run every test, the laws with fewer random cases; with ORACLE=1'
	@echo '                   also those that compare NC programs with LinuxCNC, a package of 80 MB'
	@echo 'make laws          set up, build, and run every test, the laws at full length'
	@echo 'make build         set up and build; the program is build/frustum'
	@echo 'make asan          the tests under the address and undefined-behaviour sanitizers'
	@echo 'make fuzz          libFuzzer on NC dialects, plans, points, machines, jobs, FUZZ_SECONDS=600 each, JOBS at a time'
	@echo 'make bench         build and run the benchmarks'
	@echo 'make peers         time, memory and surface error beside Manifold, CGAL and a plain tri-dexel, some minutes;'
	@echo '                   PEERS_BLOCKS=720 for less, PEERS="--scene both --all" for more, MANIFOLD=where it is installed'
	@echo 'make package       a Debian package in build/package (what it holds: cmake/FrustumPackage.cmake)'
	@echo 'make format        format every source file; make check-format only looks'
	@echo 'make tidy          clang-tidy over the sources (make tidy FILES="core/pose.cpp" for some)'
	@echo 'make clean         remove build/ and out/'

setup:
	@scripts/setup $(if $(filter 1,$(ORACLE)),--with-oracle) $(if $(filter fuzz,$(MAKECMDGOALS)),--with-fuzz)

build/%/build.ninja: CMakePresets.json | setup
	cmake --preset $*

demo: build/release/build.ninja
	$(BUILD) --preset release --target frustum frustum_link
	build/frustum run examples/cone/job.toml --out $(DEMO_OUT)

build: build/release/build.ninja
	$(BUILD) --preset release

test: build
	ctest --preset release

laws: build
	ctest --preset laws

asan: build/asan/build.ninja
	$(BUILD) --preset asan
	ctest --preset asan

fuzz: build/fuzz/build.ninja
	$(BUILD) --preset fuzz
	JOBS=$(JOBS) scripts/fuzz

bench: build/bench/build.ninja
	$(BUILD) --preset bench --target frustum_bench frustum_nc_bench
	build/bench/bench/frustum_bench
	build/bench/bench/frustum_nc_bench

peers: build/bench/build.ninja
	cmake --preset bench $(if $(MANIFOLD),-DCMAKE_PREFIX_PATH=$(abspath $(MANIFOLD))) > /dev/null
	$(BUILD) --preset bench --target frustum_peers
	build/bench/bench/frustum_peers --blocks $(PEERS_BLOCKS) $(PEERS)

package: build
	cpack --config build/release/CPackConfig.cmake -B build/package

format:
	scripts/format

check-format:
	scripts/format --check

tidy: build/files/build.ninja
	JOBS=$(JOBS) scripts/tidy $(FILES)

clean:
	rm -rf build out
