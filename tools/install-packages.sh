#!/bin/sh
# Install the Debian packages that a make target needs and the machine lacks.
#
#   tools/install-packages.sh SET            SET: build demo lab test test-long bench docs format deb python python-docs ci
#   tools/install-packages.sh --list SET     print their names, a line each, and install nothing
#
# With nothing missing it costs a look into dpkg's database.  Otherwise it says what is missing and installs it,
# as root or by a sudo that asks nothing; failing both, it prints the command to run and ends with status 1.
set -eu

build_packages="gcc libc6-dev cmake ninja-build pkg-config libyaml-dev libjansson-dev libsqlite3-dev libhdf5-dev
    liblapacke-dev libcairo2-dev libopenmpi-dev libcminpack-dev libexpat1-dev"
demo_packages="$build_packages gnuplot-nox fonts-dejavu-core"
# The Python module; its tests need the second line too.
python_packages="python3-dev python3-cffi python3-numpy"
python_test_packages="$python_packages python3-pytest python3-matplotlib python3-pandas python3-xarray"
test_packages="$demo_packages $python_test_packages python3-h5py g++ libcmocka-dev libsundials-dev python3 auto-07p ffmpeg openmpi-bin"
# The page of the lab.  Where node and npm are there already, from wherever they came, they serve.
lab_packages="$build_packages clang-14 lld-14 wasi-libc libclang-rt-14-dev-wasm32 binaryen"
for program in node npm; do
    if ! command -v $program >/dev/null 2>&1; then
        case $program in
        node) lab_packages="$lab_packages nodejs" ;;
        npm) lab_packages="$lab_packages npm" ;;
        esac
    fi
done
# The pages of the Python module.
python_docs_packages="$python_test_packages python3-sphinx python3-sphinx-gallery furo python3-numpydoc python3-myst-parser"
# A Slurm of its own for the sweep under Slurm: the daemons run as root without systemd, in a container too.
long_packages="$test_packages $python_docs_packages python3-nbclient python3-nbformat python3-ipykernel
    python3-venv python3-pip mypy chromium slurmctld slurmd slurm-client munge"
bench_packages="$build_packages g++ gnuplot-nox libgsl-dev libboost-dev python3-scipy auto-07p libsiconos-numerics-dev
    libsundials-dev"
docs_packages="$build_packages doxygen"
format_packages="clang-format"
deb_packages="$build_packages $python_packages dpkg-dev debhelper dh-python lintian"
ci_packages="$long_packages make dpkg-dev debhelper dh-python lintian zsh fish clang libclang-rt-14-dev clang-format valgrind doxygen libgsl-dev libboost-dev librsvg2-bin"

only_list=
if [ "${1-}" = --list ]; then
    only_list=yes
    shift
fi
case "${1-}" in
build) wanted=$build_packages ;;
demo) wanted=$demo_packages ;;
lab) wanted=$lab_packages ;;
test) wanted=$test_packages ;;
test-long) wanted=$long_packages ;;
bench) wanted=$bench_packages ;;
docs) wanted=$docs_packages ;;
format) wanted=$format_packages ;;
deb) wanted=$deb_packages ;;
python) wanted="$build_packages $python_packages" ;;
python-docs) wanted="$build_packages $python_docs_packages" ;;
ci) wanted=$ci_packages ;;
*)
    echo "usage: $0 [--list] build|demo|lab|test|test-long|bench|docs|format|deb|python|python-docs|ci" >&2
    exit 2
    ;;
esac
if [ "$only_list" ]; then
    # shellcheck disable=SC2086 # the lists are meant to be split
    printf '%s\n' $wanted
    exit 0
fi

if ! command -v dpkg-query >/dev/null 2>&1; then
    echo "$0: this is no Debian system; the packages' Debian names are: $wanted" >&2
    exit 0
fi

# One query for all; packages that dpkg never heard of are complained about on standard error.
# shellcheck disable=SC2086 # the lists are meant to be split
installed=$(dpkg-query -W -f '${db:Status-Abbrev}${binary:Package}\n' $wanted 2>/dev/null |
    sed -n 's/^ii *\([^:]*\).*/\1/p')
missing=
for package in $wanted; do
    case "
$installed
" in
    *"
$package
"*) ;;
    *) missing="$missing $package" ;;
    esac
done
if [ -z "$missing" ]; then
    exit 0
fi
missing=${missing# }

if [ "$(id -u)" -eq 0 ]; then
    as_root=
elif sudo -n true 2>/dev/null; then
    as_root="sudo -n"
else
    echo "These Debian packages are missing. Install them and try again:" >&2
    echo "    sudo apt-get install --no-install-recommends $missing" >&2
    exit 1
fi

install_missing() {
    # shellcheck disable=SC2086
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing
}

echo "Installing the missing Debian packages: $missing"
# The package lists are fetched only where there are none, or where those at hand have grown stale.
if ! ls /var/lib/apt/lists/*_Packages* >/dev/null 2>&1; then
    $as_root apt-get update -q
    install_missing
elif ! install_missing; then
    $as_root apt-get update -q
    install_missing
fi
