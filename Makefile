# The front door. `make fly` and `make test` work on a fresh Debian 12 that has g++, cmake, make and git.
BUILD ?= build
OUT ?= out
FLY ?= # further options of `welkin fly`, for instance FLY="--size 640x360"
CHECK ?= --json benchmarks/results/check-orbit.json # further options of scripts/check_orbit.py, for instance CHECK="--only speed --quick"
SKY ?= --json benchmarks/results/check-sky.json # further options of scripts/check_sky.py, for instance SKY="--only accuracy --quick"
ERROR ?= --json benchmarks/results/check-error.json # further options of scripts/check_error.py, for instance ERROR="--only near"
WINDOW ?= --json benchmarks/results/check-window.json # further options of scripts/check_window.py, for instance WINDOW="--only panels --quick"
TRUTH ?= # further options of scripts/make_truth.py, for instance TRUTH="--only space --force"
JOBS ?= $(shell nproc)

.PHONY: all help build fly test data setup extras check-orbit check-sky check-error check-window truth figures install format format-check clean
all: build

help: ## this list
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## /\1\t/' | expand -t 16

setup: ## install what is missing (Debian packages)
	@scripts/setup.sh

data: ## fetch the cover picture and the albedo of the Earth
	@scripts/fetch_data.sh

build: setup ## build the program into build/
	@scripts/build.sh $(BUILD) $(JOBS) OFF

fly: build data ## replay the flight from orbit to the ground into out/orbit-to-ground/
	@scripts/fly.sh $(BUILD) benchmarks/orbit-to-ground.json $(OUT)/orbit-to-ground $(FLY)

test: setup ## build and run all tests
	@scripts/build.sh $(BUILD) $(JOBS) ON
	@scripts/test.sh $(BUILD)

check-orbit: setup data ## what must hold for the flight, line by line
	@scripts/build.sh $(BUILD) $(JOBS) ON
	@/usr/bin/python3 scripts/check_orbit.py --build $(BUILD) --out $(OUT)/check-orbit $(CHECK)

check-sky: setup ## what must hold for the clear sky, line by line
	@scripts/build.sh $(BUILD) $(JOBS) ON
	@/usr/bin/python3 scripts/check_sky.py --build $(BUILD) --out $(OUT)/check-sky $(SKY)

check-error: setup data ## what must hold of error against run time, line by line
	@scripts/build.sh $(BUILD) $(JOBS) ON
	@/usr/bin/python3 scripts/check_error.py --build $(BUILD) --out $(OUT)/check-error $(ERROR)

check-window: setup data ## what must hold of the window, line by line, on a display of its own
	@scripts/build.sh $(BUILD) $(JOBS) ON
	@/usr/bin/python3 scripts/check_window.py --build $(BUILD) --out $(OUT)/check-window $(WINDOW)

truth: build ## make anew what has changed of the truth of the sky, tests/truth/sky/
	@/usr/bin/python3 scripts/make_truth.py --build $(BUILD) $(TRUTH)

figures: setup ## the figures of docs/, from benchmarks/results/
	@mkdir -p docs/figures
	@/usr/bin/python3 scripts/plot_sky.py benchmarks/results/check-sky.json -o docs/figures/sky-error.png
	@/usr/bin/python3 scripts/plot_converge.py benchmarks/results/converge-near.json -o docs/figures/converge.png

extras: build data ## the documented pictures at full size, and the zoom series
	@scripts/extras.sh $(BUILD) $(OUT)/pictures

install: build ## install to PREFIX (default /usr/local)
	@cmake --install $(BUILD) $(if $(PREFIX),--prefix $(PREFIX))

format: setup ## clang-format over the sources
	@scripts/format.sh -i

format-check: setup
	@scripts/format.sh --dry-run --Werror

clean: ## remove what was built
	rm -rf $(BUILD) $(OUT)
