# The short way in; CMake does the work.  `make help` lists the targets.

PREFIX ?= /usr/local
JOBS ?= $(shell nproc)
# One test more than processors, because some wait for other programs or for an event.
TESTS = $(shell expr $(JOBS) + 1)
PACKAGES = tools/install-packages.sh
C_FILES = $(shell find src paper include tests bench docs examples tools lab -name node_modules -prune -o \( -name '*.[ch]' -o -name '*.inl' -o -name '*.cpp' \) -print)

.PHONY: build demo lab test test-long reliability mutants bench install deb docs python-docs format check-format clean help

build: ## build build/festoon (optimised)
	@$(PACKAGES) build
	@cmake --preset release --log-level=WARNING
	@cmake --build build -j $(JOBS)

demo: ## simulate the paper's bead; table and figures in demo-results/
	@$(PACKAGES) demo
	@$(MAKE) --no-print-directory build
	build/festoon paper -o demo-results
	@echo
	@echo "Look at demo-results/report.html: the table above and the figures, which are also files of their own there."

lab: ## build/festoon-lab.html: the same physics as one offline page; skipped where its tools cannot be had
	@if $(PACKAGES) lab && lab/install-modules; then \
	    cmake --preset release --log-level=WARNING -DFESTOON_LAB=ON && cmake --build build -j $(JOBS) --target lab; \
	else \
	    echo "make lab: skipped, because Debian's or npm's packages for it could not be installed (see above)"; \
	fi

test: ## build and run the tests, but the long ones
	@$(PACKAGES) test
	@cmake --preset release --log-level=WARNING -DFESTOON_TESTS=ON
	@cmake --build build -j $(JOBS)
	@ctest --preset release -j $(TESTS)

test-long: ## run the long tests
	@$(PACKAGES) test-long
	@$(MAKE) --no-print-directory lab
	@cmake --preset release --log-level=WARNING -DFESTOON_TESTS=ON
	@cmake --build build -j $(JOBS)
	@ctest --preset release-long -j $(TESTS)

mutants: ## put faults into the code, one at a time, and count which ones the tests notice (hours)
	@$(PACKAGES) test
	@python3 tests/mutants/run.py --write -j $(JOBS)

CAMPAIGNS = kills rot power faults whole fuzz

reliability: ## attack what must not be lost, at full length; write docs/inside/reliability.md
	@$(PACKAGES) test-long
	@cmake --preset release --log-level=WARNING -DFESTOON_TESTS=ON
	@cmake --build build -j $(JOBS)
	@failed=; \
	for name in $(CAMPAIGNS); do \
	    script=tests/reliability/$$name.py; \
	    if [ ! -e $$script ]; then echo "$$script: there is no such campaign yet"; continue; fi; \
	    echo "$$script"; \
	    FESTOON="$(CURDIR)/build/festoon" SOURCE_DIR="$(CURDIR)" BUILD_DIR="$(CURDIR)/build" \
	        PYTHONPATH="$(CURDIR)/tests/helpers" \
	        python3 -B $$script --write; \
	    status=$$?; \
	    if [ $$status -eq 77 ]; then echo "$$script: skipped"; elif [ $$status -ne 0 ]; then failed="$$failed $$name"; fi; \
	done; \
	if [ -n "$$failed" ]; then echo "promises were broken:$$failed"; exit 1; fi

bench: ## time festoon against other integrators and AUTO-07p
	@$(PACKAGES) bench
	@cmake --preset release --log-level=WARNING -DFESTOON_BENCH=ON
	@cmake --build build -j $(JOBS) --target bench

install: ## install under $(DESTDIR)$(PREFIX), /usr/local unless told
	@$(PACKAGES) build
	@cmake --preset release --log-level=WARNING -DCMAKE_INSTALL_PREFIX=$(PREFIX)
	@cmake --build build -j $(JOBS)
	@DESTDIR=$(DESTDIR) cmake --install build

deb: ## Debian packages libfestoon0, libfestoon-dev, festoon and python3-festoon, in build-deb
	@$(PACKAGES) deb
	@tools/make-deb build-deb

docs: ## the API reference, in build/docs/html
	@$(PACKAGES) docs
	@cmake --preset release --log-level=WARNING
	@cmake --build build -j $(JOBS) --target docs
	@echo "Look at build/docs/html/index.html."

python-docs: ## guide, gallery and reference of the Python module, in build/docs/python
	@$(PACKAGES) python-docs
	@cmake --preset release --log-level=WARNING
	@cmake --build build -j $(JOBS) --target python-docs
	@echo "Look at build/docs/python/index.html."

format: ## lay the C sources out by .clang-format
	@$(PACKAGES) format
	@clang-format -i $(C_FILES)

check-format: ## complain about sources not laid out so
	@$(PACKAGES) format
	@clang-format --dry-run -Werror $(C_FILES)

clean: ## remove the build trees
	@rm -rf build build-*

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/make \1\t\2/p' Makefile | expand -t 20
